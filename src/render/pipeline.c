/* What no effect calls for is not made. */
#include "render/pipeline.h"

#include "render/state.h"

/* Every stage, and the one whose kernel and arguments it has. */
static const struct {
    const char *name, *kernel;
    enum rt_stage same_as;
} stages[RT_STAGE_COUNT] = {
    [RT_STAGE_CAMERA] = {"camera", "rt_camera", RT_STAGE_CAMERA},
    [RT_STAGE_TRACE] = {"trace", "rt_trace", RT_STAGE_TRACE},
    [RT_STAGE_SHADE] = {"shade", "rt_shade", RT_STAGE_SHADE},
    [RT_STAGE_RESOLVE] = {"resolve", "rt_resolve", RT_STAGE_RESOLVE},
    [RT_STAGE_OCCLUDE] = {"occlude", "rt_occlude", RT_STAGE_OCCLUDE},
    [RT_STAGE_HITS] = {"hits", "rt_resolve_hits", RT_STAGE_HITS},
    [RT_STAGE_SHADOW_RAYS] = {"shadow rays", "rt_shadow_rays", RT_STAGE_SHADOW_RAYS},
    [RT_STAGE_SHADOW] = {"shadow", "rt_occlude", RT_STAGE_OCCLUDE},
    [RT_STAGE_SHADOW_TALLY] = {"shadow tally", "rt_tally", RT_STAGE_SHADOW_TALLY},
    [RT_STAGE_AMBIENT_RAYS] = {"ambient rays", "rt_ambient_rays", RT_STAGE_AMBIENT_RAYS},
    [RT_STAGE_AMBIENT] = {"ambient", "rt_occlude", RT_STAGE_OCCLUDE},
    [RT_STAGE_AMBIENT_TALLY] = {"ambient tally", "rt_tally", RT_STAGE_SHADOW_TALLY},
    [RT_STAGE_NEXT] = {"next", "rt_next", RT_STAGE_NEXT},
    [RT_STAGE_COUNT_NEXT] = {"count", "rt_count", RT_STAGE_COUNT_NEXT},
    [RT_STAGE_PACK] = {"pack", "rt_pack", RT_STAGE_PACK},
    [RT_STAGE_NEXT_TRACE] = {"next trace", "rt_trace", RT_STAGE_TRACE},
    [RT_STAGE_NEXT_SHADE] = {"next shade", "rt_shade", RT_STAGE_SHADE},
};

const char *rt_stage_name(enum rt_stage stage)
{
    return stages[stage].name;
}

bool rt_renderer_has(const rt_renderer *r, enum rt_effect effect)
{
    return rt_effects_has(&r->effects, effect);
}

bool rt_renderer_has_next(const rt_renderer *r)
{
    return rt_renderer_has(r, RT_EFFECT_REFLECTION) || rt_renderer_has(r, RT_EFFECT_REFRACTION);
}

static bool has_shadows(const rt_renderer *r)
{
    return rt_renderer_has(r, RT_EFFECT_HARD_SHADOWS) || rt_renderer_has(r, RT_EFFECT_SOFT_SHADOWS);
}

bool rt_renderer_has_probes(const rt_renderer *r)
{
    return has_shadows(r) || rt_renderer_has(r, RT_EFFECT_OCCLUSION);
}

static bool has_kernel(const rt_renderer *r, enum rt_stage stage)
{
    switch (stages[stage].same_as) {
    case RT_STAGE_OCCLUDE:
        return r->with_occlusion || rt_renderer_has_probes(r);
    case RT_STAGE_HITS:
        return r->with_hits;
    case RT_STAGE_SHADOW_RAYS:
        return has_shadows(r);
    case RT_STAGE_AMBIENT_RAYS:
        return rt_renderer_has(r, RT_EFFECT_OCCLUSION);
    case RT_STAGE_SHADOW_TALLY:
        return rt_renderer_has_probes(r);
    case RT_STAGE_NEXT:
    case RT_STAGE_COUNT_NEXT:
    case RT_STAGE_PACK:
        return rt_renderer_has_next(r);
    default:
        return true;
    }
}

