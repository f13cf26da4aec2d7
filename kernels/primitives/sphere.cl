/* Spheres: rays against them at each level, one in all lanes or a block in the lanes; their
 * surface, and where on a picture a point of it is. */
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

/* The nearest root beyond tmin of dd t t - 2 b t + c = 0, of whose discriminant `root` is the root.
 * Of the two, the one that adds numbers of like sign is q / dd; the other follows from their
 * product c / dd. */
INLINE void meet_at_root(const rays *r, real3 center, real radius, real b, real c, real root,
                         meeting *m)
{
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
}

#if RT_ACCURACY >= RT_ROBUST
/* The sphere test of the levels robust and double: hit or miss as exact arithmetic decides it, but
 * for rays within 8 ulp of touching, whether the sphere is small and far or large and near. Most
 * rays need no more than the plain test: where it tells by more than its rounding whether there is
 * a hit, from far enough outside, its numbers are good to a few ulp. For the others (rays that all
 * but touch, that start near the surface or inside) the sums are exact:
 *
 * The difference origin - centre is exact, as a sum of two numbers (Knuth's two-sum); the distance
 * of ray and centre is a cross product whose components have a relative error of a few half ulps
 * (Kahan); dot products that cancel near a large sphere's surface are compensated (Ogita, Rump and
 * Oishi 2005). All is + - * and fma in one precision: the bits are the same on devices with and
 * without fp64. */

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

/* Puts the exact b, c and discriminant in the place of the plain ones in the lanes of `rest`. From
 * the origin to the centre, as the plain test does not: what both compute alike the compiler would
 * keep in memory. */
INLINE void make_exact(const rays *r, real3 center, real radius, const mask rest, real *b, real *c,
                       real *discriminant)
{
    const real3 d = r->direction;
    real3 f, g;
    TWO_DIFFERENCE_3(f, g, center, r->origin);
    const real3 cross = {difference_of_products(f.y, d.z, f.z, d.y) + fma(g.y, d.z, -(g.z * d.y)),
                         difference_of_products(f.z, d.x, f.x, d.z) + fma(g.z, d.x, -(g.x * d.z)),
                         difference_of_products(f.x, d.y, f.y, d.x) + fma(g.x, d.y, -(g.y * d.x))};
    const real rr = radius * radius;
    const real by_distance = fma(rr, r->dd, -DOT(cross, cross));
    const real exact_b = compensated_dot(f, d, (real)0.0f, DOT(g, d));
    const real exact_c =
        compensated_dot(f, f, -rr, fma((real)2.0f, DOT(f, g), -fma(radius, radius, -rr)));
    /* Near the surface the roots' product is the better known; hit or miss is by the distance. */
    const real by_product = difference_of_products(exact_b, exact_b, r->dd, exact_c);
    const mask near_surface =
        MASK(by_distance >= (real)0.0f) & MASK(fabs(exact_c) * (real)4.0f < rr);
    const real exact = SELECT(by_distance, GREATER(by_product, (real)0.0f), near_surface);
    *b = SELECT(*b, exact_b, rest);
    *c = SELECT(*c, exact_c, rest);
    *discriminant = SELECT(*discriminant, exact, rest);
}

/* What rounding can make of rr - ll, of which l is off by a half ulp of f and a few of its own: 7
 * |f| r half ulps at most, and, since `approach` is off too, 50 squares of a half ulp of |f|. */
#define GAP_BOUND (16 * RT_HALF_ULP)
#define GAP_BOUND_FAR (128 * RT_HALF_ULP * RT_HALF_ULP)
/* What it can make of ff - rr, as a part of ff. */
#define OUTSIDE_BOUND (8 * RT_HALF_ULP)
#endif

/* Nearest root of |o + t d - c| = r beyond tmin. The discriminant comes from the ray's closest
 * approach to the centre, not from b*b - a*c, which cancels for small or far spheres (Haines,
 * Gunther and Akenine-Moller, Ray Tracing Gems ch. 7). Returns whether any lane is on. */
INLINE int meet_spheres(const rays *r, real3 center, real radius, const mask active, meeting *m)
{
    const real3 f = SUB(real3, r->origin, center);
    const real ff = DOT(f, f);
    real b = -DOT(f, r->direction);
    real c = fma(-radius, radius, ff);
    const real approach = b * r->inv_dd;
    const real3 l = {fma(approach, r->direction.x, f.x), fma(approach, r->direction.y, f.y),
                     fma(approach, r->direction.z, f.z)};
    const real gap = fma(radius, radius, -DOT(l, l));
    real discriminant = r->dd * gap;
#if RT_ACCURACY >= RT_ROBUST
    /* Conditions as extremes of numbers: compilers do worse with many truths of lanes. */
    const real rr = radius * radius;
    const real far = (real)(GAP_BOUND_FAR * GAP_BOUND_FAR);
    const real bound = fma(ff, far, rr * (real)(GAP_BOUND * GAP_BOUND));
    const real doubt = fma(-gap, gap, ff * bound);
    m->on = active & MASK(GREATER(gap, doubt) >= (real)0.0f);
    if (!ANY(m->on))
        return 0;
    const mask rest = MASK(GREATER(doubt, rr - c) >= (real)0.0f);
    if (ANY(m->on & rest)) {
        /* Not from outside of the sphere away from it, as from its own surface. */
        const real ahead = GREATER(GREATER(fma(ff, (real)OUTSIDE_BOUND, -c), b), -r->tmin);
        discriminant = SELECT(discriminant, (real)-1.0f, rest & MASK(ahead <= (real)0.0f));
        const mask left = rest & MASK(ahead > (real)0.0f);
        if (ANY(m->on & left))
            make_exact(r, center, radius, left, &b, &c, &discriminant);
        if (!ANY(m->on & MASK(discriminant >= (real)0.0f)))
            return 0;
    }
    m->on = m->on & MASK(discriminant >= (real)0.0f);
#else
    m->on = active & MASK(gap >= (real)0.0f);
    if (!ANY(m->on))
        return 0;
#endif
    meet_at_root(r, center, radius, b, c, ROOT(discriminant), m);
    return 1;
}

