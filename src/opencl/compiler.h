/* The kernels' compiler in processes of their own: runtimes compile one program after another
 * within a process, and nothing stops them on the way. What they compile the cache keeps, from
 * where rt_program_build takes it. */
#ifndef RT_OPENCL_COMPILER_H
#define RT_OPENCL_COMPILER_H

#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"
#include "common/watch.h"
#include "opencl/device.h"

/* As the first argument of such a process; a device as "P:D", its name and options follow. */
#define RT_COMPILER_CALL "--compile-kernels"
#define RT_COMPILER_ARGUMENTS 3

/* Processes at a time, at most; no more than there are processors. */
#define RT_COMPILER_MOST 8

/* Names the executable that understands the call, for the whole life of the process and before any
 * thread begins. Without one nothing is compiled here. */
void rt_compiler_set(const char *executable);

/* Compiles programs, `options` of each, for a device side by side, those that are not kept yet.
 * The watch is ticked ten times a second with the part of them that is there. What cannot be done
 * so is left to rt_program_build; false, with RT_INTERRUPTED, when the watch says stop, a moment
 * after it. */
bool rt_compiler_run(const rt_device *device, const char *const *options, size_t count,
                     const rt_watch *watch, rt_status *status);

/* What the process does with its arguments; its exit code. Where another device has the place, as
 * where the one is a processor that is made believe, nothing is done. */
int rt_compiler_main(char *const arguments[RT_COMPILER_ARGUMENTS]);

#endif
