/* Stages between trace and shade: rays that ask whether the way from a surface is free, to a light
 * or round about, and what they found. Of `turn.count` samples at a time the probes lie sample by
 * sample, each in the order of the rays that they are for. */

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

/* The samples that a launch is for: of each pixel's `count` a ray, one. */
typedef struct probe_set {
    rt_tile tile;
    uint seed, purpose;
    uint index; /* among all of a pixel's, over all of its rays of as many bounces */
    __global const int *home;
    __global const int *marks;
} probe_set;

/* The set's sample for ray i as a point on the unit disk. */
INLINE void disk_sample(const probe_set *p, size_t step, size_t i, number *x, number *y)
{
    const int slot = RT_NEXT ? p->home[i] : (int)i;
    const int bounce = RT_NEXT ? p->marks[RT_MARK_BOUNCE * step + (size_t)slot] : 0;
    number u, v;
    sample_point(sequence_at(p->tile, slot, p->seed, p->purpose, bounce), p->index, &u, &v);
    disk(u, v, x, y);
}

#define PROBE_SET_PARAMETERS                                                                       \
    const rt_tile tile, const uint seed, __global const int *home, __global const int *marks
#define PROBE_SET(what, turn, samples)                                                             \
    {                                                                                              \
        .tile = tile, .seed = seed, .purpose = (what),                                             \
        .index = (uint)((turn).sample * (samples) + (turn).first + SAMPLE_OF(turn)), .home = home, \
        .marks = marks                                                                             \
    }

/* A work-item's first ray and first probe, and which of the launch's samples its probes are. */
#define SAMPLE_OF(turn) ((int)get_global_id(0) / ((turn).rays / RT_ITEM_RAYS))
#define PROBE_ITEM(turn)                                                                           \
    const int items = (turn).rays / RT_ITEM_RAYS;                                                  \
    const size_t first = (size_t)((int)get_global_id(0) % items) * RT_ITEM_RAYS;                   \
    const size_t first_probe = get_global_id(0) * RT_ITEM_RAYS

/* A probe from the hit of ray i to a light, as far as its place; it starts on the light's side of
 * the surface. */
INLINE void shadow_probe(const traced *w, size_t i, __global const rt_light *light,
                         const probe_set *set, __global number *probes, size_t j)
{
    const size_t step = w->step;
    const int index = w->hit_index[i];
    const int is_hit = index != RT_MISS;
    vec3 origin, l;
    const vec3 direction = LOAD3(w->rays + RT_RAY_DX * step, step, i);
    surface s;
    surface_of(w, i, is_hit ? index : 0, direction, &s);
    vec3 place = {light->x, light->y, light->z};
    const number away = -light->w;
    l = ADD_SCALED(s.point, away, place);
    const int on = make_unit_if_any(&l) & is_hit;
    leave(&s, &l, &origin);
    if (RT_SOFT_SHADOWS && light->radius > 0.0f) {
        number x, y;
        disk_sample(set, step, i, &x, &y);
        vec3 t1, t2;
        frame_about(l, &t1, &t2);
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
    store_probe(probes, step, j, &origin, &l, on ? tmax : (number)-1.0f);
}

#if RT_SHADOWS
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_ITEM_RAYS, 1, 1))) void
rt_shadow_rays(TRACED_PARAMETERS, const rt_turn turn, __global const rt_light *lights,
               __global number *probes, PROBE_SET_PARAMETERS)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_ITEM_RAYS);
    const traced w = TRACED;
    __global const rt_light *light = lights + turn.light;
    PROBE_ITEM(turn);
    const probe_set set = PROBE_SET(RT_PURPOSE_LIGHT + (uint)turn.light, turn, light->samples);
    if (!any_hit(hit_index, first)) {
        EACH_RAY(k)
        store_no_probe(probes, w.step, first_probe + k);
        return;
    }
    EACH_RAY(k)
    shadow_probe(&w, first + k, light, &set, probes, first_probe + k);
}
#endif

/* A probe from the hit of ray i into the half space above it, more of them straight up than aside
 * (Malley's method), so that each stands for as much light. */
INLINE void ambient_probe(const traced *w, size_t i, number distance, const probe_set *set,
                          __global number *probes, size_t j)
{
    const size_t step = w->step;
    const int index = w->hit_index[i];
    const int is_hit = index != RT_MISS;
    const vec3 direction = LOAD3(w->rays + RT_RAY_DX * step, step, i);
    surface s;
    surface_of(w, i, is_hit ? index : 0, direction, &s);
    number x, y;
    disk_sample(set, step, i, &x, &y);
    const number rest = fma(-x, x, fma(-y, y, (number)1.0f));
    const number z = ROOT_1(rest > (number)0.0f ? rest : (number)0.0f);
    vec3 t1, t2;
    frame_about(s.normal, &t1, &t2);
    const vec3 right = SCALE(t1, x);
    const vec3 flat = ADD_SCALED(t2, y, right);
    const vec3 out = ADD_SCALED(s.normal, z, flat);
    /* Below the surface it counts as hindered. */
    const int on = is_hit & (DOT(out, s.facing) > (number)0.0f);
    vec3 origin;
    leave(&s, &out, &origin);
    store_probe(probes, step, j, &origin, &out, on ? distance : (number)-1.0f);
}

#if RT_AMBIENT_OCCLUSION
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_ITEM_RAYS, 1, 1))) void
rt_ambient_rays(TRACED_PARAMETERS, const rt_turn turn, const rt_crevice crevice,
                __global number *probes, PROBE_SET_PARAMETERS)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_ITEM_RAYS);
    const traced w = TRACED;
    PROBE_ITEM(turn);
    const probe_set set = PROBE_SET(RT_PURPOSE_AMBIENT, turn, crevice.samples);
    if (!any_hit(hit_index, first)) {
        EACH_RAY(k)
        store_no_probe(probes, w.step, first_probe + k);
        return;
    }
    EACH_RAY(k)
    ambient_probe(&w, first + k, (number)crevice.distance, &set, probes, first_probe + k);
}
#endif

#if RT_PROBES
/* Counts the probes that got through, a row of `open` a light and one more for ambient light, and,
 * for --stats, those that were cast. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_tally(const int stride, const rt_turn turn, const int light_count, __global const number *probes,
         __global const int *blocked, __global int *open, __global ulong *tallies)
{
    ASSUME_GROUP(RT_BLOCK_RAYS);
    const size_t i = get_global_id(0);
    const size_t step = (size_t)stride;
    __global int *row = open + (size_t)turn.light * step;
    int through = 0, rays = 0;
    for (int k = 0; k < turn.count; ++k) {
        const size_t j = (size_t)k * (size_t)turn.rays + i;
        const int on = probes[RT_RAY_TMAX * step + j] > probes[RT_RAY_TMIN * step + j];
        rays += on;
        through += on & (blocked[j] == RT_MISS);
    }
    row[i] = (turn.first ? row[i] : 0) + through;
    const size_t what = turn.light == light_count ? RT_TALLY_AMBIENT : RT_TALLY_SHADOW;
    tallies[what * step + i] += (ulong)rays;
}
#endif
