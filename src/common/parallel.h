/* The cores of the host: a loop whose rounds do not depend on each other. */
#ifndef RT_COMMON_PARALLEL_H
#define RT_COMMON_PARALLEL_H

#include <stddef.h>

/* Calls round(context, i) once for each i below `count`, on up to `threads` threads, this one among
 * them; returns when all are done. Where no further thread can be had it goes on with fewer. */
void rt_parallel(size_t count, int threads, void (*round)(void *context, size_t i), void *context);

/* Processors that this process may run on, at least 1. */
int rt_parallel_processors(void);

#endif
