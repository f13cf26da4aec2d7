#include "render/renderer.h"

#include <stdlib.h>

#include "common/clock.h"
#include "render/passes.h"
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

static bool build(rt_renderer *r, const rt_device *device, const rt_scene *scene, const rt_bvh *bvh,
                  const rt_watch *watch, rt_status *status)
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
    const rt_walk walk = {r->lanes, r->packet, bvh ? bvh->stack_size : 0, scene->accuracy};
    if (!rt_programs_build(&r->programs, r->context, device, &r->effects, &walk,
                           rt_renderer_has_any_hit(r), watch, status))
        return false;
    r->times.program = rt_clock_seconds() - start;
    start = rt_clock_seconds();
    if (!rt_device_scene_upload(&r->scene, r->context, r->queue, scene, bvh, &r->effects, status))
        return false;
    r->times.upload = rt_clock_seconds() - start;
    return rt_pipeline_make(r, scene, status);
}

/* A cache line of floats between the components of an array. With a power of two between them, as
 * the rays of a tile mostly are, those of one ray would fall into the same few sets of a cache. */
#define STRIDE_PADDING 16

static int round_up(int value, int multiple)
{
    return (value + multiple - 1) / multiple * multiple;
}

/* What the passes over a tile need to know of the scene, and room for what they read back. */
static bool remember(rt_renderer *r, const rt_scene *scene, const rt_effects *given,
                     rt_status *status)
{
    const size_t blocks = (size_t)r->capacity / RT_BLOCK_RAYS;
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
    r->staging = malloc((size_t)r->capacity * r->number_size);
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
    r->packet = options->packet ? options->packet : rt_variant_packet(r->lanes);
    r->tile_side = options->tile ? options->tile : RT_TILE_DEFAULT;
    r->with_hits = options->with_hits;
    r->with_occlusion = options->with_occlusion;
    const int side = round_up(r->tile_side, RT_BLOCK_SIDE);
    r->capacity = side * side;
    r->stride = r->capacity + STRIDE_PADDING;
    if (remember(r, scene, options->effects, status) &&
        build(r, device, scene, bvh, options->building, status))
        return r;
    rt_renderer_free(r);
    return NULL;
}

void rt_renderer_free(rt_renderer *r)
{
    if (!r)
        return;
    if (r->queue)
        clFinish(r->queue);
    for (int i = 0; i < TILES_IN_FLIGHT; ++i)
        rt_flight_release(&r->flights[i]);
    rt_pipeline_release(r);
    rt_device_scene_release(&r->scene);
    rt_programs_release(&r->programs);
    if (r->queue)
        clReleaseCommandQueue(r->queue);
    if (r->context)
        clReleaseContext(r->context);
    free(r->lights);
    free(r->counts);
    free(r->staging);
    free(r);
}

static bool finish_all(rt_renderer *r, rt_status *status)
{
    bool good = true;
    for (int i = 0; i < TILES_IN_FLIGHT; ++i)
        good = rt_flight_finish(&r->flights[i], r, status) && good;
    return good;
}

bool rt_renderer_draw_tiles(rt_renderer *r, rt_tiles *tiles, const rt_sample_range *range,
                            rt_image *image, const rt_watch *watch, rt_status *status)
{
    const rt_sample_range all = {0, r->samples, false};
    rt_taker taker = {tiles, 0};
    bool good = true;
    for (int i = 0; good; ++i) {
        /* Beside others, the second tile waits for what the first one tells of the device's speed.
         */
        flight *f = &r->flights[tiles->takers > 1 && i == 1 ? 0 : i % TILES_IN_FLIGHT];
        const bool landed = f->busy;
        rt_tile tile;
        good = rt_flight_finish(f, r, status);
        if (good && landed)
            rt_tiles_finish(&taker);
        if (!good || !rt_tiles_take(&taker, &tile))
            break;
        if (!rt_watch_tick(watch, rt_tiles_done(tiles)))
            good = rt_status_fail(status, RT_INTERRUPTED, "rt: interrupted");
        good = good && rt_passes_start(r, &tile, range ? range : &all, image, f, watch,
                                       rt_tiles_done(tiles), 1.0 / tiles->count, status);
    }
    return finish_all(r, status) && good && rt_passes_read_tallies(r, status);
}

bool rt_renderer_draw(rt_renderer *r, rt_image *image, const rt_watch *watch, rt_status *status)
{
    rt_tiles tiles;
    rt_tiles_init(&tiles, r->width, r->height, r->tile_side, 1);
    return rt_renderer_draw_tiles(r, &tiles, NULL, image, watch, status);
}
