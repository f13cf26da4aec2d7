/* The arithmetic of a study: quartiles, distances in ulp, how far two pictures are apart, what is
 * not worth its time. */
#ifndef RT_STUDY_FIGURES_H
#define RT_STUDY_FIGURES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/image.h"

/* The value below which the part `p`, 0 to 1, of `count` values lies, linear between neighbours
 * (type 7 of Hyndman and Fan 1996); the values must rise. NaN for none. */
double rt_quantile(const double *sorted, size_t count, double p);

/* Lower quartile, median and upper quartile. */
typedef struct rt_spread {
    double low, median, high;
} rt_spread;

/* Sorts the values. */
rt_spread rt_spread_of(double *values, size_t count);

/* Steps from one float to the other: 0 for equal ones (+0 and -0 are), 2^32 - 1 where either is
 * NaN. */
uint32_t rt_ulp_distance(float a, float b);

/* How far a picture is from another; steps are 8-bit steps after clamping to 0..1. */
typedef struct rt_study_error {
    size_t over_0, over_1,
        over_8;        /* pixels with a component off by more than so many whole steps */
    int max_step;      /* largest difference, in whole steps */
    double rms;        /* root mean square, in steps, without rounding to whole ones */
    size_t non_finite; /* pixels with a component that is not finite in either picture */
} rt_study_error;

rt_study_error rt_study_error_of(const rt_image *picture, const rt_image *reference);

/* The noise of too few samples about each pixel of a picture of so many: how far the reference at
 * as many samples is from the converged one, in steps, at most in the 5x5 pixels about it. From
 * malloc; NULL without memory. */
uint8_t *rt_study_noise_of(const rt_image *reference, const rt_image *converged);

/* Pixels of a picture that one can see to be off: by more than a step from the reference at as many
 * samples, and by more than twice that noise, which hides the rest. */
size_t rt_study_count_visible(const rt_image *picture, const rt_image *reference,
                              const uint8_t *noise);

/* A point of the plot: what it takes, and how far off it is. */
typedef struct rt_study_point {
    rt_spread time;
    double error;
} rt_study_point;

/* Whether some other point is as good and faster, or better and as fast. Times whose quartiles
 * overlap count as equal, and so do errors within one in a hundred. */
bool rt_study_is_dominated(const rt_study_point *points, size_t count, size_t i);

#endif
