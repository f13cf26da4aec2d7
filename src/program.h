/* Kernel source, effects and device to a built program. */
#ifndef RT_PROGRAM_H
#define RT_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>

#include "cl.h"
#include "device.h"
#include "effects.h"
#include "status.h"

#define RT_PROGRAM_OPTIONS_SIZE 1024

/* How the kernels come by correctly rounded division and square root (kernels/options.h). */
enum rt_rounding { RT_ROUNDING_DEVICE = 0, RT_ROUNDING_DOUBLE = 1, RT_ROUNDING_FMA = 2 };

/* The way for a device: its own where it offers it, double where it has fp64, else fma. */
enum rt_rounding rt_program_rounding(const rt_device *device);

/* How the trace stage walks (kernels/options.h). */
typedef struct rt_walk {
    int lanes, packet;
    size_t stack_size;   /* entries that the tree needs at most; 0 for no tree */
    bool with_occlusion; /* whether any hit is asked for too */
    enum rt_accuracy accuracy;
} rt_walk;

/* Writes the compiler options of a variant to options[0..RT_PROGRAM_OPTIONS_SIZE). */
void rt_program_options(const rt_effects *effects, const rt_walk *walk, enum rt_rounding rounding,
                        char *options);

/* Builds the kernels. Their text is the one embedded in the executable, or that of the files in the
 * folder RT_KERNELS where that is set; RT_BUILD_OPTIONS is added to the options. On failure the
 * status holds device, driver, options and the whole build log; NULL is returned. The caller
 * releases the program. */
cl_program rt_program_build(cl_context context, const rt_device *device, const char *options,
                            rt_status *status);

#endif
