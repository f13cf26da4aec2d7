/* The levels of accuracy: one dial from the fastest arithmetic to the most trustworthy. */
#ifndef RT_COMMON_ACCURACY_H
#define RT_COMMON_ACCURACY_H

#include <stdbool.h>

/* In the order of what they promise. kernels/options.h gives the same numbers to RT_ACCURACY. */
enum rt_accuracy {
    RT_ACCURACY_FAST,     /* relaxed math: no promise beyond a picture that looks right */
    RT_ACCURACY_STANDARD, /* correctly rounded fp32; the same bits on every device */
    RT_ACCURACY_ROBUST,   /* watertight meshes and exact decisions for spheres, in fp32 */
    RT_ACCURACY_DOUBLE,   /* the robust algorithms in fp64 */
    RT_ACCURACY_COUNT
};

/* Where nobody names one. */
#define RT_ACCURACY_DEFAULT RT_ACCURACY_ROBUST

/* "fast", "standard", ... */
const char *rt_accuracy_name(enum rt_accuracy level);

/* The level of that name; false, and *level as it was, where there is none. */
bool rt_accuracy_of_name(const char *name, enum rt_accuracy *level);

#endif
