/* What a ray has met: the point, its normals, and where the rays that go on from there start.
 *
 * A next ray must neither hit the very primitive that it starts on nor start behind a neighbour.
 * - It starts on the primitive, not on the ray: on a sphere at center + radius * normal, on a
 *   triangle at the sum of its corners by weight. `t` would bring in the error of the whole way.
 *   Where t itself is good to a few ulp (at robust and double) and the primitive is far larger than
 *   the point is far, as the floor of a small scene may be, the point on the ray is the better one:
 *   neither center and radius nor corners tell then where the surface is as a ray from nearby can.
 * - On a triangle the weights w, u, v are drawn toward 1/3 by RT_START_DRAW, so that a start at an
 *   edge, where rounding could put it across, lies inside by more than rounding can do.
 * - The start is then moved along the geometric normal, to the side that the ray leaves on, by
 *   `lift`, the extent along the normal of a box of bounds: RT_START_BOUND times the sum of the
 *   corners' magnitudes, axis by axis, or of |center| + radius |normal|. The bound covers the start
 *   itself (3 roundings of the weighted sum, 2 of w, 1 of the move) and what the next test makes of
 *   it (pbrt 4th ed. 6.8): it is relative to the numbers at hand, so it is right at every scale,
 *   and there is no absolute constant. */

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
    vec3 within; /* the point, brought into the primitive's box: where a checker is looked up */
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

/* x, at least lo and at most hi. On a plane at right angles to an axis both are its place there, to
 * the bit, of which the point on the ray has what rounding left: by that a plane that is a border
 * of the checker's cells would be in either by chance. */
#define BETWEEN(x, lo, hi) LESSER_1(GREATER_1(x, lo), hi)

/* What the trace stage leaves behind, and the primitives that it speaks of: parameters of the
 * kernels that look at hits, and those in one. The normals are there where some are smooth. */
#define TRACED_KIND(name, names, NAMES)                                                            \
    , __global const rt_##name##_block *names, const int name##_count
#define TRACED_PARAMETERS                                                                          \
    const int stride, __global const number *rays, __global const int *hit_index,                  \
        __global const int *hit_slot, __global const number *hit_array RT_KINDS(TRACED_KIND),      \
        __global const int *normals_of, __global const float *normals
#define TRACED_KIND_ARGUMENTS(name, names, NAMES) , names, name##_count
#define TRACED                                                                                     \
    {                                                                                              \
        (size_t) stride, rays, hit_index, hit_slot, hit_array RT_KINDS(TRACED_KIND_ARGUMENTS),     \
            normals_of, normals                                                                    \
    }
typedef struct traced {
    size_t step;
    __global const number *rays;
    __global const int *hit_index, *hit_slot;
    __global const number *hit_array;
#define TRACED_FIELDS(name, names, NAMES)                                                          \
    __global const rt_##name##_block *names;                                                       \
    int name##_count;
    RT_KINDS(TRACED_FIELDS)
    __global const int *normals_of;
    __global const float *normals;
} traced;

/* In the file of each kind: the rest of the surface, whose `point` is known, of the primitive at a
 * place of a block, of that index among its kind, where a ray meets it at u and v. */
#define DECLARE_SURFACE(name, names, NAMES)                                                        \
    INLINE void name##_surface(const traced *w, int index,                                         \
                               __global const rt_##name##_block *block, int place, number u,       \
                               number v, vec3 origin, vec3 direction, surface *s);
RT_KINDS(DECLARE_SURFACE)

/* The surface that ray i, which goes along `direction`, has met as hit `index`; for a miss and any
 * index something. */
INLINE void surface_of(const traced *w, size_t i, int index, vec3 direction, surface *s)
{
    const size_t step = w->step;
    const int slot = max(w->hit_slot[i], 0);
    const int block = slot / RT_BLOCK_PRIMITIVES, place = slot % RT_BLOCK_PRIMITIVES;
    const vec3 origin = LOAD3(w->rays, step, i);
    const number t = w->hit_array[RT_HIT_T * step + i];
    const number u = w->hit_array[RT_HIT_U * step + i], v = w->hit_array[RT_HIT_V * step + i];
    s->point = ADD_SCALED(direction, t, origin);
#define SURFACE(name, names, NAMES)                                                                \
    if (RT_IS_LAST(NAMES) || (RT_##NAMES && index < w->name##_count)) {                            \
        name##_surface(w, index, w->names + block, place, u, v, origin, direction, s);             \
        return;                                                                                    \
    }                                                                                              \
    index -= RT_##NAMES ? w->name##_count : 0;
    RT_KINDS(SURFACE)
}

/* Where a ray starts that leaves the surface on the side that `side` points to. */
INLINE void leave(const surface *s, const vec3 *side, vec3 *origin)
{
    const number lift = DOT(s->facing, *side) > 0.0f ? s->lift : -s->lift;
    *origin = (vec3){fma(lift, s->facing.x, s->start.x), fma(lift, s->facing.y, s->start.y),
                     fma(lift, s->facing.z, s->start.z)};
}
