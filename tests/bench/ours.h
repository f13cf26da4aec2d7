/* rt as a tracer: its own kernels, driven by a ray set, timed by the device's events. */
#ifndef BENCH_OURS_H
#define BENCH_OURS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "bench/rays.h"
#include "common/status.h"
#include "opencl/device.h"
#include "render/renderer.h"
#include "scene/scene.h"

typedef struct bench_ours {
    rt_renderer *renderer; /* owned */
    rt_hit *hits;          /* owned */
    size_t capacity;       /* rays */
} bench_ours;

/* `rays` is the most that a trace will take. */
bool bench_ours_make(bench_ours *ours, const rt_device *device, const rt_scene *scene, size_t rays,
                     rt_status *status);
void bench_ours_clear(bench_ours *ours);

/* Traces all rays for their nearest hit, or for any; `is_hit` gets a byte a ray. Seconds are those
 * of the kernel alone. */
bool bench_ours_trace(bench_ours *ours, const bench_rays *rays, bool any_hit, uint8_t *is_hit,
                      double *seconds, rt_status *status);

/* Wall seconds of building the tree over the scene; NaN as long as there is no tree. */
bool bench_ours_build(const rt_scene *scene, double *seconds, rt_status *status);

#endif
