/* Primitives in the blocks of kernels/primitives/kinds.h, as they go to a device. */
#ifndef RT_BVH_BLOCKS_H
#define RT_BVH_BLOCKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/status.h"
#include "scene/scene.h"

/* Each array has at its end what kinds.h asks for beyond the counts given here. */
typedef struct rt_blocks {
    void *kinds[RT_KIND_COUNT]; /* owned: rt_sphere_block, rt_triangle_block, ... */
    size_t counts[RT_KIND_COUNT];
    int32_t *order; /* owned: the primitive of each slot, kind after kind; -1 for a place that is
                       not filled */
} rt_blocks;

/* Slots of all kinds before one, those that are not filled included. */
size_t rt_blocks_slots_before(const rt_blocks *blocks, enum rt_kind kind);
/* Slots of all kinds. */
size_t rt_blocks_slots(const rt_blocks *blocks);

/* Makes room for blocks->counts, with every place unfilled. False without memory; what there is
 * then is the caller's to clear. */
bool rt_blocks_make(rt_blocks *blocks);

/* Copies the scene's primitives to where the order has them. */
void rt_blocks_gather(rt_blocks *blocks, const rt_scene *scene, int threads);

/* The scene's primitives in blocks in their own order, for a walk without a tree. On failure
 * nothing is owned. */
bool rt_blocks_in_order(rt_blocks *blocks, const rt_scene *scene, rt_status *status);
void rt_blocks_clear(rt_blocks *blocks);

#endif
