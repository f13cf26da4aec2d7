/* What a ray has met: the point, its normals, and where the rays that go on from there start.
 *
 * A next ray must neither hit the very primitive that it starts on nor start behind a neighbour.
 * - It starts on the primitive, not on the ray: on a sphere at center + radius * normal, on a
 *   triangle at the sum of its corners by weight. `t` would bring in the error of the whole way.
 *   Where t itself is good to a few ulp (robust spheres, and double's) the better of the two
 * counts: the floor of a small scene may be a sphere so large that center and radius cannot tell
 * where its surface is as well as a ray from nearby can.
 * - On a triangle the weights w, u, v are drawn toward 1/3 by RT_START_DRAW, so that a start at an
 *   edge, where rounding could put it across, lies inside by more than rounding can do.
 * - The start is then moved along the geometric normal, to the side that the ray leaves on, by
 *   `lift`, the extent along the normal of a box of bounds: RT_START_BOUND times the sum of the
 *   corners' magnitudes, axis by axis, or of |center| + radius |normal|. The bound covers the start
 *   itself (3 roundings of the weighted sum, 2 of w, 1 of the move) and what the next test makes of
 *   it (pbrt 4th ed. 6.8): it is relative to the numbers at hand, so it is right at every scale,
 * and there is no absolute constant. */

/* In units of the number type's half ulp at 1. */
#define RT_START_BOUND (8 * RT_HALF_ULP)
#define RT_START_DRAW (32 * RT_HALF_ULP)
/* Of |origin| + |point|, for a point on the ray: 8 of t, 2 of the point, and room for the next
 * test. */
#define RT_POINT_BOUND (32 * RT_HALF_ULP)

typedef struct surface {
    vec3 point;  /* where the ray is at t: what is shaded */
    vec3 facing; /* geometric normal, unit, on the side that the ray comes from */
    vec3 normal; /* the same, or interpolated vertex normals on that side */
    vec3 start;  /* on the primitive */
    number lift; /* distance along `facing` that clears every rounding */
    int outside; /* whether the ray comes from outside: of the sphere, or from where the corners run
                  * counter-clockwise */
} surface;

/* The factor that turns a normal to the side that `direction` comes from. */
INLINE number side_toward(vec3 normal, vec3 direction)
{
    return DOT(normal, direction) > 0.0f ? -1.0f : 1.0f;
}

#define EXTENT_ALONG(n, bx, by, bz)                                                                \
    fma(fabs((n).x), (bx), fma(fabs((n).y), (by), fabs((n).z) * (bz)))

/* |a| + |b| + |c|. One is not fabs, or LLVM would put two into a vector of two, which keeps it from
 * making vectors across rays. */
#define SUM_OF_SIZES(a, b, c) (fabs(a) + ((b) < (number)0.0f ? -(b) : (b)) + fabs(c))

INLINE void sphere_surface(__global const rt_sphere_block *block, int k, vec3 origin,
                           vec3 direction, surface *s)
{
    const vec3 center = {block->cx[k], block->cy[k], block->cz[k]};
    const number radius = block->radius[k];
    vec3 normal = SUB(vec3, s->point, center);
    make_unit(&normal);
    const number side = side_toward(normal, direction);
    s->start = (vec3){fma(radius, normal.x, center.x), fma(radius, normal.y, center.y),
                      fma(radius, normal.z, center.z)};
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

/* The normals are made from the edges as they are and made unit last: made unit before the
 * barycentric test they would shrink the triangle, left as they are they would turn highlights
 * white. */
INLINE void triangle_surface(__global const rt_triangle_block *t, int k, number u, number v,
                             vec3 direction, surface *s)
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
    s->lift = (number)RT_START_BOUND * EXTENT_ALONG(normal, SUM_OF_SIZES(a.x, b.x, c.x),
                                                    SUM_OF_SIZES(a.y, b.y, c.y),
                                                    SUM_OF_SIZES(a.z, b.z, c.z));
    s->facing = SCALE(normal, side);
    s->normal = SCALE(normal, side);
    s->outside = side > 0.0f;
}

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

/* What the trace stage leaves behind, and the primitives that it speaks of: parameters of the
 * kernels that look at hits, and those in one. The normals are there where some are smooth. */
#define TRACED_PARAMETERS                                                                          \
    const int stride, __global const number *rays, __global const int *hit_index,                  \
        __global const int *hit_slot, __global const number *hit_array,                            \
        __global const rt_sphere_block *spheres, const int sphere_count,                           \
        __global const rt_triangle_block *triangles, const int triangle_count,              \
        __global const int *normals_of,                                                            \
        __global const float *normals
#define TRACED                                                                                     \
    {                                                                                              \
        (size_t) stride, rays, hit_index, hit_slot, hit_array, spheres, sphere_count, triangles,   \
            normals_of, normals                                                                    \
    }
typedef struct traced {
    size_t step;
    __global const number *rays;
    __global const int *hit_index, *hit_slot;
    __global const number *hit_array;
    __global const rt_sphere_block *spheres;
    int sphere_count;
    __global const rt_triangle_block *triangles;
    __global const int *normals_of;
    __global const float *normals;
} traced;

/* The surface that ray i, which goes along `direction`, has met as hit `index`; for a miss and any
 * index something. */
INLINE void surface_of(const traced *w, size_t i, int index, vec3 direction, surface *s)
{
    const size_t step = w->step;
    const int slot = max(w->hit_slot[i], 0);
    const int place = slot % RT_BLOCK_PRIMITIVES;
    const vec3 origin = LOAD3(w->rays, step, i);
    const number t = w->hit_array[RT_HIT_T * step + i];
    s->point = ADD_SCALED(direction, t, origin);
    if (RT_SPHERES && index < w->sphere_count) {
        sphere_surface(w->spheres + slot / RT_BLOCK_PRIMITIVES, place, origin, direction, s);
    } else if (RT_TRIANGLES) {
        const number u = w->hit_array[RT_HIT_U * step + i];
        const number v = w->hit_array[RT_HIT_V * step + i];
        triangle_surface(w->triangles + slot / RT_BLOCK_PRIMITIVES, place, u, v, direction, s);
        const int record = RT_SMOOTH ? w->normals_of[index - w->sphere_count] : -1;
        if (record >= 0)
            smooth_normal(w->normals + (size_t)record * RT_NORMAL_COMPONENTS, u, v, &s->normal);
    }
}

/* Where a ray starts that leaves the surface on the side that `side` points to. */
INLINE void leave(const surface *s, const vec3 *side, vec3 *origin)
{
    const number lift = DOT(s->facing, *side) > 0.0f ? s->lift : -s->lift;
    *origin = (vec3){fma(lift, s->facing.x, s->start.x), fma(lift, s->facing.y, s->start.y),
                     fma(lift, s->facing.z, s->start.z)};
}
