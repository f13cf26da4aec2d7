#include "scene/effects.h"

#include <limits.h>
#include <string.h>

/* Two sizes only: each is a variant of the kernels to compile. */
#define FEW_BITS 8
#define MANY_BITS 20

static void call(rt_effects *effects, enum rt_effect effect, bool on, rt_place place)
{
    if (!on || effects->on[effect])
        return;
    effects->on[effect] = true;
    effects->called_by[effect] = place;
}

/* Whether a primitive with this material calls for an effect. */
static bool material_calls(const rt_scene *scene, const rt_material *m, enum rt_effect effect)
{
    switch (effect) {
    case RT_EFFECT_CHECKER:
        return m->cell > 0.0f;
    case RT_EFFECT_TEXTURE:
        return m->texture >= 0;
    case RT_EFFECT_REFLECT:
        return m->reflect > 0.0f && scene->depth > 0;
    case RT_EFFECT_REFRACT:
        return m->transmit > 0.0f && scene->depth > 0;
    case RT_EFFECT_ABSORB:
        return m->transmit > 0.0f && scene->depth > 0 &&
               (m->absorb_r > 0.0f || m->absorb_g > 0.0f || m->absorb_b > 0.0f);
    default:
        return false;
    }
}

/* For each effect the first material in use that calls for it, INT_MAX where none does. */
typedef struct first_materials {
    int32_t by_effect[RT_EFFECT_COUNT];
} first_materials;

/* Takes in the materials of some primitives, which mostly come in runs of one. */
static void take_materials(rt_effects *effects, const rt_scene *scene,
                           const rt_primitives *primitives, first_materials *first)
{
    int32_t last = -1;
    for (size_t i = 0; i < primitives->count; ++i) {
        const int32_t index = primitives->materials[i];
        if (index == last)
            continue;
        last = index;
        const rt_material *m = &scene->materials[index];
        for (int e = 0; e < RT_EFFECT_COUNT; ++e)
            if (index < first->by_effect[e] && material_calls(scene, m, (enum rt_effect)e))
                first->by_effect[e] = index;
        if (m->exponent < 0)
            effects->has_fractional_exponent = true;
        else if (m->exponent >> FEW_BITS)
            effects->exponent_bits = MANY_BITS;
    }
}

static void settle_materials(rt_effects *effects, const rt_scene *scene)
{
    first_materials first;
    for (int e = 0; e < RT_EFFECT_COUNT; ++e)
        first.by_effect[e] = INT_MAX;
    for (int kind = 0; kind < RT_KIND_COUNT; ++kind)
        take_materials(effects, scene, &scene->kinds[kind], &first);
    for (int e = 0; e < RT_EFFECT_COUNT; ++e)
        if (first.by_effect[e] != INT_MAX)
            call(effects, (enum rt_effect)e, true, scene->material_places[first.by_effect[e]]);
}

static void settle_lights(rt_effects *effects, const rt_scene *scene)
{
    effects->light_count = (int)scene->light_count;
    for (size_t i = 0; i < scene->light_count; ++i) {
        const rt_light *light = &scene->lights[i];
        const bool is_soft = light->radius > 0.0f;
        if (light->w != 0.0f)
            effects->has_point_lights = true;
        else
            effects->has_directional_lights = true;
        call(effects, is_soft ? RT_EFFECT_SOFT_SHADOWS : RT_EFFECT_HARD_SHADOWS,
             light->shadow && effects->has_primitives, scene->light_places[i]);
    }
}

static bool differ(rt_vec3 a, rt_vec3 b)
{
    return a.x != b.x || a.y != b.y || a.z != b.z;
}

