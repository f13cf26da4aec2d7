#include "render/programs.h"

#include "opencl/program.h"

bool rt_programs_build(rt_programs *programs, cl_context context, const rt_device *device,
                       const rt_effects *effects, const rt_walk *walk, bool with_any_hit,
                       rt_status *status)
{
    *programs = (rt_programs){{NULL}};
    for (int part = RT_PART_TRACE; part < RT_PART_COUNT; ++part) {
        if (part == RT_PART_OCCLUDE && !with_any_hit)
            continue;
        char options[RT_VARIANT_OPTIONS_SIZE];
        rt_variant_options(part, effects, walk, rt_variant_rounding(device), options);
        programs->parts[part] = rt_program_build(context, device, options, status);
        if (!programs->parts[part])
            return false;
    }
    return true;
}

void rt_programs_release(rt_programs *programs)
{
    for (int part = 0; part < RT_PART_COUNT; ++part)
        if (programs->parts[part])
            clReleaseProgram(programs->parts[part]);
    *programs = (rt_programs){{NULL}};
}
