/* One primitive against RT_LANES rays. The nearest hit is the least t in (tmin, tmax), and among
 * equals that of the lowest primitive index, whatever the order in which primitives are offered.
 * Every test is written so that a NaN means a miss. Tests return whether any lane took the hit. */

typedef struct rays {
    real3 origin, direction;
    real3 inverse; /* 1 / direction, finite: the largest float where a component is 0 */
    real tmin;
    real dd, inv_dd; /* dot(direction, direction) and its reciprocal */
} rays;

typedef struct hits {
    mask index; /* RT_MISS where nothing is hit yet */
    mask slot;  /* where the primitive lies among those of its kind on the device */
    real t;
    real u, v, det; /* barycentric coordinates times det; divided once, when the walk is over */
} hits;

/* The part of the rays within a box, as t from `enter` to `leave`; empty where enter > leave. The
 * operations are monotone in the box, rounding included, so that the interval of a box contains
 * that of any box inside it exactly: a walk that skips a node by this test never skips a hit that
 * has been kept in its primitive's own interval. */
INLINE void box_interval(const rays *r, float lo_x, float hi_x, float lo_y, float hi_y, float lo_z,
                         float hi_z, real *enter, real *leave)
{
    const real x0 = ((real)lo_x - r->origin.x) * r->inverse.x;
    const real x1 = ((real)hi_x - r->origin.x) * r->inverse.x;
    const real y0 = ((real)lo_y - r->origin.y) * r->inverse.y;
    const real y1 = ((real)hi_y - r->origin.y) * r->inverse.y;
    const real z0 = ((real)lo_z - r->origin.z) * r->inverse.z;
    const real z1 = ((real)hi_z - r->origin.z) * r->inverse.z;
    *enter = GREATER(GREATER(LESSER(x0, x1), LESSER(y0, y1)), LESSER(z0, z1));
    *leave =
        LESSER(LESSER(GREATER(x0, x1), GREATER(y0, y1)), GREATER(z0, z1)) * (real)RT_SLAB_MARGIN;
}

/* A primitive's box along one axis, widened. */
typedef struct extent {
    float lo, hi;
} extent;

#define WIDEN_EXTENT(low, high, out)                                                               \
    do {                                                                                           \
        const float low_ = (low), high_ = (high);                                                  \
        const float margin_ = (fabs(low_) + fabs(high_)) * RT_BOX_MARGIN;                          \
        (out).lo = low_ - margin_;                                                                 \
        (out).hi = high_ + margin_;                                                                \
    } while (0)

/* Takes `t` as the hit of a primitive in the lanes of `on`, if it is nearer than what is there.
 * Moller and Trumbore's t on a sliver or a grazing ray can lie outside of the triangle by far; it
 * is kept within the primitive's own box. Returns the lanes that took it. */
INLINE mask accept(const rays *r, hits *h, mask on, real t, real enter, real leave, int index,
                   int slot)
{
    on = on & MASK(enter <= leave);
    t = LESSER(GREATER(t, enter), leave);
    const mask nearer = MASK(t < h->t) | (MASK(t == h->t) & MASK((mask)index < h->index));
    on = on & MASK(t > r->tmin) & nearer;
    h->t = SELECT(h->t, t, on);
    h->index = SELECT(h->index, (mask)index, on);
    h->slot = SELECT(h->slot, (mask)slot, on);
    return on;
}

#if RT_SPHERES
/* Nearest root of |o + t d - c| = r beyond tmin. The discriminant comes from the ray's closest
 * approach to the centre, not from b*b - a*c, which cancels for small or far spheres (Haines,
 * Gunther and Akenine-Moller, Ray Tracing Gems ch. 7). */
