/* Stages between trace and shade: rays that ask whether the way from a surface is free, to a light
 * or round about, and what they found. A launch is for `turn.rays` rays from `turn.from` on and
 * `turn.count` samples; its probes lie sample by sample, each in the order of the rays that they
 * are for. */

/* Probe j; one whose tmax is below 0 ends before it begins. Pointers, because a struct that is
 * passed by value comes as a small vector on some machines, and that ends vectorising. */
INLINE void store_probe(__global number *probes, size_t step, size_t j, const vec3 *origin,
                        const vec3 *direction, number tmax)
{
    STORE3(*origin, probes + RT_RAY_OX * step, step, j);
    STORE3(*direction, probes + RT_RAY_DX * step, step, j);
    probes[RT_RAY_TMIN * step + j] = 0.0f;
    probes[RT_RAY_TMAX * step + j] = tmax;
}

INLINE void store_no_probe(__global number *probes, size_t step, size_t j)
{
    const vec3 nowhere = {0.0f, 0.0f, 0.0f}, ahead = {0.0f, 0.0f, 1.0f};
    store_probe(probes, step, j, &nowhere, &ahead, -1.0f);
}

/* The random numbers of a work-item's probes: of the block's ray k at any sample. */
INLINE uint sequence_of_probe(rt_tile tile, uint seed, uint purpose, __global const int *home,
                              __global const int *marks, size_t step, size_t i)
{
    const int slot = RT_NEXT ? home[i] : (int)i;
    const int bounce = RT_NEXT ? marks[RT_MARK_BOUNCE * step + (size_t)slot] : 0;
    return sequence_at(tile, slot, seed, purpose, bounce);
}

/* A work-item's first ray and its first probe; the probes of its sample s are s times the launch's
 * rays further on. Where vectors are wide, a work-item is for a block of rays and all samples, so
 * that what the probes from a hit have in common is found once; where a ray is a work-item, as on a
 * GPU, which wants many of them, for one sample. */
#define PROBE_ITEM(turn)                                                                           \
    const uint items = (uint)(turn).rays / RT_ITEM_RAYS;                                           \
    const size_t first_probe = (size_t)((uint)get_global_id(0) % items * RT_ITEM_RAYS);            \
    const size_t first = (size_t)(turn).from + first_probe;                                        \
    const int first_sample = (int)((uint)get_global_id(0) / items);                                \
    const int end_sample = RT_ITEM_RAYS > 1 ? (turn).count : first_sample + 1
#define EACH_SAMPLE(s) for (int s = first_sample; s < end_sample; ++s)
#define FIRST_PROBE_OF(s) (first_probe + (size_t)(s) * (size_t)turn.rays)
/* Among all samples of a pixel, over all of its rays of as many bounces. */
#define INDEX_OF(s, samples) ((uint)(turn.sample * (samples) + turn.first + (s)))

#define NO_PROBES                                                                                  \
    EACH_SAMPLE(s)                                                                                 \
    {                                                                                              \
        const size_t from = FIRST_PROBE_OF(s);                                                     \
        EACH_RAY(k)                                                                                \
        store_no_probe(probes, step, from + k);                                                    \
    }

/* What the probes from the hits of a work-item's rays to a light have in common. `place` is where
 * they start, on the light's side of the surface, `toward` the unit vector to the light's middle,
 * `right` and `up` what stands on it at right angles. */
typedef struct shadow_item {
    number place[ITEM_VECTORS], toward[ITEM_VECTORS], right[ITEM_VECTORS], up[ITEM_VECTORS];
    uint sequence[RT_ITEM_RAYS];
    int on[RT_ITEM_RAYS];
} shadow_item;

INLINE void start_shadow_probes(const traced *w, size_t i, __global const rt_light *light,
                                shadow_item *item, size_t k)
{
    const size_t step = w->step;
    const int index = w->hit_index[i];
    const int is_hit = index != RT_MISS;
    vec3 start, l;
    const vec3 direction = LOAD3(w->rays + RT_RAY_DX * step, step, i);
    surface s;
    surface_of(w, i, is_hit ? index : 0, direction, &s);
    const vec3 middle = {light->x, light->y, light->z};
    const number away = -light->w;
    l = ADD_SCALED(s.point, away, middle);
    item->on[k] = make_unit_if_any(&l) & is_hit;
    leave(&s, &l, &start);
    STORE_ITEM_VECTOR(start, item->place, k);
    STORE_ITEM_VECTOR(l, item->toward, k);
    if (RT_SOFT_SHADOWS) {
        vec3 t1, t2;
        frame_about(l, &t1, &t2);
        STORE_ITEM_VECTOR(t1, item->right, k);
        STORE_ITEM_VECTOR(t2, item->up, k);
    }
}

