/* From rays to their nearest hits over all primitives. With or without a tree the result is the
 * same to the bit (kernels/intersect.cl says why), so that this is the only file that knows of one.
 *
 * A work-item walks the tree with a packet of RT_PACKET rays. At a node the lanes are its children:
 * one interval test holds all 16 boxes against what all rays of the packet have in common, the
 * least and the greatest of their origins and reciprocal directions. A child that passes is tested
 * again when its turn comes, then against each ray. In leaves the lanes are rays. */

#define RT_GROUPS (RT_PACKET / RT_LANES)

typedef struct packet {
    rays r[RT_GROUPS];
    hits h[RT_GROUPS];
} packet;

#if RT_SPHERES
INLINE int offer_spheres(packet *p, int groups, __global const rt_sphere *spheres,
                         __global const int *order, int first, int count)
{
    int changed = 0;
    for (int i = first; i < first + count; ++i) {
        const rt_sphere sphere = spheres[i];
        for (int g = 0; g < RT_GROUPS; ++g)
            if (groups >> g & 1)
                changed |= hit_sphere(&p->r[g], &p->h[g], sphere, order[i], i);
    }
    return changed;
}
#endif

#if RT_TRIANGLES
INLINE int offer_triangles(packet *p, int groups, __global const rt_triangle *triangles,
                           __global const int *order, int sphere_count, int first, int count)
{
    int changed = 0;
    for (int i = first; i < first + count; ++i) {
        const rt_triangle triangle = triangles[i];
        for (int g = 0; g < RT_GROUPS; ++g)
            if (groups >> g & 1)
                changed |= hit_triangle(&p->r[g], &p->h[g], triangle, order[sphere_count + i], i);
    }
    return changed;
}
#endif

#if !RT_TREE
INLINE void closest_hits(packet *p, __global const rt_node *nodes, __global const int *order,
                         __global const rt_sphere *spheres, int sphere_count,
                         __global const rt_triangle *triangles, int triangle_count)
{
#if RT_SPHERES
    offer_spheres(p, -1, spheres, order, 0, sphere_count);
#endif
#if RT_TRIANGLES
    offer_triangles(p, -1, triangles, order, sphere_count, 0, triangle_count);
#endif
}
#else

/* What the rays of a packet have in common along one axis. The axis is mirrored where the rays go
 * down it, so that they all go up. */
typedef struct bundle_axis {
    float first, last;      /* least and greatest origin */
    float slowest, fastest; /* least and greatest reciprocal direction */
    int mirrored;
    int mixed; /* some go up and some down: the axis tells nothing */
} bundle_axis;

typedef struct bundle {
    bundle_axis x, y, z;
    float tmin, tmax; /* least tmin, greatest t that is still of interest; tmin > tmax: no ray */
} bundle;

#if RT_LANES == 1
#define LEAST(v) (v)
#define MOST(v) (v)
#else
INLINE float least4(float4 v)
{
    const float2 half_ = LESSER_N(v.lo, v.hi);
    return LESSER_1(half_.x, half_.y);
}
INLINE float most4(float4 v)
{
    const float2 half_ = GREATER_N(v.lo, v.hi);
    return GREATER_1(half_.x, half_.y);
}
INLINE float least8(float8 v)
{
    return least4(LESSER_N(v.lo, v.hi));
}
INLINE float most8(float8 v)
{
    return most4(GREATER_N(v.lo, v.hi));
}
INLINE float least16(float16 v)
{
    return least8(LESSER_N(v.lo, v.hi));
}
INLINE float most16(float16 v)
{
    return most8(GREATER_N(v.lo, v.hi));
}
#define LEAST(v) RT_PASTE(least, RT_LANES)(v)
#define MOST(v) RT_PASTE(most, RT_LANES)(v)
#endif

/* Lanes whose rays can still hit anything: a dead ray must not widen the bundle. */
INLINE mask alive(const rays *r, const hits *h)
{
    return MASK(h->t > r->tmin);
}

/* One axis of the bundle from the groups' origins and inverses; dead lanes are passed over. */
#define BUNDLE_AXIS(p, axis, out)                                                                  \
    do {                                                                                           \
        real low_o = (real)FLT_MAX, high_o = (real)-FLT_MAX;                                       \
        real low_i = (real)FLT_MAX, high_i = (real)-FLT_MAX;                                       \
        for (int g = 0; g < RT_GROUPS; ++g) {                                                      \
            const mask on = alive(&(p)->r[g], &(p)->h[g]);                                         \
            const real o = (p)->r[g].origin.axis, i = (p)->r[g].inverse.axis;                      \
            low_o = SELECT(low_o, LESSER(o, low_o), on);                                           \
            high_o = SELECT(high_o, GREATER(o, high_o), on);                                       \
            low_i = SELECT(low_i, LESSER(i, low_i), on);                                           \
            high_i = SELECT(high_i, GREATER(i, high_i), on);                                       \
        }                                                                                          \
        const float o0 = LEAST(low_o), o1 = MOST(high_o);                                          \
        const float i0 = LEAST(low_i), i1 = MOST(high_i);                                          \
        (out)->mirrored = i1 < 0.0f;                                                               \
        (out)->mixed = i0 < 0.0f && i1 > 0.0f;                                                     \
        (out)->first = i1 < 0.0f ? -o1 : o0;                                                       \
        (out)->last = i1 < 0.0f ? -o0 : o1;                                                        \
        (out)->slowest = i1 < 0.0f ? -i1 : i0;                                                     \
        (out)->fastest = i1 < 0.0f ? -i0 : i1;                                                     \
    } while (0)

