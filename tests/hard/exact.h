/* The truth: fp32 inputs count as exact. In quadruple precision, and where a sign must be right
 * whatever it takes, in rational numbers (GMP). */
#ifndef RT_TESTS_HARD_EXACT_H
#define RT_TESTS_HARD_EXACT_H

#include "hard/hard.h"

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;
#else
typedef long double quad; /* 113 bits on the machines that have no other name for them */
#endif

quad hard_root(quad x);

typedef struct hard_truth {
    bool is_hit;
    double t;
    double margin; /* of a sphere: how far the ray passes from tangency, in ulp of the radius */
} hard_truth;

/* The nearest root beyond tmin = 0. */
hard_truth hard_true_sphere(const rt_ray *ray, const rt_sphere *sphere);
/* Whether the line through the ray meets the sphere at all, by rational numbers. */
bool hard_true_tangent(const rt_ray *ray, const rt_sphere *sphere);
/* The crossing with a triangle; none for a ray in its plane. */
hard_truth hard_true_triangle(const rt_ray *ray, const rt_triangle *triangle);

/* |actual - truth| in units in the last place of the truth's nearest float. */
double hard_ulps(double actual, double truth);

/* The p-th part, 0 to 1, of values; sorts them. NaN without any. */
double hard_percentile(double *values, size_t count, double p);

#endif
