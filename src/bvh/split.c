#include "bvh/split.h"

#include <float.h>
#include <math.h>
#include <string.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#define BINS_MAX 16
/* Binary splits below which ranges are halved by count: bounds the depth for any input. */
#define DEPTH_OF_HEURISTIC 48

#ifdef __SSE__
#define FOUR_MIN _mm_min_ps
#define FOUR_MAX _mm_max_ps
#else
typedef int four_mask __attribute__((vector_size(16)));

static inline rt_four four_select(four_mask m, rt_four a, rt_four b)
{
    return (rt_four)(((four_mask)a & m) | ((four_mask)b & ~m));
}
#define FOUR_MIN(a, b) four_select((a) < (b), a, b)
#define FOUR_MAX(a, b) four_select((a) > (b), a, b)
#endif

static inline rt_four four_load(const float *p)
{
    rt_four r;
    memcpy(&r, p, sizeof r);
    return r;
}

static rt_box empty_box(void)
{
    return (rt_box){{FLT_MAX, FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX}};
}

static inline void grow(rt_box *b, rt_four lo, rt_four hi)
{
    b->lo = FOUR_MIN(b->lo, lo);
    b->hi = FOUR_MAX(b->hi, hi);
}

static inline rt_four centroid_of(const rt_reference *r)
{
    return four_load(r->lo) + four_load(r->hi);
}

float rt_box_half_area(const rt_box *b)
{
    const float x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
    return x >= 0.0f ? x * y + y * z + z * x : 0.0f;
}

rt_range rt_range_whole(const rt_references *refs)
{
    rt_range r = {0, refs->count, empty_box(), empty_box(), 0};
    for (size_t i = 0; i < refs->count; ++i) {
        const rt_reference *ref = &refs->items[i];
        const rt_four c = centroid_of(ref);
        grow(&r.bounds, four_load(ref->lo), four_load(ref->hi));
        grow(&r.centroids, c, c);
    }
    return r;
}

typedef struct bin {
    rt_box bounds;
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
    float right_cost[BINS_MAX] = {0.0f};
    rt_box swept = empty_box();
    size_t primitives = 0;
    for (int i = count - 1; i > 0; --i) {
        grow(&swept, bins[i].bounds.lo, bins[i].bounds.hi);
        primitives += bins[i].count;
        right_cost[i] = primitives ? rt_box_half_area(&swept) * (float)primitives : INFINITY;
    }
    swept = empty_box();
    primitives = 0;
    for (int i = 1; i < count; ++i) {
        grow(&swept, bins[i - 1].bounds.lo, bins[i - 1].bounds.hi);
        primitives += bins[i - 1].count;
        candidate->cost = rt_box_half_area(&swept) * (float)primitives + right_cost[i];
        candidate->bin = i;
        if (primitives && candidate->cost < best->cost)
            *best = *candidate;
    }
}

/* The cheapest plane of all axes; axis -1 where all centroids are one point. */
static plane find_plane(const rt_references *refs, const rt_range *r)
{
    const int count = bins_for(r->end - r->begin);
    bin bins[3][BINS_MAX];
    float origin[4], scale[4];
    for (int axis = 0; axis < 3; ++axis) {
        const float low = r->centroids.lo[axis], extent = r->centroids.hi[axis] - low;
        origin[axis] = low;
        scale[axis] =
            extent > 0.0f && isfinite((float)count / extent) ? (float)count / extent : 0.0f;
        for (int i = 0; i < count; ++i)
            bins[axis][i] = (bin){empty_box(), 0};
    }
    for (size_t i = r->begin; i < r->end; ++i) {
        const rt_reference *ref = &refs->items[i];
        const rt_four lo = four_load(ref->lo), hi = four_load(ref->hi), c = centroid_of(ref);
        for (int axis = 0; axis < 3; ++axis) {
            bin *chosen = &bins[axis][bin_of(c[axis], origin[axis], scale[axis], count)];
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

static void add_reference(rt_range *side, const rt_reference *r)
{
    const rt_four c = centroid_of(r);
    grow(&side->bounds, four_load(r->lo), four_load(r->hi));
    grow(&side->centroids, c, c);
}

static void swap(rt_reference *a, rt_reference *b)
{
    const rt_reference t = *a;
    *a = *b;
    *b = t;
}

/* Parts a range in place by a test, and takes both sides' bounds on the way. */
#define PARTITION(refs, r, sides, goes_left)                                                       \
    do {                                                                                           \
        size_t low_ = (r)->begin, high_ = (r)->end;                                                \
        while (low_ < high_) {                                                                     \
            const rt_reference *ref = &(refs)->items[low_];                                        \
            if (goes_left) {                                                                       \
                add_reference(&(sides)[0], ref);                                                   \
                ++low_;                                                                            \
            } else {                                                                               \
                add_reference(&(sides)[1], ref);                                                   \
                swap(&(refs)->items[low_], &(refs)->items[--high_]);                               \
            }                                                                                      \
        }                                                                                          \
        (sides)[0].end = (sides)[1].begin = low_;                                                  \
    } while (0)

static void halve(const rt_references *refs, const rt_range *r, rt_range sides[2])
{
    const size_t middle = r->begin + (r->end - r->begin) / 2;
    sides[0].end = sides[1].begin = middle;
    for (size_t i = r->begin; i < r->end; ++i)
        add_reference(&sides[i >= middle], &refs->items[i]);
}

static int least_kind(const rt_references *refs, const rt_range *r)
{
    int least = RT_KIND_COUNT;
    for (size_t i = r->begin; i < r->end; ++i) {
        const int kind = rt_reference_kind(refs, &refs->items[i]);
        least = kind < least ? kind : least;
    }
    return least;
}

void rt_range_split(const rt_references *refs, const rt_range *r, rt_range sides[2])
{
    for (int side = 0; side < 2; ++side)
        sides[side] = (rt_range){r->begin, r->end, empty_box(), empty_box(), r->depth + 1};
    const bool is_small = r->end - r->begin <= RT_LEAF_TARGET;
    plane p = {.axis = -1};
    if (!is_small && r->depth < DEPTH_OF_HEURISTIC)
        p = find_plane(refs, r);
    if (is_small) { /* split for its kinds alone */
        const int kind = least_kind(refs, r);
        PARTITION(refs, r, sides, rt_reference_kind(refs, ref) == kind);
    } else if (p.axis >= 0)
        PARTITION(refs, r, sides,
                  bin_of(ref->lo[p.axis] + ref->hi[p.axis], p.origin, p.scale, p.bins) < p.bin);
    else
        halve(refs, r, sides);
}

static bool is_mixed(const rt_references *refs, const rt_range *r)
{
    for (size_t i = r->begin + 1; i < r->end; ++i)
        if (rt_reference_kind(refs, &refs->items[i]) !=
            rt_reference_kind(refs, &refs->items[r->begin]))
            return true;
    return false;
}

bool rt_range_is_leaf(const rt_references *refs, const rt_range *r)
{
    return r->end - r->begin <= RT_LEAF_TARGET && !is_mixed(refs, r);
}
