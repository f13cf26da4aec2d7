/* Rays and what they hit, as host code passes them about. */
#ifndef RT_COMMON_RAY_H
#define RT_COMMON_RAY_H

#include <stdint.h>

/* Hits have t, in units of the direction, in (tmin, tmax). */
typedef struct rt_ray {
    float origin[3], direction[3];
    float tmin, tmax;
} rt_ray;

/* What a ray hits: primitive index (RT_MISS for nothing), t in units of the ray's direction
 * (infinite for a miss), barycentric u and v (0 for a sphere). */
typedef struct rt_hit {
    int32_t primitive;
    float t, u, v;
} rt_hit;

#endif
