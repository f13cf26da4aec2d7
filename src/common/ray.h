/* Rays and what they hit, as host code passes them about. */
#ifndef RT_COMMON_RAY_H
#define RT_COMMON_RAY_H

#include <stddef.h>
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

/* The rays of a picture, by what they are for. */
typedef struct rt_ray_counts {
    size_t primary, shadow, occlusion, reflection, refraction;
    size_t ended;     /* paths that Russian roulette ended */
    size_t cut;       /* paths that `depth` cut off, ... */
    double cut_light; /* ... and what they would have brought at most if all is white, where each
                       * primary ray brings 1 */
} rt_ray_counts;

void rt_ray_counts_add(rt_ray_counts *sum, const rt_ray_counts *more);

/* Of all kinds together. */
size_t rt_ray_counts_total(const rt_ray_counts *counts);

/* The part of the picture's light that `depth` cut off, at most: if all that was cut is white. */
double rt_ray_counts_cut_part(const rt_ray_counts *counts);

#endif