/* Probe j, for sample `index`, as far as the light's place. */
INLINE void shadow_probe(const shadow_item *item, size_t k, __global const rt_light *light,
                         uint index, __global number *probes, size_t step, size_t j)
{
    const vec3 origin = ITEM_VECTOR(item->place, k);
    vec3 l = ITEM_VECTOR(item->toward, k);
    vec3 place = {light->x, light->y, light->z};
    if (RT_SOFT_SHADOWS && light->radius > 0.0f) {
        number u, v, x, y;
        sample_point(item->sequence[k], index, &u, &v);
        disk(u, v, &x, &y);
        const vec3 t1 = ITEM_VECTOR(item->right, k), t2 = ITEM_VECTOR(item->up, k);
        const number right = light->radius * x, up = light->radius * y;
        const vec3 beside = ADD_SCALED(t1, right, place);
        place = ADD_SCALED(t2, up, beside);
    }
    const int is_point = light->w != 0.0f;
    const vec3 to = SUB(vec3, place, origin);
    vec3 aim = to;
    make_unit(&aim);
    l.x = is_point ? aim.x : l.x;
    l.y = is_point ? aim.y : l.y;
    l.z = is_point ? aim.z : l.z;
    const number reach = DOT(to, aim) * ((number)1.0f - (number)light->gap);
    const number tmax = is_point ? reach : (number)INFINITY;
    store_probe(probes, step, j, &origin, &l, item->on[k] ? tmax : (number)-1.0f);
}

#if RT_HAS_SECONDARY && RT_SHADOWS
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_ITEM_RAYS, 1, 1))) void
rt_shadow_rays(TRACED_PARAMETERS, const rt_turn turn, __global const rt_light *lights,
               __global number *probes, const rt_tile tile, const uint seed,
               __global const int *home, __global const int *marks)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_ITEM_RAYS);
    const traced w = TRACED;
    const size_t step = w.step;
    __global const rt_light *light = lights + turn.light;
    PROBE_ITEM(turn);
    if (!any_hit(hit_index, first)) {
        NO_PROBES
        return;
    }
    shadow_item item;
    EACH_RAY(k)
    start_shadow_probes(&w, first + k, light, &item, k);
    if (RT_SOFT_SHADOWS)
        EACH_RAY(k)
    item.sequence[k] = sequence_of_probe(tile, seed, RT_PURPOSE_LIGHT + (uint)turn.light, home,
                                         marks, step, first + k);
    EACH_SAMPLE(s)
    {
        const uint index = INDEX_OF(s, light->samples);
        const size_t from = FIRST_PROBE_OF(s);
        EACH_RAY(k)
        shadow_probe(&item, k, light, index, probes, step, from + k);
    }
}
#endif

/* What the probes of ambient light from a work-item's rays have in common: `above` is the normal
 * that they spread about, `facing` the geometric one. */
typedef struct ambient_item {
    number place[ITEM_VECTORS], above[ITEM_VECTORS], right[ITEM_VECTORS], up[ITEM_VECTORS],
        facing[ITEM_VECTORS];
    uint sequence[RT_ITEM_RAYS];
    int on[RT_ITEM_RAYS];
} ambient_item;

INLINE void start_ambient_probes(const traced *w, size_t i, ambient_item *item, size_t k)
{
    const size_t step = w->step;
    const int index = w->hit_index[i];
    const int is_hit = index != RT_MISS;
    const vec3 direction = LOAD3(w->rays + RT_RAY_DX * step, step, i);
    surface s;
    surface_of(w, i, is_hit ? index : 0, direction, &s);
    vec3 start, t1, t2;
    leave(&s, &s.facing, &start);
    frame_about(s.normal, &t1, &t2);
    STORE_ITEM_VECTOR(start, item->place, k);
    STORE_ITEM_VECTOR(s.normal, item->above, k);
    STORE_ITEM_VECTOR(t1, item->right, k);
    STORE_ITEM_VECTOR(t2, item->up, k);
    STORE_ITEM_VECTOR(s.facing, item->facing, k);
    item->on[k] = is_hit;
}

