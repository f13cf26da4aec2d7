/* The kernels' source as embedded at build time by src/opencl/kernel_text.awk. */
#ifndef RT_OPENCL_KERNEL_TEXT_H
#define RT_OPENCL_KERNEL_TEXT_H

#include <stddef.h>

/* File names in the order in which they are put together, ended by NULL. */
extern const char *const rt_kernel_names[];
/* All files, each behind a #line that makes build logs name it. */
extern const char rt_kernel_text[];
extern const size_t rt_kernel_text_length; /* bytes, the terminator not counted */

/* Each kernel's name and those of its parameters in order, a space between any two; ended by NULL.
 */
extern const char *const rt_kernel_parameters[];

#endif
