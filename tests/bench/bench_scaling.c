/* Time and memory against the number of triangles, beside Embree: building, primary rays, and bytes
 * a triangle. */
#define _GNU_SOURCE
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/bench.h"
#include "bench/building.h"
#include "bench/embree.h"
#include "bench/meshes.h"
#include "bench/ours.h"
#include "bench/rays.h"
#include "bench/samples.h"

#define SIZE_DEFAULT 1024
/* Below this, pages and thread stacks weigh more than the triangles, and bytes a triangle tell
 * nothing. */
#define MEMORY_FROM 1e5

/* Resident bytes of this process, with what the allocator could give back given back; 0 where the
 * system does not tell. */
static double resident_bytes(void)
{
    malloc_trim(0);
    FILE *in = fopen("/proc/self/statm", "r");
    long whole = 0, resident = 0;
    if (!in)
        return 0.0;
    if (fscanf(in, "%ld %ld", &whole, &resident) != 2)
        resident = 0;
    fclose(in);
    return (double)resident * (double)sysconf(_SC_PAGESIZE);
}

/* Bytes by which a renderer that has traced the input's primary rays once makes the process grow.
 */
static bool grow_ours(bench *b, const bench_input *input, const bench_rays *rays, double *bytes)
{
    bench_ours ours;
    double seconds;
    uint8_t *is_hit = calloc(rays->count, 1);
    if (!is_hit)
        return rt_status_no_memory(&b->status, "hits");
    const double before = resident_bytes();
    const bool good = bench_find_device(b) &&
                      bench_ours_make(&ours, b->device, &input->scene, rays->count, &b->status) &&
                      bench_ours_trace(&ours, rays, false, is_hit, &seconds, &b->status);
    *bytes = resident_bytes() - before;
    if (b->device)
        bench_ours_clear(&ours);
    free(is_hit);
    return good;
}

static bool grow_theirs(bench *b, const bench_input *input, const bench_rays *rays, double *bytes)
{
    double seconds;
    bench_packets packets;
    if (!bench_packets_make(&packets, rays, &b->status))
        return false;
    const double before = resident_bytes();
    bench_embree *e = bench_embree_new(input, false, b->settings.threads, rays->count, &b->status);
    const bool good =
        e && bench_embree_trace(e, &packets, BENCH_INTERSECT16, true, &seconds, &b->status);
    *bytes = resident_bytes() - before;
    bench_embree_free(e);
    bench_packets_clear(&packets);
    return good;
}

typedef bool grow(bench *b, const bench_input *input, const bench_rays *rays, double *bytes);

/* The growth for the mesh, less that for the smallest mesh, which stands for everything that does
 * not depend on the triangles: threads, kernels, ray arrays. */
static bool grow_by_triangles(bench *b, unsigned frequency, grow *measure, double *bytes)
{
    /* Few rays: they are not what is measured. */
    const int size = 64;
    bench_input small = {.vertices = NULL}, large = {.vertices = NULL};
    bench_rays rays = {NULL, 0};
    double base = 0.0;
    /* The smallest mesh goes twice: the first time brings in libraries and compiles kernels. */
    const bool good = bench_input_icosphere(&small, 1, size, &b->status) &&
                      bench_input_icosphere(&large, frequency, size, &b->status) &&
                      bench_rays_primary(&rays, &small.scene, &b->status) &&
                      measure(b, &small, &rays, &base) && measure(b, &small, &rays, &base) &&
                      measure(b, &large, &rays, bytes);
    *bytes -= base;
    bench_rays_clear(&rays);
    bench_input_clear(&small);
    bench_input_clear(&large);
    return good;
}

/* In a process of its own, so that no earlier allocation is in the way. */
static bool grow_in_child(bench *b, unsigned frequency, grow *measure, double *bytes)
{
    int ends[2];
    if (pipe(ends) != 0)
        return rt_status_fail(&b->status, RT_ERROR_OUTPUT, "bench: cannot make a pipe");
    const pid_t child = fork();
    if (child == 0) {
        double value = 0.0;
        const bool good = grow_by_triangles(b, frequency, measure, &value) &&
                          write(ends[1], &value, sizeof value) == (ssize_t)sizeof value;
        if (b->status.text)
            fputs(b->status.text, stderr);
        _exit(good ? 0 : 1);
    }
    close(ends[1]);
    const bool is_whole =
        child > 0 && read(ends[0], bytes, sizeof *bytes) == (ssize_t)sizeof *bytes;
    close(ends[0]);
    int state = 0;
    if (child > 0)
        waitpid(child, &state, 0);
    return is_whole ||
           rt_status_fail(&b->status, RT_ERROR_DEVICE, "bench: memory could not be measured");
}

