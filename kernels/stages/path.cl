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
    int bounce, is_refracted;
    ulong inside; /* of which bodies: shading/media.cl */
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
INLINE int refracted(vec3 d, const surface *s, number eta, vec3 *out, number *reflected)
{
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

INLINE ulong both_halves(int low, int high)
{
    return (ulong)(uint)high << 32 | (uint)low;
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
    marks[RT_MARK_INSIDE_LOW * step + at] = (int)r->inside;
    marks[RT_MARK_INSIDE_HIGH * step + at] = (int)(r->inside >> 32);
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
    m[RT_WAITING_INSIDE_LOW * step] = (int)r->inside;
    m[RT_WAITING_INSIDE_HIGH * step] = (int)(r->inside >> 32);
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
    r->inside = both_halves(m[RT_WAITING_INSIDE_LOW * step], m[RT_WAITING_INSIDE_HIGH * step]);
    r->is_refracted = 0;
    return 1;
}

/* Light that comes to a hit along a ray, seen backward: the parts that a mirror ray and a refracted
 * ray bring, and where the latter goes. */
typedef struct parting {
    number mirrored, refracted;
    vec3 direction; /* of the refracted ray */
    ulong inside;   /* its bodies */
} parting;

INLINE void part_light(vec3 d, const surface *s, __global const rt_material *m, int medium,
                       __global const rt_medium *media, const rt_nesting nesting, ulong inside,
                       parting *p)
{
    p->mirrored = m->reflect;
    p->refracted = 0.0f;
    if (!(m->transmit > 0.0f))
        return;
    int here = medium_of(nesting, inside);
    if (s->outside) {
        p->inside = entered(nesting, inside, medium);
    } else {
        p->inside = left_body(nesting, inside, medium);
        /* A surface that nobody came in by is left all the same. */
        here = p->inside == inside ? medium : here;
    }
    const int there = medium_of(nesting, p->inside);
    const number eta = DIVIDE_1((number)media[here].ior, (number)media[there].ior);
    number part = 0.0f;
    int through = 1;
    p->direction = d;
    if (eta != (number)1.0f)
        through = refracted(d, s, eta, &p->direction, &part);
    p->mirrored = fma((number)m->transmit, part, (number)m->reflect);
    p->refracted = through ? (number)m->transmit * ((number)1.0f - part) : (number)0.0f;
}

/* What is followed of a hit's light, by weights of what the mirror ray and the refracted ray would
 * bring; the weights that they go on with are put in their place, 0 for a ray that is not. Each has
 * the mean that it had, and the two together, unless they are cut, exactly what they had: where
 * nothing is lost at surfaces, following by chance loses and adds nothing. `tint` is the most that
 * is left of any colour. Returns 0 where chance ends both. */
INLINE int choose(number *mirrored, number *bent, number tint, int bounce, number u, number v)
{
    const number least = RT_WEIGHT_LEAST, quantum = RT_QUANTUM(bounce);
    const number all = *mirrored + *bent, seen = all * tint;
    const number a = *mirrored * tint, b = *bent * tint;
    /* Not 0, by half a step of u. */
    const number chance = u + (number)0x1p-25f;
    const int is_least = !(seen >= least);
    if (is_least && !(chance * least < seen))
        return 0;
    if (is_least || !(seen >= (number)2.0f * quantum) || !(a > 0.0f) || !(b > 0.0f)) {
        const int is_mirrored = v * all < *mirrored;
        const number one = is_least ? DIVIDE_1(least, tint) : all;
        *mirrored = is_mirrored ? one : (number)0.0f;
        *bent = is_mirrored ? (number)0.0f : one;
    } else if (a < quantum || b < quantum) {
        const int mirrored_is_less = a < b;
        const int is_followed = chance * quantum < (mirrored_is_less ? a : b);
        const number small = is_followed ? DIVIDE_1(quantum, tint) : (number)0.0f;
        *mirrored = mirrored_is_less ? small : all - small;
        *bent = mirrored_is_less ? all - small : small;
    }
    return 1;
}

#if RT_HAS_SECONDARY && RT_NEXT
/* The stage after shade where rays go on: each ray's next one, or the end of it. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_next(TRACED_PARAMETERS, const rt_tile tile, const rt_turn turn, const uint seed,
        __global const int *material_of, __global const rt_material *materials,
        __global const int *medium_of_material, __global const rt_medium *media,
        const rt_nesting nesting, const int depth, __global const int *home, __global number *paths,
        __global int *marks, __global number *next_rays, __global int *next_home,
        __global number *waiting, __global int *waiting_marks, __global ulong *tallies)
{
    ASSUME_GROUP(RT_BLOCK_RAYS);
    const size_t i = get_global_id(0);
    const size_t step = (size_t)stride;
    const int is_alive = rays[RT_RAY_TMIN * step + i] < rays[RT_RAY_TMAX * step + i];
    const int slot = home[i];
    next_ray from, r;
    from.weight = paths[RT_PATH_WEIGHT * step + (size_t)slot];
    from.tint = LOAD3(paths + RT_PATH_TINT_R * step, step, (size_t)slot);
    from.bounce = marks[RT_MARK_BOUNCE * step + (size_t)slot];
    from.inside = both_halves(marks[RT_MARK_INSIDE_LOW * step + (size_t)slot],
                              marks[RT_MARK_INSIDE_HIGH * step + (size_t)slot]);
    from.is_refracted = 0;
    int has = 0;
    const int index = hit_index[i];
    if (is_alive && index != RT_MISS) {
        const traced w = TRACED;
        const vec3 direction = LOAD3(rays + RT_RAY_DX * step, step, i);
        surface s;
        surface_of(&w, i, index, direction, &s);
        const int material = material_of[index];
        parting p;
        part_light(direction, &s, materials + material,
                   RT_REFRACT ? medium_of_material[material] : 0, media, nesting, from.inside, &p);
        number mirrored = from.weight * p.mirrored, bent = from.weight * p.refracted;
        const number tint = GREATER_1(GREATER_1(from.tint.x, from.tint.y), from.tint.z);
        if (from.bounce >= depth) {
            tallies[RT_TALLY_CUT * step + i] += mirrored + bent > (number)0.0f;
            tallies[RT_TALLY_CUT_PART * step + i] +=
                (ulong)((mirrored + bent) * tint * (number)(1.0f / RT_CUT_UNIT));
            mirrored = bent = 0.0f;
        } else if (mirrored + bent > (number)0.0f) {
            number u, v;
            sample_point(sequence_at(tile, slot, seed, RT_PURPOSE_ROUTE, from.bounce),
                         (uint)turn.sample, &u, &v);
            if (!choose(&mirrored, &bent, tint, from.bounce, u, v)) {
                tallies[RT_TALLY_ENDED * step + i] += 1;
                mirrored = bent = 0.0f;
            }
        }
        r = from;
        r.bounce = from.bounce + 1;
        if (mirrored > (number)0.0f) {
            r.weight = mirrored;
            mirror_image(direction, &s, &r.direction);
            /* Not by the direction: at a tangent its sign is rounding's. */
            leave(&s, &s.facing, &r.origin);
            has = 1;
        }
        if (RT_REFRACT && bent > (number)0.0f) {
            if (has)
                push_waiting(waiting, waiting_marks, marks, step, slot, &r);
            const vec3 behind = SCALE(s.facing, (number)-1.0f);
            r.weight = bent;
            r.direction = p.direction;
            r.inside = p.inside;
            r.is_refracted = 1;
            leave(&s, &behind, &r.origin);
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
