#include "render/renderer.h"

#include <math.h>
#include <stdlib.h>

#include "common/clock.h"
#include "opencl/program.h"
#include "render/state.h"
#include "render/variant.h"

int rt_renderer_lanes(const rt_renderer *renderer)
{
    return renderer->lanes;
}

const rt_render_times *rt_renderer_times(const rt_renderer *renderer)
{
    return &renderer->times;
}

/* Seconds that a finished command ran; 0 where the device does not tell. */
static double event_seconds(cl_event event)
{
    cl_ulong start = 0, end = 0;
    if (clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, NULL) !=
            CL_SUCCESS ||
        clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL) !=
            CL_SUCCESS ||
        end < start)
        return 0.0;
    return 1e-9 * (double)(end - start);
}

static bool build(rt_renderer *r, const rt_device *device, const rt_scene *scene, const rt_bvh *bvh,
                  rt_status *status)
{
    const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM,
                                                (cl_context_properties)device->platform, 0};
    cl_int error = CL_SUCCESS;
    double start = rt_clock_seconds();
    if (!rt_device_check_level(device, scene->accuracy, status))
        return false;
    r->context = clCreateContext(properties, 1, &device->id, NULL, NULL, &error);
    if (!RT_CL_MADE(error, "clCreateContext", status))
        return false;
    r->queue = clCreateCommandQueue(r->context, device->id, CL_QUEUE_PROFILING_ENABLE, &error);
    if (!RT_CL_MADE(error, "clCreateCommandQueue", status))
        return false;
    char options[RT_VARIANT_OPTIONS_SIZE];
    const rt_walk walk = {r->lanes, r->packet, bvh ? bvh->stack_size : 0,
                          r->with_occlusion || rt_renderer_has_probes(r), scene->accuracy};
    rt_variant_options(&r->effects, &walk, rt_variant_rounding(device), options);
    r->program = rt_program_build(r->context, device, options, status);
    if (!r->program)
        return false;
    r->times.program = rt_clock_seconds() - start;
    start = rt_clock_seconds();
    if (!rt_device_scene_upload(&r->scene, r->context, r->queue, scene, bvh, &r->effects, status))
        return false;
    r->times.upload = rt_clock_seconds() - start;
    return rt_pipeline_make(r, scene, status);
}

static int round_up(int value, int multiple)
{
    return (value + multiple - 1) / multiple * multiple;
}

/* What the passes over a tile need to know of the scene, and room for what they read back. */
static bool remember(rt_renderer *r, const rt_scene *scene, const rt_effects *given,
                     rt_status *status)
{
    const size_t blocks = (size_t)r->stride / RT_BLOCK_RAYS;
    r->effects = given ? *given : rt_effects_of(scene);
    r->width = scene->width;
    r->height = scene->height;
    r->samples = scene->samples;
    r->depth = scene->depth;
    r->occlusion_samples = scene->occlusion_samples;
    r->unit_exponent = scene->unit_exponent;
    r->number_size = scene->accuracy == RT_ACCURACY_DOUBLE ? sizeof(double) : sizeof(float);
    r->light_count = (int)scene->light_count;
    r->lights = calloc(scene->light_count + 1, sizeof *r->lights);
    r->counts = malloc((RT_COUNT_COMPONENTS + 1) * blocks * sizeof *r->counts);
    r->staging = malloc((size_t)r->stride * r->number_size);
    if (!r->lights || !r->counts || !r->staging)
        return rt_status_no_memory(status, "the renderer");
    for (size_t i = 0; i < scene->light_count; ++i)
        r->lights[i] = scene->lights[i];
    return true;
}

rt_renderer *rt_renderer_new(const rt_device *device, const rt_scene *scene, const rt_bvh *bvh,
                             const rt_render_options *options, rt_status *status)
{
    rt_renderer *r = calloc(1, sizeof *r);
    if (!r) {
        rt_status_no_memory(status, "the renderer");
        return NULL;
    }
    r->lanes = options->lanes ? options->lanes : rt_device_lanes(device, scene->accuracy);
    r->packet = options->packet ? options->packet : r->lanes == 1 ? 1 : RT_BLOCK_RAYS;
    r->tile_side = options->tile ? options->tile : RT_TILE_DEFAULT;
    r->with_hits = options->with_hits;
    r->with_occlusion = options->with_occlusion;
    const int side = round_up(r->tile_side, RT_BLOCK_SIDE);
    r->stride = side * side;
    if (remember(r, scene, options->effects, status) && build(r, device, scene, bvh, status))
        return r;
    rt_renderer_free(r);
    return NULL;
}

static void release_events(flight *f)
{
    for (size_t i = 0; i < f->count; ++i)
        clReleaseEvent(f->events[i]);
    f->count = 0;
    f->busy = false;
}

