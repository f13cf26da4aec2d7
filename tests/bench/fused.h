/* One kernel by hand for plain scenes (fused.cl), to hold the stages against. */
#ifndef BENCH_FUSED_H
#define BENCH_FUSED_H

#include <stdbool.h>

#include "bvh/bvh.h"
#include "common/status.h"
#include "opencl/cl.h"
#include "opencl/device.h"
#include "render/device_scene.h"
#include "scene/scene.h"

typedef struct bench_fused {
    cl_context context;
    cl_command_queue queue;
    cl_program program;
    cl_kernel kernel;
    cl_mem picture; /* a tile of it: more would not stay in the caches */
    rt_device_scene scene;
    int width, height;
} bench_fused;

/* For a scene of spheres and triangles without effects at standard, whose width and height are
 * multiples of RT_BLOCK_SIDE; without a tree every ray meets every primitive. `packet` as in
 * rt_render_options, not 0. On failure, too, the caller clears. */
bool bench_fused_make(bench_fused *fused, const rt_device *device, const rt_scene *scene,
                      const rt_bvh *bvh, int packet, rt_status *status);
void bench_fused_clear(bench_fused *fused);

/* Draws into rgb, row by row, in tiles of the stages' size; the seconds are those of the kernel
 * alone. */
bool bench_fused_draw(bench_fused *fused, float *rgb, double *seconds, rt_status *status);

#endif
