#include "bvh/bvh.h"

#include <float.h>
#include <stdlib.h>

#include "bvh/box.h"
#include "bvh/split.h"
#include "common/array.h"
#include "common/parallel.h"

/* Primitives that fit into one node of full leaves. */
#define NODE_PRIMITIVES ((size_t)RT_WIDTH * RT_LEAF_TARGET)

/* What one task builds: a subtree with node indices of its own. */
typedef struct subtree {
    rt_range range;
    rt_node *nodes;
    size_t count, capacity;
    int32_t root; /* child code */
    bool good;
} subtree;

typedef struct builder {
    const rt_scene *scene;
    rt_references references;
    int threads;
    rt_range tops[RT_WIDTH]; /* the root's children */
    rt_range halves[RT_WIDTH][2];
    size_t top_count;
    subtree subtrees[RT_WIDTH];
} builder;

#define CHUNK ((size_t)16384)

static void fill_chunk(void *context, size_t chunk)
{
    builder *b = context;
    rt_references *refs = &b->references;
    const size_t begin = chunk * CHUNK;
    const size_t end = begin + CHUNK < refs->count ? begin + CHUNK : refs->count;
    for (size_t i = begin; i < end; ++i) {
        refs->items[i].primitive = (uint32_t)i;
        refs->items[i].begins_leaf = 0;
    }
    size_t first = 0; /* of the kind */
    for (int k = 0; k < RT_KIND_COUNT; ++k) {
        const size_t last = refs->ends[k];
        const size_t from = begin > first ? begin : first, to = end < last ? end : last;
        if (from < to)
            rt_boxes_of(b->scene, (enum rt_kind)k, from - first, to - first, &refs->items[from]);
        first = last;
    }
}

/* The code of a leaf, with the position among the references in the place of the block. */
static int32_t leaf_code(const builder *b, const rt_range *r)
{
    return RT_LEAF_OF(rt_reference_kind(&b->references, &b->references.items[r->begin]), r->begin);
}

static void clear_node(rt_node *node)
{
    for (int i = 0; i < RT_WIDTH; ++i) {
        node->lo_x[i] = node->lo_y[i] = node->lo_z[i] = FLT_MAX;
        node->hi_x[i] = node->hi_y[i] = node->hi_z[i] = -FLT_MAX;
        node->child[i] = RT_LEAF;
    }
}

static void set_child(rt_node *node, int i, const rt_box *bounds, int32_t child)
{
    node->lo_x[i] = bounds->lo[0];
    node->lo_y[i] = bounds->lo[1];
    node->lo_z[i] = bounds->lo[2];
    node->hi_x[i] = bounds->hi[0];
    node->hi_y[i] = bounds->hi[1];
    node->hi_z[i] = bounds->hi[2];
    node->child[i] = child;
}

/* Opens the range of the largest area again and again, until there are RT_WIDTH or none is left
 * that is worth it. One that fits into a single node of full leaves stays whole, unless it is all
 * there is: opened, it would leave nodes below half empty. */
static int open_ranges(builder *b, rt_range children[RT_WIDTH])
{
    int count = 1;
    bool closed[RT_WIDTH] = {false};
    const size_t whole = children[0].end - children[0].begin;
    const size_t fits = whole > NODE_PRIMITIVES ? NODE_PRIMITIVES : 0;
    while (count < RT_WIDTH) {
        int widest = -1;
        float area = -1.0f;
        for (int i = 0; i < count; ++i) {
            closed[i] = closed[i] || children[i].end - children[i].begin <= fits ||
                        rt_range_is_leaf(&b->references, &children[i]);
            if (!closed[i] && rt_box_half_area(&children[i].bounds) > area) {
                area = rt_box_half_area(&children[i].bounds);
                widest = i;
            }
        }
        if (widest < 0)
            break;
        rt_range sides[2];
        rt_range_split(&b->references, &children[widest], sides);
        children[widest] = sides[0];
        children[count++] = sides[1];
    }
    return count;
}