void rt_renderer_free(rt_renderer *r)
{
    if (!r)
        return;
    if (r->queue)
        clFinish(r->queue);
    for (int i = 0; i < TILES_IN_FLIGHT; ++i)
        release_events(&r->flights[i]);
    rt_pipeline_release(r);
    rt_device_scene_release(&r->scene);
    if (r->program)
        clReleaseProgram(r->program);
    if (r->queue)
        clReleaseCommandQueue(r->queue);
    if (r->context)
        clReleaseContext(r->context);
    free(r->lights);
    free(r->counts);
    free(r->staging);
    free(r);
}

/* Rays that a work-item of a kernel takes: RT_PACKET and RT_ITEM_RAYS of the kernels. */
static size_t rays_an_item(const rt_renderer *r, enum rt_stage kernel)
{
    if (kernel == RT_STAGE_TRACE || kernel == RT_STAGE_OCCLUDE)
        return (size_t)r->packet;
    const bool takes_blocks = kernel == RT_STAGE_SHADE || kernel == RT_STAGE_SHADOW_RAYS ||
                              kernel == RT_STAGE_AMBIENT_RAYS;
    return takes_blocks && r->lanes > 1 ? RT_BLOCK_RAYS : 1;
}

bool rt_renderer_launch(rt_renderer *r, enum rt_stage stage, size_t rays, flight *f,
                        rt_status *status)
{
    const enum rt_stage kernel = rt_stage_of_kernel(stage);
    const size_t rays_per_item = rays_an_item(r, kernel);
    const size_t global = rays / rays_per_item;
    const size_t local = RT_BLOCK_RAYS / rays_per_item;
    cl_event event = NULL;
    r->times.launches[stage]++;
    return RT_CL(clEnqueueNDRangeKernel(r->queue, r->kernels[kernel], 1, NULL, &global, &local, 0,
                                        NULL, &event),
                 status) &&
           rt_flight_add(r, f, (int)stage, event, status);
}

/* Waits for the commands so far and takes their times. */
static bool land(rt_renderer *r, flight *f, rt_status *status)
{
    const bool good = f->count == 0 || RT_CL(clWaitForEvents((cl_uint)f->count, f->events), status);
    for (size_t i = 0; good && i < f->count; ++i)
        *(f->stages[i] == EVENT_READ ? &r->times.readback : &r->times.stages[f->stages[i]]) +=
            event_seconds(f->events[i]);
    release_events(f);
    return good;
}

bool rt_flight_add(rt_renderer *r, flight *f, int stage, cl_event event, rt_status *status)
{
    f->busy = true;
    f->events[f->count] = event;
    f->stages[f->count++] = stage;
    if (f->count < EVENTS_IN_FLIGHT)
        return true;
    const bool good = land(r, f, status);
    f->busy = true;
    return good;
}

bool rt_renderer_finish(rt_renderer *r, flight *f, rt_status *status)
{
    return !f->busy || land(r, f, status);
}

static bool finish_all(rt_renderer *r, rt_status *status)
{
    bool good = true;
    for (int i = 0; i < TILES_IN_FLIGHT; ++i)
        good = rt_renderer_finish(r, &r->flights[i], status) && good;
    return good;
}

bool rt_renderer_draw_tiles(rt_renderer *r, rt_tiles *tiles, rt_image *image, const rt_watch *watch,
                            rt_status *status)
{
    rt_taker taker = {tiles, 0};
    bool good = true;
    for (int i = 0; good; ++i) {
        /* Beside others, the second tile waits for what the first one tells of the device's speed.
         */
        flight *f = &r->flights[tiles->takers > 1 && i == 1 ? 0 : i % TILES_IN_FLIGHT];
        const bool landed = f->busy;
        rt_tile tile;
        good = rt_renderer_finish(r, f, status);
        if (good && landed)
            rt_tiles_finish(&taker);
        if (!good || !rt_tiles_take(&taker, &tile))
            break;
        if (!rt_watch_tick(watch, rt_tiles_done(tiles)))
            good = rt_status_fail(status, RT_INTERRUPTED, "rt: interrupted");
        good = good && rt_renderer_start_tile(r, &tile, image, f, watch, rt_tiles_done(tiles),
                                              1.0 / tiles->count, status);
    }
    return finish_all(r, status) && good && rt_renderer_count_probes(r, status);
}

bool rt_renderer_draw(rt_renderer *r, rt_image *image, const rt_watch *watch, rt_status *status)
{
    rt_tiles tiles;
    rt_tiles_init(&tiles, r->width, r->height, r->tile_side, 1);
    return rt_renderer_draw_tiles(r, &tiles, image, watch, status);
}
