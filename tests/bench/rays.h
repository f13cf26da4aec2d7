/* Ray sets over an input. The same fp32 rays go to every tracer; the order is the renderer's: 64
 * rays in a row are an 8x8 block of pixels, row by row within it. */
#ifndef BENCH_RAYS_H
#define BENCH_RAYS_H

#include <stdbool.h>
#include <stddef.h>

#include "image/image.h"
#include "reference/scalar.h"
#include "scene/scene.h"

typedef struct bench_rays {
    rt_ray *rays; /* owned */
    size_t count;
} bench_rays;

/* A dead ray keeps its place but reaches nowhere (tmax < tmin). */
static inline bool bench_ray_is_dead(const rt_ray *ray)
{
    return ray->tmax < ray->tmin;
}

/* One through the centre of each pixel; the scene's sides are multiples of 8. */
bool bench_rays_primary(bench_rays *rays, const rt_scene *scene, rt_status *status);

/* Between each primary hit and the light, t from 0 to 1, from either end. The hit's end is held off
 * the surface by 1e-4 along the normal. Dead where the primary ray missed. */
bool bench_rays_shadow(bench_rays *rays, const rt_scene *scene, const bench_rays *primary,
                       const rt_hit *hits, bool from_light, rt_status *status);

/* One from each primary hit, cosine-distributed about the normal. Dead where the primary ray
 * missed. */
bool bench_rays_bounce(bench_rays *rays, const rt_scene *scene, const bench_rays *primary,
                       const rt_hit *hits, rt_status *status);

void bench_rays_clear(bench_rays *rays);

#endif
