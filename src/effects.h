/* From a scene to what it calls for. What is not called for is not in the compiled kernels. */
#ifndef RT_EFFECTS_H
#define RT_EFFECTS_H

#include <stdbool.h>

#include "scene.h"

/* In the order of `--explain`. */
enum rt_effect {
    RT_EFFECT_CULLING,
    RT_EFFECT_SMOOTH_NORMALS,
    RT_EFFECT_CHECKER,
    RT_EFFECT_TEXTURE,
    RT_EFFECT_HARD_SHADOWS,
    RT_EFFECT_SOFT_SHADOWS,
    RT_EFFECT_REFLECTION,
    RT_EFFECT_REFRACTION,
    RT_EFFECT_ABSORPTION,
    RT_EFFECT_OCCLUSION,
    RT_EFFECT_FOG,
    RT_EFFECT_GRADIENT,
    RT_EFFECT_ANTIALIASING,
    RT_EFFECT_DEPTH_OF_FIELD,
    RT_EFFECT_COUNT
};

/* Everything that decides how the kernels are built for a scene. */
typedef struct rt_effects {
    bool on[RT_EFFECT_COUNT];
    rt_place called_by[RT_EFFECT_COUNT]; /* the first statement that called for it */
    bool has_spheres, has_triangles;
    int cull_sign;                /* rt_scene_cull_sign */
    bool has_fractional_exponent; /* some shininess is not whole */
    int exponent_bits;            /* that hold the largest whole shininess: 8 or 20 */
} rt_effects;

rt_effects rt_effects_of(const rt_scene *scene);

/* The effect's name in `--stats` and messages, such as "culling". */
const char *rt_effect_name(enum rt_effect effect);

#endif
