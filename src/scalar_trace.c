/* The geometry of the scalar reference: rays against primitives. */
#include "scalar_real.h"

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
    const real margin = (FABS(lo) + FABS(hi)) * (real)RT_BOX_MARGIN;
    real inverse = (real)1 / direction;
    if (inverse > REAL_MAX)
        inverse = REAL_MAX;
    if (inverse < -REAL_MAX)
        inverse = -REAL_MAX;
    const real t0 = ((lo - margin) - origin) * inverse, t1 = ((hi + margin) - origin) * inverse;
    const real near = t0 < t1 ? t0 : t1, far = t0 < t1 ? t1 : t0;
    *enter = near > *enter ? near : *enter;
    *leave = far < *leave ? far : *leave;
}

/* Takes a hit if it is nearer than the best, or as near and of a lower index. Rounding can put t
 * outside of the primitive, far outside for slivers and grazing rays: it is kept within the ray's
 * part in the primitive's box, and a ray that does not meet the box does not meet the primitive. */
static void take(const ray *r, hit candidate, vec lo, vec hi, hit *best)
{
    real enter = -INFINITY, leave = INFINITY;
    slab(r->origin.x, r->direction.x, lo.x, hi.x, &enter, &leave);
    slab(r->origin.y, r->direction.y, lo.y, hi.y, &enter, &leave);
    slab(r->origin.z, r->direction.z, lo.z, hi.z, &enter, &leave);
    leave = leave * (real)RT_SLAB_MARGIN;
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

static void intersect_sphere(const ray *r, const rt_sphere *sphere, int primitive, hit *best)
{
    real near, far;
    const vec center = vec_of(sphere->cx, sphere->cy, sphere->cz);
    if (!sphere_roots(r, center, (real)sphere->radius, &near, &far))
        return;
    const real t = near > r->tmin ? near : far;
    const vec reach = {(real)sphere->radius, (real)sphere->radius, (real)sphere->radius};
    const vec lo = minus(center, reach), hi = minus(center, times(reach, -1));
    take(r, (hit){primitive, t, 0, 0}, lo, hi, best);
}

/* Moller and Trumbore 1997; `cull` as rt_scene_cull_sign. */
static void intersect_triangle(const ray *r, const rt_triangle *triangle, int primitive, int cull,
                               hit *best)
{
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
    const vec b = vec_of(triangle->bx, triangle->by, triangle->bz);
    const vec c = vec_of(triangle->cx, triangle->cy, triangle->cz);
    const vec lo = {FMIN(a.x, FMIN(b.x, c.x)), FMIN(a.y, FMIN(b.y, c.y)),
                    FMIN(a.z, FMIN(b.z, c.z))};
    const vec hi = {FMAX(a.x, FMAX(b.x, c.x)), FMAX(a.y, FMAX(b.y, c.y)),
                    FMAX(a.z, FMAX(b.z, c.z))};
    take(r, (hit){primitive, t / det, u / det, v / det}, lo, hi, best);
}

/* A ray with a component that is not finite hits nothing. */
static bool is_lawful(const ray *r)
{
    const vec o = r->origin, d = r->direction;
    return isfinite(o.x) && isfinite(o.y) && isfinite(o.z) && isfinite(d.x) && isfinite(d.y) &&
           isfinite(d.z) && r->tmax > r->tmin;
}

hit NAME(closest)(const rt_scene *scene, const ray *r)
{
    hit best = {RT_MISS, is_lawful(r) ? r->tmax : -INFINITY, 0, 0};
    const int spheres = (int)scene->sphere_count;
    const int cull = rt_scene_cull_sign(scene);
    for (int i = 0; i < spheres; ++i)
        intersect_sphere(r, &scene->spheres[i], i, &best);
    for (int i = 0; i < (int)scene->triangle_count; ++i)
        intersect_triangle(r, &scene->triangles[i], spheres + i, cull, &best);
    if (best.primitive == RT_MISS)
        best.t = INFINITY;
    return best;
}

void NAME(trace)(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    for (size_t i = 0; i < count; ++i) {
        const float *o = rays[i].origin, *d = rays[i].direction;
        const ray r = {vec_of(o[0], o[1], o[2]), vec_of(d[0], d[1], d[2]), (real)rays[i].tmin,
                       (real)rays[i].tmax};
        const hit h = NAME(closest)(scene, &r);
        hits[i] = (rt_hit){h.primitive, (float)h.t, (float)h.u, (float)h.v};
    }
}
