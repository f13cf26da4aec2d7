/* A packet: RT_PACKET rays that walk together, in RT_GROUPS vectors of RT_LANES. The nearest hit is
 * the least t in (tmin, tmax), and among equals that of the lowest primitive index, whatever the
 * order in which primitives are offered. */

#define RT_GROUPS (RT_PACKET / RT_LANES)

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
INLINE int offer_triangles(packet *p, int groups, const world *w, int block, const int any)
{
    __global const rt_triangle_block *s = w->triangles + block;
    __global const int *order = w->order + (w->sphere_blocks + block) * RT_BLOCK_PRIMITIVES;
    int changed = 0;
    for (int k = 0; k < RT_BLOCK_PRIMITIVES && order[k] >= 0; ++k) {
        const real3 a = SPLAT3(s->ax[k], s->ay[k], s->az[k]);
        const real3 b = SPLAT3(s->bx[k], s->by[k], s->bz[k]);
        const real3 c = SPLAT3(s->cx[k], s->cy[k], s->cz[k]);
        for (int g = 0; g < RT_GROUPS; ++g) {
            meeting m;
            if ((groups >> g & 1) && meet_triangles(&p->r[g], a, b, c, (mask)-1, &m))
                changed |= take(&p->h[g], &m, order[k], block * RT_BLOCK_PRIMITIVES + k, any);
        }
    }
    return changed;
}
#endif

INLINE int offer_block(packet *p, int groups, const world *w, int is_sphere, int block,
                       const int any)
{
#if RT_SPHERES && RT_TRIANGLES
    return is_sphere ? offer_spheres(p, groups, w, block, any)
                     : offer_triangles(p, groups, w, block, any);
#elif RT_SPHERES
    return offer_spheres(p, groups, w, block, any);
#elif RT_TRIANGLES
    return offer_triangles(p, groups, w, block, any);
#else
    return 0;
#endif
}