/* At most one ray a bounce waits. */
static size_t most_waiting(const rt_renderer *r)
{
    const int depth = r->effects.on[RT_EFFECT_REFRACTION] ? r->depth : 1;
    return (size_t)(depth < RT_WAITING_MOST ? depth : RT_WAITING_MOST);
}

/* Bytes a ray of the tile in a buffer; 0 where nothing calls for it. */
static size_t bytes_a_ray(const rt_renderer *r, enum tile_buffer which)
{
    const size_t number = r->number_size;
    const bool next = rt_renderer_has_next(r);
    const bool refraction = rt_renderer_has(r, RT_EFFECT_REFRACTION);
    const bool probes = rt_renderer_has_probes(r);
    const bool any_hit = probes || r->with_occlusion;
    switch (which) {
    case BUFFER_RAYS:
        return RT_RAY_COMPONENTS * number;
    case BUFFER_HIT_INDEX:
    case BUFFER_HIT_SLOT:
        return sizeof(cl_int);
    case BUFFER_HIT_ARRAY:
        return RT_HIT_COMPONENTS * number;
    case BUFFER_COLORS:
    case BUFFER_PICTURE:
        return RT_COLOR_COMPONENTS * sizeof(float);
    case BUFFER_RECORDS:
        return r->with_hits ? sizeof(rt_hit) : 0;
    case BUFFER_PROBES:
        return any_hit ? RT_RAY_COMPONENTS * number : 0;
    case BUFFER_BLOCKED:
        return any_hit ? sizeof(cl_int) : 0;
    case BUFFER_OPEN:
        return probes ? ((size_t)r->light_count + 1) * sizeof(cl_int) : 0;
    case BUFFER_CAST:
        return probes ? 2 * sizeof(cl_ulong) : 0;
    case BUFFER_HOME:
    case BUFFER_NEXT_HOME:
        return next ? sizeof(cl_int) : 0;
    case BUFFER_PATHS:
        return next ? RT_PATH_COMPONENTS * number : 0;
    case BUFFER_MARKS:
        return next ? RT_MARK_COMPONENTS * sizeof(cl_int) : 0;
    case BUFFER_NEXT_RAYS:
        return next ? RT_RAY_COMPONENTS * number : 0;
    case BUFFER_COUNTS:
        return next ? RT_COUNT_COMPONENTS * sizeof(cl_int) : 0;
    case BUFFER_FIRST:
        return next ? sizeof(cl_int) : 0;
    case BUFFER_WAITING:
        return refraction ? most_waiting(r) * RT_WAITING_COMPONENTS * number : 0;
    case BUFFER_WAITING_MARKS:
        return refraction ? most_waiting(r) * RT_WAITING_MARKS * sizeof(cl_int) : 0;
    case BUFFER_COUNT:
        break;
    }
    return 0;
}

static bool make_buffers(rt_renderer *r, rt_status *status)
{
    for (int i = 0; i < BUFFER_COUNT; ++i) {
        const size_t bytes = bytes_a_ray(r, (enum tile_buffer)i);
        if (bytes && !rt_buffer_make(r->context, CL_MEM_READ_WRITE, bytes * (size_t)r->stride,
                                     &r->tile[i], status))
            return false;
    }
    if (!r->tile[BUFFER_CAST])
        return true;
    const cl_ulong zero = 0;
    return RT_CL(clEnqueueFillBuffer(r->queue, r->tile[BUFFER_CAST], &zero, sizeof zero, 0,
                                     2 * (size_t)r->stride * sizeof zero, 0, NULL, NULL),
                 status);
}

/* A kernel's arguments, one after another. */
typedef struct arguments {
    cl_kernel kernel;
    int count;
    bool good;
    rt_status *status;
} arguments;

static int push(arguments *a, const void *value, size_t size)
{
    if (a->good)
        a->good = RT_CL(clSetKernelArg(a->kernel, (cl_uint)a->count, size, value), a->status);
    return a->count++;
}

#define PUSH(arguments, value) push(arguments, &(value), sizeof(value))

static void push_buffers(arguments *a, const rt_renderer *r, const enum tile_buffer *which,
                         size_t count)
{
    for (size_t i = 0; i < count; ++i)
        PUSH(a, r->tile[which[i]]);
}

