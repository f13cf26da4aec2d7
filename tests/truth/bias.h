/* How far the errors of a picture are from noise about zero. */
#ifndef RT_TESTS_TRUTH_BIAS_H
#define RT_TESTS_TRUTH_BIAS_H

#include "truth/truth.h"

/* Errors that cancel, brighter here and darker there, leave the mean as it is: they are also
 * weighed by how much of its step each pixel has, which is the tilt. */
enum truth_weight { TRUTH_MEAN, TRUTH_TILT, TRUTH_WEIGHTS };

/* A picture's truth, and what is added up of it over all counts. */
typedef struct truth_tally {
    double truth[TRUTH_PIXELS], tilt[TRUTH_PIXELS]; /* the latter 0 on average */
    size_t pixels[TRUTH_PIXELS];                    /* those that are looked at */
    size_t pixel_count;
    bool has_pixels; /* the count is that of rays a pixel */
    double size;     /* of colours, on average, 1 at least */
    double lawful;   /* a mean error that is lawful */
    /* Errors, each in units of its count's spread, and what is lawful and what rounding does in
     * those units. */
    double sum[TRUTH_WEIGHTS][TRUTH_PIXELS];
    double sum_lawful[TRUTH_WEIGHTS], sum_rounding[TRUTH_WEIGHTS];
} truth_tally;

/* Begins a tally for a row at an angle in radians, of the scene for any count above 1. */
void truth_expect(truth_tally *tally, const truth_picture *picture);

/* The bias of a count's errors, in standard errors; the errors are added to the tally. */
double truth_bias(truth_tally *tally, int count, enum truth_weight weight, const double *errors);

/* The bias of all counts that were added. */
double truth_bias_of_all(const truth_tally *tally, enum truth_weight weight);

#endif
