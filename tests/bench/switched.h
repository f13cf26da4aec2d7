/* The same scene by kernels that have only what it calls for, and by kernels that have everything
 * and are switched at run time: `--effects scene` and `--effects all`. */
#ifndef BENCH_SWITCHED_H
#define BENCH_SWITCHED_H

#include <stdbool.h>
#include <stddef.h>

#include "bench/bench.h"
#include "bench/samples.h"

/* What is measured of one scene; of pairs, [0] is what the scene calls for and [1] everything. */
typedef struct bench_switched {
    char input[64]; /* "glass 512x288, 4 samples" */
    int width, height;
    bench_quartiles frame[2]; /* seconds of kernels a picture */
    bench_quartiles ratio;    /* everything / what is called for */
    double build[2];          /* seconds until a first picture is there, beyond a second one's */
    size_t binary[2];         /* bytes, after a picture */
} bench_switched;

/* Reads scenes/NAME.txt, makes its picture `size` pixels wide or high, with at most 4 samples of
 * each kind, and measures it in a process of its own, whose caches are empty: so it is the first
 * to compile either. Fails, too, where the two pictures differ by more than a step. */
bool bench_switched_measure(bench_switched *switched, bench *b, const char *name, int size);

/* Pictures after which the build of what the scene calls for has paid for itself, against kernels
 * for everything that are ready; infinite where it never does. */
double bench_switched_pictures(const bench_switched *switched);

#endif
