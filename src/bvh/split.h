/* How the tree's builder splits: primitives as boxes, ranges of them, and the plane that the
 * surface-area heuristic finds cheapest. */
#ifndef RT_BVH_SPLIT_H
#define RT_BVH_SPLIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/primitives/kinds.h"
#include "kernels/layout.h"

/* Primitives at which a range is split no further: what a leaf's block holds. */
#define RT_LEAF_TARGET RT_BLOCK_PRIMITIVES

/* Four floats in one register, of which the last is idle (an extension of gcc and clang). */
typedef float rt_four __attribute__((vector_size(16)));

typedef struct rt_box {
    rt_four lo, hi;
} rt_box;

/* A primitive as the builder sees it. */
typedef struct rt_reference {
    float lo[3];
    uint32_t primitive;
    float hi[3];
    uint32_t begins_leaf; /* set when the tree is done */
} rt_reference;

/* References that one subtree is made of. */
typedef struct rt_range {
    size_t begin, end;
    rt_box bounds, centroids; /* centroids are lo + hi, twice the middle */
    int depth;                /* binary splits above */
} rt_range;

typedef struct rt_references {
    rt_reference *items; /* owned by the builder */
    size_t count;
    uint32_t ends[RT_KIND_COUNT]; /* primitives below are of that kind or of one before */
} rt_references;

/* All references, with their bounds. */
rt_range rt_range_whole(const rt_references *refs);

/* Whether a range can be a leaf: few enough, and of one kind. */
bool rt_range_is_leaf(const rt_references *refs, const rt_range *range);

/* Splits a range that is no leaf into two that are not empty; its references change places. */
void rt_range_split(const rt_references *refs, const rt_range *range, rt_range sides[2]);

static inline int rt_reference_kind(const rt_references *refs, const rt_reference *reference)
{
    int kind = 0;
    for (int k = 0; k < RT_KIND_COUNT - 1; ++k)
        kind += reference->primitive >= refs->ends[k];
    return kind;
}

/* Half the surface area; 0 for an empty box. */
float rt_box_half_area(const rt_box *box);

#endif
