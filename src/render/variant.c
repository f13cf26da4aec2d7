#include "render/variant.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "opencl/arguments.h"

enum rt_rounding rt_variant_rounding(const rt_device *device)
{
    if (device->rounds_divide_sqrt)
        return RT_ROUNDING_DEVICE;
    return device->has_fp64 ? RT_ROUNDING_DOUBLE : RT_ROUNDING_FMA;
}

int rt_variant_packet(int lanes)
{
    return lanes == 1 ? 1 : RT_BLOCK_RAYS;
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

__attribute__((format(printf, 2, 3))) static void add(char *options, const char *format, ...)
{
    const size_t length = strlen(options);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(options + length, RT_VARIANT_OPTIONS_SIZE - length, format, arguments);
    va_end(arguments);
}

static void add_kinds(const rt_effects *effects, char *options)
{
#define WORD(name, names, NAMES) #NAMES,
    static const char *const words[RT_KIND_COUNT] = {RT_KINDS(WORD)};
#undef WORD
    for (int k = 0; k < RT_KIND_COUNT; ++k)
        add(options, " -DRT_%s=%d", words[k],
            effects->mode == RT_EFFECTS_ALL || effects->has_kind[k]);
}

static void add_walk(const rt_walk *walk, char *options)
{
    add(options, " -DRT_PACKET=%d -DRT_TREE=%d -DRT_STACK=%d", walk->packet, walk->stack_size > 0,
        round_stack(walk->stack_size));
}

static void add_shading(const rt_effects *effects, char *options)
{
    const bool all = effects->mode == RT_EFFECTS_ALL;
    add(options, " -DRT_SHININESS_BITS=%d -DRT_SHININESS_FRACTION=%d",
        all ? 20 : effects->exponent_bits, all || effects->has_fractional_exponent);
    if (all)
        add(options, " -DRT_SWITCHED=1");
    else if (effects->light_count <= LIGHTS_UNROLLED)
        add(options, " -DRT_LIGHTS=%d", effects->light_count);
}

/* Whether a part depends on an effect: which sides triangles have is the walks' affair. */
static bool concerns(int part, enum rt_effect effect)
{
    switch (part) {
    case RT_PART_TRACE:
    case RT_PART_OCCLUDE:
        return effect == RT_EFFECT_CULL;
    case RT_PART_STAGES:
        return effect != RT_EFFECT_CULL;
    case RT_PART_SECONDARY:
        return effect == RT_EFFECT_REFLECT || effect == RT_EFFECT_REFRACT ||
               effect == RT_EFFECT_SMOOTH || effect == RT_EFFECT_HARD_SHADOWS ||
               effect == RT_EFFECT_SOFT_SHADOWS || effect == RT_EFFECT_AMBIENT_OCCLUSION;
    default:
        return true;
    }
}

static void add_effects(int part, const rt_effects *effects, char *options)
{
#define WORD(word, name) #word,
    static const char *const words[RT_EFFECT_COUNT] = {RT_EFFECTS(WORD)};
#undef WORD
    for (int e = 0; e < RT_EFFECT_COUNT; ++e) {
        const int on = e == RT_EFFECT_CULL ? effects->cull_sign
                                           : (int)rt_effects_has(effects, (enum rt_effect)e);
        add(options, " -DRT_%s=%d", words[e], concerns(part, (enum rt_effect)e) ? on : 0);
    }
}

bool rt_variant_has_part(int part, const rt_effects *effects, bool with_any_hit)
{
    switch (part) {
    case RT_PART_ALL:
        return false;
    case RT_PART_OCCLUDE:
        return with_any_hit;
    case RT_PART_SECONDARY:
        return rt_effects_has(effects, RT_EFFECT_HARD_SHADOWS) ||
               rt_effects_has(effects, RT_EFFECT_SOFT_SHADOWS) ||
               rt_effects_has(effects, RT_EFFECT_AMBIENT_OCCLUSION) ||
               rt_effects_has(effects, RT_EFFECT_REFLECT) ||
               rt_effects_has(effects, RT_EFFECT_REFRACT);
    default:
        return true;
    }
}

void rt_variant_options(int part, const rt_effects *effects, const rt_walk *walk,
                        enum rt_rounding rounding, char *options)
{
    const bool walks = part == RT_PART_ALL || part == RT_PART_TRACE || part == RT_PART_OCCLUDE;
    const bool shades = part == RT_PART_STAGES || part == RT_PART_ALL;
    *options = '\0';
    add(options, "-cl-std=CL1.2 " RT_ARGUMENTS_OPTION "%s%s -DRT_PART=%d -DRT_ACCURACY=%d",
        rounding == RT_ROUNDING_DEVICE ? " -cl-fp32-correctly-rounded-divide-sqrt" : "",
        walk->accuracy == RT_ACCURACY_FAST ? " -cl-fast-relaxed-math -cl-denorms-are-zero" : "",
        part, (int)walk->accuracy);
    add(options, " -DRT_LANES=%d -DRT_ROUNDING=%d", walk->lanes, (int)rounding);
    if (walks)
        add_walk(walk, options);
    if (shades)
        add_shading(effects, options);
    add_kinds(effects, options);
    add_effects(part, effects, options);
}
