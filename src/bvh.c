#include "bvh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "array.h"
#include "parallel.h"

#define LEAF_TARGET RT_BLOCK_PRIMITIVES /* primitives at which a range is split no further */
/* Primitives below which a range is expected to fit into one node. */
#define NODE_PRIMITIVES ((size_t)RT_WIDTH * (LEAF_TARGET - 1))
#define BINS_MAX 16
/* Binary splits below which ranges are halved by count: bounds the depth for any input. */
#define DEPTH_OF_HEURISTIC 48

/* Four floats, of which the last is idle: compilers keep it in one vector register. */
typedef struct four {
    float v[4];
} four;

typedef struct box {
    four lo, hi;
} box;

/* A primitive as the builder sees it. */
typedef struct reference {
    float lo[3];
    uint32_t primitive;
    float hi[3];
    uint32_t begins_leaf; /* set when the tree is done */
} reference;

/* References that one subtree is made of. */
typedef struct range {
    size_t begin, end;
    box bounds, centroids; /* centroids are lo + hi, twice the middle */
    int depth;             /* binary splits above */
} range;

/* What one task builds: a subtree with node indices of its own. */
typedef struct subtree {
    range range;
    rt_node *nodes;
    size_t count, capacity;
    int32_t root; /* child code */
    bool good;
} subtree;

typedef struct builder {
    const rt_scene *scene;
    reference *references;
    size_t count;
    int threads;
    range tops[RT_WIDTH]; /* the root's children */
    range halves[RT_WIDTH][2];
    size_t top_count;
    subtree subtrees[RT_WIDTH];
} builder;

static inline four four_min(four a, four b)
{
    four r;
    for (int i = 0; i < 4; ++i)
        r.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i];
    return r;
}

static inline four four_max(four a, four b)
{
    four r;
    for (int i = 0; i < 4; ++i)
        r.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    return r;
}

static inline four four_load(const float *p)
{
    four r;
    memcpy(r.v, p, sizeof r.v);
    return r;
}

static box empty_box(void)
{
    box b;
    for (int i = 0; i < 4; ++i) {
        b.lo.v[i] = FLT_MAX;
        b.hi.v[i] = -FLT_MAX;
    }
    return b;
}

static inline void grow(box *b, four lo, four hi)
{
    b->lo = four_min(b->lo, lo);
    b->hi = four_max(b->hi, hi);
}

static inline four centroid_of(const reference *r)
{
    const four lo = four_load(r->lo), hi = four_load(r->hi);
    four c;
    for (int i = 0; i < 4; ++i)
        c.v[i] = lo.v[i] + hi.v[i];
    return c;
}

/* Half the surface area; 0 for an empty box. */
static float half_area(const box *b)
{
    const float x = b->hi.v[0] - b->lo.v[0], y = b->hi.v[1] - b->lo.v[1],
                z = b->hi.v[2] - b->lo.v[2];
    return x >= 0.0f ? x * y + y * z + z * x : 0.0f;
}

static bool is_sphere(const builder *b, const reference *r)
{
    return r->primitive < b->scene->sphere_count;
}

static inline void widen(float *lo, float *hi)
{
    const float margin = (fabsf(*lo) + fabsf(*hi)) * RT_BOX_MARGIN;
    *lo -= margin;
    *hi += margin;
}

void rt_sphere_box(const rt_sphere *s, float lo[3], float hi[3])
{
    const float c[3] = {s->cx, s->cy, s->cz};
    for (int i = 0; i < 3; ++i) {
        lo[i] = c[i] - s->radius;
        hi[i] = c[i] + s->radius;
        widen(&lo[i], &hi[i]);
    }
}

void rt_triangle_box(const rt_triangle *t, float lo[3], float hi[3])
{
    const float a[3] = {t->ax, t->ay, t->az}, b[3] = {t->bx, t->by, t->bz},
                c[3] = {t->cx, t->cy, t->cz};
    for (int i = 0; i < 3; ++i) {
        const float low = a[i] < b[i] ? a[i] : b[i], high = a[i] > b[i] ? a[i] : b[i];
        lo[i] = low < c[i] ? low : c[i];
        hi[i] = high > c[i] ? high : c[i];
        widen(&lo[i], &hi[i]);
    }
}

