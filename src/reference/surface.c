/* The surfaces of the scalar reference: what is known of the point that a ray hits, and where the
 * rays start that go on from there.
 *
 * A start comes from the primitive, since t would bring in the error of the whole way, and stands
 * off it by what rounding can do at most: a multiple of half an ulp of the numbers that went in
 * (kernels/shading/surface.cl says which roundings those are). */
#include "reference/effects.h"

#define START_BOUND (8 * HALF_ULP)
#define START_DRAW (32 * HALF_ULP)
#define POINT_BOUND (32 * HALF_ULP)

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

/* Turns a geometric normal that points outward to the side that the ray comes from. */
static void face(surface *s, vec outward, vec direction)
{
    s->from_outside = !(dot(outward, direction) > 0);
    s->facing = s->from_outside ? outward : times(outward, -1);
    s->normal = s->facing;
}

static vec magnitudes(vec a)
{
    return (vec){FABS(a.x), FABS(a.y), FABS(a.z)};
}

/* How far a box reaches along the normal whose half sides are the bound times `sizes`. */
static real lift_for(real bound, vec sizes, vec normal)
{
    return bound * dot(sizes, magnitudes(normal));
}

/* A weight of a corner, a little nearer to the triangle's middle. */
static real drawn(real weight)
{
    return FMA(START_DRAW, (real)1 / 3 - weight, weight);
}

static surface on_sphere(const rt_scene *scene, const ray *r, const hit *h)
{
    const real pi = (real)3.14159265358979323846;
    const rt_sphere *sphere = &scene->spheres[h->primitive];
    const vec center = vec_of(sphere->cx, sphere->cy, sphere->cz);
    surface s = {.material_index = scene->sphere_materials[h->primitive]};
    s.point = add_scaled(r->direction, h->t, r->origin);
    const vec outward = unit(minus(s.point, center));
    face(&s, outward, r->direction);
    const real radius = (real)sphere->radius;
    s.foot = add_scaled(outward, radius, center);
    s.lift =
        lift_for(START_BOUND, add_scaled(magnitudes(outward), radius, magnitudes(center)), outward);
    if (is_robust(scene)) {
        /* t is good to a few ulp: near a huge sphere the point on the ray is the better one. */
        const vec sizes = plus(magnitudes(r->origin), magnitudes(s.point));
        const real lift = lift_for(POINT_BOUND, sizes, outward);
        if (lift < s.lift) {
            s.foot = s.point;
            s.lift = lift;
        }
    }
    /* Longitude from the z axis, latitude from the south pole up. */
    s.u = ATAN2(outward.x, outward.z) / (2 * pi) + (real)0.5;
    s.v = ASIN(FMAX(-1, FMIN(outward.y, 1))) / pi + (real)0.5;
    return s;
}

static surface on_triangle(const rt_scene *scene, const ray *r, const hit *h)
{
    const int i = h->primitive - (int)scene->sphere_count;
    const rt_triangle *triangle = &scene->triangles[i];
    surface s = {.material_index = scene->triangle_materials[i]};
    s.point = add_scaled(r->direction, h->t, r->origin);
    face(&s, triangle_normal(triangle), r->direction);
    const vec a = triangle_corner(triangle, 0);
    const vec b = triangle_corner(triangle, 1);
    const vec c = triangle_corner(triangle, 2);
    const real to_b = drawn(h->u), to_c = drawn(h->v);
    s.foot = add_scaled(c, to_c, add_scaled(b, to_b, times(a, (real)1 - to_b - to_c)));
    s.lift =
        lift_for(START_BOUND, plus(plus(magnitudes(a), magnitudes(b)), magnitudes(c)), s.facing);
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

surface NAME(surface_at)(const rt_scene *scene, const ray *r, const hit *h)
{
    const bool is_sphere = h->primitive < (int)scene->sphere_count;
    surface s = is_sphere ? on_sphere(scene, r, h) : on_triangle(scene, r, h);
    s.material = &scene->materials[s.material_index];
    return s;
}

vec NAME(start)(const surface *s, vec side)
{
    const bool is_above = dot(s->facing, side) > 0;
    return add_scaled(s->facing, is_above ? s->lift : -s->lift, s->foot);
}
