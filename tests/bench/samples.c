#include "bench/samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool bench_measure(bench_contender *contenders, size_t count, int repeats, rt_status *status)
{
    double warm_up = 0.0;
    for (size_t i = 0; i < count; ++i) {
        bench_contender *c = &contenders[i];
        c->seconds = calloc((size_t)repeats, sizeof *c->seconds);
        if (!c->seconds)
            return rt_status_no_memory(status, "samples");
        if (!c->run(c->context, &warm_up, status))
            return false;
    }
    for (int repeat = 0; repeat < repeats; ++repeat)
        for (size_t i = 0; i < count; ++i) {
            bench_contender *c = &contenders[repeat % 2 ? count - 1 - i : i];
            if (!c->run(c->context, &c->seconds[repeat], status))
                return false;
        }
    return true;
}

void bench_contenders_clear(bench_contender *contenders, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        free(contenders[i].seconds);
        contenders[i].seconds = NULL;
    }
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double at(const double *sorted, int count, double part)
{
    const double place = part * (count - 1);
    const int below = (int)place;
    const int above = below + 1 < count ? below + 1 : below;
    return sorted[below] + (place - below) * (sorted[above] - sorted[below]);
}

bench_quartiles bench_quartiles_of(const double *values, int count)
{
    double *sorted = count > 0 ? malloc((size_t)count * sizeof *sorted) : NULL;
    if (!sorted)
        return BENCH_NOTHING;
    memcpy(sorted, values, (size_t)count * sizeof *sorted);
    bool is_complete = true;
    for (int i = 0; i < count; ++i)
        is_complete = is_complete && !isnan(values[i]);
    qsort(sorted, (size_t)count, sizeof *sorted, by_value);
    const bench_quartiles q = {at(sorted, count, 0.25), at(sorted, count, 0.5),
                               at(sorted, count, 0.75)};
    free(sorted);
    return is_complete ? q : BENCH_NOTHING;
}

bench_quartiles bench_ratio(const double *other, const double *own, int count)
{
    double *ratios = malloc((size_t)count * sizeof *ratios);
    if (!ratios)
        return BENCH_NOTHING;
    for (int i = 0; i < count; ++i)
        ratios[i] = other[i] / own[i];
    const bench_quartiles q = bench_quartiles_of(ratios, count);
    free(ratios);
    return q;
}