/* Offers a block to the groups whose bits are set. */
INLINE int offer_spheres(packet *p, int groups, const world *w, int block, const int any)
{
    __global const rt_sphere_block *s = w->spheres + block;
    __global const int *order = order_of(w, RT_KIND_SPHERES, block);
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

#if RT_ONE_BY_ONE
INLINE void meet_block_of_spheres(const rays *r, hit *h, const world *w, int block, const int any)
{
    meeting m;
    __global const rt_sphere_block *s = w->spheres + block;
    const real3 center = {BLOCK_LOAD(s->cx), BLOCK_LOAD(s->cy), BLOCK_LOAD(s->cz)};
    if (meet_spheres(r, center, BLOCK_LOAD(s->radius), BLOCK_LANES, &m))
        take_best(h, &m, BLOCK_LOAD_INDEX(order_of(w, RT_KIND_SPHERES, block)), block, any);
}
#endif
#endif

/* ---- Its surface ---- */

/* A coordinate of a point of a sphere, within its box and below the upper face of that. */
INLINE number within_sphere(number x, number center, number radius)
{
    const number top = center + radius;
    return BETWEEN(x, center - radius, fma(-(number)RT_SPHERE_CELL_MARGIN, fabs(top), top));
}

INLINE void sphere_surface(const traced *w, int index, __global const rt_sphere_block *block, int k,
                           number u, number v, vec3 origin, vec3 direction, surface *s)
{
    const vec3 center = {block->cx[k], block->cy[k], block->cz[k]};
    const number radius = block->radius[k];
    /* Where the radius is below an ulp of the centre, the point can be the centre itself: its
     * normal is back along the ray. */
    vec3 normal = SUB(vec3, s->point, center);
    const int has_direction = make_unit_if_any(&normal);
    normal.x = has_direction ? normal.x : -direction.x;
    normal.y = has_direction ? normal.y : -direction.y;
    normal.z = has_direction ? normal.z : -direction.z;
    const number side = side_toward(normal, direction);
    s->start = (vec3){fma(radius, normal.x, center.x), fma(radius, normal.y, center.y),
                      fma(radius, normal.z, center.z)};
    s->within = (vec3){within_sphere(s->point.x, center.x, radius),
                       within_sphere(s->point.y, center.y, radius),
                       within_sphere(s->point.z, center.z, radius)};
    s->lift =
        (number)RT_START_BOUND * EXTENT_ALONG(normal, fma(radius, fabs(normal.x), fabs(center.x)),
                                              fma(radius, fabs(normal.y), fabs(center.y)),
                                              fma(radius, fabs(normal.z), fabs(center.z)));
    if (RT_ACCURACY >= RT_ROBUST) {
        const number lift =
            (number)RT_POINT_BOUND * EXTENT_ALONG(normal, fabs(origin.x) + fabs(s->point.x),
                                                  fabs(origin.y) + fabs(s->point.y),
                                                  fabs(origin.z) + fabs(s->point.z));
        const int is_better = lift < s->lift;
        s->start = (vec3){is_better ? s->point.x : s->start.x, is_better ? s->point.y : s->start.y,
                          is_better ? s->point.z : s->start.z};
        s->lift = is_better ? lift : s->lift;
    }
    s->facing = SCALE(normal, side);
    s->normal = SCALE(normal, side); /* no copy: a struct in memory ends vectorising */
    s->outside = side > 0.0f;
}

/* By longitude, which goes round, and latitude, which ends at the poles, about the y axis. */
INLINE void sphere_picture_point(const pictures *p, int index, number u, number v, const surface *s,
                                 texture_place *at)
{
    const vec3 out = SCALE(s->facing, s->outside ? (number)1.0f : (number)-1.0f);
    const number pole = fmin(fmax(out.y, (number)-1.0f), (number)1.0f);
    at->x = fma(atan2(out.x, out.z), (number)0.15915494f, (number)0.5f);
    at->y = fma(asin(pole), (number)0.31830989f, (number)0.5f);
    at->repeats_x = 1;
    at->repeats_y = 0;
}
