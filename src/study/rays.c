/* The same rays through every entry: primary rays of the scene's camera, made once in fp32, and
 * next rays from what each says they hit. */
#include <math.h>
#include <stdlib.h>

#include "common/parallel.h"
#include "common/vec3.h"
#include "reference/scalar.h"
#include "scene/camera.h"
#include "study/parts.h"

/* More say no more. */
#define RAYS_MOST ((size_t)1 << 20)
/* Rays that one thread traces on the scalar path before it can be stopped. */
#define CHUNK ((size_t)1 << 17)

/* As RT_START_BOUND and RT_START_DRAW of kernels/shading/surface.cl, in fp32. */
#define START_BOUND (8 * 0x1p-24)
#define START_DRAW (32 * 0x1p-24)

/* Through the centre of every `stride`-th pixel. */
static void make_primary_rays(const rt_scene *scene, size_t stride, rt_ray *rays, size_t count)
{
    const rt_view v = rt_scene_view(scene);
    for (size_t i = 0; i < count; ++i) {
        const size_t pixel = i * stride;
        const int x = (int)(pixel % (size_t)scene->width), y = (int)(pixel / (size_t)scene->width);
        vec3 d = {v.forward[0], v.forward[1], v.forward[2]};
        d = vec3_plus(d, 2 * x + 1 - scene->width, (vec3){v.right[0], v.right[1], v.right[2]});
        d = vec3_plus(d, scene->height - 1 - 2 * y, (vec3){v.up[0], v.up[1], v.up[2]});
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        vec3_store((vec3){v.origin[0], v.origin[1], v.origin[2]}, rays[i].origin);
        vec3_store(vec3_unit(d), rays[i].direction);
    }
}

/* Cosine-distributed about the unit vector n. */
static vec3 random_direction(uint32_t index, vec3 n)
{
    const double z = 2.0 * rt_study_random(index, 0) - 1.0, r = sqrt(1.0 - z * z);
    const double phi = 6.283185307179586 * rt_study_random(index, 1);
    /* A point of the unit sphere that touches the plane. */
    return vec3_plus(n, 0.999, (vec3){r * cos(phi), r * sin(phi), z});
}

/* Where a ray leaves what another has hit. */
typedef struct start {
    vec3 point, normal; /* the normal is unit, on the side that the ray came from */
    vec3 extent;        /* what the lift is relative to */
    double chord; /* from here on the ray may lawfully meet the same sphere, in cosines; or 0 */
} start;

static vec3 toward(vec3 n, vec3 direction)
{
    return vec3_dot(n, direction) > 0.0 ? (vec3){-n.x, -n.y, -n.z} : n;
}

static start on_sphere(const rt_sphere *s, const rt_ray *ray, const rt_hit *hit)
{
    const vec3 d = vec3_of(ray->direction);
    const vec3 o = vec3_of(ray->origin);
    const vec3 center = {s->cx, s->cy, s->cz};
    const double r = s->radius;
    const vec3 n = vec3_unit(vec3_plus(vec3_plus(o, hit->t, d), -1.0, center));
    const bool inside = vec3_dot(n, d) > 0.0;
    return (start){vec3_plus(center, r, n), toward(n, d),
                   (vec3){fabs(center.x) + r * fabs(n.x), fabs(center.y) + r * fabs(n.y),
                          fabs(center.z) + r * fabs(n.z)},
                   inside ? r : 0.0};
}

static start on_triangle(const rt_triangle *t, const rt_ray *ray, const rt_hit *hit)
{
    const vec3 a = {t->ax, t->ay, t->az}, b = {t->bx, t->by, t->bz}, c = {t->cx, t->cy, t->cz};
    const vec3 d = vec3_of(ray->direction);
    const double u = hit->u + START_DRAW * (1.0 / 3.0 - hit->u);
    const double v = hit->v + START_DRAW * (1.0 / 3.0 - hit->v);
    const vec3 e1 = vec3_plus(b, -1.0, a), e2 = vec3_plus(c, -1.0, a);
    return (start){vec3_plus(vec3_plus(a, u, e1), v, e2), toward(vec3_unit(vec3_cross(e1, e2)), d),
                   (vec3){fabs(a.x) + fabs(b.x) + fabs(c.x), fabs(a.y) + fabs(b.y) + fabs(c.y),
                          fabs(a.z) + fabs(b.z) + fabs(c.z)},
                   0.0};
}

/* A next ray, and the t up to which a hit of the same primitive is the start over again. */
static rt_ray next_ray(const rt_scene *scene, const rt_ray *ray, const rt_hit *hit, uint32_t index,
                       float *at_once)
{
    start s = {0};
    size_t i = (size_t)hit->primitive;
    switch (rt_scene_kind_of(scene, &i)) {
    case RT_KIND_SPHERES:
        s = on_sphere(&scene->spheres[i], ray, hit);
        break;
    case RT_KIND_TRIANGLES:
        s = on_triangle(&scene->triangles[i], ray, hit);
        break;
    case RT_KIND_COUNT:
        break;
    }
    const vec3 n = s.normal;
    const double lift =
        START_BOUND * (fabs(n.x) * s.extent.x + fabs(n.y) * s.extent.y + fabs(n.z) * s.extent.z);
    const vec3 d = vec3_unit(random_direction(index, n));
    rt_ray next = {.tmin = 0.0f, .tmax = INFINITY};
    vec3_store(vec3_plus(s.point, lift, n), next.origin);
    vec3_store(d, next.direction);
    /* A chord is 2 r cos long: half of it is far from either end. */
    *at_once = s.chord > 0.0 ? (float)(s.chord * vec3_dot(d, n)) : INFINITY;
    return next;
}

