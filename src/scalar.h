/* The reference: plain scalar C that follows the formulas of README.md, "Numerics", and shares no
 * code with the kernels. The float version does the same roundings in the same order, so its hits
 * are the kernels' hits to the bit; the double version is what errors are measured against. */
#ifndef RT_SCALAR_H
#define RT_SCALAR_H

#include <stddef.h>

#include "image.h"
#include "scene.h"
#include "watch.h"

/* A ray for rt_scalar_*_trace: hits have t in (tmin, tmax). */
typedef struct rt_ray {
    float origin[3], direction[3];
    float tmin, tmax;
} rt_ray;

/* Renders the whole scene; hit records are filled in where the picture has room for them. Fails
 * only when the watch stops it, with code RT_INTERRUPTED. */
bool rt_scalar_float_render(const rt_scene *scene, rt_image *image, const rt_watch *watch,
                            rt_status *status);
bool rt_scalar_double_render(const rt_scene *scene, rt_image *image, const rt_watch *watch,
                             rt_status *status);

/* The nearest hits of `count` rays. */
void rt_scalar_float_trace(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits);
void rt_scalar_double_trace(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits);

#endif
