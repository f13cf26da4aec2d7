/* The boxes of primitives. */
#ifndef RT_BVH_BOX_H
#define RT_BVH_BOX_H

#include "bvh/split.h"
#include "scene/scene.h"

/* Boxes that hold primitives' hits at every level, with RT_BOX_MARGIN of kernels/margins.h: of
 * those of a kind from `begin` up to `end`, to the lo and hi of as many references. At robust and
 * double the kernels compute the same, at standard a narrower one. */
void rt_boxes_of(const rt_scene *scene, enum rt_kind kind, size_t begin, size_t end,
                 rt_reference *references);

#endif
