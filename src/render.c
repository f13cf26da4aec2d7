#include "render.h"

#include <math.h>
#include <stdlib.h>

#include "clock.h"
#include "program.h"
#include "render_state.h"

static const struct {
    const char *name, *kernel;
} stages[RT_STAGE_COUNT] = {
    [RT_STAGE_CAMERA] = {"camera", "rt_camera"},    [RT_STAGE_TRACE] = {"trace", "rt_trace"},
    [RT_STAGE_SHADE] = {"shade", "rt_shade"},       [RT_STAGE_RESOLVE] = {"resolve", "rt_resolve"},
    [RT_STAGE_OCCLUDE] = {"occlude", "rt_occlude"}, [RT_STAGE_HITS] = {"hits", "rt_resolve_hits"},
};

const char *rt_stage_name(enum rt_stage stage)
{
    return stages[stage].name;
}

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

static bool make_tile_buffers(rt_renderer *r, rt_status *status)
{
    const size_t rays = (size_t)r->stride;
    tile_buffers *b = &r->tile;
    return rt_buffer_make(r->context, CL_MEM_READ_WRITE, rays * RT_RAY_COMPONENTS * sizeof(float),
                          &b->rays, status) &&
           rt_buffer_make(r->context, CL_MEM_READ_WRITE, rays * sizeof(cl_int), &b->hit_index,
                          status) &&
           rt_buffer_make(r->context, CL_MEM_READ_WRITE, rays * sizeof(cl_int), &b->hit_slot,
                          status) &&
           rt_buffer_make(r->context, CL_MEM_READ_WRITE, rays * RT_HIT_COMPONENTS * sizeof(float),
                          &b->hit_array, status) &&
           rt_buffer_make(r->context, CL_MEM_READ_WRITE, rays * RT_COLOR_COMPONENTS * sizeof(float),
                          &b->colors, status) &&
           rt_buffer_make(r->context, CL_MEM_WRITE_ONLY, rays * RT_COLOR_COMPONENTS * sizeof(float),
                          &b->picture, status) &&
           rt_buffer_make(r->context, CL_MEM_WRITE_ONLY, r->with_hits ? rays * sizeof(rt_hit) : 0,
                          &b->records, status);
}

typedef struct argument {
    const void *value;
    size_t size;
} argument;

#define ARGUMENT(value) ((argument){&(value), sizeof(value)})
#define SET_ARGUMENTS(kernel, status, ...)                                                         \
    set_arguments(kernel, (const argument[]){__VA_ARGS__},                                         \
                  sizeof((const argument[]){__VA_ARGS__}) / sizeof(argument), status)

static bool set_arguments(cl_kernel kernel, const argument *arguments, size_t count,
                          rt_status *status)
{
    for (size_t i = 0; i < count; ++i)
        if (!RT_CL(clSetKernelArg(kernel, (cl_uint)i, arguments[i].size, arguments[i].value),
                   status))
            return false;
    return true;
}

static bool make_kernels(rt_renderer *r, const rt_scene *scene, rt_status *status)
{
    for (int i = 0; i < RT_STAGE_COUNT; ++i) {
        cl_int error = CL_SUCCESS;
        if ((i == RT_STAGE_HITS && !r->with_hits) || (i == RT_STAGE_OCCLUDE && !r->with_occlusion))
            continue;
        r->kernels[i] = clCreateKernel(r->program, stages[i].kernel, &error);
        if (!RT_CL_MADE(error, "clCreateKernel", status))
            return false;
    }
    const rt_frame frame = rt_scene_frame(scene);
    const rt_tile tile = {0, 0, 0, 0}; /* set for each tile */
    const rt_surround surround = {scene->background.x, scene->background.y, scene->background.z,
                                  scene->ambient.x,    scene->ambient.y,    scene->ambient.z};
    const cl_int spheres = (cl_int)scene->sphere_count;
    const cl_int lights = (cl_int)scene->light_count;
    const cl_int stride = r->stride;
    const rt_device_scene *s = &r->scene;
    const tile_buffers *t = &r->tile;
    return SET_ARGUMENTS(r->kernels[RT_STAGE_CAMERA], status, ARGUMENT(frame), ARGUMENT(tile),
                         ARGUMENT(stride), ARGUMENT(t->rays)) &&
           SET_ARGUMENTS(r->kernels[RT_STAGE_TRACE], status, ARGUMENT(stride), ARGUMENT(t->rays),
                         ARGUMENT(s->nodes), ARGUMENT(s->order), ARGUMENT(s->spheres),
                         ARGUMENT(s->sphere_blocks), ARGUMENT(s->triangles),
                         ARGUMENT(s->triangle_blocks), ARGUMENT(t->hit_index),
                         ARGUMENT(t->hit_slot), ARGUMENT(t->hit_array)) &&
           SET_ARGUMENTS(r->kernels[RT_STAGE_SHADE], status, ARGUMENT(stride), ARGUMENT(t->rays),
                         ARGUMENT(t->hit_index), ARGUMENT(t->hit_slot), ARGUMENT(t->hit_array),
                         ARGUMENT(s->spheres), ARGUMENT(spheres), ARGUMENT(s->triangles),
                         ARGUMENT(s->materials_of), ARGUMENT(s->normals_of), ARGUMENT(s->normals),
                         ARGUMENT(s->materials), ARGUMENT(s->lights), ARGUMENT(lights),
                         ARGUMENT(surround), ARGUMENT(t->colors)) &&
           SET_ARGUMENTS(r->kernels[RT_STAGE_RESOLVE], status, ARGUMENT(tile), ARGUMENT(stride),
                         ARGUMENT(t->colors), ARGUMENT(t->picture)) &&
           (!r->with_occlusion ||
            SET_ARGUMENTS(r->kernels[RT_STAGE_OCCLUDE], status, ARGUMENT(stride), ARGUMENT(t->rays),
                          ARGUMENT(s->nodes), ARGUMENT(s->order), ARGUMENT(s->spheres),
                          ARGUMENT(s->sphere_blocks), ARGUMENT(s->triangles),
                          ARGUMENT(s->triangle_blocks), ARGUMENT(t->hit_index))) &&
           (!r->with_hits ||
            SET_ARGUMENTS(r->kernels[RT_STAGE_HITS], status, ARGUMENT(tile), ARGUMENT(stride),
                          ARGUMENT(t->hit_index), ARGUMENT(t->hit_array), ARGUMENT(t->records)));
}

