/* Where light goes on at a mirror or at glass, and the rays of a path that wait their turn.
 *
 * Rays are followed depth first, in place: each ray of the tile becomes the next one of its path.
 * Where a hit sends out two, the refracted one goes first and the mirror ray waits, at most one at
 * each bounce, until nothing is left of the other. */

/* A ray that may be followed. */
typedef struct next_ray {
    vec3 origin, direction;
    number weight;
    vec3 tint;
    int bounce, medium, is_refracted;
} next_ray;

/* The mirror image of direction d about n, or about the geometric normal where that would go into
 * the surface; not made unit again. */
INLINE void mirror_image(vec3 d, const surface *s, vec3 *out)
{
    const number twice = (number)-2.0f * DOT(d, s->normal);
    *out = ADD_SCALED(s->normal, twice, d);
    if (!(DOT(*out, s->facing) > (number)0.0f)) {
        const number twice_flat = (number)-2.0f * DOT(d, s->facing);
        *out = ADD_SCALED(s->facing, twice_flat, d);
    }
}

/* Snell's law about the normal n, which is on the side of -d, at the ratio eta of the indices of
 * refraction, and Fresnel's part of unpolarised light that is reflected. Returns 0 for total
 * reflection. */
INLINE int bend(vec3 d, vec3 n, number c1, number eta, vec3 *out, number *reflected)
{
    const number one = (number)1.0f;
    const number sine2 = (eta * eta) * fma(-c1, c1, one);
    *reflected = one;
    if (!(sine2 < one))
        return 0;
    const number c2 = ROOT_1(one - sine2);
    const number k = fma(eta, c1, -c2);
    const vec3 slowed = SCALE(d, eta);
    *out = ADD_SCALED(n, k, slowed);
    make_unit(out);
    const number rs = DIVIDE_1(k, fma(eta, c1, c2));
    const number rp = DIVIDE_1(fma(-eta, c2, c1), fma(eta, c2, c1));
    *reflected = (number)0.5f * fma(rs, rs, rp * rp);
    return 1;
}

/* The same about a surface's normal; about the geometric one where the interpolated one is turned
 * from the ray or would keep it on this side. */
INLINE int refracted(vec3 d, const surface *s, number ior, vec3 *out, number *reflected)
{
    const number eta = s->outside ? DIVIDE_1((number)1.0f, ior) : ior;
    const number cosine = -DOT(d, s->normal);
    const number flat_cosine = -DOT(d, s->facing);
    if (cosine > (number)0.0f) {
        if (!bend(d, s->normal, cosine, eta, out, reflected))
            return 0;
        if (DOT(*out, s->facing) < (number)0.0f)
            return 1;
    }
    return bend(d, s->facing, flat_cosine, eta, out, reflected);
}

INLINE void store_next(__global number *next_rays, __global int *next_home, size_t step, size_t i,
                       int slot, __global number *paths, __global int *marks, const next_ray *r)
{
    const size_t at = (size_t)slot;
    STORE3(r->origin, next_rays + RT_RAY_OX * step, step, i);
    STORE3(r->direction, next_rays + RT_RAY_DX * step, step, i);
    next_rays[RT_RAY_TMIN * step + i] = 0.0f;
    next_rays[RT_RAY_TMAX * step + i] = INFINITY;
    next_home[i] = slot;
    paths[RT_PATH_WEIGHT * step + at] = r->weight;
    STORE3(r->tint, paths + RT_PATH_TINT_R * step, step, at);
    marks[RT_MARK_BOUNCE * step + at] = r->bounce;
    marks[RT_MARK_MEDIUM * step + at] = r->medium;
    marks[RT_MARK_IS_REFRACTED * step + at] = r->is_refracted;
}

/* Place k of a path's waiting rays; component c of the first at c * step. */
#define WAITING_AT(k, slot) ((size_t)(k)*RT_WAITING_COMPONENTS * step + (size_t)(slot))
#define WAITING_MARKS_AT(k, slot) ((size_t)(k)*RT_WAITING_MARKS * step + (size_t)(slot))

INLINE void push_waiting(__global number *waiting, __global int *waiting_marks, __global int *marks,
                         size_t step, int slot, const next_ray *r)
{
    const int k = marks[RT_MARK_WAITING * step + (size_t)slot]++;
    __global number *w = waiting + WAITING_AT(k, slot);
    __global int *m = waiting_marks + WAITING_MARKS_AT(k, slot);
    STORE3(r->origin, w + RT_WAITING_OX * step, step, 0);
    STORE3(r->direction, w + RT_WAITING_DX * step, step, 0);
    w[RT_WAITING_WEIGHT * step] = r->weight;
    STORE3(r->tint, w + RT_WAITING_TINT_R * step, step, 0);
    m[RT_WAITING_BOUNCE * step] = r->bounce;
    m[RT_WAITING_MEDIUM * step] = r->medium;
}

