/* Times taken so that they can be compared: absolute times drift, so contenders take turns within
 * one run, and only ratios of neighbouring repeats count. */
#ifndef BENCH_SAMPLES_H
#define BENCH_SAMPLES_H

#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"

/* All NaN where there is nothing to tell. */
typedef struct bench_quartiles {
    double low, median, high;
} bench_quartiles;

#define BENCH_NOTHING ((bench_quartiles){NAN, NAN, NAN})

typedef struct bench_contender {
    const char *name;
    bool (*run)(void *context, double *seconds, rt_status *status);
    void *context;
    double
        *seconds; /* owned by whoever called bench_measure: one value a repeat; NaN for no time */
} bench_contender;

/* Runs each contender once to warm up, then `repeats` times in the order A B C, C B A, A B C ... */
bool bench_measure(bench_contender *contenders, size_t count, int repeats, rt_status *status);
void bench_contenders_clear(bench_contender *contenders, size_t count);

/* Quartiles by linear interpolation; nothing where a value is NaN. */
bench_quartiles bench_quartiles_of(const double *values, int count);

/* Quartiles of other[i] / own[i]: above 1 where `own` is the faster. */
bench_quartiles bench_ratio(const double *other, const double *own, int count);

#endif
