/* Spheres of the scalar reference. In the robust test sums and products that cancel are carried
 * with their rounding errors (Ogita, Rump and Oishi 2005). */
#include "reference/effects.h"
#include "reference/margins.h"

/* dd t t - 2 b t + c = 0, of which `discriminant` is a quarter: its roots are where a ray meets a
 * sphere. */
typedef struct quadratic {
    real dd, b, c, discriminant;
} quadratic;

/* Adding numbers of like sign cancels nothing; the product of the roots gives the other. */
static void roots_of(const quadratic *e, real *near, real *far)
{
    const real root = SQRT(e->discriminant);
    const real q = e->b >= 0 ? e->b + root : e->b - root;
    *near = e->b >= 0 ? e->c / q : q / e->dd;
    *far = e->b >= 0 ? q / e->dd : e->c / q;
}

/* The plain test; `gap` is by how much the square of the radius exceeds that of the distance of ray
 * and centre. */
static quadratic plain_quadratic(const ray *r, vec f, real radius, real *gap)
{
    quadratic e = {.dd = dot(r->direction, r->direction), .b = -dot(f, r->direction)};
    /* From the centre to the ray's closest approach. */
    const vec l = add_scaled(r->direction, e.b * ((real)1 / e.dd), f);
    *gap = FMA(radius, radius, -dot(l, l));
    e.c = FMA(-radius, radius, dot(f, f));
    e.discriminant = e.dd * *gap;
    return e;
}

/* a b - c d */
static real area(real a, real b, real c, real d)
{
    const twofold second = product_of(c, d);
    return FMA(a, b, -second.value) - second.rest;
}

/* a . b + last + small, of which the first two as if in twice the precision. */
static real precise_sum(vec a, vec b, real last, real small)
{
    const twofold x = product_of(a.x, b.x), y = product_of(a.y, b.y), z = product_of(a.z, b.z);
    const twofold xy = sum_of(x.value, y.value);
    const twofold xyz = sum_of(xy.value, z.value);
    const twofold all = sum_of(xyz.value, last);
    return all.value + (((xy.rest + xyz.rest) + (all.rest + (x.rest + y.rest + z.rest))) + small);
}

/* The same; hit or miss is as in exact arithmetic, but for rays that all but touch. */
static quadratic exact_quadratic(const ray *r, vec center, real radius)
{
    const vec d = r->direction;
    const twofold fx = sum_of(r->origin.x, -center.x), fy = sum_of(r->origin.y, -center.y),
                  fz = sum_of(r->origin.z, -center.z);
    const vec f = {fx.value, fy.value, fz.value}, rest = {fx.rest, fy.rest, fz.rest};
    const vec small = cross(rest, d);
    const vec across = {area(f.y, d.z, f.z, d.y) + small.x, area(f.z, d.x, f.x, d.z) + small.y,
                        area(f.x, d.y, f.y, d.x) + small.z};
    quadratic e = {.dd = dot(d, d)};
    const twofold rr = product_of(radius, radius);
    e.discriminant = FMA(rr.value, e.dd, -dot(across, across));
    e.b = -precise_sum(f, d, 0, dot(rest, d));
    e.c = precise_sum(f, f, -rr.value, FMA(2, dot(f, rest), -rr.rest));
    /* Near the surface the product of the roots is the better known. */
    if (e.discriminant >= 0 && FABS(e.c) * 4 < rr.value) {
        e.discriminant = area(e.b, e.b, e.dd, e.c);
        e.discriminant = e.discriminant > 0 ? e.discriminant : 0;
    }
    return e;
}

/* The roots of |origin + t direction - center| = radius, the nearer first; false without any. */
static bool plain_roots(const ray *r, vec center, real radius, real *near, real *far)
{
    real gap;
    const quadratic e = plain_quadratic(r, minus(r->origin, center), radius, &gap);
    if (!(gap >= 0))
        return false;
    roots_of(&e, near, far);
    return true;
}

/* The same by the plain test where that is surely right and good to a few ulp: it is not for rays
 * that start near the surface or inside, nor where `gap` is less than what rounding makes of it,
 * 7 |f| radius half ulps at most and 50 squares of a half ulp of |f|. */