/* Builds the subtree of a range; returns its child code, or RT_LEAF with s->good false. */
static int32_t build_range(builder *b, subtree *s, const rt_range *r)
{
    if (rt_range_is_leaf(&b->references, r))
        return leaf_code(b, r);
    if (!RT_ARRAY_GROW(s->nodes, s->count, &s->capacity)) {
        s->good = false;
        return RT_LEAF;
    }
    const size_t node = s->count++;
    rt_range children[RT_WIDTH] = {*r};
    const int count = open_ranges(b, children);
    clear_node(&s->nodes[node]);
    for (int i = 0; i < count && s->good; ++i) {
        const int32_t child = build_range(b, s, &children[i]);
        set_child(&s->nodes[node], i, &children[i].bounds, child); /* nodes may have moved */
    }
    return (int32_t)node;
}

static void build_subtree(void *context, size_t i)
{
    builder *b = context;
    subtree *s = &b->subtrees[i];
    s->range = b->tops[i];
    s->good = true;
    s->root = build_range(b, s, &s->range);
}

static void split_top(void *context, size_t i)
{
    builder *b = context;
    rt_range_split(&b->references, &b->tops[i], b->halves[i]);
}

/* The root's children: rounds that split every range there is, so that all threads have work
 * from the second round on. */
static void build_tops(builder *b)
{
    b->tops[0] = rt_range_whole(&b->references);
    b->top_count = b->references.count ? 1 : 0;
    while (b->top_count > 0 && 2 * b->top_count <= RT_WIDTH) {
        for (size_t i = 0; i < b->top_count; ++i)
            if (rt_range_is_leaf(&b->references, &b->tops[i]))
                return;
        rt_parallel(b->top_count, b->threads, split_top, b);
        for (size_t i = b->top_count; i-- > 0;) {
            b->tops[2 * i] = b->halves[i][0];
            b->tops[2 * i + 1] = b->halves[i][1];
        }
        b->top_count *= 2;
    }
}

/* Moves a child code of a subtree to the whole tree's numbering. */
static int32_t relocate(int32_t child, size_t first_node)
{
    return child < 0 ? child : child + (int32_t)first_node;
}

static bool join_subtrees(builder *b, rt_bvh *bvh)
{
    bvh->node_count = 1;
    for (size_t i = 0; i < b->top_count; ++i) {
        if (!b->subtrees[i].good)
            return false;
        bvh->node_count += b->subtrees[i].count;
    }
    bvh->nodes = malloc(bvh->node_count * sizeof *bvh->nodes);
    if (!bvh->nodes)
        return false;
    clear_node(&bvh->nodes[0]);
    size_t first = 1;
    for (size_t i = 0; i < b->top_count; ++i) {
        const subtree *s = &b->subtrees[i];
        set_child(&bvh->nodes[0], (int)i, &s->range.bounds, relocate(s->root, first));
        for (size_t n = 0; n < s->count; ++n) {
            rt_node *node = &bvh->nodes[first + n];
            *node = s->nodes[n];
            for (int c = 0; c < RT_WIDTH; ++c)
                node->child[c] = relocate(node->child[c], first);
        }
        first += s->count;
    }
    return true;
}

static bool is_filled(const rt_node *node, int child)
{
    return node->lo_x[child] <= node->hi_x[child];
}

/* Marks the references at which a leaf begins, and counts the leaves of each kind. */
static void mark_leaves(builder *b, rt_bvh *bvh)
{
    for (size_t n = 0; n < bvh->node_count; ++n)
        for (int c = 0; c < RT_WIDTH; ++c) {
            const int32_t child = bvh->nodes[n].child[c];
            if (child >= 0 || !is_filled(&bvh->nodes[n], c))
                continue;
            b->references.items[RT_LEAF_BLOCK(child)].begins_leaf = 1;
            bvh->blocks.counts[RT_LEAF_KIND(child)]++;
        }
}

/* Gives each leaf a block of its kind in the order of the references, and the leaf's code that
 * block in the place of the position. */