#define PUSH_BUFFERS(arguments, renderer, ...)                                                     \
    push_buffers(arguments, renderer, (const enum tile_buffer[]){__VA_ARGS__},                     \
                 sizeof((const enum tile_buffer[]){__VA_ARGS__}) / sizeof(enum tile_buffer))

/* Set before each launch. */
static const rt_tile no_tile = {0, 0, 0, 0};
static const rt_turn no_turn = {0, 0, 0, 0, 0};

/* The bits of the effects that are on, for kernels that are switched by them. */
static cl_int flags_of(const rt_renderer *r)
{
    static const struct {
        enum rt_effect effect;
        cl_int flag;
    } flags[] = {{RT_EFFECT_CHECKER, RT_FLAG_CHECKER},
                 {RT_EFFECT_TEXTURE, RT_FLAG_TEXTURE},
                 {RT_EFFECT_HARD_SHADOWS, RT_FLAG_SHADOWS},
                 {RT_EFFECT_SOFT_SHADOWS, RT_FLAG_SHADOWS},
                 {RT_EFFECT_ABSORPTION, RT_FLAG_ABSORB},
                 {RT_EFFECT_OCCLUSION, RT_FLAG_AMBIENT_OCCLUSION},
                 {RT_EFFECT_FOG, RT_FLAG_FOG},
                 {RT_EFFECT_GRADIENT, RT_FLAG_GRADIENT},
                 {RT_EFFECT_ANTIALIASING, RT_FLAG_ANTIALIAS},
                 {RT_EFFECT_DEPTH_OF_FIELD, RT_FLAG_LENS}};
    cl_int bits = 0;
    for (size_t i = 0; i < sizeof flags / sizeof *flags; ++i)
        if (r->effects.on[flags[i].effect])
            bits |= flags[i].flag;
    return bits;
}

static void push_flags(arguments *a, const rt_renderer *r)
{
    const cl_int flags = flags_of(r);
    if (r->effects.mode == RT_EFFECTS_ALL)
        PUSH(a, flags);
}

static void camera_arguments(arguments *a, rt_renderer *r, const rt_scene *scene)
{
    const rt_frame frame = rt_scene_frame(scene);
    const rt_frame_double frame_double = rt_scene_frame_double(scene);
    const cl_int samples = r->samples;
    const cl_int flags = flags_of(r) | (scene->filter == RT_FILTER_TENT ? RT_FLAG_TENT : 0);
    const bool next = rt_renderer_has_next(r);
    const bool antialias = rt_renderer_has(r, RT_EFFECT_ANTIALIASING);
    const bool random = antialias || rt_renderer_has(r, RT_EFFECT_DEPTH_OF_FIELD);
    if (scene->accuracy == RT_ACCURACY_DOUBLE)
        PUSH(a, frame_double);
    else
        PUSH(a, frame);
    r->changing[RT_STAGE_CAMERA].tile = PUSH(a, no_tile);
    PUSH(a, r->stride);
    PUSH_BUFFERS(a, r, BUFFER_RAYS);
    if (random || next)
        r->changing[RT_STAGE_CAMERA].turn = PUSH(a, no_turn);
    if (random) {
        PUSH(a, samples);
        PUSH(a, flags);
    }
    if (antialias || next)
        PUSH_BUFFERS(a, r, BUFFER_COLORS);
    if (next)
        PUSH_BUFFERS(a, r, BUFFER_HOME, BUFFER_PATHS, BUFFER_MARKS);
}

/* What rt_trace and rt_occlude work on, rays to hits. */
static void world_arguments(arguments *a, const rt_renderer *r, enum tile_buffer rays)
{
    const rt_device_scene *s = &r->scene;
    PUSH(a, r->stride);
    PUSH_BUFFERS(a, r, rays);
    PUSH(a, s->nodes);
    PUSH(a, s->order);
    PUSH(a, s->spheres);
    PUSH(a, s->sphere_blocks);
    PUSH(a, s->triangles);
    PUSH(a, s->triangle_blocks);
}

