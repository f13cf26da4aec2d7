/* Triangles as a scene holds them. */
#ifndef RT_SCENE_TRIANGLE_H
#define RT_SCENE_TRIANGLE_H

#include <stdbool.h>

#include "kernels/primitives/kinds.h"

/* True where the two corners of an edge coincide or all three lie on a line, so that the triangle
 * has no area. */
bool rt_triangle_is_degenerate(const rt_triangle *triangle);

/* Makes a triangle as a file gives it fit for the scene. One without area becomes a single point,
 * so that it keeps its index and its determinant is 0 for every ray. `normals`, NULL or nine
 * floats, are multiplied by a common power of two, which is exact and keeps their weights, so that
 * sums of them neither overflow nor vanish. Returns whether the triangle has area. */
bool rt_triangle_settle(rt_triangle *triangle, float *normals);

#endif
