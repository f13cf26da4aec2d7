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

/* The texel of a column from the left and a row from below; pictures repeat. */
static vec texel(const rt_scene *scene, const rt_texture *t, real column, real row)
{
    const real width = (real)t->width, height = (real)t->height;
    const size_t x = (size_t)(column - width * FLOOR(column / width));
    const size_t y = (size_t)(t->height - 1) - (size_t)(row - height * FLOOR(row / height));
    const uint32_t bits = scene->texels[(size_t)t->first + y * (size_t)t->width + x];
    return (vec){(real)(bits & 255) / 255, (real)(bits >> 8 & 255) / 255,
                 (real)(bits >> 16 & 255) / 255};
}

static vec mixed(vec a, vec b, real part)
{
    return add_scaled(minus(b, a), part, a);
}

/* Texel (i, j) has its centre at (i + 1/2, j + 1/2) from the lower left. */
static vec picture(const rt_scene *scene, const rt_material *m, real u, real v)
{
    const rt_texture *t = &scene->textures[m->texture];
    const real across = (u - FLOOR(u)) * (real)t->width;
    const real up = (v - FLOOR(v)) * (real)t->height;
    if (m->nearest)
        return texel(scene, t, FLOOR(across), FLOOR(up));
    const real half = (real)0.5;
    const real left = FLOOR(across - half), low = FLOOR(up - half);
    const real to_right = across - half - left, to_top = up - half - low;
    const vec below = mixed(texel(scene, t, left, low), texel(scene, t, left + 1, low), to_right);
    const vec above =
        mixed(texel(scene, t, left, low + 1), texel(scene, t, left + 1, low + 1), to_right);
    return mixed(below, above, to_top);
}

vec NAME(pattern)(const rt_scene *scene, const surface *s)
{
    const rt_material *m = s->material;
    vec color = {1, 1, 1};
    if (m->cell > 0 && is_odd_cell(s->within, (real)m->cell))
        color = vec_of(m->checker_r, m->checker_g, m->checker_b);
    if (m->texture >= 0)
        color = product(color, picture(scene, m, s->u, s->v));
    return color;
}
