/* Which bodies a point is inside of. */
#ifndef RT_SCENE_INSIDE_H
#define RT_SCENE_INSIDE_H

#include "common/status.h"
#include "common/vec3.h"
#include "scene/scene.h"

/* For each material of the scene, in its order, how often `point` (in the scene's unit of length)
 * lies inside of the primitives that have it: spheres count 1 each, triangles the winding number of
 * their surface about the point, which is the sum of the solid angles that they cover as seen from
 * there over 4 pi (Jacobson, Kavan and Sorkine-Hornung 2013). Of a closed mesh whose corners run
 * counter-clockwise as seen from outside it is 1 inside and 0 outside, to about 1e-12; it is
 * negative where they run clockwise, and where meshes of a material overlap it is their sum. An
 * open surface gives the part of all directions that it covers, and 0 outside of the box of all the
 * material's triangles. On a surface itself it is anything between the two sides.
 *
 * From malloc, material_count numbers; NULL after an error. It takes some 0.1 microseconds a
 * triangle of the materials in whose box the point is, and a fifth of that for others.
 */
double *rt_scene_windings(const rt_scene *scene, vec3 point, rt_status *status);

#endif
