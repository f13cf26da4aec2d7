/* One primitive against RT_LANES rays. The least t in (tmin, t of the hit so far) wins; primitives
 * are offered by ascending index, so the strict comparison keeps the lowest index among equals.
 * Every test is written so that a NaN means a miss. */

typedef struct rays {
    real3 origin, direction;
    real tmin;
    real inv_dd; /* 1 / dot(direction, direction) */
    real dd;
} rays;

typedef struct hits {
    mask index; /* RT_MISS where nothing is hit yet */
    real t, u, v;
} hits;

#if RT_SPHERES
/* Nearest root of |o + t d - c| = r beyond tmin. The discriminant comes from the ray's closest
 * approach to the centre, not from b*b - a*c, which cancels for small or far spheres (Haines,
 * Gunther and Akenine-Moller, Ray Tracing Gems ch. 7). */
void hit_sphere(const rays *r, hits *h, rt_sphere sphere, int index)
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
        return;
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
    const mask on = meets & MASK(t > r->tmin) & MASK(t < h->t);
    h->t = SELECT(h->t, t, on);
    h->u = SELECT(h->u, (real)0.0f, on);
    h->v = SELECT(h->v, (real)0.0f, on);
    h->index = SELECT(h->index, (mask)index, on);
}
#endif

#if RT_TRIANGLES
/* Moller and Trumbore 1997. Barycentric bounds are tested before any division, against the
 * determinant itself: there is no epsilon, so the test is the same at every scale. */
void hit_triangle(const rays *r, hits *h, rt_triangle triangle, int index)
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
        return;
    const real t = DIVIDE(AS_REAL(AS_MASK(DOT(e2, q)) ^ sign), det);
    const mask on = inside & MASK(t > r->tmin) & MASK(t < h->t);
    if (!ANY(on))
        return;
    h->t = SELECT(h->t, t, on);
    h->u = SELECT(h->u, DIVIDE(u, det), on);
    h->v = SELECT(h->v, DIVIDE(v, det), on);
    h->index = SELECT(h->index, (mask)index, on);
}
#endif
