/* Triangles: rays against them at each level but for the robust test (watertight.cl), one in all
 * lanes or a block in the lanes; their surface, and where on a picture a point of it is. */
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

/* ---- Its surface ---- */

/* Replaces `normal`, the geometric one turned toward the ray, by the interpolated vertex normal on
 * the same side; leaves it where the vertex normals cancel. */
INLINE void smooth_normal(__global const float *n, number u, number v, vec3 *normal)
{
    const number w = 1.0f - u - v;
    const vec3 na = {n[0], n[1], n[2]};
    const vec3 nb = {n[3], n[4], n[5]};
    const vec3 nc = {n[6], n[7], n[8]};
    vec3 unit = {fma(v, nc.x, fma(u, nb.x, w * na.x)), fma(v, nc.y, fma(u, nb.y, w * na.y)),
                 fma(v, nc.z, fma(u, nb.z, w * na.z))};
    const int has_direction = make_unit_if_any(&unit);
    const number side = DOT(unit, *normal);
    if (has_direction)
        *normal = SCALE(unit, side < 0.0f ? -1.0f : 1.0f);
}

/* A coordinate of a point of a triangle, between those of its corners. */
INLINE number within_corners(number x, number a, number b, number c)
{
    return BETWEEN(x, LESSER_1(LESSER_1(a, b), c), GREATER_1(GREATER_1(a, b), c));
}

#if RT_ACCURACY >= RT_ROBUST
/* Corners whose sizes are together so many times those of the ray's origin and the point are far
 * away. */
#define FAR_CORNERS_OF_START 64
/* A good part of the way to the middle, beside which what t is off is small. */
#define POINT_DRAW (256 * RT_HALF_ULP)

/* On a floor that reaches to the horizon, a sum of corners by weight is anywhere within a rounding
 * of the corners. There rays start at the point on the ray, drawn toward the triangle's middle and
 * brought onto its plane. How far it is off the plane is the volume that it spans with two edges
 * over the area that they span, by sums and products that carry their rounding errors (Knuth;
 * Ogita, Rump and Oishi 2005). `sizes` are the corners', axis by axis. */
INLINE void start_at_point(vec3 a, vec3 b, vec3 c, vec3 sizes, vec3 normal, vec3 origin, surface *s)
{
    const number far = sizes.x + sizes.y + sizes.z;
    const number near = fabs(origin.x) + fabs(origin.y) + fabs(origin.z) + fabs(s->point.x) +
                        fabs(s->point.y) + fabs(s->point.z);
    const int is_far = far > (number)FAR_CORNERS_OF_START * near;
    const number draw = (number)POINT_DRAW * (near * moderating_factor(sizes));
    const number third = (number)1.0f / (number)3.0f;
    const vec3 point = {fma(draw, fma(third, a.x + b.x + c.x, -s->point.x), s->point.x),
                        fma(draw, fma(third, a.y + b.y + c.y, -s->point.y), s->point.y),
                        fma(draw, fma(third, a.z + b.z + c.z, -s->point.z), s->point.z)};
    vec3 f, g, h, rest_f, rest_g, rest_h, n, low;
    TWO_DIFFERENCE_3(f, rest_f, point, a);
    TWO_DIFFERENCE_3(g, rest_g, b, a);
    TWO_DIFFERENCE_3(h, rest_h, c, a);
    const number of_g = moderating_factor(g), of_h = moderating_factor(h);
    g = SCALE(g, of_g);
    h = SCALE(h, of_h);
    rest_g = SCALE(rest_g, of_g);
    rest_h = SCALE(rest_h, of_h);
    TWOFOLD_DIFFERENCE(number, n.x, low.x, g.y, h.z, g.z, h.y);
    TWOFOLD_DIFFERENCE(number, n.y, low.y, g.z, h.x, g.x, h.z);
    TWOFOLD_DIFFERENCE(number, n.z, low.z, g.x, h.y, g.y, h.x);
    const vec3 by_g = CROSS(vec3, rest_g, h), by_h = CROSS(vec3, g, rest_h);
    low.x += by_g.x + by_h.x;
    low.y += by_g.y + by_h.y;
    low.z += by_g.z + by_h.z;
    const vec3 parts = MULTIPLY(f, n);
    number two, three, low_two, low_three;
    TWO_SUM(two, low_two, parts.x, parts.y);
    TWO_SUM(three, low_three, two, parts.z);
    const number low_parts =
        fma(f.x, n.x, -parts.x) + fma(f.y, n.y, -parts.y) + fma(f.z, n.z, -parts.z);
    const number volume =
        three + (((low_two + low_three) + low_parts) + (DOT(f, low) + DOT(rest_f, n)));
    const number inverse = DIVIDE_1(1.0f, DOT(n, normal));
    const number off = volume * inverse;
    const number reach = GREATER_1(GREATER_1(fabs(f.x), fabs(f.y)), fabs(f.z));
    const number lift = fma((number)RT_START_BOUND,
                            EXTENT_ALONG(normal, fabs(point.x), fabs(point.y), fabs(point.z)),
                            (number)(512 * RT_HALF_ULP * RT_HALF_ULP) * (reach * inverse));
    s->start = (vec3){is_far ? fma(-off, normal.x, point.x) : s->start.x,
                      is_far ? fma(-off, normal.y, point.y) : s->start.y,
                      is_far ? fma(-off, normal.z, point.z) : s->start.z};
    s->lift = is_far ? lift : s->lift;
}
#endif

