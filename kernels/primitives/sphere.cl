/* The sphere test of the levels robust and double: hit or miss as exact arithmetic decides it, but
 * for rays within 8 ulp of touching, whether the sphere is small and far or large and near.
 *
 * The difference origin - centre is exact, as a sum of two numbers (Knuth's two-sum); the distance
 * of ray and centre is a cross product whose components have a relative error of a few half ulps
 * (Kahan); dot products that cancel near a large sphere's surface are compensated (Ogita, Rump and
 * Oishi 2005). All is + - * and fma in one precision: the bits are the same on devices with and
 * without fp64. */
#if RT_SPHERES && RT_ACCURACY >= RT_ROBUST

/* sum + error = a + b exactly. */
#define TWO_SUM(sum, error, a, b)                                                                  \
    do {                                                                                           \
        sum = (a) + (b);                                                                           \
        const real part_ = sum - (a);                                                              \
        error = ((a) - (sum - part_)) + ((b)-part_);                                               \
    } while (0)

INLINE real difference_of_products(real a, real b, real c, real d)
{
    const real product = c * d;
    return fma(a, b, -product) + fma(-c, d, product);
}

/* The sum of products f.x g.x + f.y g.y + f.z g.z + rest, as if in twice the precision; `small` is
 * what is to be added in plain. */
INLINE real compensated_dot(real3 f, real3 g, real rest, real small)
{
    const real px = f.x * g.x, py = f.y * g.y, pz = f.z * g.z;
    real s1, s2, s3, e1, e2, e3;
    TWO_SUM(s1, e1, px, py);
    TWO_SUM(s2, e2, s1, pz);
    TWO_SUM(s3, e3, s2, rest);
    const real products = fma(f.x, g.x, -px) + fma(f.y, g.y, -py) + fma(f.z, g.z, -pz);
    return s3 + (((e1 + e2) + (e3 + products)) + small);
}

/* Nearest root of |o + t d - c| = r beyond tmin. Returns whether any lane is on. */
INLINE int meet_spheres(const rays *r, real3 center, real radius, const mask active, meeting *m)
{
    const real3 d = r->direction;
    real3 f, g;
    TWO_SUM(f.x, g.x, r->origin.x, -center.x);
    TWO_SUM(f.y, g.y, r->origin.y, -center.y);
    TWO_SUM(f.z, g.z, r->origin.z, -center.z);
    const real3 cross = {difference_of_products(f.y, d.z, f.z, d.y) + fma(g.y, d.z, -(g.z * d.y)),
                         difference_of_products(f.z, d.x, f.x, d.z) + fma(g.z, d.x, -(g.x * d.z)),
                         difference_of_products(f.x, d.y, f.y, d.x) + fma(g.x, d.y, -(g.y * d.x))};
    const real rr = radius * radius;
    const real discriminant = fma(rr, r->dd, -DOT(cross, cross));
    m->on = active & MASK(discriminant >= (real)0.0f);
    if (!ANY(m->on))
        return 0;
    const real b = -compensated_dot(f, d, (real)0.0f, DOT(g, d));
    const real c =
        compensated_dot(f, f, -rr, fma((real)2.0f, DOT(f, g), -fma(radius, radius, -rr)));
    /* Near the surface the roots' product is the better known. */
    const real by_product = difference_of_products(b, b, r->dd, c);
    const mask near_surface = MASK(fabs(c) * (real)4.0f < rr);
    const real root = ROOT(SELECT(discriminant, GREATER(by_product, (real)0.0f), near_surface));
    const mask ahead = MASK(b >= (real)0.0f); /* for a zero of either sign */
    const real q = b + SELECT(-root, root, ahead);
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
