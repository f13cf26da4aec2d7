/* Primitives against rays, lane by lane: many rays and one primitive in all lanes, or one ray in
 * all lanes and a block of primitives; only `active` lanes mean anything. Every test is written so
 * that a NaN means a miss. */

#define RT_WATERTIGHT (RT_TRIANGLES && RT_ACCURACY >= RT_ROBUST)
#if RT_ACCURACY >= RT_ROBUST
#define SLAB_MARGIN RT_SLAB_MARGIN_ROBUST
#else
#define SLAB_MARGIN RT_SLAB_MARGIN
#endif

typedef struct rays {
    real3 origin, direction;
    real3 inverse; /* 1 / direction, finite: the largest number where a component is 0 */
    real tmin;
#if RT_SPHERES
    real dd, inv_dd; /* dot(direction, direction) and its reciprocal */
#endif
#if RT_WATERTIGHT
    /* The axes in an order in which the direction's largest component is the last: x, y, z as y, z,
     * x for axis 0, as z, x, y for axis 1, as they are for axis 2. */
    mask axis;
    real3 from;   /* the origin in that order */
    real3 onward; /* `inverse` in that order */
    real sx, sy;  /* how far the ray goes along the first two for one step along the last */
#endif
} rays;

/* Where rays and primitives meet: t within the primitive's box, and barycentric coordinates times
 * det, which are divided when the walk is over. */
typedef struct meeting {
    mask on;
    real t, u, v, det;
} meeting;

/* The part of the rays within boxes, as t from `enter` to `leave`; empty where enter > leave. The
 * operations are monotone in the box, rounding included, so that the interval of a box contains
 * that of any box inside it exactly: a walk that skips a node by this test never skips a hit that
 * has been kept in its primitive's own interval. */
INLINE void box_interval(real3 origin, real3 inverse, real3 lo, real3 hi, real *enter, real *leave)
{
    const real x0 = (lo.x - origin.x) * inverse.x;
    const real x1 = (hi.x - origin.x) * inverse.x;
    const real y0 = (lo.y - origin.y) * inverse.y;
    const real y1 = (hi.y - origin.y) * inverse.y;
    const real z0 = (lo.z - origin.z) * inverse.z;
    const real z1 = (hi.z - origin.z) * inverse.z;
    *enter = GREATER(GREATER(LESSER(x0, x1), LESSER(y0, y1)), LESSER(z0, z1));
    *leave = LESSER(LESSER(GREATER(x0, x1), GREATER(y0, y1)), GREATER(z0, z1)) * (real)SLAB_MARGIN;
}

/* Widens primitives' exact boxes by the margin of RT_BOX_MARGIN. */
INLINE void widen_boxes(real3 *lo, real3 *hi)
{
    const floats lo_x = TO_FLOATS(lo->x), hi_x = TO_FLOATS(hi->x);
    const floats lo_y = TO_FLOATS(lo->y), hi_y = TO_FLOATS(hi->y);
    const floats lo_z = TO_FLOATS(lo->z), hi_z = TO_FLOATS(hi->z);
    const floats size_x = fabs(lo_x) + fabs(hi_x);
    const floats size_y = fabs(lo_y) + fabs(hi_y);
    const floats size_z = fabs(lo_z) + fabs(hi_z);
#if RT_ACCURACY >= RT_ROBUST
    const floats margin_x =
        GREATER_FLOATS(GREATER_FLOATS(size_x, size_y), size_z) * (floats)RT_BOX_MARGIN;
    const floats margin_y = margin_x, margin_z = margin_x;
#else
    const floats margin_x = size_x * (floats)RT_BOX_MARGIN;
    const floats margin_y = size_y * (floats)RT_BOX_MARGIN;
    const floats margin_z = size_z * (floats)RT_BOX_MARGIN;
#endif
    *lo = (real3){FROM_FLOATS(lo_x - margin_x), FROM_FLOATS(lo_y - margin_y),
                  FROM_FLOATS(lo_z - margin_z)};
    *hi = (real3){FROM_FLOATS(hi_x + margin_x), FROM_FLOATS(hi_y + margin_y),
                  FROM_FLOATS(hi_z + margin_z)};
}

