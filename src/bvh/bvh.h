/* A bounding-volume hierarchy over primitives of all kinds together, flat for the device.
 *
 * Nodes have up to 16 children, whose boxes lie side by side so that one vector operation tests
 * them all. Splits follow the surface-area heuristic (MacDonald and Booth 1990) over binned
 * centroids (Wald 2007). */
#ifndef RT_BVH_BVH_H
#define RT_BVH_BVH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "bvh/blocks.h"
#include "common/status.h"
#include "scene/scene.h"

typedef struct rt_bvh {
    rt_node *nodes; /* owned; nodes[0] is the root, also where there is no primitive */
    size_t node_count;
    rt_blocks blocks;  /* one a leaf */
    size_t stack_size; /* entries that a depth-first walk needs at most */
} rt_bvh;

/* Builds on `threads` threads; the tree does not depend on their number. On failure (memory, or
 * more primitives than leaves can name) nothing is owned. */
bool rt_bvh_build(rt_bvh *bvh, const rt_scene *scene, int threads, rt_status *status);
void rt_bvh_clear(rt_bvh *bvh);

#endif
