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

/* Corners whose sizes are together so many times those of the ray's origin and the point are far
 * away. */
#define FAR 64
#define POINT_DRAW (256 * HALF_ULP)

static real total(vec a)
{
    return a.x + a.y + a.z;
}

/* An edge of moderate length: exact as value and rest. */
typedef struct edge {
    vec value, rest;
} edge;

static edge edge_of(vec to, vec from)
{
    const twofold x = sum_of(to.x, -from.x), y = sum_of(to.y, -from.y), z = sum_of(to.z, -from.z);
    const vec value = {x.value, y.value, z.value}, rest = {x.rest, y.rest, z.rest};
    return (edge){value, rest};
}

static edge moderate_edge(edge e)
{
    const int k = moderating_exponent(e.value);
    return (edge){scaled(e.value, k), scaled(e.rest, k)};
}

/* a b - c d, to be made up by its rest. */
static twofold difference_of(real a, real b, real c, real d)
{
    const twofold left = product_of(a, b), right = product_of(c, d);
    const twofold all = sum_of(left.value, -right.value);
    return (twofold){all.value, all.rest + (left.rest - right.rest)};
}

/* How far `point` is off the plane, along the unit normal, as if in twice the precision; in
 * `doubt`, what that can be off. */
static real off_plane(vec point, vec a, vec b, vec c, vec normal, real *doubt)
{
    const edge f = edge_of(point, a);
    const edge g = moderate_edge(edge_of(b, a)), h = moderate_edge(edge_of(c, a));
    const twofold x = difference_of(g.value.y, h.value.z, g.value.z, h.value.y);
    const twofold y = difference_of(g.value.z, h.value.x, g.value.x, h.value.z);
    const twofold z = difference_of(g.value.x, h.value.y, g.value.y, h.value.x);
    const vec n = {x.value, y.value, z.value}, rest = {x.rest, y.rest, z.rest};
    const vec low = plus(rest, plus(cross(g.rest, h.value), cross(g.value, h.rest)));
    const twofold fx = product_of(f.value.x, n.x), fy = product_of(f.value.y, n.y),
                  fz = product_of(f.value.z, n.z);
    const twofold xy = sum_of(fx.value, fy.value);
    const twofold xyz = sum_of(xy.value, fz.value);
    const real volume = xyz.value + (((xy.rest + xyz.rest) + (fx.rest + fy.rest + fz.rest)) +
                                     (dot(f.value, low) + dot(f.rest, n)));
    const real inverse = (real)1 / dot(n, normal);
    const vec m = magnitudes(f.value);
    *doubt = 512 * HALF_ULP * HALF_ULP * (FMAX(m.x, FMAX(m.y, m.z)) * inverse);
    return volume * inverse;
}

/* Where corners are far away beside the point, their sum by weight is anywhere within a rounding of
 * theirs: next rays start on the plane below the point. */
static void start_below_point(const rt_triangle *triangle, const ray *r, vec normal, vec sizes,
                              surface *s)
{
    const real far = total(sizes);
    const vec near = magnitudes(s->point);
    const real size =
        FABS(r->origin.x) + FABS(r->origin.y) + FABS(r->origin.z) + near.x + near.y + near.z;
    if (!(far > FAR * size))
        return;
    const vec a = triangle_corner(triangle, 0), b = triangle_corner(triangle, 1),
              c = triangle_corner(triangle, 2);
    const vec inward = add_scaled(plus(plus(a, b), c), (real)1 / 3, times(s->point, -1));
    const vec point =
        add_scaled(inward, POINT_DRAW * LDEXP(size, moderating_exponent(sizes)), s->point);
    real doubt;
    const real off = off_plane(point, a, b, c, normal, &doubt);
    s->foot = add_scaled(normal, -off, point);
    s->lift = FMA(START_BOUND, dot(magnitudes(point), magnitudes(normal)), doubt);
}

surface NAME(surface_of_triangle)(const rt_scene *scene, const ray *r, size_t i, const hit *h)
{
    const rt_triangle *triangle = &scene->triangles[i];
    surface s = {.material = NULL};
    s.point = add_scaled(r->direction, h->t, r->origin);
    const vec normal = triangle_normal(triangle);
    NAME(face)(&s, normal, r->direction);
    const vec a = triangle_corner(triangle, 0);
    const vec b = triangle_corner(triangle, 1);
    const vec c = triangle_corner(triangle, 2);
    s.within = within_corners(triangle, s.point);
    const real to_b = drawn(h->u), to_c = drawn(h->v);
    s.foot = add_scaled(c, to_c, add_scaled(b, to_b, times(a, (real)1 - to_b - to_c)));
    const vec sizes = plus(plus(magnitudes(a), magnitudes(b)), magnitudes(c));
    s.lift = NAME(lift_for)(START_BOUND, sizes, s.facing);
    if (is_robust(scene))
        start_below_point(triangle, r, normal, sizes, &s);
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
