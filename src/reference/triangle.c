/* Triangles of the scalar reference; their robust test is in watertight.c. */
#include "reference/effects.h"

#define START_DRAW (32 * HALF_ULP)

void NAME(box_of_triangle)(const rt_triangle *t, float lo[3], float hi[3])
{
    const float corners[3][3] = {
        {t->ax, t->ay, t->az}, {t->bx, t->by, t->bz}, {t->cx, t->cy, t->cz}};
    for (int i = 0; i < 3; ++i) {
        lo[i] = fminf(corners[0][i], fminf(corners[1][i], corners[2][i]));
        hi[i] = fmaxf(corners[0][i], fmaxf(corners[1][i], corners[2][i]));
    }
}

/* Moller and Trumbore 1997. */
bool NAME(meet_triangle)(const rt_scene *scene, const ray *r, size_t i, hit *h)
{
    const rt_triangle *triangle = &scene->triangles[i];
    const int cull = rt_scene_cull_sign(scene);
    if (is_robust(scene))
        return NAME(meet_watertight)(triangle, r, cull, h);
    const vec a = vec_of(triangle->ax, triangle->ay, triangle->az);
    const vec e1 = minus(vec_of(triangle->bx, triangle->by, triangle->bz), a);
    const vec e2 = minus(vec_of(triangle->cx, triangle->cy, triangle->cz), a);
    const vec p = cross(r->direction, e2);
    const vec s = minus(r->origin, a);
    const vec q = cross(s, e1);
    real det = dot(e1, p);
    real u = dot(s, p);
    real v = dot(r->direction, q);
    real t = dot(e2, q);
    if ((cull > 0 && !(det > 0)) || (cull < 0 && !(det < 0)))
        return false;
    if (det < 0) {
        det = -det;
        u = -u;
        v = -v;
        t = -t;
    }
    if (!(det > 0 && u >= 0 && v >= 0 && u + v <= det))
        return false;
    h->t = t / det;
    h->u = u / det;
    h->v = v / det;
    return true;
}

static vec triangle_corner(const rt_triangle *t, int corner)
{
    return corner == 0   ? vec_of(t->ax, t->ay, t->az)
           : corner == 1 ? vec_of(t->bx, t->by, t->bz)
                         : vec_of(t->cx, t->cy, t->cz);
}

/* On the side from which the corners run counter-clockwise. */
static vec triangle_normal(const rt_triangle *t)
{
    const vec a = triangle_corner(t, 0);
    const vec e1 = minus(triangle_corner(t, 1), a), e2 = minus(triangle_corner(t, 2), a);
    return unit(cross(moderate(e1), moderate(e2)));
}

/* The vertex normals weighed by u and v, on the side of the geometric normal `facing`. */
static vec interpolated_normal(const float *n, real u, real v, vec facing)
{
    const vec na = vec_of(n[0], n[1], n[2]);
    const vec nb = vec_of(n[3], n[4], n[5]);
    const vec nc = vec_of(n[6], n[7], n[8]);
    const vec sum = add_scaled(nc, v, add_scaled(nb, u, times(na, (real)1 - u - v)));
    const vec normal = unit(sum);
    const real side = dot(normal, facing);
    if (!isfinite(side))
        return facing;
    return side < 0 ? times(normal, -1) : normal;
}

/* The point for patterns: in the box of the corners. */
static vec within_corners(const rt_triangle *triangle, vec point)
{
    float lo[3], hi[3];
    NAME(box_of_triangle)(triangle, lo, hi);
    return NAME(into_box)(point, vec_of(lo[0], lo[1], lo[2]), vec_of(hi[0], hi[1], hi[2]));
}

/* A weight of a corner, a little nearer to the triangle's middle. */
static real drawn(real weight)
{
    return FMA(START_DRAW, (real)1 / 3 - weight, weight);
}

surface NAME(surface_of_triangle)(const rt_scene *scene, const ray *r, size_t i, const hit *h)
{
    const rt_triangle *triangle = &scene->triangles[i];
    surface s = {.material = NULL};
    s.point = add_scaled(r->direction, h->t, r->origin);
    NAME(face)(&s, triangle_normal(triangle), r->direction);
    const vec a = triangle_corner(triangle, 0);
    const vec b = triangle_corner(triangle, 1);
    const vec c = triangle_corner(triangle, 2);
    s.within = within_corners(triangle, s.point);
    const real to_b = drawn(h->u), to_c = drawn(h->v);
    s.foot = add_scaled(c, to_c, add_scaled(b, to_b, times(a, (real)1 - to_b - to_c)));
    s.lift = NAME(lift_for)(START_BOUND, plus(plus(magnitudes(a), magnitudes(b)), magnitudes(c)),
                            s.facing);
    if (scene->triangle_normals[i] >= 0) {
        const float *n = scene->normals + RT_NORMAL_COMPONENTS * (size_t)scene->triangle_normals[i];
        s.normal = interpolated_normal(n, h->u, h->v, s.facing);
    }
    if (scene->triangle_uvs && scene->triangle_uvs[i] >= 0) {
        const float *t = scene->uvs + RT_UV_COMPONENTS * (size_t)scene->triangle_uvs[i];
        const real w = (real)1 - h->u - h->v;
        s.u = FMA((real)t[4], h->v, FMA((real)t[2], h->u, (real)t[0] * w));
        s.v = FMA((real)t[5], h->v, FMA((real)t[3], h->u, (real)t[1] * w));
    }
    return s;
}
