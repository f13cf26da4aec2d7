/* The folder of built programs: whose it is, how large it may become, and PoCL's own cache in it.
 *
 * What is in it runs as the user's own code, so it counts only where the folder and the file belong
 * to the user and nobody else can write them. */
#ifndef RT_OPENCL_CACHE_H
#define RT_OPENCL_CACHE_H

#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"

/* RT_CACHE_DIR, else rt in XDG_CACHE_HOME, else .cache/rt in HOME; made where it is missing. NULL
 * where there is none that can be used, as with an empty RT_CACHE_DIR. The caller frees it. */
char *rt_cache_folder(void);

/* What a folder in it begins with that a compiler works in. */
#define RT_CACHE_COMPILING "compiling-"

/* Whether a file belongs to the user, and to nobody else to write. */
bool rt_cache_is_own(const char *path);

/* Marks a file as used now. */
void rt_cache_touch(const char *path);

/* Removes what has not been used for the longest time until the rest is at most rt_cache_limit()
 * bytes: programs, and of PoCL's those of which no other run is likely to be in the middle. */
void rt_cache_bound(void);
/* 256 MB, or RT_CACHE_SIZE in MB. */
size_t rt_cache_limit(void);

/* How much there is in it. False, with a status of code RT_ERROR_OUTPUT that says why, where it is
 * not used. */
typedef struct rt_cache_size {
    size_t programs, bytes;           /* rt's */
    size_t pocl_programs, pocl_bytes; /* PoCL's */
} rt_cache_size;
bool rt_cache_measure(rt_cache_size *size, rt_status *status);

/* Removes what is rt's in it, and PoCL's; other runs then build anew. */
bool rt_cache_clear(rt_status *status);

/* Gives PoCL, which has not begun yet, a place for what it compiles, unless the environment names
 * one that can be written: beside the programs, or else in a folder of the temporary ones that is
 * gone when the process ends. PoCL without a place has no device. */
void rt_cache_suit_pocl(void);

#endif