INLINE int hit_sphere(const rays *r, hits *h, rt_sphere sphere, int index, int slot)
{
    const real3 center = SPLAT3(sphere.cx, sphere.cy, sphere.cz);
    const real radius = (real)sphere.radius;
    const real3 f = SUB(real3, r->origin, center);
    const real b = -DOT(f, r->direction);
    const real approach = b * r->inv_dd;
    const real3 l = {fma(approach, r->direction.x, f.x), fma(approach, r->direction.y, f.y),
                     fma(approach, r->direction.z, f.z)};
    const real discriminant = fma(radius, radius, -DOT(l, l));
    const mask meets = MASK(discriminant >= (real)0.0f);
    if (!ANY(meets))
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
    const real t = SELECT(far, near, MASK(near > r->tmin));
    extent x, y, z;
    WIDEN_EXTENT(sphere.cx - sphere.radius, sphere.cx + sphere.radius, x);
    WIDEN_EXTENT(sphere.cy - sphere.radius, sphere.cy + sphere.radius, y);
    WIDEN_EXTENT(sphere.cz - sphere.radius, sphere.cz + sphere.radius, z);
    real enter, leave;
    box_interval(r, x.lo, x.hi, y.lo, y.hi, z.lo, z.hi, &enter, &leave);
    const mask on = accept(r, h, meets, t, enter, leave, index, slot);
    h->u = SELECT(h->u, (real)0.0f, on);
    h->v = SELECT(h->v, (real)0.0f, on);
    h->det = SELECT(h->det, (real)1.0f, on);
    return ANY(on);
}
#endif

#if RT_TRIANGLES
#define LESSEST(a, b, c) LESSER_1(LESSER_1(a, b), c)
#define GREATEST(a, b, c) GREATER_1(GREATER_1(a, b), c)

/* Moller and Trumbore 1997. Barycentric bounds are tested before any division, against the
 * determinant itself: there is no epsilon, so the test is the same at every scale. */
INLINE int hit_triangle(const rays *r, hits *h, rt_triangle triangle, int index, int slot)
{
    const real3 a = SPLAT3(triangle.ax, triangle.ay, triangle.az);
    const real3 e1 =
        SPLAT3(triangle.bx - triangle.ax, triangle.by - triangle.ay, triangle.bz - triangle.az);
    const real3 e2 =
        SPLAT3(triangle.cx - triangle.ax, triangle.cy - triangle.ay, triangle.cz - triangle.az);
    const real3 p = CROSS(real3, r->direction, e2);
    const real signed_det = DOT(e1, p);
    /* Multiplying by the determinant's sign, as one flip of the sign bit. */
    const mask sign = AS_MASK(signed_det) & (mask)0x80000000;
    const real det = AS_REAL(AS_MASK(signed_det) ^ sign);
#if RT_CULL > 0
    const mask facing = MASK(signed_det > (real)0.0f);
#elif RT_CULL < 0
    const mask facing = MASK(signed_det < (real)0.0f);
#else
    const mask facing = MASK(det > (real)0.0f);
#endif
    const real3 s = SUB(real3, r->origin, a);
    const real u = AS_REAL(AS_MASK(DOT(s, p)) ^ sign);
    const real3 q = CROSS(real3, s, e1);
    const real v = AS_REAL(AS_MASK(DOT(r->direction, q)) ^ sign);
    const mask inside = facing & MASK(u >= (real)0.0f) & MASK(v >= (real)0.0f) & MASK(u + v <= det);
    if (!ANY(inside))
        return 0;
    const real t = DIVIDE(AS_REAL(AS_MASK(DOT(e2, q)) ^ sign), det);
    extent x, y, z;
    WIDEN_EXTENT(LESSEST(triangle.ax, triangle.bx, triangle.cx),
                 GREATEST(triangle.ax, triangle.bx, triangle.cx), x);
    WIDEN_EXTENT(LESSEST(triangle.ay, triangle.by, triangle.cy),
                 GREATEST(triangle.ay, triangle.by, triangle.cy), y);
    WIDEN_EXTENT(LESSEST(triangle.az, triangle.bz, triangle.cz),
                 GREATEST(triangle.az, triangle.bz, triangle.cz), z);
    real enter, leave;
    box_interval(r, x.lo, x.hi, y.lo, y.hi, z.lo, z.hi, &enter, &leave);
    const mask on = accept(r, h, inside, t, enter, leave, index, slot);
    h->u = SELECT(h->u, u, on);
    h->v = SELECT(h->v, v, on);
    h->det = SELECT(h->det, det, on);
    return ANY(on);
}
#endif
