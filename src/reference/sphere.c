/* Spheres of the scalar reference. In the robust test sums and products that cancel are carried
 * with their rounding errors (Knuth; Dekker; Ogita, Rump and Oishi 2005). */
#include "reference/effects.h"
#include "reference/margins.h"

/* The roots of |origin + t direction - center| = radius, the nearer first; false without any. */
static bool sphere_roots(const ray *r, vec center, real radius, real *near, real *far)
{
    const vec f = minus(r->origin, center);
    const real dd = dot(r->direction, r->direction);
    const real b = -dot(f, r->direction);
    /* From the centre to the ray's closest approach. */
    const vec l = add_scaled(r->direction, b * ((real)1 / dd), f);
    const real discriminant = FMA(radius, radius, -dot(l, l));
    if (!(discriminant >= 0))
        return false;
    const real root = SQRT(dd * discriminant);
    const real c = FMA(-radius, radius, dot(f, f));
    /* Adding numbers of like sign cancels nothing; the product of the roots gives the other. */
    if (b >= 0) {
        const real q = b + root;
        *near = c / q;
        *far = q / dd;
    } else {
        const real q = b - root;
        *near = q / dd;
        *far = c / q;
    }
    return true;
}

/* A number and what rounding took from it: together they are exact. */
typedef struct twofold {
    real value, rest;
} twofold;

static twofold sum_of(real a, real b)
{
    const real s = a + b;
    const real b_part = s - a;
    return (twofold){s, (a - (s - b_part)) + (b - b_part)};
}

static twofold product_of(real a, real b)
{
    const real p = a * b;
    return (twofold){p, FMA(a, b, -p)};
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
static bool robust_roots(const ray *r, vec center, real radius, real *near, real *far)
{
    const vec d = r->direction;
    const twofold fx = sum_of(r->origin.x, -center.x), fy = sum_of(r->origin.y, -center.y),
                  fz = sum_of(r->origin.z, -center.z);
    const vec f = {fx.value, fy.value, fz.value}, rest = {fx.rest, fy.rest, fz.rest};
    const vec small = cross(rest, d);
    const vec across = {area(f.y, d.z, f.z, d.y) + small.x, area(f.z, d.x, f.x, d.z) + small.y,
                        area(f.x, d.y, f.y, d.x) + small.z};
    const real dd = dot(d, d);
    const twofold rr = product_of(radius, radius);
    real discriminant = FMA(rr.value, dd, -dot(across, across));
    if (!(discriminant >= 0))
        return false;
    const real b = -precise_sum(f, d, 0, dot(rest, d));
    const real c = precise_sum(f, f, -rr.value, FMA(2, dot(f, rest), -rr.rest));
    /* Near the surface the product of the roots is the better known. */
    if (FABS(c) * 4 < rr.value) {
        discriminant = area(b, b, dd, c);
        discriminant = discriminant > 0 ? discriminant : 0;
    }
    const real root = SQRT(discriminant);
    const real q = b >= 0 ? b + root : b - root;
    *near = b >= 0 ? c / q : q / dd;
    *far = b >= 0 ? q / dd : c / q;
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
                           : sphere_roots(r, center, radius, &near, &far)))
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