/* Probe j, for sample `index`, into the half space above a hit, more of them straight up than aside
 * (Malley's method), so that each stands for as much light. */
INLINE void ambient_probe(const ambient_item *item, size_t k, number distance, uint index,
                          __global number *probes, size_t step, size_t j)
{
    number u, v, x, y;
    sample_point(item->sequence[k], index, &u, &v);
    disk(u, v, &x, &y);
    const number rest = fma(-x, x, fma(-y, y, (number)1.0f));
    const number z = ROOT_1(rest > (number)0.0f ? rest : (number)0.0f);
    const vec3 t1 = ITEM_VECTOR(item->right, k), t2 = ITEM_VECTOR(item->up, k);
    const vec3 normal = ITEM_VECTOR(item->above, k), facing = ITEM_VECTOR(item->facing, k);
    const vec3 right = SCALE(t1, x);
    const vec3 flat = ADD_SCALED(t2, y, right);
    const vec3 out = ADD_SCALED(normal, z, flat);
    const vec3 start = ITEM_VECTOR(item->place, k);
    /* Below the surface it counts as hindered. */
    const int on = item->on[k] & (DOT(out, facing) > (number)0.0f);
    store_probe(probes, step, j, &start, &out, on ? distance : (number)-1.0f);
}

#if RT_HAS_SECONDARY && RT_AMBIENT_OCCLUSION
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_ITEM_RAYS, 1, 1))) void
rt_ambient_rays(TRACED_PARAMETERS, const rt_turn turn, const rt_crevice crevice,
                __global number *probes, const rt_tile tile, const uint seed,
                __global const int *home, __global const int *marks)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_ITEM_RAYS);
    const traced w = TRACED;
    const size_t step = w.step;
    PROBE_ITEM(turn);
    if (!any_hit(hit_index, first)) {
        NO_PROBES
        return;
    }
    ambient_item item;
    EACH_RAY(k)
    start_ambient_probes(&w, first + k, &item, k);
    EACH_RAY(k)
    item.sequence[k] =
        sequence_of_probe(tile, seed, RT_PURPOSE_AMBIENT, home, marks, step, first + k);
    EACH_SAMPLE(s)
    {
        const uint index = INDEX_OF(s, crevice.samples);
        const size_t from = FIRST_PROBE_OF(s);
        EACH_RAY(k)
        ambient_probe(&item, k, (number)crevice.distance, index, probes, step, from + k);
    }
}
#endif

#if RT_HAS_SECONDARY && RT_PROBES
/* Counts the probes that got through, a row of `open` a light and one more for ambient light, and,
 * for --stats, those that were cast. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_ITEM_RAYS, 1, 1))) void
rt_tally(const int stride, const rt_turn turn, const int light_count, __global const number *probes,
         __global const int *blocked, __global int *open, __global ulong *tallies)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_ITEM_RAYS);
    const size_t step = (size_t)stride;
    const size_t first_probe = get_global_id(0) * RT_ITEM_RAYS;
    const size_t first = (size_t)turn.from + first_probe;
    __global int *row = open + (size_t)turn.light * step + first;
    const size_t what = turn.light == light_count ? RT_TALLY_AMBIENT : RT_TALLY_SHADOW;
    __global ulong *tally = tallies + what * step + first;
    int through[RT_ITEM_RAYS], rays[RT_ITEM_RAYS];
    EACH_RAY(k)
    through[k] = rays[k] = 0;
    for (int s = 0; s < turn.count; ++s) {
        const size_t from = FIRST_PROBE_OF(s);
        EACH_RAY(k)
        {
            const size_t j = from + k;
            const int on = probes[RT_RAY_TMAX * step + j] > probes[RT_RAY_TMIN * step + j];
            rays[k] += on;
            through[k] += on & (blocked[j] == RT_MISS);
        }
    }
    EACH_RAY(k)
    {
        row[k] = (turn.first ? row[k] : 0) + through[k];
        tally[k] += (ulong)rays[k];
    }
}
#endif
