#include "render/programs.h"

#include "opencl/compiler.h"
#include "opencl/program.h"

static bool compile(const rt_device *device, char options[][RT_VARIANT_OPTIONS_SIZE],
                    const bool is_missing[], const rt_watch *watch, rt_status *status)
{
    const char *missing[RT_PART_COUNT];
    size_t count = 0;
    for (int part = 0; part < RT_PART_COUNT; ++part)
        if (is_missing[part])
            missing[count++] = options[part];
    return rt_compiler_run(device, missing, count, watch, status);
}

bool rt_programs_build(rt_programs *programs, cl_context context, const rt_device *device,
                       const rt_effects *effects, const rt_walk *walk, bool with_any_hit,
                       const rt_watch *watch, rt_status *status)
{
    char options[RT_PART_COUNT][RT_VARIANT_OPTIONS_SIZE];
    bool is_missing[RT_PART_COUNT] = {false};
    *programs = (rt_programs){{NULL}};
    for (int part = 0; part < RT_PART_COUNT; ++part) {
        if (!rt_variant_has_part(part, effects, with_any_hit))
            continue;
        rt_variant_options(part, effects, walk, rt_variant_rounding(device), options[part]);
        programs->parts[part] = rt_program_kept(context, device, options[part]);
        is_missing[part] = !programs->parts[part];
    }
    if (!compile(device, options, is_missing, watch, status))
        return false;
    for (int part = 0; part < RT_PART_COUNT; ++part) {
        if (!is_missing[part])
            continue;
        programs->parts[part] = rt_program_build(context, device, options[part], status);
        if (!programs->parts[part])
            return false;
    }
    return true;
}

#define SETS_OF_KINDS ((1 << RT_KIND_COUNT) - 1) /* but the empty one */
#define WALKS (2 * 2 * SETS_OF_KINDS)            /* nearest and any hit, with and without culling */

bool rt_programs_prepare(const rt_device *device, enum rt_accuracy level, const rt_watch *watch,
                         rt_status *status)
{
    char texts[WALKS][RT_VARIANT_OPTIONS_SIZE];
    const char *options[WALKS];
    size_t count = 0;
    const int lanes = rt_device_lanes(device, level);
    const rt_walk walk = {lanes, rt_variant_packet(lanes), 1, level};
    for (int part = RT_PART_TRACE; part <= RT_PART_OCCLUDE; ++part)
        for (int kinds = 1; kinds <= SETS_OF_KINDS; ++kinds)
            for (int culls = 0; culls <= (kinds >> RT_KIND_TRIANGLES & 1); ++culls) {
                rt_effects effects = {.cull_sign = culls};
                for (int k = 0; k < RT_KIND_COUNT; ++k)
                    effects.has_kind[k] = kinds >> k & 1;
                effects.on[RT_EFFECT_CULL] = culls != 0;
                rt_variant_options(part, &effects, &walk, rt_variant_rounding(device),
                                   texts[count]);
                options[count] = texts[count];
                ++count;
            }
    return rt_device_check_level(device, level, status) &&
           rt_compiler_run(device, options, count, watch, status);
}

void rt_programs_release(rt_programs *programs)
{
    for (int part = 0; part < RT_PART_COUNT; ++part)
        if (programs->parts[part])
            clReleaseProgram(programs->parts[part]);
    *programs = (rt_programs){{NULL}};
}
