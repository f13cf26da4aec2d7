/* The command line that the measuring programs share. */
#ifndef BENCH_SETTINGS_H
#define BENCH_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"

/* 20 * 4^level triangles. */
#define BENCH_LEVEL_MAX 11

typedef struct bench_settings {
    int level;   /* the only mesh to measure, or the largest where counts are stepped through; -1
                    for the program's own set */
    int size;    /* side of the picture in pixels, a multiple of 8; 0 for the program's own */
    int spheres; /* of the sphere field; 0 leaves it out */
    int repeats;
    int threads;
    bool huge;              /* 10^7 triangles and more too */
    bool shadow_from_light; /* shadow rays start at the light and end at the hit */
    bool help;
    const char *device; /* as rt --device takes it; NULL for the default */
    const char *rt;     /* the program to measure whole */
    const char *json;   /* where rows are added; NULL for nowhere */
} bench_settings;

/* Reads the command line; false, with code RT_ERROR_USAGE, where it makes no sense. Sets the number
 * of threads for OpenCL runtimes that take it from the environment. */
bool bench_settings_read(bench_settings *settings, int argc, char **argv, rt_status *status);

void bench_settings_help(const char *program);

#endif
