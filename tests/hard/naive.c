#include "hard/naive.h"

#include <math.h>

typedef struct v3 {
    float x, y, z;
} v3;

static v3 minus(v3 a, v3 b)
{
    return (v3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static v3 cross(v3 a, v3 b)
{
    return (v3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static float dot(v3 a, v3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static v3 of(const float p[3])
{
    return (v3){p[0], p[1], p[2]};
}

typedef bool triangle_fn(const rt_ray *r, v3 a, v3 b, v3 c, float *t);

/* u and v must be at least `least`, the determinant at least `smallest`. */
static bool moller(const rt_ray *r, v3 a, v3 b, v3 c, float least, float smallest, float *t)
{
    const v3 d = of(r->direction), e1 = minus(b, a), e2 = minus(c, a), p = cross(d, e2);
    const float det = dot(e1, p);
    if (!(fabsf(det) > smallest))
        return false;
    const v3 s = minus(of(r->origin), a), q = cross(s, e1);
    const float u = dot(s, p) / det, v = dot(d, q) / det;
    if (!(u >= least && v >= least && u + v <= 1.0f - least))
        return false;
    *t = dot(e2, q) / det;
    return *t > r->tmin && *t < r->tmax;
}

static bool moller_epsilon(const rt_ray *r, v3 a, v3 b, v3 c, float *t)
{
    return moller(r, a, b, c, 0.0f, 1e-6f, t);
}

static bool moller_plain(const rt_ray *r, v3 a, v3 b, v3 c, float *t)
{
    return moller(r, a, b, c, 0.0f, 0.0f, t);
}

static bool moller_inside(const rt_ray *r, v3 a, v3 b, v3 c, float *t)
{
    return moller(r, a, b, c, 1e-4f, 0.0f, t);
}

static bool moller_slab(const rt_ray *r, v3 a, v3 b, v3 c, float *t)
{
    const float corners[3][3] = {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
    float enter = r->tmin, leave = r->tmax;
    for (int k = 0; k < 3; ++k) {
        float lo = corners[0][k], hi = lo;
        for (int i = 1; i < 3; ++i) {
            lo = corners[i][k] < lo ? corners[i][k] : lo;
            hi = corners[i][k] > hi ? corners[i][k] : hi;
        }
        const float inverse = 1.0f / r->direction[k];
        const float t0 = (lo - r->origin[k]) * inverse, t1 = (hi - r->origin[k]) * inverse;
        const float near = inverse < 0.0f ? t1 : t0, far = inverse < 0.0f ? t0 : t1;
        if (!(near <= leave && far >= enter))
            return false;
        enter = near > enter ? near : enter;
        leave = far < leave ? far : leave;
    }
    return enter <= leave && moller_plain(r, a, b, c, t);
}

/* Woop, Benthin and Wald 2013 without what makes it watertight: the edge functions as contracted
 * by a compiler, and zeros left as they come. */
static bool woop(const rt_ray *r, v3 a, v3 b, v3 c, float *t)
{
    const float *d = r->direction;
    int kz = 0;
    for (int k = 1; k < 3; ++k)
        kz = fabsf(d[k]) > fabsf(d[kz]) ? k : kz;
    const int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    const float sx = d[kx] / d[kz], sy = d[ky] / d[kz], sz = 1.0f / d[kz];
    const v3 p[3] = {minus(a, of(r->origin)), minus(b, of(r->origin)), minus(c, of(r->origin))};
    float x[3], y[3], z[3], edge[3];
    for (int i = 0; i < 3; ++i) {
        const float q[3] = {p[i].x, p[i].y, p[i].z};
        x[i] = fmaf(-sx, q[kz], q[kx]);
        y[i] = fmaf(-sy, q[kz], q[ky]);
        z[i] = sz * q[kz];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        edge[i] = fmaf(x[k], y[j], -(y[k] * x[j]));
    }
    const float det = edge[0] + edge[1] + edge[2];
    const bool is_below = edge[0] < 0.0f || edge[1] < 0.0f || edge[2] < 0.0f;
    const bool is_above = edge[0] > 0.0f || edge[1] > 0.0f || edge[2] > 0.0f;
    if ((is_below && is_above) || det == 0.0f)
        return false;
    *t = (edge[0] * z[0] + edge[1] * z[1] + edge[2] * z[2]) / det;
    return *t > r->tmin && *t < r->tmax;
}

/* The nearest of all triangles, the first of equals or the last. */
static void nearest(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits,
                    triangle_fn *meet, bool takes_last)
{
    for (size_t i = 0; i < count; ++i) {
        hits[i] = (rt_hit){RT_MISS, INFINITY, 0.0f, 0.0f};
        for (size_t k = 0; k < scene->triangle_count; ++k) {
            const rt_triangle *s = &scene->triangles[k];
            const v3 a = {s->ax, s->ay, s->az}, b = {s->bx, s->by, s->bz};
            const v3 c = {s->cx, s->cy, s->cz};
            float t = INFINITY;
            if (meet(&rays[i], a, b, c, &t) && (t < hits[i].t || (takes_last && t == hits[i].t)))
                hits[i] = (rt_hit){(int32_t)(scene->sphere_count + k), t, 0.0f, 0.0f};
        }
    }
}

static void trace_epsilon(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    nearest(scene, rays, count, hits, moller_epsilon, false);
}

static void trace_moller(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    nearest(scene, rays, count, hits, moller_plain, false);
}

static void trace_inside(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    nearest(scene, rays, count, hits, moller_inside, false);
}

static void trace_woop(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    nearest(scene, rays, count, hits, woop, false);
}

static void trace_slab(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    nearest(scene, rays, count, hits, moller_slab, false);
}

static void trace_last(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    nearest(scene, rays, count, hits, moller_plain, true);
}

/* The nearer of what there is already and of all spheres. */
static void nearest_sphere(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits,
                           bool only_enters)
{
    for (size_t i = 0; i < count; ++i) {
        const rt_ray *r = &rays[i];
        const v3 d = of(r->direction);
        for (size_t k = 0; k < scene->sphere_count; ++k) {
            const rt_sphere *s = &scene->spheres[k];
            const v3 f = minus(of(r->origin), (v3){s->cx, s->cy, s->cz});
            const float a = dot(d, d), b = 2.0f * dot(f, d);
            const float c = dot(f, f) - s->radius * s->radius;
            const float discriminant = b * b - 4.0f * a * c;
            if (!(discriminant >= 0.0f))
                continue;
            const float root = sqrtf(discriminant);
            const float near = (-b - root) / (2.0f * a), far = (-b + root) / (2.0f * a);
            const float t = near > r->tmin || only_enters ? near : far;
            if (t > r->tmin && t < r->tmax && t < hits[i].t)
                hits[i] = (rt_hit){(int32_t)k, t, 0.0f, 0.0f};
        }
    }
}

static void trace_quadratic(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    nearest(scene, rays, count, hits, moller_plain, false);
    nearest_sphere(scene, rays, count, hits, false);
}

static void trace_entering(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    nearest(scene, rays, count, hits, moller_plain, false);
    nearest_sphere(scene, rays, count, hits, true);
}

const hard_naive hard_naive_epsilon = {.name = "determinant above 1e-6", .trace = trace_epsilon};
const hard_naive hard_naive_moller = {.name = "Moller-Trumbore", .trace = trace_moller};
const hard_naive hard_naive_inside = {.name = "u, v above 1e-4", .trace = trace_inside};
const hard_naive hard_naive_woop = {.name = "Woop contracted", .trace = trace_woop};
const hard_naive hard_naive_quadratic = {.name = "b*b - 4ac", .trace = trace_quadratic};
const hard_naive hard_naive_slab = {.name = "slabs without margin", .trace = trace_slab};
const hard_naive hard_naive_last = {.name = "last of equals", .trace = trace_last};
const hard_naive hard_naive_entering = {.name = "near roots only", .trace = trace_entering};
const hard_naive hard_naive_no_offset = {.mutant = MUTANT_NO_OFFSET};
