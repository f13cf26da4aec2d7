#include "effects.h"

/* Two sizes only: each is a variant of the kernels to compile. */
#define FEW_BITS 8
#define MANY_BITS 20

rt_effects rt_effects_of(const rt_scene *scene)
{
    rt_effects effects = {.has_spheres = scene->sphere_count > 0,
                          .has_triangles = scene->triangle_count > 0,
                          .exponent_bits = FEW_BITS};
    effects.on[RT_EFFECT_CULLING] = effects.has_triangles && scene->cull != RT_CULL_NONE;
    effects.called_by[RT_EFFECT_CULLING] = scene->cull_place;
    effects.cull_sign = effects.on[RT_EFFECT_CULLING] ? rt_scene_cull_sign(scene) : 0;
    effects.on[RT_EFFECT_SMOOTH_NORMALS] = scene->normal_count > 0;
    effects.called_by[RT_EFFECT_SMOOTH_NORMALS] = scene->smooth_place;
    for (size_t i = 0; i < scene->material_count; ++i) {
        const rt_material *material = &scene->materials[i];
        if (material->exponent < 0)
            effects.has_fractional_exponent = true;
        else if (material->exponent >> FEW_BITS)
            effects.exponent_bits = MANY_BITS;
    }
    return effects;
}

const char *rt_effect_name(enum rt_effect effect)
{
    static const char *const names[RT_EFFECT_COUNT] = {
        "culling",      "smooth normals", "checker",       "texture",       "hard shadows",
        "soft shadows", "reflection",     "refraction",    "absorption",    "ambient occlusion",
        "fog",          "gradient",       "anti-aliasing", "depth of field"};
    return effect < RT_EFFECT_COUNT ? names[effect] : "none";
}