/* Keeps t within the primitives' own boxes, given by their exact corners. Moller and Trumbore's t
 * on a sliver or a grazing ray can lie outside of the triangle by far. */
INLINE void keep_in_box(real3 origin, real3 inverse, real tmin, real3 lo, real3 hi, meeting *m)
{
    real enter, leave;
    widen_boxes(&lo, &hi);
    box_interval(origin, inverse, lo, hi, &enter, &leave);
    m->t = LESSER(GREATER(m->t, enter), leave);
    m->on = m->on & MASK(enter <= leave) & MASK(m->t > tmin);
}

#if RT_SPHERES
INLINE void keep_in_sphere_box(const rays *r, real3 center, real radius, meeting *m)
{
    /* In float at every level, as the tree's boxes are. */
    const floats cx = TO_FLOATS(center.x), cy = TO_FLOATS(center.y), cz = TO_FLOATS(center.z);
    const floats reach = TO_FLOATS(radius);
    const real3 lo = {FROM_FLOATS(cx - reach), FROM_FLOATS(cy - reach), FROM_FLOATS(cz - reach)};
    const real3 hi = {FROM_FLOATS(cx + reach), FROM_FLOATS(cy + reach), FROM_FLOATS(cz + reach)};
    keep_in_box(r->origin, r->inverse, r->tmin, lo, hi, m);
}
#endif

#if RT_SPHERES && RT_ACCURACY < RT_ROBUST
/* Nearest root of |o + t d - c| = r beyond tmin. The discriminant comes from the ray's closest
 * approach to the centre, not from b*b - a*c, which cancels for small or far spheres (Haines,
 * Gunther and Akenine-Moller, Ray Tracing Gems ch. 7). Returns whether any lane is on. */
INLINE int meet_spheres(const rays *r, real3 center, real radius, const mask active, meeting *m)
{
    const real3 f = SUB(real3, r->origin, center);
    const real b = -DOT(f, r->direction);
    const real approach = b * r->inv_dd;
    const real3 l = {fma(approach, r->direction.x, f.x), fma(approach, r->direction.y, f.y),
                     fma(approach, r->direction.z, f.z)};
    const real discriminant = fma(radius, radius, -DOT(l, l));
    m->on = active & MASK(discriminant >= (real)0.0f);
    if (!ANY(m->on))
        return 0;
    /* Of the two roots, the one that adds numbers of like sign is q / dd; the other follows from
     * their product c / dd. */
    const mask ahead = MASK(b >= (real)0.0f); /* for a zero of either sign */
    const real root = ROOT(r->dd * discriminant);
    const real q = b + SELECT(-root, root, ahead);
    const real c = fma(-radius, radius, DOT(f, f));
    const real sum = DIVIDE(q, r->dd);
    const real product = DIVIDE(c, q);
    const real near = SELECT(sum, product, ahead);
    const real far = SELECT(product, sum, ahead);
    m->t = SELECT(far, near, MASK(near > r->tmin));
    m->u = m->v = (real)0.0f;
    m->det = (real)1.0f;
    keep_in_sphere_box(r, center, radius, m);
    return 1;
}
#endif

#if RT_TRIANGLES
#define LESSEST(a, b, c) LESSER(LESSER(a, b), c)
#define GREATEST(a, b, c) GREATER(GREATER(a, b), c)
#define LEAST_CORNER(a, b, c)                                                                      \
    ((real3){LESSEST((a).x, (b).x, (c).x), LESSEST((a).y, (b).y, (c).y),                           \
             LESSEST((a).z, (b).z, (c).z)})
#define GREATEST_CORNER(a, b, c)                                                                   \
    ((real3){GREATEST((a).x, (b).x, (c).x), GREATEST((a).y, (b).y, (c).y),                         \
             GREATEST((a).z, (b).z, (c).z)})
#endif

#if RT_TRIANGLES && !RT_WATERTIGHT
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
