/* Stage 1: the primary rays of a tile, unit directions through the pixels' centres or, of several
 * samples, through points about them. */

/* From a point of the unit interval to an offset from the pixel's centre, in pixels: even over the
 * pixel, or like a tent over it and half of each neighbour. */
INLINE number filtered(number t, const int tent)
{
    const number twice = t + t;
    const number side = twice < (number)1.0f ? ROOT_1(twice) - (number)1.0f
                                             : (number)1.0f - ROOT_1((number)2.0f - twice);
    return tent ? side : t - (number)0.5f;
}

/* Ray i is its pixel's own, and nothing has been lost of it. */
INLINE void begin_path(__global int *home, __global number *paths, __global int *marks,
                       ulong inside, size_t step, size_t i)
{
    home[i] = (int)i;
    paths[RT_PATH_WEIGHT * step + i] = 1.0f;
    paths[RT_PATH_TINT_R * step + i] = 1.0f;
    paths[RT_PATH_TINT_G * step + i] = 1.0f;
    paths[RT_PATH_TINT_B * step + i] = 1.0f;
    marks[RT_MARK_BOUNCE * step + i] = 0;
    marks[RT_MARK_INSIDE_LOW * step + i] = (int)inside;
    marks[RT_MARK_INSIDE_HIGH * step + i] = (int)(inside >> 32);
    marks[RT_MARK_WAITING * step + i] = 0;
}

/* What rays are made of. */
typedef struct view {
    rt_frame frame;
    rt_tile tile;
    uint seed, sample;
    int flags;
} view;

INLINE void primary_ray(const view *w, pixel p, vec3 *origin, vec3 *direction)
{
    const int flags = w->flags;
    const int x = w->tile.x + p.column, y = w->tile.y + p.row;
    /* Whole numbers, exact in float; the pixel size is in the frame's vectors. */
    number across = (number)(2 * x + 1 - w->frame.width);
    number upward = (number)(w->frame.height - 1 - 2 * y);
    if (ON(ANTIALIAS)) {
        number u, v;
        sample_point(sequence_of(w->seed, x, y, RT_PURPOSE_PIXEL, 0), w->sample, &u, &v);
        const number dx = filtered(u, flags & RT_FLAG_TENT);
        const number dy = filtered(v, flags & RT_FLAG_TENT);
        across = across + (dx + dx);
        upward = upward - (dy + dy);
    }
    const vec3 right = {w->frame.right_x, w->frame.right_y, w->frame.right_z};
    const vec3 up = {w->frame.up_x, w->frame.up_y, w->frame.up_z};
    const vec3 forward = {w->frame.forward_x, w->frame.forward_y, w->frame.forward_z};
    const vec3 level = ADD_SCALED(up, upward, forward);
    vec3 through = ADD_SCALED(right, across, level);
    *origin = (vec3){w->frame.ox, w->frame.oy, w->frame.oz};
    if (ON(LENS)) {
        number u, v, dx, dy;
        sample_point(sequence_of(w->seed, x, y, RT_PURPOSE_LENS, 0), w->sample, &u, &v);
        disk(u, v, &dx, &dy);
        const vec3 lens_right = {w->frame.lens_right_x, w->frame.lens_right_y,
                                 w->frame.lens_right_z};
        const vec3 lens_up = {w->frame.lens_up_x, w->frame.lens_up_y, w->frame.lens_up_z};
        const vec3 aside = SCALE(lens_right, dx);
        const vec3 lens = ADD_SCALED(lens_up, dy, aside);
        const vec3 back = {-lens.x, -lens.y, -lens.z};
        through = ADD_SCALED(through, w->frame.focus, back);
        *origin = (vec3){origin->x + lens.x, origin->y + lens.y, origin->z + lens.z};
        make_unit(&through);
    } else {
        through = SCALE(through, RECIPROCAL_LENGTH(through));
    }
    *direction = through;
}

/* What earlier samples have brought is in the picture's rows. */
INLINE void begin_color(__global const float *picture, rt_tile tile, int begin, pixel p,
                        __global float *colors, size_t step, size_t i)
{
    vec3 before = {0.0f, 0.0f, 0.0f};
    if (begin > 0 && p.inside)
        before = LOAD3(picture, 1, picture_place(tile, p));
    STORE3(before, colors, step, i);
}

#if RT_HAS_STAGES
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_ITEM_RAYS, 1, 1))) void
rt_camera(const rt_frame frame, const rt_tile tile, const int stride, __global number *rays,
          const rt_turn turn, const uint seed, const int flags, __global float *colors,
          __global int *home, __global number *paths, __global int *marks, const rt_nesting nesting,
          __global const float *picture)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_ITEM_RAYS);
    const view w = {frame, tile, seed, (uint)turn.sample, flags};
    const size_t step = (size_t)stride;
    const size_t first = get_global_id(0) * RT_ITEM_RAYS;
    const int block = (int)(first / RT_BLOCK_RAYS), place = (int)(first % RT_BLOCK_RAYS);
    EACH_RAY(k)
    {
        const pixel p = block_pixel(tile, block, place + (int)k);
        vec3 origin, direction;
        primary_ray(&w, p, &origin, &direction);
        STORE3(origin, rays + RT_RAY_OX * step, step, first + k);
        STORE3(direction, rays + RT_RAY_DX * step, step, first + k);
        rays[RT_RAY_TMIN * step + first + k] = 0.0f;
        /* A ray that hangs over the tile's edge ends before it begins. */
        rays[RT_RAY_TMAX * step + first + k] = p.inside ? (number)INFINITY : (number)-1.0f;
    }
    if (RT_SUM && turn.sample == turn.begin)
        for (int k = 0; k < RT_ITEM_RAYS; ++k)
            begin_color(picture, tile, turn.begin, block_pixel(tile, block, place + k), colors,
                        step, first + (size_t)k);
    if (RT_NEXT) {
        EACH_RAY(k)
        begin_path(home, paths, marks, nesting.eye, step, first + k);
    }
}
#endif
