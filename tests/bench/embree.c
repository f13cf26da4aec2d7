#define _GNU_SOURCE
#include "bench/embree.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __SSE3__
#include <pmmintrin.h>
#endif

#include "common/clock.h"

#define LANES 16
/* Rays that a thread takes at a time. */
#define CHUNK 1024
#define THREADS_MAX 256

/* Read and written like the arrays of rt's trace kernel: eight components in, four out. */
struct bench_packet {
    float ox[LANES], oy[LANES], oz[LANES], dx[LANES], dy[LANES], dz[LANES], tmin[LANES],
        tmax[LANES];
};

typedef struct results {
    int32_t *primitive;
    float *t, *u, *v;
    uint8_t *occluded;
} results;

struct bench_embree {
    RTCDevice device;
    RTCScene scene;
    int threads;
    double build_seconds;
    atomic_llong bytes;
    size_t capacity; /* rays */
    results found;   /* owned arrays, in the order of the rays or of the packets' lanes */
    size_t count;
    enum bench_call call;
};

typedef struct job {
    bench_embree *embree;
    const bench_packets *packets;
    enum RTCIntersectContextFlags flags;
    atomic_size_t next;
    pthread_barrier_t ready;
} job;

/* A thread and when it worked: its own word, since the one that waits for it may be woken late. */
typedef struct worker {
    pthread_t thread;
    job *job;
    double start, end;
} worker;

bool bench_packets_make(bench_packets *packets, const bench_rays *rays, rt_status *status)
{
    const size_t count = rays->count / LANES;
    packets->rays = rays;
    packets->packets = aligned_alloc(64, count * sizeof *packets->packets);
    if (!packets->packets)
        return rt_status_no_memory(status, "packets");
    for (size_t i = 0; i < count; ++i)
        for (size_t lane = 0; lane < LANES; ++lane) {
            const rt_ray *ray = &rays->rays[i * LANES + lane];
            struct bench_packet *p = &packets->packets[i];
            p->ox[lane] = ray->origin[0];
            p->oy[lane] = ray->origin[1];
            p->oz[lane] = ray->origin[2];
            p->dx[lane] = ray->direction[0];
            p->dy[lane] = ray->direction[1];
            p->dz[lane] = ray->direction[2];
            p->tmin[lane] = ray->tmin;
            p->tmax[lane] = ray->tmax;
        }
    return true;
}

void bench_packets_clear(bench_packets *packets)
{
    free(packets->packets);
    *packets = (bench_packets){NULL, NULL};
}

static bool check(const bench_embree *e, const char *what, rt_status *status)
{
    const enum RTCError error = rtcGetDeviceError(e->device);
    return error == RTC_ERROR_NONE ||
           rt_status_fail(status, RT_ERROR_DEVICE, "bench: Embree: %s: error %d", what, (int)error);
}

static bool count_bytes(void *context, ssize_t bytes, bool after)
{
    (void)after;
    bench_embree *e = context;
    atomic_fetch_add(&e->bytes, (long long)bytes);
    return true;
}

static bool copy_buffer(RTCGeometry geometry, enum RTCBufferType type, enum RTCFormat format,
                        const void *bytes, size_t size, size_t count)
{
    void *buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, size, count);
    if (buffer)
        memcpy(buffer, bytes, size * count);
    return buffer != NULL;
}

static RTCGeometry make_geometry(const bench_embree *e, const bench_input *input)
{
    const rt_scene *scene = &input->scene;
    const bool is_mesh = input->vertices != NULL;
    RTCGeometry geometry = rtcNewGeometry(e->device, is_mesh ? RTC_GEOMETRY_TYPE_TRIANGLE
                                                             : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (is_mesh) {
        copy_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, input->vertices,
                    3 * sizeof *input->vertices, input->vertex_count);
        copy_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, input->indices,
                    3 * sizeof *input->indices, scene->triangle_count);
    } else {
        /* An rt_sphere is Embree's (x, y, z, radius). */
        copy_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, scene->spheres,
                    sizeof *scene->spheres, scene->sphere_count);
    }
    rtcCommitGeometry(geometry);
    return geometry;
}