#define CHUNK ((size_t)16384)

static void fill_chunk(void *context, size_t chunk)
{
    builder *b = context;
    const rt_scene *scene = b->scene;
    const size_t end = (chunk + 1) * CHUNK < b->count ? (chunk + 1) * CHUNK : b->count;
    for (size_t i = chunk * CHUNK; i < end; ++i) {
        reference *r = &b->references[i];
        r->primitive = (uint32_t)i;
        r->begins_leaf = 0;
        if (i < scene->sphere_count)
            rt_sphere_box(&scene->spheres[i], r->lo, r->hi);
        else
            rt_triangle_box(&scene->triangles[i - scene->sphere_count], r->lo, r->hi);
    }
}

static range whole_range(const builder *b)
{
    range r = {0, b->count, empty_box(), empty_box(), 0};
    for (size_t i = 0; i < b->count; ++i) {
        const reference *ref = &b->references[i];
        const four c = centroid_of(ref);
        grow(&r.bounds, four_load(ref->lo), four_load(ref->hi));
        grow(&r.centroids, c, c);
    }
    return r;
}

typedef struct bin {
    box bounds;
    size_t count;
} bin;

/* A plane that a range is split by: bins below `bin` of `bins` along `axis` go to the left. */
typedef struct plane {
    int axis, bin, bins;
    float cost;
    float origin, scale; /* bin = (centroid - origin) * scale */
} plane;

static inline int bin_of(float centroid, float origin, float scale, int bins)
{
    const int index = (int)((centroid - origin) * scale);
    return index < bins ? index : bins - 1;
}

/* Few bins for small ranges: there the sweep costs more than it finds. */
static int bins_for(size_t count)
{
    return count > 512 ? BINS_MAX : count > 48 ? 8 : 4;
}

/* The cheapest plane along one axis. */
static void sweep(const bin *bins, int count, plane *candidate, plane *best)
{
    float right_cost[BINS_MAX];
    box swept = empty_box();
    size_t primitives = 0;
    for (int i = count - 1; i > 0; --i) {
        grow(&swept, bins[i].bounds.lo, bins[i].bounds.hi);
        primitives += bins[i].count;
        right_cost[i] = primitives ? half_area(&swept) * (float)primitives : INFINITY;
    }
    swept = empty_box();
    primitives = 0;
    for (int i = 1; i < count; ++i) {
        grow(&swept, bins[i - 1].bounds.lo, bins[i - 1].bounds.hi);
        primitives += bins[i - 1].count;
        candidate->cost = half_area(&swept) * (float)primitives + right_cost[i];
        candidate->bin = i;
        if (primitives && candidate->cost < best->cost)
            *best = *candidate;
    }
}

/* The cheapest plane of all axes; axis -1 where all centroids are one point. */
static plane find_plane(const builder *b, const range *r)
{
    const int count = bins_for(r->end - r->begin);
    bin bins[3][BINS_MAX];
    float origin[4], scale[4];
    for (int axis = 0; axis < 3; ++axis) {
        const float low = r->centroids.lo.v[axis], extent = r->centroids.hi.v[axis] - low;
        origin[axis] = low;
        scale[axis] =
            extent > 0.0f && isfinite((float)count / extent) ? (float)count / extent : 0.0f;
        for (int i = 0; i < count; ++i)
            bins[axis][i] = (bin){empty_box(), 0};
    }
    for (size_t i = r->begin; i < r->end; ++i) {
        const reference *ref = &b->references[i];
        const four lo = four_load(ref->lo), hi = four_load(ref->hi), c = centroid_of(ref);
        for (int axis = 0; axis < 3; ++axis) {
            bin *chosen = &bins[axis][bin_of(c.v[axis], origin[axis], scale[axis], count)];
            grow(&chosen->bounds, lo, hi);
            chosen->count++;
        }
    }
    plane best = {.axis = -1, .cost = INFINITY};
    for (int axis = 0; axis < 3; ++axis) {
        plane candidate = {axis, 0, count, INFINITY, origin[axis], scale[axis]};
        if (scale[axis] > 0.0f)
            sweep(bins[axis], count, &candidate, &best);
    }
    return best;
}

static void add_reference(range *side, const reference *r)
{
    const four c = centroid_of(r);
    grow(&side->bounds, four_load(r->lo), four_load(r->hi));
    grow(&side->centroids, c, c);
}

