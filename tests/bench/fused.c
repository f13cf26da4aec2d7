#include "bench/fused.h"

#include <stdlib.h>

#include "common/file.h"
#include "opencl/kernel_text.h"
#include "render/renderer.h"
#include "render/tiles.h"
#include "scene/camera.h"
#include "scene/effects.h"
#include "render/variant.h"

#define SOURCE "tests/bench/fused.cl"
#define TILE_BYTES ((size_t)RT_TILE_DEFAULT * RT_TILE_DEFAULT * RT_COLOR_COMPONENTS * sizeof(float))
/* Tiles whose times are taken at once. */
#define TILES_AT_ONCE 64

static bool report_log(const bench_fused *f, const rt_device *device, rt_status *status)
{
    char log[8192] = "";
    clGetProgramBuildInfo(f->program, device->id, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log, NULL);
    return rt_status_fail(status, RT_ERROR_DEVICE, "bench: %s does not build\n%s", SOURCE, log);
}

/* The kernels' own text, with the options that the stages would get, and fused.cl behind it. */
static bool build(bench_fused *f, const rt_device *device, const rt_scene *scene, const rt_bvh *bvh,
                  int packet, rt_status *status)
{
    const rt_effects effects = rt_effects_of(scene);
    const rt_walk walk = {rt_device_lanes(device, scene->accuracy), packet,
                          bvh ? bvh->stack_size : 0, scene->accuracy};
    char options[RT_VARIANT_OPTIONS_SIZE];
    rt_variant_options(RT_PART_ALL, &effects, &walk, rt_variant_rounding(device), options);
    rt_file_text text = {NULL, 0};
    const char *reason = rt_file_read(SOURCE, &text);
    if (reason)
        return rt_status_fail(status, RT_ERROR_USAGE, "bench: cannot read '%s': %s", SOURCE,
                              reason);
    const char *parts[] = {rt_kernel_text, "#line 1 \"" SOURCE "\"\n", text.bytes};
    const size_t lengths[] = {rt_kernel_text_length, 0, text.length};
    cl_int error = CL_SUCCESS;
    f->program = clCreateProgramWithSource(f->context, 3, parts, lengths, &error);
    rt_file_free(&text);
    if (!RT_CL_MADE(error, "clCreateProgramWithSource", status))
        return false;
    error = clBuildProgram(f->program, 1, &device->id, options, NULL, NULL);
    if (error == CL_BUILD_PROGRAM_FAILURE)
        return report_log(f, device, status);
    if (!RT_CL_MADE(error, "clBuildProgram", status))
        return false;
    f->kernel = clCreateKernel(f->program, "fused", &error);
    return RT_CL_MADE(error, "clCreateKernel", status) &&
           rt_device_scene_upload(&f->scene, f->context, f->queue, scene, bvh, &effects, status);
}

static bool set_arguments(const bench_fused *f, const rt_scene *scene, rt_status *status)
{
    const rt_tile no_tile = {0, 0, 0, 0};
    const rt_frame frame = rt_scene_frame(scene);
    const rt_surround around = {scene->background.x, scene->background.y, scene->background.z,
                                scene->ambient.x,    scene->ambient.y,    scene->ambient.z};
    const rt_device_scene *s = &f->scene;
    const struct {
        const void *value;
        size_t size;
    } arguments[] = {
        {&no_tile, sizeof no_tile},
        {&frame, sizeof frame},
        {&s->nodes, sizeof s->nodes},
        {&s->order, sizeof s->order},
        {&s->blocks[RT_KIND_SPHERES], sizeof s->blocks[RT_KIND_SPHERES]},
        {&s->block_counts[RT_KIND_SPHERES], sizeof s->block_counts[RT_KIND_SPHERES]},
        {&s->blocks[RT_KIND_TRIANGLES], sizeof s->blocks[RT_KIND_TRIANGLES]},
        {&s->block_counts[RT_KIND_TRIANGLES], sizeof s->block_counts[RT_KIND_TRIANGLES]},
        {&s->counts[RT_KIND_SPHERES], sizeof s->counts[RT_KIND_SPHERES]},
        {&s->materials_of, sizeof s->materials_of},
        {&s->materials, sizeof s->materials},
        {&s->lights, sizeof s->lights},
        {&around, sizeof around},
        {&f->picture, sizeof f->picture}};
    for (size_t i = 0; i < sizeof arguments / sizeof *arguments; ++i)
        if (!RT_CL(clSetKernelArg(f->kernel, (cl_uint)i, arguments[i].size, arguments[i].value),
                   status))
            return false;
    return true;
}

