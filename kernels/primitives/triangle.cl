/* Triangles: rays against them at each level but for the robust test (watertight.cl), one in all
 * lanes or a block in the lanes. */
#if RT_TRIANGLES

/* From a corner's component in a block of triangles to the next corner's. */
#define CORNER (3 * RT_BLOCK_PRIMITIVES)

#if !RT_WATERTIGHT
/* Moller and Trumbore 1997. Barycentric bounds are tested before any division, against the
 * determinant itself: there is no epsilon, so the test is the same at every scale. Returns whether
 * any lane is on. */
INLINE int meet_triangles(const rays *r, real3 a, real3 b, real3 c, const mask active, meeting *m)
{
    const real3 e1 = SUB(real3, b, a);
    const real3 e2 = SUB(real3, c, a);
    const real3 p = CROSS(real3, r->direction, e2);
    const real signed_det = DOT(e1, p);
    /* Multiplying by the determinant's sign, as one flip of the sign bit. */
    const mask sign = AS_MASK(signed_det) & (mask)SIGN_BIT;
    m->det = AS_REAL(AS_MASK(signed_det) ^ sign);
#if RT_CULL > 0
    const mask facing = MASK(signed_det > (real)0.0f);
#elif RT_CULL < 0
    const mask facing = MASK(signed_det < (real)0.0f);
#else
    const mask facing = MASK(m->det > (real)0.0f);
#endif
    const real3 s = SUB(real3, r->origin, a);
    m->u = AS_REAL(AS_MASK(DOT(s, p)) ^ sign);
    const real3 q = CROSS(real3, s, e1);
    m->v = AS_REAL(AS_MASK(DOT(r->direction, q)) ^ sign);
    m->on =
        facing & MASK(m->u >= (real)0.0f) & MASK(m->v >= (real)0.0f) & MASK(m->u + m->v <= m->det);
    if (!ANY(m->on))
        return 0;
    m->t = DIVIDE(AS_REAL(AS_MASK(DOT(e2, q)) ^ sign), m->det);
    keep_in_box(r->origin, r->inverse, r->tmin, LEAST_CORNER(a, b, c), GREATEST_CORNER(a, b, c), m);
    return 1;
}
#endif

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
    __global const int *order = order_of(w, RT_KIND_TRIANGLES, block);
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

#if RT_ONE_BY_ONE
INLINE void meet_block_of_triangles(const rays *r, hit *h, const world *w, int block, const int any)
{
    meeting m;
    __global const rt_triangle_block *t = w->triangles + block;
#if RT_WATERTIGHT
    const int axis = (int)LANE_OF_MASK(r->axis, 0);
    __global const float *first = (__global const float *)t + FIRST_OF(axis) * RT_BLOCK_PRIMITIVES;
    __global const float *second =
        (__global const float *)t + SECOND_OF(axis) * RT_BLOCK_PRIMITIVES;
    __global const float *third = (__global const float *)t + THIRD_OF(axis) * RT_BLOCK_PRIMITIVES;
#else
    __global const float *first = t->ax, *second = t->ay, *third = t->az;
#endif
    const real3 a = {BLOCK_LOAD(first), BLOCK_LOAD(second), BLOCK_LOAD(third)};
    const real3 b = {BLOCK_LOAD(first + CORNER), BLOCK_LOAD(second + CORNER),
                     BLOCK_LOAD(third + CORNER)};
    const real3 c = {BLOCK_LOAD(first + 2 * CORNER), BLOCK_LOAD(second + 2 * CORNER),
                     BLOCK_LOAD(third + 2 * CORNER)};
    __global const int *order = order_of(w, RT_KIND_TRIANGLES, block);
    if (meet_triangles(r, a, b, c, BLOCK_LANES, &m))
        take_best(h, &m, BLOCK_LOAD_INDEX(order), block, any);
}
#endif

#endif
