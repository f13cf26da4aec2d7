/* A packet: RT_PACKET rays that walk together, in RT_GROUPS vectors of RT_LANES. The nearest hit is
 * the least t in (tmin, tmax), and among equals that of the lowest primitive index, whatever the
 * order in which primitives are offered. */

#define RT_GROUPS (RT_PACKET / RT_LANES)

/* From a corner's component in a block of triangles to the next corner's. */
#define CORNER (3 * RT_BLOCK_PRIMITIVES)

/* What a walk works on. */
typedef struct world {
    __global const rt_node *nodes;
    __global const int *order; /* the primitive of each slot: spheres' slots, then triangles' */
    __global const rt_sphere_block *spheres;
    __global const rt_triangle_block *triangles;
    int sphere_blocks, triangle_blocks;
} world;

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

#if RT_SPHERES
/* Offers a block to the groups whose bits are set. */
INLINE int offer_spheres(packet *p, int groups, const world *w, int block, const int any)
{
    __global const rt_sphere_block *s = w->spheres + block;
    __global const int *order = w->order + block * RT_BLOCK_PRIMITIVES;
    int changed = 0;
    for (int k = 0; k < RT_BLOCK_PRIMITIVES && order[k] >= 0; ++k) {
        const real3 center = SPLAT3(s->cx[k], s->cy[k], s->cz[k]);
        for (int g = 0; g < RT_GROUPS; ++g) {
            meeting m;
            if ((groups >> g & 1) &&
                meet_spheres(&p->r[g], center, (real)s->radius[k], (mask)-1, &m))
                changed |= take(&p->h[g], &m, order[k], block * RT_BLOCK_PRIMITIVES + k, any);
        }
    }
    return changed;
}
#endif

#if RT_TRIANGLES
#if RT_WATERTIGHT
#define MIXED_AXES 3
/* Where a block has the components of its corners in the order for an axis: free where all rays
 * agree, which is nearly always. */
#define FIRST_OF(axis) ((axis) == 0 ? 1 : (axis) == 1 ? 2 : 0)
#define SECOND_OF(axis) ((axis) == 0 ? 2 : (axis) == 1 ? 0 : 1)
#define THIRD_OF(axis) ((axis) == MIXED_AXES ? 2 : (axis))

INLINE int common_axis(const packet *p)
{
    mask x = (mask)0, y = (mask)0, z = (mask)0;
    for (int g = 0; g < RT_GROUPS; ++g) {
        const mask on = alive(&p->r[g], &p->h[g]);
        x = x | (on & MASK(p->r[g].axis == (mask)0));
        y = y | (on & MASK(p->r[g].axis == (mask)1));
        z = z | (on & MASK(p->r[g].axis == (mask)2));
    }
    const int any_x = ANY(x), any_y = ANY(y), any_z = ANY(z);
    return any_x + any_y + any_z > 1 ? MIXED_AXES : any_x ? 0 : any_y ? 1 : 2;
}
#endif

INLINE int offer_triangles(packet *p, int groups, const world *w, int block, const int any)
{
    __global const rt_triangle_block *s = w->triangles + block;
    __global const int *order = w->order + (w->sphere_blocks + block) * RT_BLOCK_PRIMITIVES;
    int changed = 0;
#if RT_WATERTIGHT
    __global const float *first =
        (__global const float *)s + FIRST_OF(p->axis) * RT_BLOCK_PRIMITIVES;
    __global const float *second =
        (__global const float *)s + SECOND_OF(p->axis) * RT_BLOCK_PRIMITIVES;
    __global const float *third =
        (__global const float *)s + THIRD_OF(p->axis) * RT_BLOCK_PRIMITIVES;
#else
    __global const float *first = s->ax, *second = s->ay, *third = s->az;
#endif
    for (int k = 0; k < RT_BLOCK_PRIMITIVES && order[k] >= 0; ++k) {
        const real3 a = SPLAT3(first[k], second[k], third[k]);
        const real3 b = SPLAT3(first[CORNER + k], second[CORNER + k], third[CORNER + k]);
        const real3 c =
            SPLAT3(first[2 * CORNER + k], second[2 * CORNER + k], third[2 * CORNER + k]);
        for (int g = 0; g < RT_GROUPS; ++g) {
            meeting m;
            if (!(groups >> g & 1))
                continue;
#if RT_WATERTIGHT && RT_PACKET > 1
            if (p->axis == MIXED_AXES) {
                real3 pa = a, pb = b, pc = c;
                permute_by_lane(&p->r[g], &pa, &pb, &pc);
                if (meet_triangles(&p->r[g], pa, pb, pc, (mask)-1, &m))
                    changed |= take(&p->h[g], &m, order[k], block * RT_BLOCK_PRIMITIVES + k, any);
                continue;
            }
#endif
            if (meet_triangles(&p->r[g], a, b, c, (mask)-1, &m))
                changed |= take(&p->h[g], &m, order[k], block * RT_BLOCK_PRIMITIVES + k, any);
        }
    }
    return changed;
}
#endif

INLINE int offer_block(packet *p, int groups, const world *w, int kind, int block,
                       const int any)
{
#if RT_SPHERES && RT_TRIANGLES
    return kind == RT_KIND_SPHERES ? offer_spheres(p, groups, w, block, any)
                     : offer_triangles(p, groups, w, block, any);
#elif RT_SPHERES
    return offer_spheres(p, groups, w, block, any);
#elif RT_TRIANGLES
    return offer_triangles(p, groups, w, block, any);
#else
    return 0;
#endif
}