/* TRACED_PARAMETERS of kernels/shading/surface.cl. */
static void traced_arguments(arguments *a, const rt_renderer *r)
{
    const rt_device_scene *s = &r->scene;
    PUSH(a, r->stride);
    PUSH_BUFFERS(a, r, BUFFER_RAYS, BUFFER_HIT_INDEX, BUFFER_HIT_SLOT, BUFFER_HIT_ARRAY);
    PUSH(a, s->spheres);
    PUSH(a, s->sphere_count);
    PUSH(a, s->triangles);
    if (rt_renderer_has(r, RT_EFFECT_SMOOTH_NORMALS)) {
        PUSH(a, s->normals_of);
        PUSH(a, s->normals);
    }
}

static void next_arguments(arguments *a, const rt_renderer *r)
{
    const cl_int depth = r->depth;
    traced_arguments(a, r);
    PUSH(a, r->scene.materials_of);
    PUSH(a, r->scene.materials);
    PUSH(a, depth);
    PUSH_BUFFERS(a, r, BUFFER_HOME, BUFFER_PATHS, BUFFER_MARKS, BUFFER_NEXT_RAYS, BUFFER_NEXT_HOME);
    if (rt_renderer_has(r, RT_EFFECT_REFRACTION))
        PUSH_BUFFERS(a, r, BUFFER_WAITING, BUFFER_WAITING_MARKS);
}

static void shade_arguments(arguments *a, const rt_renderer *r, const rt_scene *scene)
{
    const rt_device_scene *s = &r->scene;
    const rt_surround surround = {scene->background.x, scene->background.y, scene->background.z,
                                  scene->ambient.x,    scene->ambient.y,    scene->ambient.z};
    const cl_int lights = r->light_count;
    traced_arguments(a, r);
    PUSH(a, s->materials_of);
    PUSH(a, s->materials);
    PUSH(a, s->lights);
    PUSH(a, lights);
    PUSH(a, surround);
    PUSH_BUFFERS(a, r, BUFFER_COLORS);
    if (rt_renderer_has(r, RT_EFFECT_GRADIENT)) {
        const rt_gradient gradient = rt_scene_gradient(scene);
        PUSH(a, gradient);
    }
    if (rt_renderer_has(r, RT_EFFECT_FOG)) {
        const rt_fog fog = {scene->fog.x, scene->fog.y, scene->fog.z, scene->fog_density};
        PUSH(a, fog);
    }
    if (rt_renderer_has(r, RT_EFFECT_TEXTURE)) {
        PUSH(a, s->uvs_of);
        PUSH(a, s->uvs);
        PUSH(a, s->textures);
        PUSH(a, s->texels);
    }
    if (rt_renderer_has_probes(r))
        PUSH_BUFFERS(a, r, BUFFER_OPEN);
    if (rt_renderer_has(r, RT_EFFECT_OCCLUSION)) {
        const rt_crevice crevice = {scene->occlusion_distance, scene->occlusion_samples};
        PUSH(a, crevice);
    }
    if (rt_renderer_has_next(r))
        PUSH_BUFFERS(a, r, BUFFER_HOME, BUFFER_PATHS, BUFFER_MARKS);
    push_flags(a, r);
}

/* What probes with random directions need to know of their rays. */
static void way_arguments(arguments *a, rt_renderer *r, enum rt_stage stage)
{
    r->changing[stage].tile = PUSH(a, no_tile);
    if (rt_renderer_has_next(r))
        PUSH_BUFFERS(a, r, BUFFER_HOME, BUFFER_MARKS);
}

static void probe_arguments(arguments *a, rt_renderer *r, const rt_scene *scene,
                            enum rt_stage stage)
{
    traced_arguments(a, r);
    r->changing[stage].turn = PUSH(a, no_turn);
    if (stage == RT_STAGE_SHADOW_RAYS) {
        PUSH(a, r->scene.lights);
    } else {
        const rt_crevice crevice = {scene->occlusion_distance, scene->occlusion_samples};
        PUSH(a, crevice);
    }
    PUSH_BUFFERS(a, r, BUFFER_PROBES);
    if (stage == RT_STAGE_AMBIENT_RAYS || rt_renderer_has(r, RT_EFFECT_SOFT_SHADOWS))
        way_arguments(a, r, stage);
}