bool bench_fused_make(bench_fused *f, const rt_device *device, const rt_scene *scene,
                      const rt_bvh *bvh, int packet, rt_status *status)
{
    const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM,
                                                (cl_context_properties)device->platform, 0};
    cl_int error = CL_SUCCESS;
    *f = (bench_fused){.width = scene->width, .height = scene->height};
    f->context = clCreateContext(properties, 1, &device->id, NULL, NULL, &error);
    if (!RT_CL_MADE(error, "clCreateContext", status))
        return false;
    f->queue = clCreateCommandQueue(f->context, device->id, CL_QUEUE_PROFILING_ENABLE, &error);
    return RT_CL_MADE(error, "clCreateCommandQueue", status) &&
           build(f, device, scene, bvh, packet, status) &&
           rt_buffer_make(f->context, CL_MEM_WRITE_ONLY, TILE_BYTES, &f->picture, status) &&
           set_arguments(f, scene, status);
}

void bench_fused_clear(bench_fused *f)
{
    rt_device_scene_release(&f->scene);
    if (f->picture)
        clReleaseMemObject(f->picture);
    if (f->kernel)
        clReleaseKernel(f->kernel);
    if (f->program)
        clReleaseProgram(f->program);
    if (f->queue)
        clReleaseCommandQueue(f->queue);
    if (f->context)
        clReleaseContext(f->context);
    *f = (bench_fused){.context = NULL};
}

/* Waits for the kernels so far and adds up their times. */
static bool land(bench_fused *f, cl_event *events, size_t count, double *seconds, rt_status *status)
{
    bool good = RT_CL(clFinish(f->queue), status);
    for (size_t i = 0; i < count; ++i) {
        cl_ulong start = 0, end = 0;
        good = good &&
               RT_CL(clGetEventProfilingInfo(events[i], CL_PROFILING_COMMAND_START, sizeof start,
                                             &start, NULL),
                     status) &&
               RT_CL(clGetEventProfilingInfo(events[i], CL_PROFILING_COMMAND_END, sizeof end, &end,
                                             NULL),
                     status);
        *seconds += 1e-9 * (double)(end - start);
        clReleaseEvent(events[i]);
    }
    return good;
}

static bool start_tile(bench_fused *f, const rt_tile *tile, float *rgb, cl_event *event,
                       rt_status *status)
{
    const size_t pixel = RT_COLOR_COMPONENTS * sizeof *rgb;
    const size_t global = (size_t)tile->width * (size_t)tile->height / RT_BLOCK_RAYS, local = 1;
    const size_t source[3] = {0, 0, 0};
    const size_t target[3] = {(size_t)tile->x * pixel, (size_t)tile->y, 0};
    const size_t region[3] = {(size_t)tile->width * pixel, (size_t)tile->height, 1};
    return RT_CL(clSetKernelArg(f->kernel, 0, sizeof *tile, tile), status) &&
           RT_CL(clEnqueueNDRangeKernel(f->queue, f->kernel, 1, NULL, &global, &local, 0, NULL,
                                        event),
                 status) &&
           RT_CL(clEnqueueReadBufferRect(f->queue, f->picture, CL_FALSE, source, target, region,
                                         region[0], 0, (size_t)f->width * pixel, 0, rgb, 0, NULL,
                                         NULL),
                 status) &&
           RT_CL(clFlush(f->queue), status);
}

bool bench_fused_draw(bench_fused *f, float *rgb, double *seconds, rt_status *status)
{
    cl_event events[TILES_AT_ONCE] = {NULL};
    size_t count = 0;
    rt_tiles tiles;
    rt_tiles_init(&tiles, f->width, f->height, RT_TILE_DEFAULT, 1);
    rt_taker taker = {&tiles, 0};
    rt_tile tile;
    bool good = true;
    *seconds = 0.0;
    while (good && rt_tiles_take(&taker, &tile)) {
        good = start_tile(f, &tile, rgb, &events[count], status);
        count += events[count] != NULL;
        if (count == TILES_AT_ONCE) {
            good = land(f, events, count, seconds, status) && good;
            for (; count > 0; --count)
                events[count - 1] = NULL;
        }
    }
    return land(f, events, count, seconds, status) && good;
}
