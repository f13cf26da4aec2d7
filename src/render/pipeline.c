/* What no effect calls for is not made. */
#include "render/pipeline.h"

#include "render/arguments.h"
#include "render/state.h"

/* Every stage, the one whose kernel and arguments it has, the program that it is in, and whether a
 * work-item is for a block of rays where vectors are wide. */
static const struct {
    const char *name, *kernel;
    enum rt_stage same_as;
    int part;
    bool by_blocks;
} stages[RT_STAGE_COUNT] = {
    [RT_STAGE_CAMERA] = {"camera", "rt_camera", RT_STAGE_CAMERA, RT_PART_STAGES, true},
    [RT_STAGE_TRACE] = {"trace", "rt_trace", RT_STAGE_TRACE, RT_PART_TRACE, false},
    [RT_STAGE_SHADE] = {"shade", "rt_shade", RT_STAGE_SHADE, RT_PART_STAGES, true},
    [RT_STAGE_RESOLVE] = {"resolve", "rt_resolve", RT_STAGE_RESOLVE, RT_PART_STAGES, true},
    [RT_STAGE_OCCLUDE] = {"occlude", "rt_occlude", RT_STAGE_OCCLUDE, RT_PART_OCCLUDE, false},
    [RT_STAGE_HITS] = {"hits", "rt_resolve_hits", RT_STAGE_HITS, RT_PART_STAGES, false},
    [RT_STAGE_SHADOW_RAYS] = {"shadow rays", "rt_shadow_rays", RT_STAGE_SHADOW_RAYS,
                              RT_PART_SECONDARY, true},
    [RT_STAGE_SHADOW] = {"shadow", "rt_occlude", RT_STAGE_OCCLUDE, RT_PART_OCCLUDE, false},
    [RT_STAGE_SHADOW_TALLY] = {"shadow tally", "rt_tally", RT_STAGE_SHADOW_TALLY, RT_PART_SECONDARY,
                               true},
    [RT_STAGE_AMBIENT_RAYS] = {"ambient rays", "rt_ambient_rays", RT_STAGE_AMBIENT_RAYS,
                               RT_PART_SECONDARY, true},
    [RT_STAGE_AMBIENT] = {"ambient", "rt_occlude", RT_STAGE_OCCLUDE, RT_PART_OCCLUDE, false},
    [RT_STAGE_AMBIENT_TALLY] = {"ambient tally", "rt_tally", RT_STAGE_SHADOW_TALLY,
                                RT_PART_SECONDARY, true},
    [RT_STAGE_NEXT] = {"next", "rt_next", RT_STAGE_NEXT, RT_PART_SECONDARY, false},
    [RT_STAGE_COUNT_NEXT] = {"count", "rt_count", RT_STAGE_COUNT_NEXT, RT_PART_SECONDARY, false},
    [RT_STAGE_PACK] = {"pack", "rt_pack", RT_STAGE_PACK, RT_PART_SECONDARY, false},
    [RT_STAGE_NEXT_TRACE] = {"next trace", "rt_trace", RT_STAGE_TRACE, RT_PART_TRACE, false},
    [RT_STAGE_NEXT_SHADE] = {"next shade", "rt_shade", RT_STAGE_SHADE, RT_PART_STAGES, true},
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
    return rt_renderer_has(r, RT_EFFECT_REFLECT) || rt_renderer_has(r, RT_EFFECT_REFRACT);
}

static bool has_shadows(const rt_renderer *r)
{
    return rt_renderer_has(r, RT_EFFECT_HARD_SHADOWS) || rt_renderer_has(r, RT_EFFECT_SOFT_SHADOWS);
}

bool rt_renderer_has_probes(const rt_renderer *r)
{
    return has_shadows(r) || rt_renderer_has(r, RT_EFFECT_AMBIENT_OCCLUSION);
}

bool rt_renderer_has_any_hit(const rt_renderer *r)
{
    return r->with_occlusion || rt_renderer_has_probes(r);
}

/* Which program a kernel is in. */
static cl_program program_of(const rt_renderer *r, enum rt_stage stage)
{
    return r->programs.parts[stages[stage].part];
}

size_t rt_pipeline_rays_an_item(const rt_renderer *r, enum rt_stage stage)
{
    if (stages[stage].part == RT_PART_TRACE || stages[stage].part == RT_PART_OCCLUDE)
        return (size_t)r->packet;
    return stages[stage].by_blocks && r->lanes > 1 ? RT_BLOCK_RAYS : 1;
}

static bool has_kernel(const rt_renderer *r, enum rt_stage stage)
{
    switch (stages[stage].same_as) {
    case RT_STAGE_OCCLUDE:
        return rt_renderer_has_any_hit(r);
    case RT_STAGE_HITS:
        return r->with_hits;
    case RT_STAGE_SHADOW_RAYS:
        return has_shadows(r);
    case RT_STAGE_AMBIENT_RAYS:
        return rt_renderer_has(r, RT_EFFECT_AMBIENT_OCCLUSION);
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

/* At most one ray a bounce waits; none is left to go on from the last one. */
static size_t most_waiting(const rt_renderer *r)
{
    const int depth = r->effects.on[RT_EFFECT_REFRACT] && r->depth > 1 ? r->depth : 1;
    return (size_t)(depth < RT_WAITING_MOST ? depth : RT_WAITING_MOST);
}

/* Bytes a ray of the tile in a buffer; 0 where nothing calls for it. */
static size_t bytes_a_ray(const rt_renderer *r, enum tile_buffer which)
{
    const size_t number = r->number_size;
    const bool next = rt_renderer_has_next(r);
    const bool refraction = rt_renderer_has(r, RT_EFFECT_REFRACT);
    const bool probes = rt_renderer_has_probes(r);
    const bool any_hit = rt_renderer_has_any_hit(r);
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
    case BUFFER_TALLIES:
        return probes || next ? RT_TALLY_COMPONENTS * sizeof(cl_ulong) : 0;
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
    if (!r->tile[BUFFER_TALLIES])
        return true;
    const cl_ulong zero = 0;
    return RT_CL(clEnqueueFillBuffer(r->queue, r->tile[BUFFER_TALLIES], &zero, sizeof zero, 0,
                                     RT_TALLY_COMPONENTS * (size_t)r->stride * sizeof zero, 0, NULL,
                                     NULL),
                 status);
}

/* Stages of one kernel and the same arguments share it. */
static bool make_kernels(rt_renderer *r, rt_status *status)
{
    for (int i = 0; i < RT_STAGE_COUNT; ++i) {
        const enum rt_stage stage = (enum rt_stage)i, same = stages[i].same_as;
        cl_int error = CL_SUCCESS;
        if (same != stage || !has_kernel(r, stage))
            continue;
        r->kernels[i] = clCreateKernel(program_of(r, stage), stages[i].kernel, &error);
        if (!RT_CL_MADE(error, "clCreateKernel", status))
            return false;
    }
    return true;
}

bool rt_pipeline_make(rt_renderer *r, const rt_scene *scene, rt_status *status)
{
    return make_buffers(r, status) && make_kernels(r, status) &&
           rt_renderer_set_arguments(r, scene, status);
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