static void swap(reference *a, reference *b)
{
    const reference t = *a;
    *a = *b;
    *b = t;
}

/* Parts a range in place by a test, and takes both sides' bounds on the way. */
#define PARTITION(b, r, sides, goes_left)                                                          \
    do {                                                                                           \
        size_t low_ = (r)->begin, high_ = (r)->end;                                                \
        while (low_ < high_) {                                                                     \
            const reference *ref = &(b)->references[low_];                                         \
            if (goes_left) {                                                                       \
                add_reference(&(sides)[0], ref);                                                   \
                ++low_;                                                                            \
            } else {                                                                               \
                add_reference(&(sides)[1], ref);                                                   \
                swap(&(b)->references[low_], &(b)->references[--high_]);                           \
            }                                                                                      \
        }                                                                                          \
        (sides)[0].end = (sides)[1].begin = low_;                                                  \
    } while (0)

static void halve(builder *b, const range *r, range sides[2])
{
    const size_t middle = r->begin + (r->end - r->begin) / 2;
    sides[0].end = sides[1].begin = middle;
    for (size_t i = r->begin; i < r->end; ++i)
        add_reference(&sides[i >= middle], &b->references[i]);
}

/* Splits a range that has more than one reference into two that are not empty. */
static void split(builder *b, const range *r, range sides[2])
{
    for (int side = 0; side < 2; ++side)
        sides[side] = (range){r->begin, r->end, empty_box(), empty_box(), r->depth + 1};
    const bool is_small = r->end - r->begin <= LEAF_TARGET;
    const plane p =
        is_small || r->depth >= DEPTH_OF_HEURISTIC ? (plane){.axis = -1} : find_plane(b, r);
    if (is_small) /* split for its two kinds alone */
        PARTITION(b, r, sides, is_sphere(b, ref));
    else if (p.axis >= 0)
        PARTITION(b, r, sides,
                  bin_of(ref->lo[p.axis] + ref->hi[p.axis], p.origin, p.scale, p.bins) < p.bin);
    else
        halve(b, r, sides);
}

static bool is_mixed(const builder *b, const range *r)
{
    for (size_t i = r->begin + 1; i < r->end; ++i)
        if (is_sphere(b, &b->references[i]) != is_sphere(b, &b->references[r->begin]))
            return true;
    return false;
}

static bool is_leaf(const builder *b, const range *r)
{
    return r->end - r->begin <= LEAF_TARGET && !is_mixed(b, r);
}

/* The code of a leaf, with the position among the references in the place of the block. */
static int32_t leaf_code(const builder *b, const range *r)
{
    const uint32_t kind = is_sphere(b, &b->references[r->begin]) ? RT_LEAF_SPHERES : 0U;
    return (int32_t)((uint32_t)RT_LEAF | kind | (uint32_t)r->begin);
}

static void clear_node(rt_node *node)
{
    for (int i = 0; i < RT_WIDTH; ++i) {
        node->lo_x[i] = node->lo_y[i] = node->lo_z[i] = FLT_MAX;
        node->hi_x[i] = node->hi_y[i] = node->hi_z[i] = -FLT_MAX;
        node->child[i] = RT_LEAF;
    }
}

static void set_child(rt_node *node, int i, const box *bounds, int32_t child)
{
    node->lo_x[i] = bounds->lo.v[0];
    node->lo_y[i] = bounds->lo.v[1];
    node->lo_z[i] = bounds->lo.v[2];
    node->hi_x[i] = bounds->hi.v[0];
    node->hi_y[i] = bounds->hi.v[1];
    node->hi_z[i] = bounds->hi.v[2];
    node->child[i] = child;
}

/* Opens the range of the largest area again and again, until there are RT_WIDTH or none is left
 * that is worth it. One that fits into a single node of full leaves stays whole, unless it is all
 * there is: opened, it would leave nodes below half empty. */
static int open_ranges(builder *b, range children[RT_WIDTH])
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
                        is_leaf(b, &children[i]);
            if (!closed[i] && half_area(&children[i].bounds) > area) {
                area = half_area(&children[i].bounds);
                widest = i;
            }
        }
        if (widest < 0)
            break;
        range sides[2];
        split(b, &children[widest], sides);
        children[widest] = sides[0];
        children[count++] = sides[1];
    }
    return count;
}