static bool build(rt_renderer *r, const rt_device *device, const rt_scene *scene, const rt_bvh *bvh,
                  const rt_effects *given, rt_status *status)
{
    const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM,
                                                (cl_context_properties)device->platform, 0};
    cl_int error = CL_SUCCESS;
    double start = rt_clock_seconds();
    r->context = clCreateContext(properties, 1, &device->id, NULL, NULL, &error);
    if (!RT_CL_MADE(error, "clCreateContext", status))
        return false;
    r->queue = clCreateCommandQueue(r->context, device->id, CL_QUEUE_PROFILING_ENABLE, &error);
    if (!RT_CL_MADE(error, "clCreateCommandQueue", status))
        return false;
    const rt_effects effects = given ? *given : rt_effects_of(scene);
    char options[RT_PROGRAM_OPTIONS_SIZE];
    const rt_walk walk = {r->lanes, r->packet, bvh ? bvh->stack_size : 0, r->with_occlusion,
                          scene->accuracy};
    rt_program_options(&effects, &walk, rt_program_rounding(device), options);
    r->program = rt_program_build(r->context, device, options, status);
    if (!r->program)
        return false;
    r->times.program = rt_clock_seconds() - start;
    start = rt_clock_seconds();
    if (!rt_device_scene_upload(&r->scene, r->context, r->queue, scene, bvh, status) ||
        !make_tile_buffers(r, status))
        return false;
    r->times.upload = rt_clock_seconds() - start;
    return make_kernels(r, scene, status);
}

static int round_up(int value, int multiple)
{
    return (value + multiple - 1) / multiple * multiple;
}

rt_renderer *rt_renderer_new(const rt_device *device, const rt_scene *scene, const rt_bvh *bvh,
                             const rt_render_options *options, rt_status *status)
{
    rt_renderer *r = calloc(1, sizeof *r);
    if (!r) {
        rt_status_no_memory(status, "the renderer");
        return NULL;
    }
    r->lanes = options->lanes ? options->lanes : rt_device_lanes(device);
    r->packet = options->packet ? options->packet : r->lanes == 1 ? 1 : RT_BLOCK_RAYS;
    r->tile_side = options->tile ? options->tile : RT_TILE_DEFAULT;
    r->width = scene->width;
    r->height = scene->height;
    r->with_hits = options->with_hits;
    r->with_occlusion = options->with_occlusion;
    const int side = round_up(r->tile_side, RT_BLOCK_SIDE);
    r->stride = side * side;
    r->staging = malloc((size_t)r->stride * sizeof *r->staging);
    const bool good = r->staging ? build(r, device, scene, bvh, options->effects, status)
                                 : rt_status_no_memory(status, "the renderer");
    if (good)
        return r;
    rt_renderer_free(r);
    return NULL;
}

static void release_events(flight *f)
{
    for (int i = 0; i < EVENTS_PER_TILE; ++i)
        if (f->events[i])
            clReleaseEvent(f->events[i]);
    *f = (flight){{NULL}, false};
}