static bool build(bench_embree *e, const bench_input *input, bool is_robust, rt_status *status)
{
    char options[64];
    snprintf(options, sizeof options, "threads=%d", e->threads);
    e->device = rtcNewDevice(options);
    if (!e->device)
        return rt_status_fail(status, RT_ERROR_DEVICE, "bench: Embree makes no device");
    e->scene = rtcNewScene(e->device);
    rtcSetSceneBuildQuality(e->scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(e->scene, is_robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    RTCGeometry geometry = make_geometry(e, input);
    rtcAttachGeometry(e->scene, geometry);
    rtcReleaseGeometry(geometry);
    if (!check(e, "geometry", status))
        return false;
    /* From here on, so that the copies above are not counted. */
    rtcSetDeviceMemoryMonitorFunction(e->device, count_bytes, e);
    const double start = rt_clock_seconds();
    rtcCommitScene(e->scene);
    e->build_seconds = rt_clock_seconds() - start;
    return check(e, "rtcCommitScene", status);
}

static bool allocate_results(bench_embree *e, size_t rays, rt_status *status)
{
    results *f = &e->found;
    e->capacity = rays;
    f->primitive = malloc(rays * sizeof *f->primitive);
    f->t = malloc(rays * sizeof *f->t);
    f->u = malloc(rays * sizeof *f->u);
    f->v = malloc(rays * sizeof *f->v);
    f->occluded = malloc(rays);
    return (f->primitive && f->t && f->u && f->v && f->occluded) ||
           rt_status_no_memory(status, "Embree's hits");
}

bench_embree *bench_embree_new(const bench_input *input, bool is_robust, int threads, size_t rays,
                               rt_status *status)
{
    bench_embree *e = calloc(1, sizeof *e);
    if (!e) {
        rt_status_no_memory(status, "Embree");
        return NULL;
    }
    e->threads = threads < THREADS_MAX ? threads : THREADS_MAX;
    if ((rays == 0 || allocate_results(e, rays, status)) && build(e, input, is_robust, status))
        return e;
    bench_embree_free(e);
    return NULL;
}

void bench_embree_free(bench_embree *e)
{
    if (!e)
        return;
    if (e->scene)
        rtcReleaseScene(e->scene);
    if (e->device)
        rtcReleaseDevice(e->device);
    free(e->found.primitive);
    free(e->found.t);
    free(e->found.u);
    free(e->found.v);
    free(e->found.occluded);
    free(e);
}

double bench_embree_build_seconds(const bench_embree *e)
{
    return e->build_seconds;
}

size_t bench_embree_bytes(const bench_embree *e)
{
    const long long bytes = atomic_load(&e->bytes);
    return bytes > 0 ? (size_t)bytes : 0;
}

static struct RTCRay single_ray(const rt_ray *ray)
{
    return (struct RTCRay){.org_x = ray->origin[0],
                           .org_y = ray->origin[1],
                           .org_z = ray->origin[2],
                           .tnear = ray->tmin,
                           .dir_x = ray->direction[0],
                           .dir_y = ray->direction[1],
                           .dir_z = ray->direction[2],
                           .tfar = ray->tmax,
                           .mask = UINT32_MAX};
}

static void intersect1(const job *j, struct RTCIntersectContext *context, size_t first, size_t end)
{
    const results *f = &j->embree->found;
    for (size_t i = first; i < end; ++i) {
        const rt_ray *ray = &j->packets->rays->rays[i];
        struct RTCRayHit r;
        r.ray = single_ray(ray);
        r.hit.geomID = r.hit.primID = RTC_INVALID_GEOMETRY_ID;
        r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        if (!bench_ray_is_dead(ray))
            rtcIntersect1(j->embree->scene, context, &r);
        f->primitive[i] = (int32_t)r.hit.primID;
        f->t[i] = r.ray.tfar;
        f->u[i] = r.hit.u;
        f->v[i] = r.hit.v;
    }
}

static void occluded1(const job *j, struct RTCIntersectContext *context, size_t first, size_t end)
{
    for (size_t i = first; i < end; ++i) {
        const rt_ray *ray = &j->packets->rays->rays[i];
        struct RTCRay r = single_ray(ray);
        const bool is_dead = bench_ray_is_dead(ray);
        if (!is_dead)
            rtcOccluded1(j->embree->scene, context, &r);
        j->embree->found.occluded[i] = !is_dead && r.tfar < 0.0f;
    }
}

/* Returns whether any lane is alive. */
static bool load_packet(const struct bench_packet *p, struct RTCRay16 *ray, int valid[LANES])
{
    memcpy(ray->org_x, p->ox, sizeof p->ox);
    memcpy(ray->org_y, p->oy, sizeof p->oy);
    memcpy(ray->org_z, p->oz, sizeof p->oz);
    memcpy(ray->dir_x, p->dx, sizeof p->dx);
    memcpy(ray->dir_y, p->dy, sizeof p->dy);
    memcpy(ray->dir_z, p->dz, sizeof p->dz);
    memcpy(ray->tnear, p->tmin, sizeof p->tmin);
    memcpy(ray->tfar, p->tmax, sizeof p->tmax);
    memset(ray->time, 0, sizeof ray->time);
    memset(ray->mask, 0xff, sizeof ray->mask);
    memset(ray->id, 0, sizeof ray->id);
    memset(ray->flags, 0, sizeof ray->flags);
    int any = 0;
    for (int lane = 0; lane < LANES; ++lane) {
        valid[lane] = p->tmax[lane] < p->tmin[lane] ? 0 : -1;
        any |= valid[lane];
    }
    return any != 0;
}

static void intersect16(const job *j, struct RTCIntersectContext *context, size_t first, size_t end)
{
    const results *f = &j->embree->found;
    for (size_t i = first; i < end; i += LANES) {
        struct RTCRayHit16 r;
        _Alignas(64) int valid[LANES];
        memset(r.hit.primID, 0xff, sizeof r.hit.primID);
        memset(r.hit.geomID, 0xff, sizeof r.hit.geomID);
        memset(r.hit.instID, 0xff, sizeof r.hit.instID);
        if (load_packet(&j->packets->packets[i / LANES], &r.ray, valid))
            rtcIntersect16(valid, j->embree->scene, context, &r);
        memcpy(f->primitive + i, r.hit.primID, sizeof r.hit.primID);
        memcpy(f->t + i, r.ray.tfar, sizeof r.ray.tfar);
        memcpy(f->u + i, r.hit.u, sizeof r.hit.u);
        memcpy(f->v + i, r.hit.v, sizeof r.hit.v);
    }
}

static void occluded16(const job *j, struct RTCIntersectContext *context, size_t first, size_t end)
{
    for (size_t i = first; i < end; i += LANES) {
        struct RTCRay16 r;
        _Alignas(64) int valid[LANES];
        if (load_packet(&j->packets->packets[i / LANES], &r, valid))
            rtcOccluded16(valid, j->embree->scene, context, &r);
        for (size_t lane = 0; lane < LANES; ++lane)
            j->embree->found.occluded[i + lane] = valid[lane] && r.tfar[lane] < 0.0f;
    }
}

static void *work(void *argument)
{
    static void (*const calls[])(const job *, struct RTCIntersectContext *, size_t,
                                 size_t) = {[BENCH_INTERSECT1] = intersect1,
                                            [BENCH_INTERSECT16] = intersect16,
                                            [BENCH_OCCLUDED1] = occluded1,
                                            [BENCH_OCCLUDED16] = occluded16};
    worker *w = argument;
    job *j = w->job;
#ifdef __SSE3__
    /* As Embree's manual asks for; in these threads alone, since OpenCL threads inherit it. */
    _mm_setcsr(_mm_getcsr() | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
#endif
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = j->flags;
    pthread_barrier_wait(&j->ready);
    w->start = rt_clock_seconds();
    const size_t count = j->packets->rays->count;
    size_t first;
    while ((first = atomic_fetch_add(&j->next, CHUNK)) < count)
        calls[j->embree->call](j, &context, first, first + CHUNK < count ? first + CHUNK : count);
    w->end = rt_clock_seconds();
    return NULL;
}

bool bench_embree_trace(bench_embree *e, const bench_packets *packets, enum bench_call call,
                        bool is_coherent, double *seconds, rt_status *status)
{
    job j = {.embree = e,
             .packets = packets,
             .flags = is_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                  : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT};
    worker workers[THREADS_MAX];
    if (packets->rays->count > e->capacity)
        return rt_status_fail(status, RT_ERROR_USAGE, "bench: too many rays for Embree's arrays");
    e->call = call;
    e->count = packets->rays->count;
    pthread_barrier_init(&j.ready, NULL, (unsigned)e->threads);
    for (int i = 0; i < e->threads; ++i) {
        workers[i].job = &j;
        if (pthread_create(&workers[i].thread, NULL, work, &workers[i]) != 0) {
            /* Those that run wait for the rest: there is no going on. */
            fputs("bench: cannot start a thread\n", stderr);
            abort();
        }
    }
    double start = INFINITY, end = 0.0;
    for (int i = 0; i < e->threads; ++i) {
        pthread_join(workers[i].thread, NULL);
        start = fmin(start, workers[i].start);
        end = fmax(end, workers[i].end);
    }
    *seconds = end - start;
    pthread_barrier_destroy(&j.ready);
    return check(e, "tracing", status);
}

void bench_embree_hits(const bench_embree *e, rt_hit *hits)
{
    const results *f = &e->found;
    for (size_t i = 0; i < e->count; ++i)
        hits[i] = (rt_hit){f->primitive[i], f->t[i], f->u[i], f->v[i]};
}

void bench_embree_is_hit(const bench_embree *e, uint8_t *is_hit)
{
    const bool is_any = e->call == BENCH_OCCLUDED1 || e->call == BENCH_OCCLUDED16;
    for (size_t i = 0; i < e->count; ++i)
        is_hit[i] = is_any ? e->found.occluded[i]
                           : e->found.primitive[i] != (int32_t)RTC_INVALID_GEOMETRY_ID;
}