/* Builds the subtree of a range; returns its child code, or RT_LEAF with s->good false. */
static int32_t build_range(builder *b, subtree *s, const range *r)
{
    if (is_leaf(b, r))
        return leaf_code(b, r);
    if (!RT_ARRAY_GROW(s->nodes, s->count, &s->capacity)) {
        s->good = false;
        return RT_LEAF;
    }
    const size_t node = s->count++;
    range children[RT_WIDTH] = {*r};
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
    split(b, &b->tops[i], b->halves[i]);
}

/* The root's children: rounds that split every range there is, so that all threads have work from
 * the second round on. */
static void build_tops(builder *b)
{
    b->tops[0] = whole_range(b);
    b->top_count = b->count ? 1 : 0;
    while (b->top_count > 0 && 2 * b->top_count <= RT_WIDTH) {
        for (size_t i = 0; i < b->top_count; ++i)
            if (is_leaf(b, &b->tops[i]))
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
            b->references[(uint32_t)child & (RT_LEAF_SPHERES - 1U)].begins_leaf = 1;
            if (child & RT_LEAF_SPHERES)
                bvh->blocks.sphere_blocks++;
            else
                bvh->blocks.triangle_blocks++;
        }
}

/* Gives each leaf a block of its kind in the order of the references, and the leaf's code that
 * block in the place of the position. */
static bool number_blocks(builder *b, rt_bvh *bvh)
{
    uint32_t *block_at = malloc((b->count + 1) * sizeof *block_at);
    if (!block_at)
        return false;
    uint32_t next[2] = {0, 0}, place = 0;
    const size_t triangle_slots = bvh->blocks.sphere_blocks * RT_BLOCK_PRIMITIVES;
    for (size_t i = 0; i < b->count; ++i) {
        const reference *r = &b->references[i];
        const bool sphere = is_sphere(b, r);
        if (r->begins_leaf) {
            block_at[i] = next[sphere]++;
            place = 0;
        }
        const size_t slot = (size_t)(next[sphere] - 1) * RT_BLOCK_PRIMITIVES + place++;
        bvh->blocks.order[slot + (sphere ? 0 : triangle_slots)] = (int32_t)r->primitive;
    }
    for (size_t n = 0; n < bvh->node_count; ++n)
        for (int c = 0; c < RT_WIDTH; ++c) {
            int32_t *child = &bvh->nodes[n].child[c];
            const uint32_t position = (uint32_t)*child & (RT_LEAF_SPHERES - 1U);
            if (*child < 0 && is_filled(&bvh->nodes[n], c))
                *child =
                    (int32_t)(((uint32_t)*child & ~(RT_LEAF_SPHERES - 1U)) | block_at[position]);
        }
    free(block_at);
    return true;
}

/* Memory for the counted blocks, all places unfilled. */
static bool make_blocks(rt_blocks *blocks)
{
    const size_t slots = (blocks->sphere_blocks + blocks->triangle_blocks) * RT_BLOCK_PRIMITIVES;
    blocks->spheres = calloc(blocks->sphere_blocks + 1, sizeof *blocks->spheres);
    blocks->triangles = calloc(blocks->triangle_blocks + 1, sizeof *blocks->triangles);
    blocks->order = malloc((slots + 1) * sizeof *blocks->order);
    if (!blocks->spheres || !blocks->triangles || !blocks->order)
        return false;
    memset(blocks->order, 0xff, (slots + 1) * sizeof *blocks->order); /* -1 */
    return true;
}

typedef struct gathering {
    const rt_scene *scene;
    rt_blocks *blocks;
} gathering;

static void gather_sphere(rt_sphere_block *block, size_t place, const rt_sphere *sphere)
{
    block->cx[place] = sphere->cx;
    block->cy[place] = sphere->cy;
    block->cz[place] = sphere->cz;
    block->radius[place] = sphere->radius;
}

static void gather_triangle(rt_triangle_block *block, size_t place, const rt_triangle *triangle)
{
    block->ax[place] = triangle->ax;
    block->ay[place] = triangle->ay;
    block->az[place] = triangle->az;
    block->bx[place] = triangle->bx;
    block->by[place] = triangle->by;
    block->bz[place] = triangle->bz;
    block->cx[place] = triangle->cx;
    block->cy[place] = triangle->cy;
    block->cz[place] = triangle->cz;
}

