/* The watertight triangle test of the levels robust and double.
 *
 * Corners are taken relative to the origin, then sheared so that the ray runs along the last axis
 * (Woop, Benthin and Wald 2013): a corner lands on the same point for every triangle that has it.
 * On which side of an edge the ray is, is told by a difference of products whose sign is exact
 * (Kahan; Jeannerod, Louvet and Muller 2013), so neighbours agree about their common edge. A ray
 * that runs exactly through an edge or a corner is thought of as moved by (e, e * e), e > 0
 * vanishing: it is then in exactly one of the triangles around. Only leaving the range of normal
 * numbers spoils this, and scenes are brought to where that does not happen (src/scene/scene.h,
 * unit). */
#if RT_WATERTIGHT

#define PERMUTED(v, is_x, is_y)                                                                    \
    ((real3){SELECT(SELECT((v).x, (v).z, is_y), (v).y, is_x),                                      \
             SELECT(SELECT((v).y, (v).x, is_y), (v).z, is_x),                                      \
             SELECT(SELECT((v).z, (v).y, is_y), (v).x, is_x)})

/* Once a ray. Returns which rays have a direction at all. */
INLINE mask set_up_shear(rays *r)
{
    const real x = fabs(r->direction.x), y = fabs(r->direction.y), z = fabs(r->direction.z);
    const mask is_x = MASK(x >= y) & MASK(x >= z);
    const mask is_y = MASK(y >= z) & ~is_x;
    const real3 d = PERMUTED(r->direction, is_x, is_y);
    r->axis = SELECT(SELECT((mask)2, (mask)1, is_y), (mask)0, is_x);
    r->from = PERMUTED(r->origin, is_x, is_y);
    r->onward = PERMUTED(r->inverse, is_x, is_y);
    r->sx = d.x * r->onward.z;
    r->sy = d.y * r->onward.z;
    return MASK(fabs(d.z) > (real)0.0f);
}

/* Corners in each ray's own order of axes. */
INLINE void permute_by_lane(const rays *r, real3 *a, real3 *b, real3 *c)
{
    const mask is_x = MASK(r->axis == (mask)0), is_y = MASK(r->axis == (mask)1);
    *a = PERMUTED(*a, is_x, is_y);
    *b = PERMUTED(*b, is_x, is_y);
    *c = PERMUTED(*c, is_x, is_y);
}

/* a * b - c * d with a relative error below 2 half ulps. */
#define DIFFERENCE_OF_PRODUCTS(result, a, b, c, d)                                                 \
    do {                                                                                           \
        const real product_ = (c) * (d);                                                           \
        result = fma(a, b, -product_) + fma(-(c), d, product_);                                    \
    } while (0)

/* A triangle as the rays see it: corners relative to the origin in the order of axes, `x`, `y`
 * sheared, `t` how far along the ray; each corner's weight, which is the area opposite to it. */
typedef struct corners {
    real3 a, b, c;
    real ax, ay, bx, by, cx, cy;
    real wa, wb, wc;
} corners;

/* Of rays that run through an edge or a corner, those that the triangle owns. */
INLINE mask owns(const corners *s, mask is_positive)
{
    const mask beyond_a = MASK(s->cy > s->by) | (MASK(s->cy == s->by) & MASK(s->bx > s->cx));
    const mask beyond_b = MASK(s->ay > s->cy) | (MASK(s->ay == s->cy) & MASK(s->cx > s->ax));
    const mask beyond_c = MASK(s->by > s->ay) | (MASK(s->by == s->ay) & MASK(s->ax > s->bx));
    return (MASK(s->wa != (real)0.0f) | ~(beyond_a ^ is_positive)) &
           (MASK(s->wb != (real)0.0f) | ~(beyond_b ^ is_positive)) &
           (MASK(s->wc != (real)0.0f) | ~(beyond_c ^ is_positive));
}

#define FARTHEST_OF(v) GREATEST(fabs((v).x), fabs((v).y), fabs((v).z))

/* t where the corners are far away beside it, as of a floor that reaches to the horizon: a mean of
 * theirs cancels then. It is det times t, the volume that the corners span with the origin, by sums
 * and products that carry their rounding errors (Knuth; Ogita, Rump and Oishi 2005). `bound` is
 * what rounding can make of t all the same, but for a few ulp of t. From the corners mirrored in
 * the origin, which changes signs alone: taken anew, or the compiler keeps those of the test in
 * memory for what is rarely asked. */
