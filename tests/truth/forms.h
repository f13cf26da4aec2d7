/* Closed forms. */
#ifndef RT_TESTS_TRUTH_FORMS_H
#define RT_TESTS_TRUTH_FORMS_H

#include <stdbool.h>

#include "truth/truth.h"

/* The part of a disk of radius 1 that is on one side of a line: where x < s. */
double truth_disk_part(double s);

/* The part of it where x < a and y < b. */
double truth_disk_corner(double a, double b);

/* The probability that a sum of `count` numbers, each uniform and `widths` wide about 0, is below
 * t. Widths are 0 or not small. */
double truth_sum_below(const double *widths, int count, double t);

/* What a light ball's disk about `lamp` sends to p past a half plane, 0 to 1: the disk faces p, and
 * what is not on the side of `open` of the line through `edge` along `along` is hidden. */
double truth_half_hidden(truth_vec p, truth_vec lamp, double radius, truth_vec edge,
                         truth_vec along, truth_vec open);

/* Where a ray meets a sphere: the length of its way there, and of that inside. False for a miss. */
bool truth_meet_sphere(const truth_ray *ray, truth_vec center, double radius, double *way,
                       double *inside);

/* Where a ray from the eye meets the floor. */
truth_vec truth_floor(const truth_ray *ray);

double truth_dot(truth_vec a, truth_vec b);
/* a + s b. */
truth_vec truth_add(truth_vec a, double s, truth_vec b);
truth_vec truth_cross(truth_vec a, truth_vec b);

#endif
