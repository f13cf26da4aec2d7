/* The reference: plain scalar C that follows the formulas of kernels/README.md, "Numerics", and
 * shares no code with the kernels. The float version does the same roundings in the same order, so
 * its hits are the kernels' hits to the bit; the double version is what errors are measured
 * against. */
#ifndef RT_REFERENCE_SCALAR_H
#define RT_REFERENCE_SCALAR_H

#include <stddef.h>

#include "common/ray.h"
#include "common/watch.h"
#include "image/image.h"
#include "scene/scene.h"

/* Renders the whole scene; hit records are filled in where the picture has room for them. Fails
 * when the watch stops it, with code RT_INTERRUPTED, or without memory. */
bool rt_scalar_float_render(const rt_scene *scene, rt_image *image, const rt_watch *watch,
                            rt_status *status);
bool rt_scalar_double_render(const rt_scene *scene, rt_image *image, const rt_watch *watch,
                             rt_status *status);

/* The same, with the rays that it took. */
bool rt_scalar_float_render_counted(const rt_scene *scene, rt_image *image, rt_ray_counts *counts,
                                    const rt_watch *watch, rt_status *status);
bool rt_scalar_double_render_counted(const rt_scene *scene, rt_image *image, rt_ray_counts *counts,
                                     const rt_watch *watch, rt_status *status);

/* The nearest hits of `count` rays. */
void rt_scalar_float_trace(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits);
void rt_scalar_double_trace(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits);

/* What these find primitives by, made once for many calls: a tree over a scene's primitives, good
 * for every scene that has the same ones of the same materials in the same unit and the same eye,
 * whatever its size, samples or level. It changes no bit. NULL without memory, which is good too:
 * then each call makes its own. */
typedef struct rt_scalar_tree rt_scalar_tree;
rt_scalar_tree *rt_scalar_double_tree(const rt_scene *scene);
void rt_scalar_double_tree_free(rt_scalar_tree *tree);

/* As those above, by the scene's tree or NULL. */
bool rt_scalar_double_render_by(const rt_scalar_tree *tree, const rt_scene *scene, rt_image *image,
                                const rt_watch *watch, rt_status *status);
void rt_scalar_double_trace_by(const rt_scalar_tree *tree, const rt_scene *scene,
                               const rt_ray *rays, size_t count, rt_hit *hits);

#endif