INLINE real near_t(const rays *r, real3 a, real3 b, real3 c, const mask sign, real det, real *bound)
{
    real3 f, g, h, rest_f, rest_g, rest_h;
    TWO_DIFFERENCE_3(f, rest_f, r->from, a);
    TWO_DIFFERENCE_3(g, rest_g, r->from, b);
    TWO_DIFFERENCE_3(h, rest_h, r->from, c);
    real area_f, area_g, area_h, low_f, low_g, low_h;
    TWOFOLD_DIFFERENCE(real, area_f, low_f, h.x, g.y, h.y, g.x);
    TWOFOLD_DIFFERENCE(real, area_g, low_g, f.x, h.y, f.y, h.x);
    TWOFOLD_DIFFERENCE(real, area_h, low_h, g.x, f.y, g.y, f.x);
    const real part_f = f.z * area_f, part_g = g.z * area_g, part_h = h.z * area_h;
    low_f = fma(f.z, low_f, fma(f.z, area_f, -part_f));
    low_g = fma(g.z, low_g, fma(g.z, area_g, -part_g));
    low_h = fma(h.z, low_h, fma(h.z, area_h, -part_h));
    real two, three, low_two, low_three;
    TWO_SUM(two, low_two, part_f, part_g);
    TWO_SUM(three, low_three, two, part_h);
    const real rest = DOT(rest_f, CROSS(real3, h, g)) + DOT(rest_g, CROSS(real3, f, h)) +
                      DOT(rest_h, CROSS(real3, g, f));
    const real volume = three + (((low_two + low_three) + (low_f + low_g + low_h)) + rest);
    const real far = GREATEST(FARTHEST_OF(f), FARTHEST_OF(g), FARTHEST_OF(h));
    const real part = DIVIDE(r->onward.z, det);
    *bound = (real)(512 * RT_HALF_ULP * RT_HALF_ULP) * fabs(part) * far * far * far;
    return -AS_REAL(AS_MASK(volume) ^ sign) * part;
}

/* Corners so many times as far along the ray are far away. */
#define FAR_CORNERS 64

/* Corners in the rays' order of axes. Returns whether any lane is on. What is rarely asked takes a
 * lane out by a determinant of 0: compilers do worse with masks that branches change. */
INLINE int meet_triangles(const rays *r, real3 a, real3 b, real3 c, const mask active, meeting *m)
{
    corners s;
    s.a = SUB(real3, a, r->from);
    s.b = SUB(real3, b, r->from);
    s.c = SUB(real3, c, r->from);
    s.ax = fma(-r->sx, s.a.z, s.a.x);
    s.ay = fma(-r->sy, s.a.z, s.a.y);
    s.bx = fma(-r->sx, s.b.z, s.b.x);
    s.by = fma(-r->sy, s.b.z, s.b.y);
    s.cx = fma(-r->sx, s.c.z, s.c.x);
    s.cy = fma(-r->sy, s.c.z, s.c.y);
    DIFFERENCE_OF_PRODUCTS(s.wa, s.cx, s.by, s.cy, s.bx);
    DIFFERENCE_OF_PRODUCTS(s.wb, s.ax, s.cy, s.ay, s.cx);
    DIFFERENCE_OF_PRODUCTS(s.wc, s.bx, s.ay, s.by, s.ax);
    const real least = LESSEST(s.wa, s.wb, s.wc);
    const real most = GREATEST(s.wa, s.wb, s.wc);
    const mask is_positive = MASK(least >= (real)0.0f);
    m->on = active & (is_positive | MASK(most <= (real)0.0f));
    if (!ANY(m->on))
        return 0;
    const real signed_det = s.wa + s.wb + s.wc;
    const mask sign = AS_MASK(signed_det) & (mask)SIGN_BIT;
    m->det = AS_REAL(AS_MASK(signed_det) ^ sign);
#if RT_CULL
    /* The sign of Moller and Trumbore's determinant. */
    const real facing = AS_REAL(AS_MASK(signed_det) ^ (AS_MASK(r->onward.z) & (mask)SIGN_BIT));
    m->on = m->on & MASK(facing * (real)RT_CULL > (real)0.0f);
#endif
    if (ANY(m->on & (MASK(least == (real)0.0f) | MASK(most == (real)0.0f))))
        m->det = SELECT((real)0.0f, m->det, owns(&s, is_positive));
    const real at = s.a.z * r->onward.z;
    const real bt = s.b.z * r->onward.z;
    const real ct = s.c.z * r->onward.z;
    const real sum = fma(s.wa, at, fma(s.wb, bt, s.wc * ct));
    m->t = DIVIDE(AS_REAL(AS_MASK(sum) ^ sign), m->det);
    m->u = AS_REAL(AS_MASK(s.wb) ^ sign);
    m->v = AS_REAL(AS_MASK(s.wc) ^ sign);
    /* A hit that is nearer than its own error does not count (pbrt 4th ed. 6.8). Where no corner is
     * far away, the sign of t is sure. */
    const real farthest_t = GREATEST(fabs(at), fabs(bt), fabs(ct));
    const mask is_near = MASK(farthest_t > (real)FAR_CORNERS * fabs(m->t));
    if (ANY(m->on & MASK(m->det > (real)0.0f) & is_near)) {
        real bound;
        const real t = near_t(r, a, b, c, sign, m->det, &bound);
        m->t = SELECT(m->t, t, is_near);
        m->det = SELECT(m->det, (real)0.0f, is_near & ~MASK(t > bound));
    }
    m->on = m->on & MASK(m->det > (real)0.0f);
    keep_in_box(r->from, r->onward, r->tmin, LEAST_CORNER(a, b, c), GREATEST_CORNER(a, b, c), m);
    return 1;
}
#endif
