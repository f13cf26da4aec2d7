#include "fused.h"

#include <stdlib.h>

#include "effects.h"
#include "file.h"
#include "kernel_text.h"
#include "program.h"

#define SOURCE "tests/bench/fused.cl"

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
                          bvh ? bvh->stack_size : 0, false, scene->accuracy};
    char options[RT_PROGRAM_OPTIONS_SIZE];
    rt_program_options(&effects, &walk, rt_program_rounding(device), options);
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
    const rt_frame frame = rt_scene_frame(scene);
    const rt_surround around = {scene->background.x, scene->background.y, scene->background.z,
                                scene->ambient.x,    scene->ambient.y,    scene->ambient.z};
    const rt_device_scene *s = &f->scene;
    const struct {
        const void *value;
        size_t size;
    } arguments[] = {{&frame, sizeof frame},
                     {&s->nodes, sizeof s->nodes},
                     {&s->order, sizeof s->order},
                     {&s->spheres, sizeof s->spheres},
                     {&s->sphere_blocks, sizeof s->sphere_blocks},
                     {&s->triangles, sizeof s->triangles},
                     {&s->triangle_blocks, sizeof s->triangle_blocks},
                     {&s->sphere_count, sizeof s->sphere_count},
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
    *f = (bench_fused){.pixels = (size_t)scene->width * (size_t)scene->height};
    f->context = clCreateContext(properties, 1, &device->id, NULL, NULL, &error);
    if (!RT_CL_MADE(error, "clCreateContext", status))
        return false;
    f->queue = clCreateCommandQueue(f->context, device->id, CL_QUEUE_PROFILING_ENABLE, &error);
    return RT_CL_MADE(error, "clCreateCommandQueue", status) &&
           build(f, device, scene, bvh, packet, status) &&
           rt_buffer_make(f->context, CL_MEM_WRITE_ONLY,
                          f->pixels * RT_COLOR_COMPONENTS * sizeof(float), &f->picture, status) &&
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

bool bench_fused_draw(bench_fused *f, float *rgb, double *seconds, rt_status *status)
{
    const size_t global = f->pixels / RT_BLOCK_RAYS, local = 1;
    const size_t bytes = f->pixels * RT_COLOR_COMPONENTS * sizeof *rgb;
    cl_ulong start = 0, end = 0;
    cl_event event = NULL;
    const bool good =
        RT_CL(
            clEnqueueNDRangeKernel(f->queue, f->kernel, 1, NULL, &global, &local, 0, NULL, &event),
            status) &&
        RT_CL(clEnqueueReadBuffer(f->queue, f->picture, CL_TRUE, 0, bytes, rgb, 0, NULL, NULL),
              status) &&
        RT_CL(
            clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, NULL),
            status) &&
        RT_CL(clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL),
              status);
    if (event)
        clReleaseEvent(event);
    *seconds = 1e-9 * (double)(end - start);
    return good;
}
