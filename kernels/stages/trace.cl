/* Stage 2: from a ray array to a hit array, the nearest hits, or to whether there is any hit at
 * all, RT_PACKET rays a work-item. Rendering, tests and benchmarks all launch this kernel: what is
 * tested is what renders. */

/* 1 / d, finite: the largest number where d is zero or denormal. */
INLINE real finite_reciprocal(real d)
{
    const real inverse = DIVIDE((real)1.0f, d);
    return LESSER(GREATER(inverse, (real)-NUMBER_MAX), (real)NUMBER_MAX);
}

/* The exponent's bits: all set, and so the greatest, for infinities and NaN alone. */
#define EXPONENT_OF(v) (AS_MASK(v) & (mask)EXPONENT_BITS)
#define MOST_EXPONENT(v) max(max(EXPONENT_OF((v).x), EXPONENT_OF((v).y)), EXPONENT_OF((v).z))

/* Rays from the array; t is their tmax, or -infinity for rays that cannot hit anything because
 * something in them is not finite. */
INLINE void load_rays(__global const number *source, size_t step, rays *r, hits *h)
{
    r->origin.x = LOAD_REAL(source + RT_RAY_OX * step);
    r->origin.y = LOAD_REAL(source + RT_RAY_OY * step);
    r->origin.z = LOAD_REAL(source + RT_RAY_OZ * step);
    r->direction.x = LOAD_REAL(source + RT_RAY_DX * step);
    r->direction.y = LOAD_REAL(source + RT_RAY_DY * step);
    r->direction.z = LOAD_REAL(source + RT_RAY_DZ * step);
    r->tmin = LOAD_REAL(source + RT_RAY_TMIN * step);
    r->inverse.x = finite_reciprocal(r->direction.x);
    r->inverse.y = finite_reciprocal(r->direction.y);
    r->inverse.z = finite_reciprocal(r->direction.z);
#if RT_SPHERES
    r->dd = DOT(r->direction, r->direction);
    r->inv_dd = DIVIDE((real)1.0f, r->dd);
#endif
    /* By bits: relaxed math takes for granted that numbers are finite, and leaves out a test by
     * arithmetic. */
    const mask exponent = max(MOST_EXPONENT(r->origin), MOST_EXPONENT(r->direction));
    const real tmax = LOAD_REAL(source + RT_RAY_TMAX * step);
    mask lawful = MASK(exponent < (mask)EXPONENT_BITS) & MASK(tmax > r->tmin);
#if RT_WATERTIGHT
    lawful = lawful & set_up_shear(r);
#endif
    h->t = SELECT((real)-INFINITY, tmax, lawful);
    h->index = (mask)RT_MISS;
    h->slot = (mask)RT_MISS;
    h->u = (real)0.0f;
    h->v = (real)0.0f;
    h->det = (real)1.0f;
}

/* Writes a group's hits; a miss has an infinite t, whatever tmax was. */
INLINE void store_hits(const hits *h, size_t at, size_t step, __global int *hit_index,
                       __global int *hit_slot, __global number *hit_array)
{
    const real t = SELECT(h->t, (real)INFINITY, MASK(h->index == (mask)RT_MISS));
    STORE_INDEX(h->index, hit_index + at);
    STORE_INDEX(h->slot, hit_slot + at);
    STORE_REAL(t, hit_array + at + RT_HIT_T * step);
    STORE_REAL(DIVIDE(h->u, h->det), hit_array + at + RT_HIT_U * step);
    STORE_REAL(DIVIDE(h->v, h->det), hit_array + at + RT_HIT_V * step);
}

INLINE void load_packet(__global const number *source, size_t step, packet *p)
{
    for (int g = 0; g < RT_GROUPS; ++g)
        load_rays(source + g * RT_LANES, step, &p->r[g], &p->h[g]);
#if RT_WATERTIGHT
    p->axis = common_axis(p);
#endif
}

#if RT_HAS_TRACE
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_PACKET, 1, 1))) void
rt_trace(const int stride, __global const number *rays, WORLD_PARAMETERS, __global int *hit_index,
         __global int *hit_slot, __global number *hit_array)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_PACKET);
    const world w = WORLD;
    const size_t step = (size_t)stride;
    const size_t first = get_global_id(0) * RT_PACKET;
    packet p;
    load_packet(rays + first, step, &p);
    walk(&p, &w, 0);
    for (int g = 0; g < RT_GROUPS; ++g)
        store_hits(&p.h[g], first + g * RT_LANES, step, hit_index, hit_slot, hit_array);
}
#endif

#if RT_HAS_OCCLUDE
/* Any hit: the index of some primitive that is hit in (tmin, tmax), or RT_MISS. Which one it is may
 * differ from device to device; whether there is one does not. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_PACKET, 1, 1))) void
rt_occlude(const int stride, __global const number *probes, WORLD_PARAMETERS, __global int *blocked)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_PACKET);
    const world w = WORLD;
    const size_t first = get_global_id(0) * RT_PACKET;
    packet p;
    load_packet(probes + first, (size_t)stride, &p);
    walk(&p, &w, 1);
    for (int g = 0; g < RT_GROUPS; ++g)
        STORE_INDEX(p.h[g].index, blocked + first + g * RT_LANES);
}
#endif
