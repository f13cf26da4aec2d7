/* The robust sphere test of the scalar reference. Sums and products that cancel are carried with
 * their rounding errors (Knuth; Dekker; Ogita, Rump and Oishi 2005). */
#include "reference/real.h"

/* A number and what rounding took from it: together they are exact. */
typedef struct pair {
    real value, rest;
} pair;

static pair sum_of(real a, real b)
{
    const real s = a + b;
    const real b_part = s - a;
    return (pair){s, (a - (s - b_part)) + (b - b_part)};
}

static pair product_of(real a, real b)
{
    const real p = a * b;
    return (pair){p, FMA(a, b, -p)};
}

/* a b - c d */
static real area(real a, real b, real c, real d)
{
    const pair second = product_of(c, d);
    return FMA(a, b, -second.value) - second.rest;
}

/* a . b + last + small, of which the first two as if in twice the precision. */
static real precise_sum(vec a, vec b, real last, real small)
{
    const pair x = product_of(a.x, b.x), y = product_of(a.y, b.y), z = product_of(a.z, b.z);
    const pair xy = sum_of(x.value, y.value);
    const pair xyz = sum_of(xy.value, z.value);
    const pair all = sum_of(xyz.value, last);
    return all.value + (((xy.rest + xyz.rest) + (all.rest + (x.rest + y.rest + z.rest))) + small);
}

bool NAME(robust_roots)(const ray *r, vec center, real radius, real *near, real *far)
{
    const vec d = r->direction;
    const pair fx = sum_of(r->origin.x, -center.x), fy = sum_of(r->origin.y, -center.y),
               fz = sum_of(r->origin.z, -center.z);
    const vec f = {fx.value, fy.value, fz.value}, rest = {fx.rest, fy.rest, fz.rest};
    const vec small = cross(rest, d);
    const vec across = {area(f.y, d.z, f.z, d.y) + small.x, area(f.z, d.x, f.x, d.z) + small.y,
                        area(f.x, d.y, f.y, d.x) + small.z};
    const real dd = dot(d, d);
    const pair rr = product_of(radius, radius);
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
