/* What every measuring program opens and closes. */
#ifndef BENCH_BENCH_H
#define BENCH_BENCH_H

#include <stdbool.h>

#include "bench/report.h"
#include "bench/settings.h"
#include "common/status.h"
#include "opencl/device.h"

typedef struct bench {
    bench_settings settings;
    rt_status status;
    bench_report report;
    rt_device_list devices;
    const rt_device *device; /* NULL until bench_find_device */
} bench;

/* Reads the command line, opens the report, measures and writes the report; returns the exit code:
 * RT_DIFFERENT where hit counts differ. */
int bench_main(int argc, char **argv, bool (*measure)(bench *));

/* Chooses the OpenCL device of the settings. Not done before it is needed: a process that has
 * spoken to an OpenCL runtime cannot fork and go on with it. */
bool bench_find_device(bench *b);

#endif
