/* Naive variants: what is found in textbooks and in a first try. Each is wrong somewhere, and the
 * hard cases must notice. */
#ifndef RT_TESTS_HARD_NAIVE_H
#define RT_TESTS_HARD_NAIVE_H

#include "hard/hard.h"

/* Moller-Trumbore with a determinant below 1e-6 taken for parallel. */
extern const hard_naive hard_naive_epsilon;
/* Moller-Trumbore in fp32. */
extern const hard_naive hard_naive_moller;
/* Moller-Trumbore with barycentric coordinates that must be above 1e-4. */
extern const hard_naive hard_naive_inside;
/* Woop's shear with products that the compiler has contracted, and nothing for edges. */
extern const hard_naive hard_naive_woop;
/* b*b - 4ac, as one learns it. */
extern const hard_naive hard_naive_quadratic;
/* b*b - 4ac with the nearer root alone, and triangles. */
extern const hard_naive hard_naive_entering;
/* Moller-Trumbore behind a slab test of each triangle's box without any margin. */
extern const hard_naive hard_naive_slab;
/* The same, taking the last of equal hits. */
extern const hard_naive hard_naive_last;
/* Kernels in which next rays start on the surface as it was computed, not moved at all. */
extern const hard_naive hard_naive_no_offset;

#endif
