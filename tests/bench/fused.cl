/* A picture's tile in one kernel, for scenes of spheres and triangles under Phong's formula and
 * nothing else: what somebody would write who wants that one picture and no stages. It stands
 * behind the sources in kernels/, so that it makes the same decisions on the way to a hit; between
 * ray and pixel nothing goes through global memory. A work-item is a block of 8x8 pixels. */

#if RT_ACCURACY != 1 || RT_SUM || RT_PROBES || RT_FOG || RT_GRADIENT || RT_CHECKER ||              \
    RT_TEXTURE || RT_SMOOTH || RT_LENS
#error "fused.cl is for plain scenes at standard"
#endif

#define EACH_PIXEL(k)                                                                              \
    _Pragma("clang loop vectorize(assume_safety)") for (int k = 0; k < RT_BLOCK_RAYS; ++k)

/* All that a block knows of its rays. */
typedef struct block {
    number dx[RT_BLOCK_RAYS], dy[RT_BLOCK_RAYS], dz[RT_BLOCK_RAYS];
    number t[RT_BLOCK_RAYS], u[RT_BLOCK_RAYS], v[RT_BLOCK_RAYS];
    int index[RT_BLOCK_RAYS], slot[RT_BLOCK_RAYS];
    float r[RT_BLOCK_RAYS], g[RT_BLOCK_RAYS], b[RT_BLOCK_RAYS];
} block;

INLINE void aim(block *all, const rt_frame *frame, int left, int top)
{
    EACH_PIXEL(k)
    {
        const number across = (number)(2 * (left + RT_BLOCK_COLUMN(k)) + 1 - frame->width);
        const number upward = (number)(frame->height - 1 - 2 * (top + RT_BLOCK_ROW(k)));
        const vec3 right = {frame->right_x, frame->right_y, frame->right_z};
        const vec3 up = {frame->up_x, frame->up_y, frame->up_z};
        const vec3 forward = {frame->forward_x, frame->forward_y, frame->forward_z};
        const vec3 level = ADD_SCALED(up, upward, forward);
        const vec3 through = ADD_SCALED(right, across, level);
        const number length = RECIPROCAL_LENGTH(through);
        all->dx[k] = through.x * length;
        all->dy[k] = through.y * length;
        all->dz[k] = through.z * length;
    }
}

/* Finite rays from the eye, without an end. */
INLINE void load_eye_rays(const block *all, int first, const rt_frame *frame, packet *p)
{
    for (int g = 0; g < RT_GROUPS; ++g) {
        rays *r = &p->r[g];
        hits *h = &p->h[g];
        r->origin = SPLAT3(frame->ox, frame->oy, frame->oz);
        r->direction.x = LOAD_REAL(all->dx + first + g * RT_LANES);
        r->direction.y = LOAD_REAL(all->dy + first + g * RT_LANES);
        r->direction.z = LOAD_REAL(all->dz + first + g * RT_LANES);
        r->tmin = (real)0.0f;
        r->inverse.x = finite_reciprocal(r->direction.x);
        r->inverse.y = finite_reciprocal(r->direction.y);
        r->inverse.z = finite_reciprocal(r->direction.z);
        r->dd = DOT(r->direction, r->direction);
        r->inv_dd = DIVIDE((real)1.0f, r->dd);
        h->t = (real)INFINITY;
        h->index = h->slot = (mask)RT_MISS;
        h->u = h->v = (real)0.0f;
        h->det = (real)1.0f;
    }
}

/* Returns whether anything is hit. */
INLINE int meet_all(block *all, const rt_frame *frame, const world *w)
{
    mask any = (mask)0;
    for (int first = 0; first < RT_BLOCK_RAYS; first += RT_PACKET) {
        packet p;
        load_eye_rays(all, first, frame, &p);
        walk(&p, w, 0);
        for (int g = 0; g < RT_GROUPS; ++g) {
            const hits *h = &p.h[g];
            const int at = first + g * RT_LANES;
            any = any | MASK(h->index != (mask)RT_MISS);
            STORE_INDEX(h->index, all->index + at);
            STORE_INDEX(h->slot, all->slot + at);
            STORE_REAL(h->t, all->t + at);
            STORE_REAL(DIVIDE(h->u, h->det), all->u + at);
            STORE_REAL(DIVIDE(h->v, h->det), all->v + at);
        }
    }
    return ANY(any);
}

/* What the shading needs besides the block. */
typedef struct painting {
    rt_surround around;
    __global const int *material_of;
    __global const rt_material *materials;
    __global const rt_light *lights;
    int sphere_count;
} painting;

INLINE void paint(block *all, const rt_frame *frame, const world *w, const painting *with)
{
    const vec3 origin = {frame->ox, frame->oy, frame->oz};
    EACH_PIXEL(k)
    {
        const int is_hit = all->index[k] != RT_MISS;
        const int index = is_hit ? all->index[k] : 0;
        const int slot = max(all->slot[k], 0);
        const int at = slot / RT_BLOCK_PRIMITIVES, place = slot % RT_BLOCK_PRIMITIVES;
        const vec3 direction = {all->dx[k], all->dy[k], all->dz[k]};
        surface s;
        s.point = ADD_SCALED(direction, all->t[k], origin);
        if (index < with->sphere_count)
            sphere_surface(0, index, w->spheres + at, place, 0.0f, 0.0f, origin, direction, &s);
        else
            triangle_surface(0, index, w->triangles + at, place, all->u[k], all->v[k], origin,
                             direction, &s);
        __global const rt_material *m = with->materials + with->material_of[index];
        const vec3 kd = {m->kd_r, m->kd_g, m->kd_b};
        vec3 sum = {with->around.ambient_r * m->ka_r, with->around.ambient_g * m->ka_g,
                    with->around.ambient_b * m->ka_b};
#pragma unroll
        for (int i = 0; i < RT_LIGHTS; ++i)
            add_light(with->lights + i, m, kd, &s, direction, 1.0f, &sum);
        all->r[k] = is_hit ? sum.x : with->around.background_r;
        all->g[k] = is_hit ? sum.y : with->around.background_g;
        all->b[k] = is_hit ? sum.z : with->around.background_b;
    }
}

__kernel __attribute__((reqd_work_group_size(1, 1, 1))) void
fused(const rt_tile tile, const rt_frame frame, WORLD_PARAMETERS,
      const int sphere_count, __global const int *material_of,
      __global const rt_material *materials, __global const rt_light *lights,
      const rt_surround around, __global float *picture)
{
    const world w = WORLD;
    const painting with = {around, material_of, materials, lights, sphere_count};
    const int across = tile.width / RT_BLOCK_SIDE, at = (int)get_global_id(0);
    const int left = at % across * RT_BLOCK_SIDE, top = at / across * RT_BLOCK_SIDE;
    block all;
    aim(&all, &frame, tile.x + left, tile.y + top);
    __global float *corner =
        picture + ((size_t)top * (size_t)tile.width + (size_t)left) * RT_COLOR_COMPONENTS;
    const int is_sky = !meet_all(&all, &frame, &w);
    if (!is_sky)
        paint(&all, &frame, &w, &with);
    for (int k = 0; k < RT_BLOCK_RAYS; ++k) {
        __global float *out =
            corner + (RT_BLOCK_ROW(k) * tile.width + RT_BLOCK_COLUMN(k)) * RT_COLOR_COMPONENTS;
        out[0] = is_sky ? around.background_r : all.r[k];
        out[1] = is_sky ? around.background_g : all.g[k];
        out[2] = is_sky ? around.background_b : all.b[k];
    }
}
