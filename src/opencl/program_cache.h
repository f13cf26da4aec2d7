/* Built programs on disk. OpenCL runtimes that cache what they compile still read the source afresh
 * each time: under PoCL 3.1 that is 27 ms a program, two thirds of it to look at OpenCL's own
 * header, against 9 ms for the binary that the runtime itself gives out.
 *
 * The cache is a folder of files named by a hash. A file holds, before the binary, everything that
 * the binary follows from (device, driver, options, source), and counts only where that is the same
 * to the byte and the binary is whole. A cache that cannot be read or written is no error: the
 * program is then built. */
#ifndef RT_OPENCL_PROGRAM_CACHE_H
#define RT_OPENCL_PROGRAM_CACHE_H

#include <stdbool.h>
#include <stddef.h>

#include "opencl/cl.h"
#include "opencl/device.h"

/* What a program is built from. */
typedef struct rt_recipe {
    cl_context context;
    const rt_device *device;
    const char *options;
    const char *text; /* `length` bytes */
    size_t length;
} rt_recipe;

/* The built program, or NULL where there is none. The folder is rt_cache_folder's. */
cl_program rt_program_cache_load(const rt_recipe *recipe);

/* Whether it is not there and there is a place for it. */
bool rt_program_cache_wants(const rt_recipe *recipe);

/* Keeps a program that has been built. */
void rt_program_cache_save(const rt_recipe *recipe, cl_program program);

#endif
