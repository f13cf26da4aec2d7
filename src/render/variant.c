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

/* RT_CULL has a sign. */
static int value_of(const rt_effects *effects, enum rt_effect effect)
{
    return effect == RT_EFFECT_CULL ? effects->cull_sign : rt_effects_has(effects, effect);
}

static void kind_options(const rt_effects *effects, char *options, size_t size)
{
#define WORD(name, names, NAMES) #NAMES,
    static const char *const words[RT_KIND_COUNT] = {RT_KINDS(WORD)};
#undef WORD
    size_t length = strlen(options);
    for (int k = 0; k < RT_KIND_COUNT && length < size; ++k)
        length += (size_t)snprintf(options + length, size - length, " -DRT_%s=%d", words[k],
                                   effects->mode == RT_EFFECTS_ALL || effects->has_kind[k]);
}

static void effect_options(const rt_effects *effects, char *options, size_t size)
{
#define WORD(word, name) #word,
    static const char *const words[RT_EFFECT_COUNT] = {RT_EFFECTS(WORD)};
#undef WORD
    size_t length = strlen(options);
    if (effects->mode == RT_EFFECTS_ALL)
        length += (size_t)snprintf(options + length, size - length, " -DRT_SWITCHED=1");
    else if (effects->light_count <= LIGHTS_UNROLLED)
        length += (size_t)snprintf(options + length, size - length, " -DRT_LIGHTS=%d",
                                   effects->light_count);
    for (int e = 0; e < RT_EFFECT_COUNT && length < size; ++e)
        length += (size_t)snprintf(options + length, size - length, " -DRT_%s=%d", words[e],
                                   value_of(effects, (enum rt_effect)e));
}

void rt_variant_options(const rt_effects *effects, const rt_walk *walk, enum rt_rounding rounding,
                        char *options)
{
    const bool all = effects->mode == RT_EFFECTS_ALL;
    snprintf(options, RT_VARIANT_OPTIONS_SIZE,
             "-cl-std=CL1.2 " RT_ARGUMENTS_OPTION
             "%s%s -DRT_ACCURACY=%d -DRT_LANES=%d -DRT_PACKET=%d -DRT_TREE=%d "
             "-DRT_STACK=%d -DRT_OCCLUSION=%d "
             "-DRT_SHININESS_BITS=%d -DRT_SHININESS_FRACTION=%d -DRT_ROUNDING=%d",
             rounding == RT_ROUNDING_DEVICE ? " -cl-fp32-correctly-rounded-divide-sqrt" : "",
             walk->accuracy == RT_ACCURACY_FAST ? " -cl-fast-relaxed-math -cl-denorms-are-zero"
                                                : "",
             (int)walk->accuracy, walk->lanes, walk->packet, walk->stack_size > 0,
             round_stack(walk->stack_size), walk->with_occlusion, all ? 20 : effects->exponent_bits,
             all || effects->has_fractional_exponent, (int)rounding);
    kind_options(effects, options, RT_VARIANT_OPTIONS_SIZE);
    effect_options(effects, options, RT_VARIANT_OPTIONS_SIZE);
}
