#include "bench/ours.h"

#include <stdlib.h>

#include "bvh/bvh.h"
#include "common/clock.h"
#include "common/parallel.h"

bool bench_ours_make(bench_ours *ours, const rt_device *device, const rt_scene *scene, size_t rays,
                     rt_status *status)
{
    const rt_render_options options = {.with_occlusion = true};
    *ours = (bench_ours){.capacity = rays};
    ours->hits = malloc(rays * sizeof *ours->hits);
    if (!ours->hits)
        return rt_status_no_memory(status, "hits");
    rt_bvh bvh;
    if (!rt_bvh_build(&bvh, scene, rt_parallel_processors(), status))
        return false;
    ours->renderer = rt_renderer_new(device, scene, &bvh, &options, status);
    rt_bvh_clear(&bvh);
    return ours->renderer != NULL;
}

void bench_ours_clear(bench_ours *ours)
{
    rt_renderer_free(ours->renderer);
    free(ours->hits);
    *ours = (bench_ours){.renderer = NULL};
}

static bool trace_nearest(bench_ours *ours, const bench_rays *rays, uint8_t *is_hit,
                          rt_status *status)
{
    if (!rt_renderer_trace(ours->renderer, rays->rays, rays->count, ours->hits, status))
        return false;
    for (size_t i = 0; i < rays->count; ++i)
        is_hit[i] = ours->hits[i].primitive != RT_MISS;
    return true;
}

/* The stages that trace rays. */
static double kernel_seconds(const bench_ours *ours)
{
    const rt_render_times *times = rt_renderer_times(ours->renderer);
    return times->stages[RT_STAGE_TRACE] + times->stages[RT_STAGE_OCCLUDE];
}

bool bench_ours_trace(bench_ours *ours, const bench_rays *rays, bool any_hit, uint8_t *is_hit,
                      double *seconds, rt_status *status)
{
    if (rays->count > ours->capacity)
        return rt_status_fail(status, RT_ERROR_USAGE, "bench: too many rays for the hit array");
    const double before = kernel_seconds(ours);
    if (!(any_hit ? rt_renderer_occluded(ours->renderer, rays->rays, rays->count, is_hit, status)
                  : trace_nearest(ours, rays, is_hit, status)))
        return false;
    *seconds = kernel_seconds(ours) - before;
    return true;
}

bool bench_ours_build(const rt_scene *scene, double *seconds, rt_status *status)
{
    rt_bvh bvh;
    const double start = rt_clock_seconds();
    if (!rt_bvh_build(&bvh, scene, rt_parallel_processors(), status))
        return false;
    *seconds = rt_clock_seconds() - start;
    rt_bvh_clear(&bvh);
    return true;
}