void rt_renderer_free(rt_renderer *r)
{
    if (!r)
        return;
    if (r->queue)
        clFinish(r->queue);
    for (int i = 0; i < TILES_IN_FLIGHT; ++i)
        release_events(&r->flights[i]);
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        if (r->kernels[i])
            clReleaseKernel(r->kernels[i]);
    rt_device_scene_release(&r->scene);
    const cl_mem buffers[] = {r->tile.rays,      r->tile.hit_index, r->tile.hit_slot,
                              r->tile.hit_array, r->tile.colors,    r->tile.picture,
                              r->tile.records};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; ++i)
        if (buffers[i])
            clReleaseMemObject(buffers[i]);
    if (r->program)
        clReleaseProgram(r->program);
    if (r->queue)
        clReleaseCommandQueue(r->queue);
    if (r->context)
        clReleaseContext(r->context);
    free(r->staging);
    free(r);
}

bool rt_renderer_launch(rt_renderer *r, enum rt_stage stage, size_t rays, cl_event *event,
                        rt_status *status)
{
    const size_t rays_per_item =
        stage == RT_STAGE_TRACE || stage == RT_STAGE_OCCLUDE ? (size_t)r->packet : 1;
    const size_t global = rays / rays_per_item;
    const size_t local = RT_BLOCK_RAYS / rays_per_item;
    r->times.launches[stage]++;
    return RT_CL(clEnqueueNDRangeKernel(r->queue, r->kernels[stage], 1, NULL, &global, &local, 0,
                                        NULL, event),
                 status);
}

/* Reads a tile's rows into their place in a picture of `size`-byte pixels. */
static bool read_tile(rt_renderer *r, cl_mem buffer, const rt_tile *tile, void *pixels, size_t size,
                      cl_event *event, rt_status *status)
{
    const size_t source[3] = {0, 0, 0};
    const size_t target[3] = {(size_t)tile->x * size, (size_t)tile->y, 0};
    const size_t region[3] = {(size_t)tile->width * size, (size_t)tile->height, 1};
    return RT_CL(clEnqueueReadBufferRect(r->queue, buffer, CL_FALSE, source, target, region,
                                         region[0], 0, (size_t)r->width * size, 0, pixels, 0, NULL,
                                         event),
                 status);
}

/* Queues all stages of a tile. */
static bool start_tile(rt_renderer *r, const rt_tile *tile, rt_image *image, flight *f,
                       rt_status *status)
{
    const size_t rays = (size_t)round_up(tile->width, RT_BLOCK_SIDE) *
                        (size_t)round_up(tile->height, RT_BLOCK_SIDE);
    const bool hits = image->hits != NULL;
    f->busy = true;
    r->times.tiles++;
    r->times.primary_rays += (size_t)tile->width * (size_t)tile->height;
    if (!RT_CL(clSetKernelArg(r->kernels[RT_STAGE_CAMERA], 1, sizeof *tile, tile), status) ||
        !RT_CL(clSetKernelArg(r->kernels[RT_STAGE_RESOLVE], 0, sizeof *tile, tile), status) ||
        (hits && !RT_CL(clSetKernelArg(r->kernels[RT_STAGE_HITS], 0, sizeof *tile, tile), status)))
        return false;
    for (int stage = 0; stage < RT_STAGE_COUNT; ++stage)
        if (stage != RT_STAGE_OCCLUDE && (stage != RT_STAGE_HITS || hits) &&
            !rt_renderer_launch(r, (enum rt_stage)stage, rays, &f->events[stage], status))
            return false;
    if (!read_tile(r, r->tile.picture, tile, image->rgb, 3 * sizeof *image->rgb,
                   &f->events[EVENT_READ_COLORS], status) ||
        (hits && !read_tile(r, r->tile.records, tile, image->hits, sizeof *image->hits,
                            &f->events[EVENT_READ_HITS], status)))
        return false;
    return RT_CL(clFlush(r->queue), status);
}

bool rt_renderer_finish(rt_renderer *r, flight *f, rt_status *status)
{
    if (!f->busy)
        return true;
    cl_event queued[EVENTS_PER_TILE];
    cl_uint count = 0;
    for (int i = 0; i < EVENTS_PER_TILE; ++i)
        if (f->events[i])
            queued[count++] = f->events[i];
    const bool good = count == 0 || RT_CL(clWaitForEvents(count, queued), status);
    for (int i = 0; good && i < EVENTS_PER_TILE; ++i)
        if (f->events[i])
            *(i < RT_STAGE_COUNT ? &r->times.stages[i] : &r->times.readback) +=
                event_seconds(f->events[i]);
    release_events(f);
    return good;
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
        good = good && start_tile(r, &tile, image, f, status);
    }
    return finish_all(r, status) && good;
}

bool rt_renderer_draw(rt_renderer *r, rt_image *image, const rt_watch *watch, rt_status *status)
{
    rt_tiles tiles;
    rt_tiles_init(&tiles, r->width, r->height, r->tile_side, 1);
    return rt_renderer_draw_tiles(r, &tiles, image, watch, status);
}