static bool number_blocks(builder *b, rt_bvh *bvh)
{
    uint32_t *block_at = malloc((b->references.count + 1) * sizeof *block_at);
    if (!block_at)
        return false;
    size_t slots[RT_KIND_COUNT]; /* where the kind's next block begins in the order */
    for (int k = 0; k < RT_KIND_COUNT; ++k)
        slots[k] = rt_blocks_slots_before(&bvh->blocks, (enum rt_kind)k);
    uint32_t next[RT_KIND_COUNT] = {0};
    int32_t *place = bvh->blocks.order;
    for (size_t i = 0; i < b->references.count; ++i) {
        const rt_reference *r = &b->references.items[i];
        if (r->begins_leaf) {
            const int kind = rt_reference_kind(&b->references, r);
            block_at[i] = next[kind]++;
            place = bvh->blocks.order + slots[kind];
            slots[kind] += RT_BLOCK_PRIMITIVES;
        }
        *place++ = (int32_t)r->primitive;
    }
    for (size_t n = 0; n < bvh->node_count; ++n)
        for (int c = 0; c < RT_WIDTH; ++c) {
            int32_t *child = &bvh->nodes[n].child[c];
            if (*child < 0 && is_filled(&bvh->nodes[n], c))
                *child = RT_LEAF_OF(RT_LEAF_KIND(*child), block_at[RT_LEAF_BLOCK(*child)]);
        }
    free(block_at);
    return true;
}

/* Entries below a node at most: its own children less the one that is followed, and so on down. */
static size_t stack_need(const rt_bvh *bvh, int32_t node)
{
    size_t children = 0, deepest = 0;
    for (int c = 0; c < RT_WIDTH; ++c) {
        const rt_node *n = &bvh->nodes[node];
        if (!is_filled(n, c))
            continue;
        ++children;
        if (n->child[c] >= 0) {
            const size_t below = stack_need(bvh, n->child[c]);
            deepest = below > deepest ? below : deepest;
        }
    }
    return children + deepest;
}

static bool build(builder *b, rt_bvh *bvh, const rt_scene *scene)
{
    const size_t chunks = (b->references.count + CHUNK - 1) / CHUNK;
    rt_parallel(chunks, b->threads, fill_chunk, b);
    build_tops(b);
    rt_parallel(b->top_count, b->threads, build_subtree, b);
    if (!join_subtrees(b, bvh))
        return false;
    mark_leaves(b, bvh);
    if (!rt_blocks_make(&bvh->blocks) || !number_blocks(b, bvh))
        return false;
    rt_blocks_gather(&bvh->blocks, scene, b->threads);
    bvh->stack_size = stack_need(bvh, 0);
    return true;
}

bool rt_bvh_build(rt_bvh *bvh, const rt_scene *scene, int threads, rt_status *status)
{
    *bvh = (rt_bvh){0};
    const size_t count = rt_scene_primitive_count(scene);
    if (count >= RT_LEAF_BLOCKS)
        return rt_status_fail(status, RT_ERROR_SCENE, "rt: %zu primitives; the tree takes %d",
                              count, RT_LEAF_BLOCKS - 1);
    builder b = {.scene = scene, .references = {.count = count}, .threads = threads};
    for (int k = 0; k < RT_KIND_COUNT; ++k)
        b.references.ends[k] = (uint32_t)rt_scene_primitives_before(scene, (enum rt_kind)(k + 1));
    b.references.items = malloc((count + 1) * sizeof *b.references.items);
    const bool good = b.references.items && build(&b, bvh, scene);
    for (size_t i = 0; i < RT_WIDTH; ++i)
        free(b.subtrees[i].nodes);
    free(b.references.items);
    if (good)
        return true;
    rt_bvh_clear(bvh);
    return rt_status_no_memory(status, "the tree");
}

void rt_bvh_clear(rt_bvh *bvh)
{
    free(bvh->nodes);
    rt_blocks_clear(&bvh->blocks);
    *bvh = (rt_bvh){0};
}
