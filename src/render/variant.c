#include "render/variant.h"

#include <stdio.h>
#include <string.h>

#include "opencl/arguments.h"

enum rt_rounding rt_variant_rounding(const rt_device *device)
{
    if (device->rounds_divide_sqrt)
        return RT_ROUNDING_DEVICE;
    return device->has_fp64 ? RT_ROUNDING_DOUBLE : RT_ROUNDING_FMA;
}

/* Few sizes, because each is a variant to compile. */
static int round_stack(size_t need)
{
    int size = 64;
    while ((size_t)size < need)
        size *= 4;
    return size;
}

/* So many lights are a loop that is unrolled; each count is a variant to compile. */
#define LIGHTS_UNROLLED 4

/* Of the effects, the options of those that are on: the others' default is not to be there. */
static void effect_options(const rt_effects *effects, char *options, size_t size)
{
    static const struct {
        enum rt_effect effect;
        const char *option;
    } names[] = {{RT_EFFECT_CHECKER, "CHECKER"},
                 {RT_EFFECT_TEXTURE, "TEXTURE"},
                 {RT_EFFECT_REFLECT, "REFLECT"},
                 {RT_EFFECT_REFRACT, "REFRACT"},
                 {RT_EFFECT_ABSORB, "ABSORB"},
                 {RT_EFFECT_AMBIENT_OCCLUSION, "AMBIENT_OCCLUSION"},
                 {RT_EFFECT_FOG, "FOG"},
                 {RT_EFFECT_GRADIENT, "GRADIENT"},
                 {RT_EFFECT_ANTIALIAS, "ANTIALIAS"},
                 {RT_EFFECT_LENS, "LENS"}};
    size_t length = strlen(options);
    const bool all = effects->mode == RT_EFFECTS_ALL;
    if (all)
        length += (size_t)snprintf(options + length, size - length, " -DRT_SWITCHED=1");
    else if (effects->light_count <= LIGHTS_UNROLLED)
        length += (size_t)snprintf(options + length, size - length, " -DRT_LIGHTS=%d",
                                   effects->light_count);
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (rt_effects_has(effects, names[i].effect))
            length +=
                (size_t)snprintf(options + length, size - length, " -DRT_%s=1", names[i].option);
    const bool soft = rt_effects_has(effects, RT_EFFECT_SOFT_SHADOWS);
    if (soft || rt_effects_has(effects, RT_EFFECT_HARD_SHADOWS))
        snprintf(options + length, size - length, " -DRT_SHADOWS=%d", soft ? 2 : 1);
}

void rt_variant_options(const rt_effects *effects, const rt_walk *walk, enum rt_rounding rounding,
                        char *options)
{
    const bool all = effects->mode == RT_EFFECTS_ALL;
    snprintf(options, RT_VARIANT_OPTIONS_SIZE,
             "-cl-std=CL1.2 " RT_ARGUMENTS_OPTION
             "%s%s -DRT_ACCURACY=%d -DRT_LANES=%d -DRT_PACKET=%d -DRT_TREE=%d "
             "-DRT_STACK=%d "
             "-DRT_OCCLUSION=%d "
             "-DRT_SPHERES=%d -DRT_TRIANGLES=%d -DRT_CULL=%d "
             "-DRT_SMOOTH=%d -DRT_SHININESS_BITS=%d -DRT_SHININESS_FRACTION=%d -DRT_ROUNDING=%d",
             rounding == RT_ROUNDING_DEVICE ? " -cl-fp32-correctly-rounded-divide-sqrt" : "",
             walk->accuracy == RT_ACCURACY_FAST ? " -cl-fast-relaxed-math -cl-denorms-are-zero"
                                                : "",
             (int)walk->accuracy, walk->lanes, walk->packet, walk->stack_size > 0,
             round_stack(walk->stack_size), walk->with_occlusion, all || effects->has_spheres,
             all || effects->has_triangles, effects->cull_sign,
             rt_effects_has(effects, RT_EFFECT_SMOOTH), all ? 20 : effects->exponent_bits,
             all || effects->has_fractional_exponent, (int)rounding);
    effect_options(effects, options, RT_VARIANT_OPTIONS_SIZE);
}
