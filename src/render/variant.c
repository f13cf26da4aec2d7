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

/* Which sides triangles have is the walks' affair, with a sign, and all else that of the stages. */
static void add_effects(const rt_effects *effects, bool walks, bool shades, char *options)
{
#define WORD(word, name) #word,
    static const char *const words[RT_EFFECT_COUNT] = {RT_EFFECTS(WORD)};
#undef WORD
    for (int e = 0; e < RT_EFFECT_COUNT; ++e)
        add(options, " -DRT_%s=%d", words[e],
            e == RT_EFFECT_CULL ? walks * effects->cull_sign
                                : shades && rt_effects_has(effects, (enum rt_effect)e));
}

void rt_variant_options(int part, const rt_effects *effects, const rt_walk *walk,
                        enum rt_rounding rounding, char *options)
{
    const bool walks = part != RT_PART_STAGES;
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
    add_effects(effects, walks, shades, options);
}
