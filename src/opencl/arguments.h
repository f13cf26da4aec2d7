/* Kernels' arguments by the names of their parameters: two of the same size cannot be swapped
 * unnoticed, and the order is the kernel's own affair. */
#ifndef RT_OPENCL_ARGUMENTS_H
#define RT_OPENCL_ARGUMENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"
#include "opencl/cl.h"

/* What a parameter of that name gets, in every kernel that has one. */
typedef struct rt_argument {
    const char *name;
    const void *value; /* `size` bytes; for an array a cl_mem, which may be NULL */
    size_t size;
} rt_argument;

/* Gives each parameter of a kernel its argument, one of the `count` that are known. A parameter
 * that is not known or of another size is an error, with code RT_ERROR_DEVICE and a message that
 * names both.
 *
 * The names are the driver's where it knows them: of programs built with RT_ARGUMENTS_OPTION, but
 * not everywhere of binaries. Else they are those of rt_kernel_parameters. */
bool rt_arguments_set(cl_kernel kernel, const rt_argument *known, size_t count, rt_status *status);

/* The place of the parameter of that name, for clSetKernelArg; -1 where the kernel has none. */
int rt_arguments_place(cl_kernel kernel, const char *name);

#define RT_ARGUMENTS_OPTION "-cl-kernel-arg-info"

#endif