static void resolve_arguments(arguments *a, rt_renderer *r)
{
    const cl_int samples = r->samples;
    r->changing[RT_STAGE_RESOLVE].tile = PUSH(a, no_tile);
    PUSH(a, r->stride);
    PUSH_BUFFERS(a, r, BUFFER_COLORS, BUFFER_PICTURE);
    if (rt_renderer_has(r, RT_EFFECT_ANTIALIASING)) {
        PUSH(a, samples);
        push_flags(a, r);
    }
}

static bool set_arguments(rt_renderer *r, const rt_scene *scene, enum rt_stage stage,
                          rt_status *status)
{
    arguments list = {r->kernels[stage], 0, true, status}, *a = &list;
    const cl_int none = 0;
    const cl_int lights = r->light_count;
    switch (stage) {
    case RT_STAGE_CAMERA:
        camera_arguments(a, r, scene);
        break;
    case RT_STAGE_TRACE:
        world_arguments(a, r, BUFFER_RAYS);
        PUSH_BUFFERS(a, r, BUFFER_HIT_INDEX, BUFFER_HIT_SLOT, BUFFER_HIT_ARRAY);
        break;
    case RT_STAGE_OCCLUDE:
        world_arguments(a, r, BUFFER_PROBES);
        PUSH_BUFFERS(a, r, BUFFER_BLOCKED);
        break;
    case RT_STAGE_SHADE:
        shade_arguments(a, r, scene);
        break;
    case RT_STAGE_RESOLVE:
        resolve_arguments(a, r);
        break;
    case RT_STAGE_HITS:
        r->changing[stage].tile = PUSH(a, no_tile);
        PUSH(a, r->stride);
        PUSH_BUFFERS(a, r, BUFFER_HIT_INDEX, BUFFER_HIT_ARRAY, BUFFER_RECORDS);
        PUSH(a, r->unit_exponent);
        break;
    case RT_STAGE_SHADOW_RAYS:
    case RT_STAGE_AMBIENT_RAYS:
        probe_arguments(a, r, scene, stage);
        break;
    case RT_STAGE_SHADOW_TALLY:
        PUSH(a, r->stride);
        r->changing[stage].turn = PUSH(a, no_turn);
        PUSH(a, lights);
        PUSH_BUFFERS(a, r, BUFFER_PROBES, BUFFER_BLOCKED, BUFFER_OPEN, BUFFER_CAST);
        break;
    case RT_STAGE_NEXT:
        next_arguments(a, r);
        break;
    case RT_STAGE_COUNT_NEXT:
        PUSH(a, r->stride);
        PUSH_BUFFERS(a, r, BUFFER_NEXT_RAYS, BUFFER_NEXT_HOME, BUFFER_MARKS, BUFFER_COUNTS);
        break;
    case RT_STAGE_PACK:
        PUSH(a, r->stride);
        r->changing[stage].total = PUSH(a, none);
        PUSH_BUFFERS(a, r, BUFFER_FIRST, BUFFER_NEXT_RAYS, BUFFER_NEXT_HOME, BUFFER_RAYS,
                     BUFFER_HOME);
        break;
    default:
        break;
    }
    return list.good;
}

/* Stages of one kernel and the same arguments share it. */
static bool make_kernels(rt_renderer *r, const rt_scene *scene, rt_status *status)
{
    for (int i = 0; i < RT_STAGE_COUNT; ++i) {
        const enum rt_stage stage = (enum rt_stage)i, same = stages[i].same_as;
        cl_int error = CL_SUCCESS;
        r->changing[i] = (changing){-1, -1, -1};
        if (same != stage || !has_kernel(r, stage))
            continue;
        r->kernels[i] = clCreateKernel(r->program, stages[i].kernel, &error);
        if (!RT_CL_MADE(error, "clCreateKernel", status) || !set_arguments(r, scene, stage, status))
            return false;
    }
    return true;
}

bool rt_pipeline_make(rt_renderer *r, const rt_scene *scene, rt_status *status)
{
    return make_buffers(r, status) && make_kernels(r, scene, status);
}

enum rt_stage rt_stage_of_kernel(enum rt_stage stage)
{
    return stages[stage].same_as;
}

void rt_pipeline_release(rt_renderer *r)
{
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        if (r->kernels[i])
            clReleaseKernel(r->kernels[i]);
    for (int i = 0; i < BUFFER_COUNT; ++i)
        if (r->tile[i])
            clReleaseMemObject(r->tile[i]);
}
