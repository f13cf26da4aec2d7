/* The patterns of the scalar reference: the checker and pictures. */
#include "scalar_effects.h"

/* Cells are centred on the multiples of their size, so that a plane at a whole multiple lies in the
 * middle of them and not on a border, where rounding would choose. */
static bool is_odd_cell(vec point, real size)
{
    const real half = (real)0.5;
    const real cell =
        FLOOR(point.x / size + half) + FLOOR(point.y / size + half) + FLOOR(point.z / size + half);
    return cell - 2 * FLOOR(cell * half) != 0;
}

/* Pictures repeat; row 0 is the top. */
static vec texel(const rt_scene *scene, const rt_texture *t, real column, real row)
{
    const real width = (real)t->width, height = (real)t->height;
    const size_t x = (size_t)FMIN(column - width * FLOOR(column / width), width - 1);
    const size_t y = (size_t)FMIN(row - height * FLOOR(row / height), height - 1);
    const uint32_t bits = scene->texels[(size_t)t->first + y * (size_t)t->width + x];
    return (vec){(real)(bits & 255) / 255, (real)(bits >> 8 & 255) / 255,
                 (real)(bits >> 16 & 255) / 255};
}

static vec mixed(vec a, vec b, real part)
{
    return add_scaled(minus(b, a), part, a);
}

/* Texel (i, j) has its centre at column i + 1/2, row j + 1/2. */
static vec picture(const rt_scene *scene, const rt_material *m, real u, real v)
{
    const rt_texture *t = &scene->textures[m->texture];
    const real column = (u - FLOOR(u)) * (real)t->width;
    const real row = (1 - (v - FLOOR(v))) * (real)t->height;
    if (m->nearest)
        return texel(scene, t, FLOOR(column), FLOOR(row));
    const real left = FLOOR(column - (real)0.5), above = FLOOR(row - (real)0.5);
    const real across = column - (real)0.5 - left, down = row - (real)0.5 - above;
    const vec upper = mixed(texel(scene, t, left, above), texel(scene, t, left + 1, above), across);
    const vec lower =
        mixed(texel(scene, t, left, above + 1), texel(scene, t, left + 1, above + 1), across);
    return mixed(upper, lower, down);
}

vec NAME(pattern)(const rt_scene *scene, const surface *s)
{
    const rt_material *m = s->material;
    vec color = {1, 1, 1};
    if (m->cell > 0 && is_odd_cell(s->point, (real)m->cell))
        color = vec_of(m->checker_r, m->checker_g, m->checker_b);
    if (m->texture >= 0)
        color = product(color, picture(scene, m, s->u, s->v));
    return color;
}
