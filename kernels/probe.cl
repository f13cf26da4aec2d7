/* Stages between trace and shade: rays that ask whether the way from a surface is free, to a light
 * or round about, and what they found. Of `turn.count` samples at a time the probes lie sample by
 * sample, each in the order of the rays that they are for. */

#if RT_PROBES
/* A probe; without `on` one that ends before it begins. */
INLINE void store_probe(__global number *probes, size_t step, size_t j, int on, vec3 origin,
                        vec3 direction, number tmax)
{
    STORE3(origin, probes + RT_RAY_OX * step, step, j);
    STORE3(direction, probes + RT_RAY_DX * step, step, j);
    probes[RT_RAY_TMIN * step + j] = 0.0f;
    probes[RT_RAY_TMAX * step + j] = on ? tmax : (number)-1.0f;
}

#if RT_SHADOWS == 2 || RT_AMBIENT_OCCLUSION
/* Sample `sample` of `count` as a point on the unit disk. */
INLINE void disk_sample(rt_tile tile, int slot, int bounce, const rt_turn turn, uint base,
                        int sample, int count, number *x, number *y)
{
    const pixel p = slot_pixel(tile, slot);
    const uint dimension = RT_DIMENSION(base, bounce, turn.sample);
    number u, v;
    stratified(sample, count, seed_of(tile.x + p.column, tile.y + p.row, dimension), dimension, &u,
               &v);
    disk(u, v, x, y);
}
#endif
#endif

#if RT_NEXT
#define WAY_PARAMETERS , __global const int *home, __global const int *marks
#define SLOT_OF(i) home[i]
#define BOUNCE_OF(slot) marks[RT_MARK_BOUNCE * step + (size_t)(slot)]
#else
#define WAY_PARAMETERS
#define SLOT_OF(i) (int)(i)
#define BOUNCE_OF(slot) 0
#endif

#if RT_SHADOWS
/* How much of the way to a light a probe goes: a part of 2^-12 is left out. */
#define RT_LIGHT_REACH (1.0f - 0x1p-12f)

/* Probes from the hits to a light. They start on the light's side of the surface. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_shadow_rays(TRACED_PARAMETERS, const rt_turn turn, __global const rt_light *lights,
               __global number *probes
#if RT_SHADOWS == 2
               ,
               const rt_tile tile WAY_PARAMETERS
#endif
)
{
    const size_t j = get_global_id(0);
    const size_t step = (size_t)stride;
    const size_t i = j % (size_t)turn.rays;
    const int index = hit_index[i];
    vec3 origin = {0.0f, 0.0f, 0.0f}, l = {0.0f, 0.0f, 1.0f};
    number tmax = INFINITY;
    int on = index != RT_MISS;
#if RT_SPHERES || RT_TRIANGLES
    if (on) {
        const traced w = TRACED;
        const vec3 direction = LOAD3(rays + RT_RAY_DX * step, step, i);
        surface s;
        surface_of(&w, i, index, direction, &s);
        const rt_light light = lights[turn.light];
        const number away = -light.w;
        vec3 place = {light.x, light.y, light.z};
        l = ADD_SCALED(s.point, away, place);
        make_unit(&l);
        on = isfinite(l.x);
        leave(&s, l, &origin);
        if (light.w != 0.0f) {
#if RT_SHADOWS == 2
            if (light.radius > 0.0f) {
                number x, y;
                const int slot = SLOT_OF(i);
                disk_sample(tile, slot, BOUNCE_OF(slot), turn,
                            RT_DIMENSION_LIGHT + (uint)turn.light,
                            turn.first + (int)(j / (size_t)turn.rays), light.samples, &x, &y);
                vec3 t1, t2;
                frame_about(l, &t1, &t2);
                const number right = (number)light.radius * x, up = (number)light.radius * y;
                const vec3 beside = ADD_SCALED(t1, right, place);
                place = ADD_SCALED(t2, up, beside);
            }
#endif
            const vec3 to = SUB(vec3, place, origin);
            l = to;
            make_unit(&l);
            tmax = DOT(to, l) * (number)RT_LIGHT_REACH;
        }
    }
#endif
    store_probe(probes, step, j, on, origin, l, tmax);
}
#endif

#if RT_AMBIENT_OCCLUSION
/* Probes from the hits into the half space above them, more of them straight up than aside
 * (Malley's method), so that each stands for as much light. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_ambient_rays(TRACED_PARAMETERS, const rt_turn turn, const rt_crevice crevice,
                __global number *probes, const rt_tile tile WAY_PARAMETERS)
{
    const size_t j = get_global_id(0);
    const size_t step = (size_t)stride;
    const size_t i = j % (size_t)turn.rays;
    const int index = hit_index[i];
    vec3 origin = {0.0f, 0.0f, 0.0f}, out = {0.0f, 0.0f, 1.0f};
    int on = index != RT_MISS;
#if RT_SPHERES || RT_TRIANGLES
    if (on) {
        const traced w = TRACED;
        const vec3 direction = LOAD3(rays + RT_RAY_DX * step, step, i);
        surface s;
        surface_of(&w, i, index, direction, &s);
        number x, y;
        const int slot = SLOT_OF(i);
        disk_sample(tile, slot, BOUNCE_OF(slot), turn, RT_DIMENSION_AMBIENT,
                    turn.first + (int)(j / (size_t)turn.rays), crevice.samples, &x, &y);
        const number rest = fma(-x, x, fma(-y, y, (number)1.0f));
        const number z = ROOT_1(rest > (number)0.0f ? rest : (number)0.0f);
        vec3 t1, t2;
        frame_about(s.normal, &t1, &t2);
        const vec3 right = SCALE(t1, x);
        const vec3 flat = ADD_SCALED(t2, y, right);
        out = ADD_SCALED(s.normal, z, flat);
        on = DOT(out, s.facing) > (number)0.0f; /* below the surface it counts as hindered */
        leave(&s, out, &origin);
    }
#endif
    store_probe(probes, step, j, on, origin, out, (number)crevice.distance);
}
#endif

#if RT_PROBES
/* Counts the probes that got through, a row of `open` a light and one more for ambient light, and,
 * for --stats, those that were cast: for shadows, then for ambient light. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_tally(const int stride, const rt_turn turn, const int light_count, __global const number *probes,
         __global const int *blocked, __global int *open, __global ulong *cast)
{
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
    cast[(turn.light == light_count ? step : 0) + i] += (ulong)rays;
}
#endif
