/* The geometry of the scalar reference: rays against primitives. */
#include "reference/margins.h"
#include "reference/real.h"

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

/* Where the ray is within an axis's slab, and no longer; a direction of 0 counts as the smallest.
 */
static void slab(real origin, real direction, real lo, real hi, real *enter, real *leave)
{
    real inverse = (real)1 / direction;
    if (inverse > REAL_MAX)
        inverse = REAL_MAX;
    if (inverse < -REAL_MAX)
        inverse = -REAL_MAX;
    const real t0 = (lo - origin) * inverse, t1 = (hi - origin) * inverse;
    const real near = t0 < t1 ? t0 : t1, far = t0 < t1 ? t1 : t0;
    *enter = near > *enter ? near : *enter;
    *leave = far < *leave ? far : *leave;
}

void NAME(part_in_box)(const rt_scene *scene, const ray *r, vec lo, vec hi, real *enter,
                       real *leave)
{
    *enter = -INFINITY;
    *leave = INFINITY;
    slab(r->origin.x, r->direction.x, lo.x, hi.x, enter, leave);
    slab(r->origin.y, r->direction.y, lo.y, hi.y, enter, leave);
    slab(r->origin.z, r->direction.z, lo.z, hi.z, enter, leave);
    *leave = *leave * (real)(is_robust(scene) ? SLAB_MARGIN_ROBUST : SLAB_MARGIN);
}

/* One axis of a primitive's box, its margin still to come. */
typedef struct extent {
    float lo, hi;
} extent;

static extent around(float center, float radius)
{
    return (extent){center - radius, center + radius};
}

static extent over(float a, float b, float c)
{
    return (extent){fminf(a, fminf(b, c)), fmaxf(a, fmaxf(b, c))};
}

static float margin_of(extent e)
{
    return (fabsf(e.lo) + fabsf(e.hi)) * BOX_MARGIN;
}

/* In float also where the rest is in double: that is what primitives are made of. */
void NAME(box)(const rt_scene *scene, int primitive, vec *lo, vec *hi)
{
    extent x, y, z;
    if (primitive < (int)scene->sphere_count) {
        const rt_sphere *s = &scene->spheres[primitive];
        x = around(s->cx, s->radius);
        y = around(s->cy, s->radius);
        z = around(s->cz, s->radius);
    } else {
        const rt_triangle *t = &scene->triangles[primitive - (int)scene->sphere_count];
        x = over(t->ax, t->bx, t->cx);
        y = over(t->ay, t->by, t->cy);
        z = over(t->az, t->bz, t->cz);
    }
    float mx = margin_of(x), my = margin_of(y), mz = margin_of(z);
    if (is_robust(scene))
        mx = my = mz = fmaxf(mx, fmaxf(my, mz));
    *lo = vec_of(x.lo - mx, y.lo - my, z.lo - mz);
    *hi = vec_of(x.hi + mx, y.hi + my, z.hi + mz);
}

/* Takes a hit if it is nearer than the best, or as near and of a lower index. Rounding can put t
 * outside of the primitive, far outside for slivers and grazing rays: it is kept within the ray's
 * part in the primitive's box, and a ray that does not meet the box does not meet the primitive. */
static void take(const rt_scene *scene, const ray *r, hit candidate, hit *best)
{
    vec lo, hi;
    real enter, leave;
    NAME(box)(scene, candidate.primitive, &lo, &hi);
    NAME(part_in_box)(scene, r, lo, hi, &enter, &leave);
    if (!(enter <= leave))
        return;
    if (!(candidate.t > enter))
        candidate.t = enter;
    if (!(candidate.t < leave))
        candidate.t = leave;
    const bool nearer =
        candidate.t < best->t || (candidate.t == best->t && candidate.primitive < best->primitive);
    if (candidate.t > r->tmin && nearer)
        *best = candidate;
}

static void meet_sphere(const rt_scene *scene, const ray *r, int primitive, hit *best)
{
    real near, far;
    const rt_sphere *sphere = &scene->spheres[primitive];
    const vec center = vec_of(sphere->cx, sphere->cy, sphere->cz);
    const real radius = (real)sphere->radius;
    if (!(is_robust(scene) ? NAME(robust_roots)(r, center, radius, &near, &far)
                           : sphere_roots(r, center, radius, &near, &far)))
        return;
    take(scene, r, (hit){primitive, near > r->tmin ? near : far, 0, 0}, best);
}

/* Moller and Trumbore 1997. */
static void meet_triangle(const rt_scene *scene, const ray *r, int primitive, hit *best)
{
    const rt_triangle *triangle = &scene->triangles[primitive - (int)scene->sphere_count];
    const int cull = rt_scene_cull_sign(scene);
    hit watertight = {primitive, 0, 0, 0};
    if (is_robust(scene)) {
        if (NAME(meet_watertight)(triangle, r, cull, &watertight))
            take(scene, r, watertight, best);
        return;
    }
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
        return;
    if (det < 0) {
        det = -det;
        u = -u;
        v = -v;
        t = -t;
    }
    if (!(det > 0 && u >= 0 && v >= 0 && u + v <= det))
        return;
    take(scene, r, (hit){primitive, t / det, u / det, v / det}, best);
}

void NAME(meet)(const rt_scene *scene, const ray *r, int primitive, hit *best)
{
    if (primitive < (int)scene->sphere_count)
        meet_sphere(scene, r, primitive, best);
    else
        meet_triangle(scene, r, primitive, best);
}