static bool measure_memory(bench *b, unsigned frequency)
{
    const double triangles = 20.0 * frequency * frequency;
    double ours = 0.0, theirs = 0.0;
    if (!grow_in_child(b, frequency, grow_ours, &ours) ||
        !grow_in_child(b, frequency, grow_theirs, &theirs))
        return false;
    char label[32];
    snprintf(label, sizeof label, "%.0f triangles", triangles);
    ours /= triangles;
    theirs /= triangles;
    const double ratio = theirs / ours;
    const bench_row row = {.what = "memory, vertices included",
                           .input = label,
                           .against = "Embree, default quality",
                           .unit = "bytes/triangle",
                           .ours = {ours, ours, ours},
                           .theirs = {theirs, theirs, theirs},
                           .ratio = {ratio, ratio, ratio},
                           .bar = 1.0};
    return bench_report_add(&b->report, &row, &b->status);
}

typedef struct tracer {
    bench_ours *ours; /* NULL for Embree */
    bench_embree *embree;
    const bench_packets *packets;
    uint8_t *is_hit; /* owned */
} tracer;

static bool trace(void *context, double *seconds, rt_status *status)
{
    const tracer *t = context;
    if (t->ours)
        return bench_ours_trace(t->ours, t->packets->rays, false, t->is_hit, seconds, status);
    return bench_embree_trace(t->embree, t->packets, BENCH_INTERSECT16, true, seconds, status);
}

static bool report_time(bench *b, const bench_input *input, const bench_contender c[2],
                        const tracer t[2])
{
    bench_agreement hits = {.rays = t[0].packets->rays->count};
    bench_embree_is_hit(t[1].embree, t[1].is_hit);
    for (size_t i = 0; i < hits.rays; ++i) {
        hits.ours += t[0].is_hit[i];
        hits.theirs += t[1].is_hit[i];
        hits.apart += t[0].is_hit[i] != t[1].is_hit[i];
    }
    const int repeats = b->settings.repeats;
    const bench_row row = {.what = "primary rays by count",
                           .input = input->label,
                           .against = "Embree rtcIntersect16 coherent",
                           .unit = "s",
                           .ours = bench_quartiles_of(c[0].seconds, repeats),
                           .theirs = bench_quartiles_of(c[1].seconds, repeats),
                           .ratio = bench_ratio(c[1].seconds, c[0].seconds, repeats),
                           .hits = hits};
    return bench_report_add(&b->report, &row, &b->status);
}

static bool measure_time(bench *b, const bench_input *input)
{
    bench_rays rays = {NULL, 0};
    bench_packets packets = {NULL, NULL};
    bench_ours ours = {.renderer = NULL};
    bench_embree *embree = NULL;
    tracer t[2] = {{.ours = &ours, .packets = &packets}, {.packets = &packets}};
    bench_contender c[2] = {{.name = "rt", .run = trace, .context = &t[0]},
                            {.name = "Embree", .run = trace, .context = &t[1]}};
    bool good = bench_rays_primary(&rays, &input->scene, &b->status) &&
                bench_packets_make(&packets, &rays, &b->status) && bench_find_device(b) &&
                bench_ours_make(&ours, b->device, &input->scene, rays.count, &b->status) &&
                (embree = bench_embree_new(input, false, b->settings.threads, rays.count,
                                           &b->status)) != NULL;
    for (int i = 0; good && i < 2; ++i)
        if (!(t[i].is_hit = malloc(rays.count)))
            good = rt_status_no_memory(&b->status, "hits");
    t[1].embree = embree;
    good =
        good && bench_measure(c, 2, b->settings.repeats, &b->status) && report_time(b, input, c, t);
    bench_contenders_clear(c, 2);
    for (int i = 0; i < 2; ++i)
        free(t[i].is_hit);
    bench_embree_free(embree);
    bench_ours_clear(&ours);
    bench_packets_clear(&packets);
    bench_rays_clear(&rays);
    return good;
}

static bool measure_times(bench *b, unsigned frequency)
{
    bench_input input;
    const bool good = bench_input_icosphere(&input, frequency, b->settings.size, &b->status) &&
                      measure_time(b, &input) && bench_measure_building(b, &input);
    bench_input_clear(&input);
    return good;
}

/* 10^3, 10^4 ... triangles, as near as an icosphere comes. Memory first, since its children are
 * forked before this process speaks to OpenCL. */
static bool measure_all(bench *b)
{
    bench_settings *s = &b->settings;
    if (s->size == 0)
        s->size = SIZE_DEFAULT;
    const double most = s->level >= 0 ? 20.0 * pow(4.0, s->level) : s->huge ? 1e7 : 1e6;
    for (double count = MEMORY_FROM; count <= most; count *= 10.0)
        if (!measure_memory(b, bench_frequency((size_t)count)))
            return false;
    for (double count = 1e3; count <= most; count *= 10.0)
        if (!measure_times(b, bench_frequency((size_t)count)))
            return false;
    return true;
}

int main(int argc, char **argv)
{
    return bench_main(argc, argv, measure_all);
}
