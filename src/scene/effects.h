/* From a scene to what it calls for. What is not called for is not in the compiled kernels. */
#ifndef RT_SCENE_EFFECTS_H
#define RT_SCENE_EFFECTS_H

#include <stdbool.h>

#include "kernels/effects.def"
#include "scene/scene.h"

/* What is compiled into the kernels. */
enum rt_effects_mode {
    RT_EFFECTS_SCENE, /* what the scene calls for, and nothing else */
    RT_EFFECTS_ALL,   /* every effect, switched at run time by `on`; the picture is the same */
    RT_EFFECTS_NONE,  /* Phong alone, whatever the scene asks for */
    RT_EFFECTS_MODES
};

/* Everything that decides how the kernels are built for a scene. */
typedef struct rt_effects {
    enum rt_effects_mode mode;
    bool on[RT_EFFECT_COUNT];
    rt_place called_by[RT_EFFECT_COUNT]; /* the first statement that called for it */
    bool has_primitives, has_kind[RT_KIND_COUNT];
    bool has_point_lights, has_directional_lights;
    int light_count;
    int cull_sign;                /* rt_scene_cull_sign */
    bool has_fractional_exponent; /* some shininess is not whole */
    int exponent_bits;            /* that hold the largest whole shininess: 8 or 20 */
} rt_effects;

/* The set of a scene, with mode RT_EFFECTS_SCENE. A material counts only where a primitive has it,
 * a light only where there is a primitive to light. */
rt_effects rt_effects_of(const rt_scene *scene);

/* Takes from the scene what calls for an effect, so that every path renders it without. Absorption
 * needs refraction and goes with it. */
void rt_effects_remove(rt_scene *scene, enum rt_effect effect);

/* Leaves Phong's formula alone: what RT_EFFECTS_NONE stands for. */
void rt_effects_remove_all(rt_scene *scene);

/* Whether an effect is compiled into the kernels: because it is on, or because all are. */
bool rt_effects_has(const rt_effects *effects, enum rt_effect effect);

/* The effect's name in `--stats` and messages, such as "culling". */
const char *rt_effect_name(enum rt_effect effect);

/* The mode of that name, "scene", "all" or "none"; false, and *mode as it was, for no such name. */
bool rt_effects_mode_of_name(const char *name, enum rt_effects_mode *mode);

#endif
