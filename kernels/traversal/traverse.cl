/* From rays to their hits over all primitives. With or without a tree, together or one by one, the
 * result is the same to the bit (kernels/primitives/intersect.cl says why), so that this is the
 * only file that knows of trees.
 *
 * Rays that go together walk as a packet. At a node the lanes are its children: one interval test
 * holds all 16 boxes against what all rays of the packet have in common, the least and the greatest
 * of their origins and reciprocal directions. A child that passes is tested again when its turn
 * comes, then against each ray. In leaves the lanes are rays. Rays that go apart walk one by one:
 * there the lanes are a node's children or a leaf's primitives all the way. */

#if !RT_TREE
INLINE void walk(packet *p, const world *w, const int any)
{
#define OFFER_ALL(name, names, NAMES)                                                              \
    RT_WHERE(NAMES, for (int block = 0; block < w->name##_blocks; ++block)                         \
                        offer_##names(p, -1, w, block, any);)
    RT_KINDS(OFFER_ALL)
}
#else

/* Offers a leaf's block to the groups whose bits are set. Returns whether one took something. */
INLINE int offer_block(packet *p, int groups, const world *w, int kind, int block, const int any)
{
#define OFFER(name, names, NAMES)                                                                  \
    RT_WHERE(NAMES, if (RT_IS_OF(NAMES, kind)) return offer_##names(p, groups, w, block, any);)
    RT_KINDS(OFFER)
    return 0;
}

/* What the rays of a packet have in common along one axis. The axis is mirrored where the rays go
 * down it, so that they all go up. */
typedef struct bundle_axis {
    number first, last;      /* least and greatest origin */
    number slowest, fastest; /* least and greatest reciprocal direction */
    int mirrored;
    int mixed; /* some go up and some down: the axis tells nothing */
} bundle_axis;

typedef struct bundle {
    bundle_axis x, y, z;
    number tmin, tmax; /* least tmin, greatest t that is still of interest; tmin > tmax: no ray */
} bundle;

/* One axis of the bundle from the groups' origins and inverses. Dead lanes are passed over: they
 * would widen it. */
#define BUNDLE_AXIS(p, axis, out)                                                                  \
    do {                                                                                           \
        real low_o = (real)NUMBER_MAX, high_o = (real)-NUMBER_MAX;                                 \
        real low_i = (real)NUMBER_MAX, high_i = (real)-NUMBER_MAX;                                 \
        for (int g = 0; g < RT_GROUPS; ++g) {                                                      \
            const mask on = alive(&(p)->r[g], &(p)->h[g]);                                         \
            const real o = (p)->r[g].origin.axis, i = (p)->r[g].inverse.axis;                      \
            low_o = SELECT(low_o, LESSER(o, low_o), on);                                           \
            high_o = SELECT(high_o, GREATER(o, high_o), on);                                       \
            low_i = SELECT(low_i, LESSER(i, low_i), on);                                           \
            high_i = SELECT(high_i, GREATER(i, high_i), on);                                       \
        }                                                                                          \
        const number o0 = LEAST(low_o), o1 = MOST(high_o);                                         \
        const number i0 = LEAST(low_i), i1 = MOST(high_i);                                         \
        (out)->mirrored = i1 < 0.0f;                                                               \
        (out)->mixed = i0 < 0.0f && i1 > 0.0f;                                                     \
        (out)->first = i1 < 0.0f ? -o1 : o0;                                                       \
        (out)->last = i1 < 0.0f ? -o0 : o1;                                                        \
        (out)->slowest = i1 < 0.0f ? -i1 : i0;                                                     \
        (out)->fastest = i1 < 0.0f ? -i0 : i1;                                                     \
    } while (0)

/* The greatest t that is still of interest to some ray; -infinity without one. */
INLINE number farthest(const packet *p)
{
    real high = (real)-INFINITY;
    for (int g = 0; g < RT_GROUPS; ++g)
        high = SELECT(high, GREATER(p->h[g].t, high), alive(&p->r[g], &p->h[g]));
    return MOST(high);
}

INLINE number least_tmin(const packet *p)
{
    real low = (real)INFINITY;
    for (int g = 0; g < RT_GROUPS; ++g)
        low = SELECT(low, LESSER(p->r[g].tmin, low), alive(&p->r[g], &p->h[g]));
    return LEAST(low);
}

/* Narrows [enter, leave] of 16 boxes by one axis. For each ray of the bundle its own interval, as
 * box_interval computes it, lies within: every operation rounds monotonely. */
INLINE void narrow(const bundle_axis *a, __global const float *lo, __global const float *hi,
                   number16 *enter, number16 *leave)
{
    if (a->mixed)
        return;
    number16 near = LOAD_16(a->mirrored ? hi : lo);
    number16 far = LOAD_16(a->mirrored ? lo : hi);
    near = (a->mirrored ? -near : near) - a->last;
    far = (a->mirrored ? -far : far) - a->first;
    near = near * select((number16)a->slowest, (number16)a->fastest, near < 0.0f);
    far = far * select((number16)a->fastest, (number16)a->slowest, far < 0.0f);
    *enter = select(*enter, near, near > *enter);
    *leave = select(*leave, far, far < *leave);
}

/* The lanes of a mask as bits, lane 0 lowest. AVX-512 has an instruction for it, which rays that
 * walk alone are a tenth faster by. Elsewhere by way of bytes of ones and zeros: each keeps the bit
 * of its place, and a multiplication adds the eight up in the top byte. Little-endian, as every
 * OpenCL device there is. */
#if defined(__AVX512DQ__) && HAS_BUILTIN(__builtin_ia32_cvtd2mask512) && RT_ACCURACY != RT_DOUBLE
typedef int avx_mask __attribute__((vector_size(64)));
INLINE int bits_of(mask16 m)
{
    return (ushort)__builtin_ia32_cvtd2mask512((avx_mask)m);
}
#else
INLINE int bits_of(mask16 m)
{
    const ulong2 v = as_ulong2(convert_char16(m));
    const ulong x = (v.x & 0x8040201008040201UL) * 0x0101010101010101UL;
    const ulong y = (v.y & 0x8040201008040201UL) * 0x0101010101010101UL;
    return (int)(x >> 56) | (int)(y >> 48 & 0xff00);
}
#endif

/* Groups of which some ray meets the box of a node's child in time. */
INLINE int groups_in_box(const packet *p, __global const rt_node *n, int c)
{
    int groups = 0;
    for (int g = 0; g < RT_GROUPS; ++g) {
        real enter, leave;
        const rays *r = &p->r[g];
        const real3 lo = SPLAT3(n->lo_x[c], n->lo_y[c], n->lo_z[c]);
        const real3 hi = SPLAT3(n->hi_x[c], n->hi_y[c], n->hi_z[c]);
        box_interval(r->origin, r->inverse, lo, hi, &enter, &leave);
        /* That the ray is alive, its part in the box not empty, and in time: all in one. */
        const mask on = MASK(GREATER(enter, r->tmin) <= LESSER(leave, p->h[g].t));
        groups |= ANY(on) ? 1 << g : 0;
    }
    return groups;
}

/* In the form that compilers know for a count of trailing zeros. */
#define LOWEST_BIT(bits) ((int)popcount(~(bits) & ((bits)-1)))

/* Puts the children that a node's test has left onto the stack, the nearest on top. */
INLINE int push_children(mask16 meets, number16 enter, int code, int *codes, number *enters,
                         int top)
{
    number nearest[RT_WIDTH];
    vstore16(enter, 0, nearest);
    const int bottom = top;
    for (int left = bits_of(meets); left; left &= left - 1) {
        const int c = LOWEST_BIT(left);
        int at = top++;
        for (; at > bottom && enters[at - 1] < nearest[c]; --at) {
            enters[at] = enters[at - 1];
            codes[at] = codes[at - 1];
        }
        enters[at] = nearest[c];
        codes[at] = code + c;
    }
    return top;
}

/* The bundle of a packet; its tmin is above its tmax where no ray is alive. */
INLINE void bundle_up(const packet *p, bundle *b)
{
    BUNDLE_AXIS(p, x, &b->x);
    BUNDLE_AXIS(p, y, &b->y);
    BUNDLE_AXIS(p, z, &b->z);
    b->tmin = least_tmin(p);
    b->tmax = farthest(p);
}

INLINE void walk_packet(packet *p, bundle *b, const world *w, const int any)
{
    int codes[RT_STACK]; /* parent * RT_WIDTH + child */
    number enters[RT_STACK];
    int top = 0;
    int node = b->tmin <= b->tmax ? 0 : -1;
    while (node >= 0) {
        __global const rt_node *n = w->nodes + node;
        number16 enter = (number16)b->tmin, leave = (number16)b->tmax;
        narrow(&b->x, n->lo_x, n->hi_x, &enter, &leave);
        narrow(&b->y, n->lo_y, n->hi_y, &enter, &leave);
        narrow(&b->z, n->lo_z, n->hi_z, &enter, &leave);
        /* The margin of box_interval, and empty boxes out. */
        const mask16 meets =
            (enter <= leave * SLAB_MARGIN) & (LOAD_16(n->lo_x) <= LOAD_16(n->hi_x));
        top = push_children(meets, enter, node * RT_WIDTH, codes, enters, top);
        node = -1;
        while (top > 0 && node < 0) {
            --top;
            if (!(enters[top] <= b->tmax))
                continue;
            const int c = codes[top] % RT_WIDTH;
            __global const rt_node *parent = w->nodes + codes[top] / RT_WIDTH;
            const int groups = groups_in_box(p, parent, c);
            const int child = parent->child[c];
            if (groups == 0)
                continue;
            if (child >= 0)
                node = child;
            else if (offer_block(p, groups, w, RT_LEAF_KIND(child), RT_LEAF_BLOCK(child), any))
                b->tmax = farthest(p);
        }
    }
}

#if RT_ONE_BY_ONE
/* ---- One ray at a time ---- */

/* Holds one ray, in all lanes of `r`, against a leaf's block. */
INLINE void meet_block(const rays *r, hit *h, const world *w, int kind, int block, const int any)
{
#define MEET(name, names, NAMES)                                                                   \
    RT_WHERE(                                                                                      \
        NAMES, if (RT_IS_OF(NAMES, kind)) {                                                        \
            meet_block_of_##names(r, h, w, block, any);                                            \
            return;                                                                                \
        })
    RT_KINDS(MEET)
}

/* Narrows [enter, leave] of 16 boxes by one axis of one ray, as box_interval does. */
INLINE void narrow_one(number origin, number inverse, __global const float *lo,
                       __global const float *hi, number16 *enter, number16 *leave)
{
    const number16 near = (LOAD_16(inverse < 0.0f ? hi : lo) - origin) * inverse;
    const number16 far = (LOAD_16(inverse < 0.0f ? lo : hi) - origin) * inverse;
    *enter = GREATER_N(near, *enter);
    *leave = LESSER_N(far, *leave);
}

/* A child that is a node is where the walk goes on; a leaf is dealt with, and -1 returned. */
INLINE int follow(const rays *r, hit *h, const world *w, int child, const int any)
{
    if (child >= 0)
        return child;
    meet_block(r, h, w, RT_LEAF_KIND(child), RT_LEAF_BLOCK(child), any);
    return -1;
}

INLINE void walk_one(const rays *r, number tmin, hit *h, const world *w, const int any)
{
    int children[RT_STACK];
    number enters[RT_STACK];
    int top = 0, node = 0;
    const number ox = LANE(r->origin.x, 0), oy = LANE(r->origin.y, 0), oz = LANE(r->origin.z, 0);
    const number ix = LANE(r->inverse.x, 0), iy = LANE(r->inverse.y, 0), iz = LANE(r->inverse.z, 0);
    while (node >= 0) {
        __global const rt_node *n = w->nodes + node;
        number16 enter = (number16)tmin, leave = (number16)h->t;
        narrow_one(ox, ix, n->lo_x, n->hi_x, &enter, &leave);
        narrow_one(oy, iy, n->lo_y, n->hi_y, &enter, &leave);
        narrow_one(oz, iz, n->lo_z, n->hi_z, &enter, &leave);
        int left = bits_of(enter <= leave * SLAB_MARGIN);
        node = -1;
        if (left) {
            /* The nearest child is followed, the others wait: sorting them costs more than it
             * saves. */
            number nearest[RT_WIDTH];
            vstore16(enter, 0, nearest);
            int c = LOWEST_BIT(left);
            number e = nearest[c];
            for (left &= left - 1; left; left &= left - 1) {
                const int other = LOWEST_BIT(left);
                const number o = nearest[other];
                const int is_nearer = o < e;
                enters[top] = is_nearer ? e : o;
                children[top++] = n->child[is_nearer ? c : other];
                c = is_nearer ? other : c;
                e = is_nearer ? o : e;
            }
            node = follow(r, h, w, n->child[c], any);
        }
        while (top > 0 && node < 0) {
            --top;
            if (enters[top] <= h->t)
                node = follow(r, h, w, children[top], any);
        }
    }
}

/* Lane k of a group's rays in all lanes. */
INLINE void spread_ray(const rays *from, int k, rays *r)
{
    r->origin = SPLAT3(LANE(from->origin.x, k), LANE(from->origin.y, k), LANE(from->origin.z, k));
    r->direction =
        SPLAT3(LANE(from->direction.x, k), LANE(from->direction.y, k), LANE(from->direction.z, k));
    r->inverse =
        SPLAT3(LANE(from->inverse.x, k), LANE(from->inverse.y, k), LANE(from->inverse.z, k));
    r->tmin = (real)LANE(from->tmin, k);
#if RT_SPHERES
    r->dd = (real)LANE(from->dd, k);
    r->inv_dd = (real)LANE(from->inv_dd, k);
#endif
#if RT_WATERTIGHT
    r->axis = (mask)LANE_OF_MASK(from->axis, k);
    r->from = SPLAT3(LANE(from->from.x, k), LANE(from->from.y, k), LANE(from->from.z, k));
    r->onward = SPLAT3(LANE(from->onward.x, k), LANE(from->onward.y, k), LANE(from->onward.z, k));
    r->sx = (real)LANE(from->sx, k);
    r->sy = (real)LANE(from->sy, k);
#endif
}

INLINE void walk_rays(packet *p, const world *w, const int any)
{
    for (int i = 0; i < RT_PACKET; ++i) {
        rays *from = &p->r[i / RT_LANES];
        hits *to = &p->h[i / RT_LANES];
        const int k = i % RT_LANES;
        hit h = {LANE(to->t, k), 0.0f, 0.0f, 1.0f, RT_MISS, RT_MISS};
        const number tmin = LANE(from->tmin, k);
        if (!(h.t > tmin))
            continue;
        rays r;
        spread_ray(from, k, &r);
        walk_one(&r, tmin, &h, w, any);
        LANE(to->t, k) = h.t;
        LANE(to->u, k) = h.u;
        LANE(to->v, k) = h.v;
        LANE(to->det, k) = h.det;
        LANE_OF_MASK(to->index, k) = h.index;
        LANE_OF_MASK(to->slot, k) = h.slot;
    }
}
#endif

/* Rays go together where at most one axis has them go both ways. */
INLINE void walk(packet *p, const world *w, const int any)
{
    bundle b;
    bundle_up(p, &b);
#if RT_ONE_BY_ONE
    if (b.x.mixed + b.y.mixed + b.z.mixed > 1) {
        walk_rays(p, w, any);
        return;
    }
#endif
    walk_packet(p, &b, w, any);
}
#endif