/* The ray set and its answers. */
typedef struct ray_set {
    size_t count;
    rt_ray *rays, *next;
    rt_hit *reference, *hits, *next_hits;
    float *at_once;
    size_t *source; /* of each next ray: the ray whose hit it starts on */
    double *ulps;
} ray_set;

static void free_set(ray_set *r)
{
    free(r->rays);
    free(r->next);
    free(r->reference);
    free(r->hits);
    free(r->next_hits);
    free(r->at_once);
    free(r->source);
    free(r->ulps);
}

static bool make_set(ray_set *r, size_t count, rt_status *status)
{
    *r = (ray_set){count,
                   calloc(count, sizeof *r->rays),
                   calloc(count, sizeof *r->next),
                   calloc(count, sizeof *r->reference),
                   calloc(count, sizeof *r->hits),
                   calloc(count, sizeof *r->next_hits),
                   calloc(count, sizeof *r->at_once),
                   calloc(count, sizeof *r->source),
                   calloc(count, sizeof *r->ulps)};
    return (r->rays && r->next && r->reference && r->hits && r->next_hits && r->at_once &&
            r->source && r->ulps) ||
           rt_status_no_memory(status, "rays");
}

typedef struct batch {
    const rt_scalar_tree *tree;
    const rt_scene *scene;
    const rt_ray *rays;
    rt_hit *hits;
    size_t count;
} batch;

static void trace_chunk(void *context, size_t i)
{
    const batch *b = context;
    const size_t first = i * CHUNK, left = b->count - first;
    rt_scalar_double_trace_by(b->tree, b->scene, b->rays + first, left < CHUNK ? left : CHUNK,
                              b->hits + first);
}

/* The scalar path on all cores, in batches between which it can be stopped. */
static bool trace_reference(study_state *s, const rt_scene *scene, ray_set *r)
{
    const int threads = rt_parallel_processors();
    const size_t most = (size_t)threads * CHUNK;
    for (size_t first = 0; first < r->count; first += most) {
        const size_t left = r->count - first;
        batch b = {s->tree, scene, r->rays + first, r->reference + first,
                   left < most ? left : most};
        if (!rt_study_tick(s, 0.5 * (double)first / (double)r->count))
            return false;
        rt_parallel((b.count + CHUNK - 1) / CHUNK, threads, trace_chunk, &b);
    }
    return true;
}

static void compare_hits(const ray_set *r, rt_study_entry *entry)
{
    size_t agreeing = 0;
    entry->rays = r->count;
    for (size_t i = 0; i < r->count; ++i) {
        entry->hits += r->reference[i].primitive != RT_MISS;
        if (r->hits[i].primitive != r->reference[i].primitive)
            ++entry->disagreements;
        else if (r->hits[i].primitive != RT_MISS)
            r->ulps[agreeing++] = rt_ulp_distance(r->hits[i].t, r->reference[i].t);
    }
    (void)rt_spread_of(r->ulps, agreeing); /* sorts */
    entry->t_p50 = rt_quantile(r->ulps, agreeing, 0.5);
    entry->t_p99 = rt_quantile(r->ulps, agreeing, 0.99);
    entry->t_max = rt_quantile(r->ulps, agreeing, 1.0);
}

static bool trace_next(study_state *s, ray_set *r, rt_renderer *renderer, rt_study_entry *entry)
{
    size_t count = 0;
    for (size_t i = 0; i < r->count; ++i)
        if (r->hits[i].primitive != RT_MISS) {
            r->next[count] =
                next_ray(s->scene, &r->rays[i], &r->hits[i], (uint32_t)i, &r->at_once[count]);
            r->source[count++] = i;
        }
    if (!rt_renderer_trace(renderer, r->next, count, r->next_hits, s->status))
        return false;
    entry->next_rays = count;
    for (size_t i = 0; i < count; ++i)
        entry->self_hits += r->next_hits[i].primitive == r->hits[r->source[i]].primitive &&
                            r->next_hits[i].t < r->at_once[i];
    return true;
}

bool rt_study_trace_rays(study_state *s, rt_renderer *const *renderers)
{
    rt_scene reference = *s->scene;
    reference.accuracy = RT_ACCURACY_DOUBLE;
    const size_t pixels = (size_t)reference.width * (size_t)reference.height;
    /* Odd, so that rays do not stand in columns of a picture of even width. */
    const size_t stride = ((pixels + RAYS_MOST - 1) / RAYS_MOST) | 1;
    ray_set r;
    rt_study_begin_part(s, RT_WORK_RAYS, 1.0);
    bool good = make_set(&r, (pixels + stride - 1) / stride, s->status);
    if (good) {
        make_primary_rays(&reference, stride, r.rays, r.count);
        good = trace_reference(s, &reference, &r);
    }
    for (size_t i = 0; good && i < s->study->entry_count; ++i) {
        rt_study_entry *entry = &s->study->entries[i];
        good = rt_renderer_trace(renderers[i], r.rays, r.count, r.hits, s->status);
        if (good) {
            compare_hits(&r, entry);
            good = trace_next(s, &r, renderers[i], entry);
        }
        good =
            good && rt_study_tick(s, 0.5 + 0.5 * (double)(i + 1) / (double)s->study->entry_count);
    }
    free_set(&r);
    return good;
}