/* The normals are made from the edges as they are and made unit last: made unit before the
 * barycentric test they would shrink the triangle, left as they are they would turn highlights
 * white. */
INLINE void triangle_surface(const traced *w, int index, __global const rt_triangle_block *t, int k,
                             number u, number v, vec3 origin, vec3 direction, surface *s)
{
    const vec3 a = {t->ax[k], t->ay[k], t->az[k]};
    const vec3 b = {t->bx[k], t->by[k], t->bz[k]};
    const vec3 c = {t->cx[k], t->cy[k], t->cz[k]};
    const vec3 e1 = SUB(vec3, b, a);
    const vec3 e2 = SUB(vec3, c, a);
    /* Each edge by a power of two of its own, or the product of long ones would overflow. */
    const vec3 f1 = SCALE(e1, moderating_factor(e1));
    const vec3 f2 = SCALE(e2, moderating_factor(e2));
    vec3 normal = CROSS(vec3, f1, f2);
    make_unit(&normal);
    const number side = side_toward(normal, direction);

    const number third = 1.0f / 3.0f;
    const number pu = fma((number)RT_START_DRAW, third - u, u);
    const number pv = fma((number)RT_START_DRAW, third - v, v);
    const number pw = 1.0f - pu - pv;
    s->start = (vec3){fma(pv, c.x, fma(pu, b.x, pw * a.x)), fma(pv, c.y, fma(pu, b.y, pw * a.y)),
                      fma(pv, c.z, fma(pu, b.z, pw * a.z))};
    const vec3 sizes = {SUM_OF_SIZES(a.x, b.x, c.x), SUM_OF_SIZES(a.y, b.y, c.y),
                        SUM_OF_SIZES(a.z, b.z, c.z)};
    s->lift = (number)RT_START_BOUND * EXTENT_ALONG(normal, sizes.x, sizes.y, sizes.z);
#if RT_ACCURACY >= RT_ROBUST
    start_at_point(a, b, c, sizes, normal, origin, s);
#endif
    s->within =
        (vec3){within_corners(s->point.x, a.x, b.x, c.x), within_corners(s->point.y, a.y, b.y, c.y),
               within_corners(s->point.z, a.z, b.z, c.z)};
    s->facing = SCALE(normal, side);
    s->normal = SCALE(normal, side);
    s->outside = side > 0.0f;
    const int record = RT_SMOOTH ? w->normals_of[index] : -1;
    if (record >= 0)
        smooth_normal(w->normals + (size_t)record * RT_NORMAL_COMPONENTS, u, v, &s->normal);
}

INLINE void triangle_picture_point(const pictures *p, int index, number u, number v,
                                   const surface *s, texture_place *at)
{
    const int record = p->uvs_of[index];
    if (record < 0)
        return;
    __global const float *uv = p->uvs + (size_t)record * RT_UV_COMPONENTS;
    const number rest = (number)1.0f - u - v;
    at->x = fma(v, (number)uv[4], fma(u, (number)uv[2], rest * (number)uv[0]));
    at->y = fma(v, (number)uv[5], fma(u, (number)uv[3], rest * (number)uv[1]));
}