/* The ray that has waited the shortest; 0 where none does. */
INLINE int pop_waiting(__global const number *waiting, __global const int *waiting_marks,
                       __global int *marks, size_t step, int slot, next_ray *r)
{
    const int k = marks[RT_MARK_WAITING * step + (size_t)slot] - 1;
    if (k < 0)
        return 0;
    marks[RT_MARK_WAITING * step + (size_t)slot] = k;
    __global const number *w = waiting + WAITING_AT(k, slot);
    __global const int *m = waiting_marks + WAITING_MARKS_AT(k, slot);
    r->origin = LOAD3(w + RT_WAITING_OX * step, step, 0);
    r->direction = LOAD3(w + RT_WAITING_DX * step, step, 0);
    r->weight = w[RT_WAITING_WEIGHT * step];
    r->tint = LOAD3(w + RT_WAITING_TINT_R * step, step, 0);
    r->bounce = m[RT_WAITING_BOUNCE * step];
    r->medium = m[RT_WAITING_MEDIUM * step];
    r->is_refracted = 0;
    return 1;
}

/* The rays that a hit sends out: whether each is worth following, and what it is. */
INLINE int send_mirrored(vec3 d, const surface *s, number part, const next_ray *from, next_ray *r)
{
    *r = *from;
    r->weight = from->weight * part;
    r->bounce = from->bounce + 1;
    r->is_refracted = 0;
    if (!(r->weight >= (number)RT_WEIGHT_LEAST))
        return 0;
    mirror_image(d, s, &r->direction);
    /* Not by the direction: at a tangent its sign is rounding's. */
    leave(s, &s->facing, &r->origin);
    return 1;
}

/* `part` is what is left for the mirror ray: what Fresnel's law says, and what the material itself
 * mirrors. */
INLINE int send_refracted(vec3 d, const surface *s, __global const rt_material *m, int material,
                          const next_ray *from, next_ray *r, number *part)
{
    number reflected = 1.0f;
    *r = *from;
    *part = m->reflect;
    if (!(m->transmit > 0.0f))
        return 0;
    const int through = refracted(d, s, (number)m->ior, &r->direction, &reflected);
    *part = fma((number)m->transmit, reflected, (number)m->reflect);
    r->weight = from->weight * ((number)m->transmit * ((number)1.0f - reflected));
    r->bounce = from->bounce + 1;
    r->medium = s->outside ? material : RT_OUTSIDE;
    r->is_refracted = 1;
    if (!through || !(r->weight >= (number)RT_WEIGHT_LEAST))
        return 0;
    const vec3 behind = SCALE(s->facing, (number)-1.0f);
    leave(s, &behind, &r->origin);
    return 1;
}

#if RT_NEXT
/* The stage after shade where rays go on: each ray's next one, or the end of it. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_next(TRACED_PARAMETERS, __global const int *material_of, __global const rt_material *materials,
        const int depth, __global const int *home, __global number *paths, __global int *marks,
        __global number *next_rays, __global int *next_home, __global number *waiting,
        __global int *waiting_marks)
{
    const size_t i = get_global_id(0);
    const size_t step = (size_t)stride;
    const int is_alive = rays[RT_RAY_TMIN * step + i] < rays[RT_RAY_TMAX * step + i];
    const int slot = home[i];
    next_ray from, r;
    from.weight = paths[RT_PATH_WEIGHT * step + (size_t)slot];
    from.tint = LOAD3(paths + RT_PATH_TINT_R * step, step, (size_t)slot);
    from.bounce = marks[RT_MARK_BOUNCE * step + (size_t)slot];
    from.medium = marks[RT_MARK_MEDIUM * step + (size_t)slot];
    int has = 0;
    const int index = hit_index[i];
    if (is_alive && index != RT_MISS && from.bounce < depth) {
        const traced w = TRACED;
        const vec3 direction = LOAD3(rays + RT_RAY_DX * step, step, i);
        surface s;
        surface_of(&w, i, index, direction, &s);
        const int material = material_of[index];
        __global const rt_material *m = materials + material;
        number part = m->reflect;
        next_ray aside;
        if (RT_REFRACT)
            has = send_refracted(direction, &s, m, material, &from, &r, &part);
        if (send_mirrored(direction, &s, part, &from, has ? &aside : &r)) {
            if (has)
                push_waiting(waiting, waiting_marks, marks, step, slot, &aside);
            has = 1;
        }
    }
    if (RT_REFRACT && is_alive && !has)
        has = pop_waiting(waiting, waiting_marks, marks, step, slot, &r);
    if (has) {
        store_next(next_rays, next_home, step, i, slot, paths, marks, &r);
    } else {
        next_rays[RT_RAY_TMIN * step + i] = 0.0f;
        next_rays[RT_RAY_TMAX * step + i] = -1.0f;
    }
}
#endif
