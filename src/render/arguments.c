#include "render/arguments.h"

#include "opencl/arguments.h"
#include "render/state.h"
#include "scene/camera.h"

/* Arrays between stages, those of the scene and values, and a few of each kind of primitive. */
#define KNOWN_MOST (BUFFER_COUNT + 48 + 3 * RT_KIND_COUNT)

_Static_assert(RT_EFFECT_COUNT < 31, "each effect has a bit of `flags`");

typedef struct known {
    rt_argument list[KNOWN_MOST];
    size_t count;
} known;

static void know(known *k, const char *name, const void *value, size_t size)
{
    if (k->count < KNOWN_MOST)
        k->list[k->count] = (rt_argument){name, value, size};
    ++k->count;
}

#define KNOW(known, name, value) know(known, name, &(value), sizeof(value))

/* Arrays between the stages. */
static void know_tile(known *k, const rt_renderer *r)
{
    static const char *const names[BUFFER_COUNT] = {
        [BUFFER_RAYS] = "rays",           [BUFFER_HIT_INDEX] = "hit_index",
        [BUFFER_HIT_SLOT] = "hit_slot",   [BUFFER_HIT_ARRAY] = "hit_array",
        [BUFFER_COLORS] = "colors",       [BUFFER_PICTURE] = "picture",
        [BUFFER_RECORDS] = "records",     [BUFFER_PROBES] = "probes",
        [BUFFER_BLOCKED] = "blocked",     [BUFFER_OPEN] = "open",
        [BUFFER_TALLIES] = "tallies",     [BUFFER_HOME] = "home",
        [BUFFER_PATHS] = "paths",         [BUFFER_MARKS] = "marks",
        [BUFFER_NEXT_RAYS] = "next_rays", [BUFFER_NEXT_HOME] = "next_home",
        [BUFFER_COUNTS] = "counts",       [BUFFER_FIRST] = "first",
        [BUFFER_WAITING] = "waiting",     [BUFFER_WAITING_MARKS] = "waiting_marks",
    };
    for (int i = 0; i < BUFFER_COUNT; ++i)
        KNOW(k, names[i], r->tile[i]);
    KNOW(k, "stride", r->stride);
}

/* A kind's blocks and their number, and the number of primitives. */
#define KNOW_KIND(name, names, NAMES)                                                              \
    KNOW(k, #names, s->blocks[RT_KIND_##NAMES]);                                                   \
    KNOW(k, #name "_blocks", s->block_counts[RT_KIND_##NAMES]);                                    \
    KNOW(k, #name "_count", s->counts[RT_KIND_##NAMES]);

/* The scene's arrays. */
static void know_scene(known *k, const rt_device_scene *s)
{
    KNOW(k, "nodes", s->nodes);
    KNOW(k, "order", s->order);
    RT_KINDS(KNOW_KIND)
    KNOW(k, "normals_of", s->normals_of);
    KNOW(k, "normals", s->normals);
    KNOW(k, "material_of", s->materials_of);
    KNOW(k, "materials", s->materials);
    KNOW(k, "lights", s->lights);
    KNOW(k, "medium_of_material", s->media_of);
    KNOW(k, "media", s->media);
    KNOW(k, "nesting", s->nesting);
    KNOW(k, "uvs_of", s->uvs_of);
    KNOW(k, "uvs", s->uvs);
    KNOW(k, "textures", s->textures);
    KNOW(k, "texels", s->texels);
}

/* The bits of the effects that are on, for kernels that are switched by them. */
static cl_int flags_of(const rt_renderer *r)
{
    cl_int bits = 0;
    for (int e = 0; e < RT_EFFECT_COUNT; ++e)
        if (r->effects.on[e])
            bits |= RT_FLAG(e);
    return bits;
}

/* What is given by value and is not the renderer's own. */
typedef struct values {
    rt_frame frame;
    rt_frame_double frame_double;
    rt_surround surround;
    rt_gradient gradient;
    rt_fog fog;
    rt_crevice crevice;
    cl_int light_count, depth, flags;
    cl_uint seed;
    /* Set before each launch. */
    rt_tile tile;
    rt_turn turn;
    cl_int total;
} values;

static values values_of(const rt_renderer *r, const rt_scene *scene)
{
    const rt_vec3 low = scene->background, all = scene->ambient, fog = scene->fog;
    return (values){
        .frame = rt_scene_frame(scene),
        .frame_double = rt_scene_frame_double(scene),
        .surround = {low.x, low.y, low.z, all.x, all.y, all.z},
        .gradient = rt_scene_gradient(scene),
        .fog = {fog.x, fog.y, fog.z, scene->fog_density},
        .crevice = {scene->occlusion_distance, scene->occlusion_samples},
        .light_count = r->light_count,
        .depth = r->depth,
        .seed = scene->seed,
        .flags = flags_of(r) | (scene->filter == RT_FILTER_TENT ? RT_FLAG_TENT : 0),
    };
}

static void know_values(known *k, const values *v, const rt_renderer *r)
{
    if (r->number_size == sizeof(double))
        KNOW(k, "frame", v->frame_double);
    else
        KNOW(k, "frame", v->frame);
    KNOW(k, "surround", v->surround);
    KNOW(k, "gradient", v->gradient);
    KNOW(k, "fog", v->fog);
    KNOW(k, "crevice", v->crevice);
    KNOW(k, "light_count", v->light_count);
    KNOW(k, "depth", v->depth);
    KNOW(k, "seed", v->seed);
    KNOW(k, "flags", v->flags);
    KNOW(k, "unit_exponent", r->unit_exponent);
    KNOW(k, "tile", v->tile);
    KNOW(k, "turn", v->turn);
    KNOW(k, "total", v->total);
}

bool rt_renderer_set_arguments(rt_renderer *r, const rt_scene *scene, rt_status *status)
{
    const values v = values_of(r, scene);
    known k = {.count = 0};
    know_tile(&k, r);
    know_scene(&k, &r->scene);
    know_values(&k, &v, r);
    if (k.count > KNOWN_MOST)
        return rt_status_fail(status, RT_ERROR_DEVICE, "rt: %zu arguments, room for %d", k.count,
                              (int)KNOWN_MOST);
    for (int i = 0; i < RT_STAGE_COUNT; ++i) {
        cl_kernel kernel = r->kernels[i];
        r->changing[i] = (changing){-1, -1, -1};
        if (!kernel)
            continue;
        if (!rt_arguments_set(kernel, k.list, k.count, status))
            return false;
        r->changing[i] =
            (changing){rt_arguments_place(kernel, "tile"), rt_arguments_place(kernel, "turn"),
                       rt_arguments_place(kernel, "total")};
    }
    return true;
}