static void gather_chunk(void *context, size_t chunk)
{
    const gathering *g = context;
    rt_blocks *blocks = g->blocks;
    const size_t sphere_slots = blocks->sphere_blocks * RT_BLOCK_PRIMITIVES;
    const size_t slots = sphere_slots + blocks->triangle_blocks * RT_BLOCK_PRIMITIVES;
    const size_t end = (chunk + 1) * CHUNK < slots ? (chunk + 1) * CHUNK : slots;
    for (size_t i = chunk * CHUNK; i < end; ++i) {
        const int32_t primitive = blocks->order[i];
        const size_t slot = i < sphere_slots ? i : i - sphere_slots;
        const size_t block = slot / RT_BLOCK_PRIMITIVES, place = slot % RT_BLOCK_PRIMITIVES;
        if (primitive < 0)
            continue;
        if (i < sphere_slots)
            gather_sphere(&blocks->spheres[block], place, &g->scene->spheres[primitive]);
        else
            gather_triangle(&blocks->triangles[block], place,
                            &g->scene->triangles[(size_t)primitive - g->scene->sphere_count]);
    }
}

/* Copies the primitives to where the order has them. */
static void gather(rt_blocks *blocks, const rt_scene *scene, int threads)
{
    gathering g = {scene, blocks};
    const size_t slots = (blocks->sphere_blocks + blocks->triangle_blocks) * RT_BLOCK_PRIMITIVES;
    rt_parallel((slots + CHUNK - 1) / CHUNK, threads, gather_chunk, &g);
}

static size_t blocks_for(size_t primitives)
{
    return (primitives + RT_BLOCK_PRIMITIVES - 1) / RT_BLOCK_PRIMITIVES;
}

bool rt_blocks_in_order(rt_blocks *blocks, const rt_scene *scene, rt_status *status)
{
    *blocks = (rt_blocks){.sphere_blocks = blocks_for(scene->sphere_count),
                          .triangle_blocks = blocks_for(scene->triangle_count)};
    if (!make_blocks(blocks)) {
        rt_blocks_clear(blocks);
        return rt_status_no_memory(status, "the scene");
    }
    for (size_t i = 0; i < scene->sphere_count; ++i)
        blocks->order[i] = (int32_t)i;
    for (size_t i = 0; i < scene->triangle_count; ++i)
        blocks->order[blocks->sphere_blocks * RT_BLOCK_PRIMITIVES + i] =
            (int32_t)(scene->sphere_count + i);
    gather(blocks, scene, 1);
    return true;
}

void rt_blocks_clear(rt_blocks *blocks)
{
    free(blocks->spheres);
    free(blocks->triangles);
    free(blocks->order);
    *blocks = (rt_blocks){0};
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
    const size_t chunks = (b->count + CHUNK - 1) / CHUNK;
    rt_parallel(chunks, b->threads, fill_chunk, b);
    build_tops(b);
    rt_parallel(b->top_count, b->threads, build_subtree, b);
    if (!join_subtrees(b, bvh))
        return false;
    mark_leaves(b, bvh);
    if (!make_blocks(&bvh->blocks) || !number_blocks(b, bvh))
        return false;
    gather(&bvh->blocks, scene, b->threads);
    bvh->stack_size = stack_need(bvh, 0);
    return true;
}

bool rt_bvh_build(rt_bvh *bvh, const rt_scene *scene, int threads, rt_status *status)
{
    *bvh = (rt_bvh){0};
    builder b = {
        .scene = scene, .count = scene->sphere_count + scene->triangle_count, .threads = threads};
    if (b.count >= RT_LEAF_SPHERES)
        return rt_status_fail(status, RT_ERROR_SCENE, "rt: %zu primitives; the tree takes %d",
                              b.count, RT_LEAF_SPHERES - 1);
    b.references = malloc((b.count + 1) * sizeof *b.references);
    const bool good = b.references && build(&b, bvh, scene);
    for (size_t i = 0; i < RT_WIDTH; ++i)
        free(b.subtrees[i].nodes);
    free(b.references);
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