rt_effects rt_effects_of(const rt_scene *scene)
{
    rt_effects effects = {.mode = RT_EFFECTS_SCENE,
                          .has_primitives = rt_scene_primitive_count(scene) > 0,
                          .exponent_bits = FEW_BITS};
    rt_effects *e = &effects;
    for (int kind = 0; kind < RT_KIND_COUNT; ++kind)
        e->has_kind[kind] = scene->kinds[kind].count > 0;
    call(e, RT_EFFECT_CULL, e->has_kind[RT_KIND_TRIANGLES] && scene->cull != RT_CULL_NONE,
         scene->cull_place);
    e->cull_sign = e->on[RT_EFFECT_CULL] ? rt_scene_cull_sign(scene) : 0;
    call(e, RT_EFFECT_SMOOTH, scene->normal_count > 0, scene->smooth_place);
    settle_materials(e, scene);
    settle_lights(e, scene);
    call(e, RT_EFFECT_AMBIENT_OCCLUSION, scene->occlusion_samples > 0, scene->occlusion_place);
    call(e, RT_EFFECT_FOG, scene->fog_density > 0.0f, scene->fog_place);
    call(e, RT_EFFECT_GRADIENT,
         scene->has_gradient && differ(scene->background, scene->background_top),
         scene->background_place);
    call(e, RT_EFFECT_ANTIALIAS, scene->samples > 1, scene->image_place);
    call(e, RT_EFFECT_LENS, scene->camera.aperture > 0.0f, scene->camera_place);
    return effects;
}

static void remove_from_material(rt_material *m, enum rt_effect effect)
{
    if (effect == RT_EFFECT_CHECKER)
        m->cell = 0.0f;
    if (effect == RT_EFFECT_TEXTURE)
        m->texture = -1;
    if (effect == RT_EFFECT_REFLECT)
        m->reflect = 0.0f;
    if (effect == RT_EFFECT_REFRACT)
        m->transmit = 0.0f;
    if (effect == RT_EFFECT_REFRACT || effect == RT_EFFECT_ABSORB)
        m->absorb_r = m->absorb_g = m->absorb_b = 0.0f;
}

void rt_effects_remove(rt_scene *scene, enum rt_effect effect)
{
    for (size_t i = 0; i < scene->material_count; ++i)
        remove_from_material(&scene->materials[i], effect);
    for (size_t i = 0; i < scene->light_count; ++i)
        if (effect ==
            (scene->lights[i].radius > 0.0f ? RT_EFFECT_SOFT_SHADOWS : RT_EFFECT_HARD_SHADOWS))
            scene->lights[i].shadow = 0;
    for (size_t i = 0; i < scene->triangle_count && effect == RT_EFFECT_SMOOTH; ++i)
        scene->triangle_normals[i] = -1;
    if (effect == RT_EFFECT_SMOOTH)
        scene->normal_count = 0;
    if (effect == RT_EFFECT_CULL)
        scene->cull = RT_CULL_NONE;
    if (effect == RT_EFFECT_AMBIENT_OCCLUSION)
        scene->occlusion_samples = 0;
    if (effect == RT_EFFECT_FOG)
        scene->fog_density = 0.0f;
    if (effect == RT_EFFECT_GRADIENT)
        scene->has_gradient = false;
    if (effect == RT_EFFECT_ANTIALIAS)
        scene->samples = 1;
    if (effect == RT_EFFECT_LENS)
        scene->camera.aperture = 0.0f;
}

void rt_effects_remove_all(rt_scene *scene)
{
    for (int e = 0; e < RT_EFFECT_COUNT; ++e)
        rt_effects_remove(scene, (enum rt_effect)e);
}

bool rt_effects_has(const rt_effects *effects, enum rt_effect effect)
{
    return effects->mode == RT_EFFECTS_ALL || effects->on[effect];
}

const char *rt_effect_name(enum rt_effect effect)
{
#define NAME(word, name) name,
    static const char *const names[RT_EFFECT_COUNT] = {RT_EFFECTS(NAME)};
#undef NAME
    return effect < RT_EFFECT_COUNT ? names[effect] : "none";
}

bool rt_effects_mode_of_name(const char *name, enum rt_effects_mode *mode)
{
    static const char *const names[RT_EFFECTS_MODES] = {
        [RT_EFFECTS_SCENE] = "scene", [RT_EFFECTS_ALL] = "all", [RT_EFFECTS_NONE] = "none"};
    for (int i = 0; i < RT_EFFECTS_MODES; ++i)
        if (strcmp(name, names[i]) == 0) {
            *mode = (enum rt_effects_mode)i;
            return true;
        }
    return false;
}
