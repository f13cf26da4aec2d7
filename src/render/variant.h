/* Which variant of the kernels a scene and a device call for, as compiler options. */
#ifndef RT_RENDER_VARIANT_H
#define RT_RENDER_VARIANT_H

#include <stdbool.h>
#include <stddef.h>

#include "common/accuracy.h"
#include "kernels/parts.h"
#include "opencl/device.h"
#include "scene/effects.h"

#define RT_VARIANT_OPTIONS_SIZE 1024

/* How the kernels come by correctly rounded division and square root (kernels/options.h). */
enum rt_rounding { RT_ROUNDING_DEVICE = 0, RT_ROUNDING_DOUBLE = 1, RT_ROUNDING_FMA = 2 };

/* The way for a device: its own where it offers it, double where it has fp64, else fma. */
enum rt_rounding rt_variant_rounding(const rt_device *device);

/* How the trace stage walks (kernels/options.h). */
typedef struct rt_walk {
    int lanes, packet;
    size_t stack_size; /* entries that the tree needs at most; 0 for no tree */
    enum rt_accuracy accuracy;
} rt_walk;

/* Rays that a work-item traces, for a lane width, unless somebody says otherwise. */
int rt_variant_packet(int lanes);

/* Writes the compiler options of a part of the kernels (kernels/parts.h) to
 * options[0..RT_VARIANT_OPTIONS_SIZE): what the part does not depend on is the same in all. */
void rt_variant_options(int part, const rt_effects *effects, const rt_walk *walk,
                        enum rt_rounding rounding, char *options);

/* Whether pictures of these effects take the part; any hit also where somebody else asks for it. */
bool rt_variant_has_part(int part, const rt_effects *effects, bool with_any_hit);

#endif
