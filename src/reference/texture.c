/* The patterns of the scalar reference: the checker and pictures. */
#include "reference/effects.h"
#include "reference/margins.h"

/* 1 where the coordinate's cell has an odd number, else 0. Cells are centred on the multiples of
 * their size, so that a plane at a whole multiple lies in the middle of them; a plane between them
 * is the lower side of a cell. Numbers that are too large to be odd, and infinite ones, are even.
 */
static int oddness(real coordinate, real size)
{
    const real half = (real)0.5;
    const real place = coordinate / size;
    const real cell = FLOOR(FMA(FABS(place), CELL_MARGIN, place) + half);
    return cell - 2 * FLOOR(cell * half) > half;
}

static bool is_odd_cell(vec point, real size)
{
    return (oddness(point.x, size) + oddness(point.y, size) + oddness(point.z, size)) % 2 == 1;
}

/* An axis of a picture: so many texels, beyond which it begins again or stays as it is. */
typedef struct axis {
    int texels;
    bool is_clamped;
} axis;

/* In texels from the picture's edge; huge numbers are whole. */
static real place_on(axis a, real coordinate)
{
    const real last = (real)a.texels;
    if (a.is_clamped)
        return coordinate > 1 ? last : coordinate > 0 ? coordinate * last : 0;
    const real part = coordinate - FLOOR(coordinate);
    return isfinite(part) ? part * last : 0;
}

/* The texel of a number that is at most one beyond either end. */
static size_t texel_on(axis a, real number)
{
    const int end = a.texels - 1;
    if (number < 0)
        return (size_t)(a.is_clamped ? 0 : end);
    if (number > (real)end)
        return (size_t)(a.is_clamped ? end : 0);
    return (size_t)number;
}

/* The texel of a column from the left and a row from below. */
static vec texel(const rt_scene *scene, const rt_texture *t, size_t column, size_t row)
{
    const size_t line = (size_t)t->height - 1 - row;
    const uint32_t bits = scene->texels[(size_t)t->first + line * (size_t)t->width + column];
    return (vec){(real)(bits & 255) / 255, (real)(bits >> 8 & 255) / 255,
                 (real)(bits >> 16 & 255) / 255};
}

static vec mixed(vec a, vec b, real part)
{
    return add_scaled(minus(b, a), part, a);
}

/* Texel (i, j) has its centre at (i + 1/2, j + 1/2) from the lower left. */
static vec picture(const rt_scene *scene, const surface *s)
{
    const rt_material *m = s->material;
    const rt_texture *t = &scene->textures[m->texture];
    const axis columns = {t->width, m->clamp && !s->is_globe};
    const axis rows = {t->height, m->clamp || s->is_globe};
    const real across = place_on(columns, s->u), up = place_on(rows, s->v);
    if (m->nearest)
        return texel(scene, t, texel_on(columns, FLOOR(across)), texel_on(rows, FLOOR(up)));
    const real half = (real)0.5;
    const real left = FLOOR(across - half), low = FLOOR(up - half);
    const real to_right = across - half - left, to_top = up - half - low;
    const size_t x0 = texel_on(columns, left), x1 = texel_on(columns, left + 1);
    const size_t y0 = texel_on(rows, low), y1 = texel_on(rows, low + 1);
    const vec below = mixed(texel(scene, t, x0, y0), texel(scene, t, x1, y0), to_right);
    const vec above = mixed(texel(scene, t, x0, y1), texel(scene, t, x1, y1), to_right);
    return mixed(below, above, to_top);
}

vec NAME(pattern)(const rt_scene *scene, const surface *s)
{
    const rt_material *m = s->material;
    vec color = {1, 1, 1};
    if (m->cell > 0 && is_odd_cell(s->within, (real)m->cell))
        color = vec_of(m->checker_r, m->checker_g, m->checker_b);
    if (m->texture >= 0)
        color = product(color, picture(scene, s));
    return color;
}