/* The greatest t that is still of interest to some ray; -infinity without one. */
INLINE float farthest(const packet *p)
{
    real high = (real)-INFINITY;
    for (int g = 0; g < RT_GROUPS; ++g)
        high = SELECT(high, GREATER(p->h[g].t, high), alive(&p->r[g], &p->h[g]));
    return MOST(high);
}

INLINE float least_tmin(const packet *p)
{
    real low = (real)INFINITY;
    for (int g = 0; g < RT_GROUPS; ++g)
        low = SELECT(low, LESSER(p->r[g].tmin, low), alive(&p->r[g], &p->h[g]));
    return LEAST(low);
}

/* Narrows [enter, leave] of 16 boxes by one axis. For each ray of the bundle its own interval, as
 * box_interval computes it, lies within: every operation rounds monotonely. */
INLINE void narrow(const bundle_axis *a, __global const float *lo, __global const float *hi,
                   float16 *enter, float16 *leave)
{
    if (a->mixed)
        return;
    float16 near = vload16(0, a->mirrored ? hi : lo);
    float16 far = vload16(0, a->mirrored ? lo : hi);
    near = (a->mirrored ? -near : near) - a->last;
    far = (a->mirrored ? -far : far) - a->first;
    near = near * select((float16)a->slowest, (float16)a->fastest, near < 0.0f);
    far = far * select((float16)a->fastest, (float16)a->slowest, far < 0.0f);
    *enter = select(*enter, near, near > *enter);
    *leave = select(*leave, far, far < *leave);
}

/* The lanes of a 16-lane mask as bits, lane 0 lowest. */
INLINE int bits_of(int16 m)
{
    const int16 weights = {1,   2,   4,    8,    16,   32,   64,    128,
                           256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
    return lanes_or16(m & weights);
}

/* Groups of which some ray meets the box of a node's child in time. */
INLINE int groups_in_box(const packet *p, __global const rt_node *n, int c)
{
    int groups = 0;
    for (int g = 0; g < RT_GROUPS; ++g) {
        real enter, leave;
        const rays *r = &p->r[g];
        box_interval(r, n->lo_x[c], n->hi_x[c], n->lo_y[c], n->hi_y[c], n->lo_z[c], n->hi_z[c],
                     &enter, &leave);
        const mask on = alive(r, &p->h[g]) & MASK(enter <= leave) & MASK(leave >= r->tmin) &
                        MASK(enter <= p->h[g].t);
        groups |= ANY(on) ? 1 << g : 0;
    }
    return groups;
}

INLINE void closest_hits(packet *p, __global const rt_node *nodes, __global const int *order,
                         __global const rt_sphere *spheres, int sphere_count,
                         __global const rt_triangle *triangles, int triangle_count)
{
    int node_of[RT_STACK]; /* parent * RT_WIDTH + child */
    float enter_of[RT_STACK];
    int top = 0;
    bundle b;
    BUNDLE_AXIS(p, x, &b.x);
    BUNDLE_AXIS(p, y, &b.y);
    BUNDLE_AXIS(p, z, &b.z);
    b.tmin = least_tmin(p);
    b.tmax = farthest(p);
    int node = b.tmin <= b.tmax ? 0 : -1;
    while (node >= 0) {
        __global const rt_node *n = nodes + node;
        float16 enter = (float16)b.tmin, leave = (float16)b.tmax;
        narrow(&b.x, n->lo_x, n->hi_x, &enter, &leave);
        narrow(&b.y, n->lo_y, n->hi_y, &enter, &leave);
        narrow(&b.z, n->lo_z, n->hi_z, &enter, &leave);
        /* The margin of box_interval, and empty boxes out. */
        const int16 meets =
            enter <= leave * RT_SLAB_MARGIN & vload16(0, n->lo_x) <= vload16(0, n->hi_x);
        float nearest[RT_WIDTH];
        vstore16(enter, 0, nearest);
        const int bottom = top;
        for (int left = bits_of(meets); left; left &= left - 1) {
            const int c = popcount((left & -left) - 1);
            /* Insertion keeps the nearest of these children on top. */
            int at = top++;
            for (; at > bottom && enter_of[at - 1] < nearest[c]; --at) {
                enter_of[at] = enter_of[at - 1];
                node_of[at] = node_of[at - 1];
            }
            enter_of[at] = nearest[c];
            node_of[at] = node * RT_WIDTH + c;
        }
        node = -1;
        while (top > 0 && node < 0) {
            --top;
            if (!(enter_of[top] <= b.tmax))
                continue;
            const int c = node_of[top] % RT_WIDTH;
            __global const rt_node *parent = nodes + node_of[top] / RT_WIDTH;
            const int groups = groups_in_box(p, parent, c);
            const int child = parent->child[c];
            if (groups == 0)
                continue;
            if (child >= 0) {
                node = child;
                continue;
            }
            const int first = child & (RT_LEAF_SLOTS - 1);
            const int count = (child >> RT_LEAF_COUNT_SHIFT & (RT_LEAF_COUNT_MAX - 1)) + 1;
            int changed;
#if RT_SPHERES && RT_TRIANGLES
            if (child & RT_LEAF_SPHERES)
                changed = offer_spheres(p, groups, spheres, order, first, count);
            else
                changed = offer_triangles(p, groups, triangles, order, sphere_count, first, count);
#elif RT_SPHERES
            changed = offer_spheres(p, groups, spheres, order, first, count);
#else
            changed = offer_triangles(p, groups, triangles, order, sphere_count, first, count);
#endif
            if (changed)
                b.tmax = farthest(p);
        }
    }
}
#endif