static bool robust_roots(const ray *r, vec center, real radius, real *near, real *far)
{
    const vec f = minus(r->origin, center);
    const real ff = dot(f, f), rr = radius * radius;
    const real per_radius = 16 * HALF_ULP, per_distance = 128 * HALF_ULP * HALF_ULP;
    real gap;
    quadratic e = plain_quadratic(r, f, radius, &gap);
    const real bound = ff * FMA(ff, per_distance * per_distance, rr * (per_radius * per_radius));
    const bool is_unsure = FMA(-gap, gap, bound) >= 0;
    if (!is_unsure && gap < 0)
        return false;
    if (is_unsure || rr - e.c >= 0) {
        const bool surely_outside = FMA(ff, 8 * HALF_ULP, -e.c) <= 0;
        if (surely_outside && e.b <= 0 && r->tmin >= 0)
            return false; /* away from it */
        e = exact_quadratic(r, center, radius);
    }
    if (!(e.discriminant >= 0))
        return false;
    roots_of(&e, near, far);
    return true;
}

void NAME(box_of_sphere)(const rt_sphere *s, float lo[3], float hi[3])
{
    const float center[3] = {s->cx, s->cy, s->cz};
    for (int i = 0; i < 3; ++i) {
        lo[i] = center[i] - s->radius;
        hi[i] = center[i] + s->radius;
    }
}

bool NAME(meet_sphere)(const rt_scene *scene, const ray *r, size_t i, hit *h)
{
    real near, far;
    const rt_sphere *sphere = &scene->spheres[i];
    const vec center = vec_of(sphere->cx, sphere->cy, sphere->cz);
    const real radius = (real)sphere->radius;
    if (!(is_robust(scene) ? robust_roots(r, center, radius, &near, &far)
                           : plain_roots(r, center, radius, &near, &far)))
        return false;
    h->t = near > r->tmin ? near : far;
    return true;
}

/* The unit normal at a point of a sphere; against the ray where the sphere is so small for its
 * place that the point is rounded to the centre. */
static vec outward_at(vec point, vec center, vec direction)
{
    const vec way = minus(point, center);
    return way.x != 0 || way.y != 0 || way.z != 0 ? unit(way) : times(direction, -1);
}

/* The point for patterns: in the sphere's box, but for what lies at its upper faces. */
static vec point_below_top(vec point, vec center, real radius)
{
    const vec reach = {radius, radius, radius};
    const vec top = plus(center, reach);
    return NAME(into_box)(point, minus(center, reach),
                          add_scaled(magnitudes(top), -SPHERE_CELL_MARGIN, top));
}

surface NAME(surface_of_sphere)(const rt_scene *scene, const ray *r, size_t i, const hit *h)
{
    const real pi = (real)3.14159265358979323846;
    const rt_sphere *sphere = &scene->spheres[i];
    const vec center = vec_of(sphere->cx, sphere->cy, sphere->cz);
    surface s = {.material = NULL};
    s.point = add_scaled(r->direction, h->t, r->origin);
    const vec outward = outward_at(s.point, center, r->direction);
    NAME(face)(&s, outward, r->direction);
    const real radius = (real)sphere->radius;
    s.within = point_below_top(s.point, center, radius);
    s.foot = add_scaled(outward, radius, center);
    s.lift = NAME(lift_for)(START_BOUND,
                            add_scaled(magnitudes(outward), radius, magnitudes(center)), outward);
    if (is_robust(scene)) {
        /* t is good to a few ulp: near a huge sphere the point on the ray is the better one. */
        const vec sizes = plus(magnitudes(r->origin), magnitudes(s.point));
        const real lift = NAME(lift_for)(POINT_BOUND, sizes, outward);
        if (lift < s.lift) {
            s.foot = s.point;
            s.lift = lift;
        }
    }
    /* Longitude from the z axis, latitude from the south pole up. */
    s.u = ATAN2(outward.x, outward.z) / (2 * pi) + (real)0.5;
    s.is_globe = true;
    s.v = ASIN(FMAX(-1, FMIN(outward.y, 1))) / pi + (real)0.5;
    return s;
}
