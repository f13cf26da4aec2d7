/* Building the tree, rt against Embree. */
#ifndef BENCH_BUILDING_H
#define BENCH_BUILDING_H

#include "bench/bench.h"
#include "bench/meshes.h"

/* Adds the row for one input. */
bool bench_measure_building(bench *b, const bench_input *input);

#endif
