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
