/* Kernel source, options and device to a built program. */
#ifndef RT_OPENCL_PROGRAM_H
#define RT_OPENCL_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"
#include "opencl/cl.h"
#include "opencl/device.h"

/* Builds the kernels. Their text is the one embedded in the executable, or that of the files in the
 * folder RT_KERNELS where that is set; RT_BUILD_OPTIONS is added to the options. On failure the
 * status holds device, driver, options and the whole build log; NULL is returned. The caller
 * releases the program. */
cl_program rt_program_build(cl_context context, const rt_device *device, const char *options,
                            rt_status *status);

/* The same program from the cache alone; NULL, which is no error, where it is not there. */
cl_program rt_program_kept(cl_context context, const rt_device *device, const char *options);

/* Whether it is not there and there is a place for it: another process may put it there. */
bool rt_program_can_be_kept(const rt_device *device, const char *options);

#endif
