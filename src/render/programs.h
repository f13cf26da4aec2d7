/* The programs of a renderer, a part of the kernels each (kernels/parts.h). */
#ifndef RT_RENDER_PROGRAMS_H
#define RT_RENDER_PROGRAMS_H

#include <stdbool.h>

#include "common/status.h"
#include "common/watch.h"
#include "opencl/cl.h"
#include "opencl/device.h"
#include "render/variant.h"

typedef struct rt_programs {
    cl_program parts[RT_PART_COUNT]; /* NULL for what is not needed, and for RT_PART_ALL */
} rt_programs;

/* Builds what the effects call for on a device; with any hit where that is asked for. While
 * compilers run, the watch is told the part of the missing programs that is there, and may stop
 * them with RT_INTERRUPTED. After a failure, too, the caller releases what there is. */
bool rt_programs_build(rt_programs *programs, cl_context context, const rt_device *device,
                       const rt_effects *effects, const rt_walk *walk, bool with_any_hit,
                       const rt_watch *watch, rt_status *status);
/* Compiles the walks that scenes of any kinds of primitives take at a level, where they are not
 * kept yet. Without a place to keep them in nothing is done. */
bool rt_programs_prepare(const rt_device *device, enum rt_accuracy level, const rt_watch *watch,
                         rt_status *status);

void rt_programs_release(rt_programs *programs);

#endif
