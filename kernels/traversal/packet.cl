/* A packet: RT_PACKET rays that walk together, in RT_GROUPS vectors of RT_LANES. The nearest hit is
 * the least t in (tmin, tmax), and among equals that of the lowest primitive index, whatever the
 * order in which primitives are offered. */

#define RT_GROUPS (RT_PACKET / RT_LANES)
/* Whether rays that go apart walk one by one. */
#define RT_ONE_BY_ONE (RT_TREE && RT_LANES > 1 && RT_PRIMITIVES)

/* What a walk works on. */
typedef struct world {
    __global const rt_node *nodes;
    __global const int *order; /* the primitive of each slot, kind after kind */
#define WORLD_FIELD(name, names, NAMES)                                                            \
    __global const rt_##name##_block *names;                                                       \
    int name##_blocks;
    RT_KINDS(WORLD_FIELD)
} world;

/* The same as parameters of a kernel, and made from them. */
#define WORLD_KIND(name, names, NAMES)                                                             \
    , __global const rt_##name##_block *names, const int name##_blocks
#define WORLD_PARAMETERS                                                                           \
    __global const rt_node *nodes, __global const int *order RT_KINDS(WORLD_KIND)
#define WORLD_KIND_ARGUMENTS(name, names, NAMES) , names, name##_blocks
#define WORLD                                                                                      \
    {                                                                                              \
        nodes, order RT_KINDS(WORLD_KIND_ARGUMENTS)                                                \
    }

/* The primitives of a block's places. */
INLINE __global const int *order_of(const world *w, const int kind, int block)
{
    int before = 0;
#define ADD_BLOCKS(name, names, NAMES) before += RT_KIND_##NAMES < kind ? w->name##_blocks : 0;
    RT_KINDS(ADD_BLOCKS)
    return w->order + (before + block) * RT_BLOCK_PRIMITIVES;
}

typedef struct hits {
    mask index; /* RT_MISS where nothing is hit yet */
    mask slot;
    real t;         /* -infinity where nothing can be hit any more */
    real u, v, det; /* as in a meeting */
} hits;

typedef struct packet {
    rays r[RT_GROUPS];
    hits h[RT_GROUPS];
#if RT_WATERTIGHT
    int axis; /* of all its rays, or MIXED_AXES */
#endif
} packet;

/* Lanes whose rays can still hit anything. */
INLINE mask alive(const rays *r, const hits *h)
{
    return MASK(h->t > r->tmin);
}

/* Takes a meeting with one primitive where it is nearer than what there is; with `any`, where there
 * is one at all, and the lane is done. Returns whether a lane took it. */
INLINE int take(hits *h, const meeting *m, int index, int slot, const int any)
{
    const mask nearer = MASK(m->t < h->t) | (MASK(m->t == h->t) & MASK((mask)index < h->index));
    const mask on = m->on & nearer;
    h->t = SELECT(h->t, any ? (real)-INFINITY : m->t, on);
    h->index = SELECT(h->index, (mask)index, on);
    if (!any) {
        h->slot = SELECT(h->slot, (mask)slot, on);
        h->u = SELECT(h->u, m->u, on);
        h->v = SELECT(h->v, m->v, on);
        h->det = SELECT(h->det, m->det, on);
    }
    return ANY(on);
}

#if RT_ONE_BY_ONE
/* ---- One ray and a block, whose primitives are in the lanes ---- */

/* The lanes that a block fills. What a whole vector loads beyond the block is not looked at; arrays
 * end with enough to load. */
typedef RT_PASTE(RT_BITS, 4) mask4;
typedef RT_PASTE(RT_BITS, 8) mask8;
#if RT_LANES == 4
#define BLOCK_LANES ((mask4)-1)
#elif RT_LANES == 8
#define BLOCK_LANES ((mask8)((mask4)-1, (mask4)0))
#else
#define BLOCK_LANES ((mask16)((mask4)-1, (mask4)0, (mask8)0))
#endif
#define BLOCK_LOAD(p)                                                                              \
    RT_PASTE(RT_PASTE(convert_, RT_NUMBER), RT_LANES)(RT_PASTE(vload, RT_LANES)(0, p))
#define BLOCK_LOAD_INDEX(p)                                                                        \
    RT_PASTE(RT_PASTE(convert_, RT_BITS), RT_LANES)(RT_PASTE(vload, RT_LANES)(0, p))

/* Lane k of a vector in memory. */
#define LANE(v, k) (((number *)&(v))[k])
#define LANE_OF_MASK(v, k) (((RT_BITS *)&(v))[k])

/* What a ray has hit so far. */
typedef struct hit {
    number t, u, v, det;
    int index, slot;
} hit;

/* Takes the best of a block's meetings with one ray, by the rule of take(). */
INLINE void take_best(hit *h, meeting *m, mask index, int block, const int any)
{
    m->on = m->on & MASK(index >= (mask)0) & MASK(m->t <= (real)h->t);
    if (!ANY(m->on))
        return;
    for (int k = 0; k < RT_BLOCK_PRIMITIVES; ++k) {
        const number t = LANE(m->t, k);
        const int i = (int)LANE_OF_MASK(index, k);
        if (!LANE_OF_MASK(m->on, k) || !(t < h->t || (t == h->t && i < h->index)))
            continue;
        h->t = any ? -INFINITY : t;
        h->index = i;
        h->slot = block * RT_BLOCK_PRIMITIVES + k;
        h->u = LANE(m->u, k);
        h->v = LANE(m->v, k);
        h->det = LANE(m->det, k);
    }
}
#endif
