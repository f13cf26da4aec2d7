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

#if RT_HAS_STAGES
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_camera(const rt_frame frame, const rt_tile tile, const int stride, __global number *rays,
          const rt_turn turn, const uint seed, const int flags, __global float *colors,
          __global int *home, __global number *paths, __global int *marks, const rt_nesting nesting,
          __global const float *picture)
{
    ASSUME_GROUP(RT_BLOCK_RAYS);
    const pixel p = tile_pixel(tile);
    const size_t i = get_global_id(0);
    const int x = tile.x + p.column, y = tile.y + p.row;
    /* Whole numbers, exact in float; the pixel size is in the frame's vectors. */
    number across = (number)(2 * x + 1 - frame.width);
    number upward = (number)(frame.height - 1 - 2 * y);
    if (ON(ANTIALIAS)) {
        number u, v;
        sample_point(sequence_of(seed, x, y, RT_PURPOSE_PIXEL, 0), (uint)turn.sample, &u, &v);
        const number dx = filtered(u, flags & RT_FLAG_TENT);
        const number dy = filtered(v, flags & RT_FLAG_TENT);
        across = across + (dx + dx);
        upward = upward - (dy + dy);
    }
    const vec3 right = {frame.right_x, frame.right_y, frame.right_z};
    const vec3 up = {frame.up_x, frame.up_y, frame.up_z};
    const vec3 forward = {frame.forward_x, frame.forward_y, frame.forward_z};
    const vec3 level = ADD_SCALED(up, upward, forward);
    vec3 through = ADD_SCALED(right, across, level);
    vec3 origin = {frame.ox, frame.oy, frame.oz};
    if (ON(LENS)) {
        number u, v, dx, dy;
        sample_point(sequence_of(seed, x, y, RT_PURPOSE_LENS, 0), (uint)turn.sample, &u, &v);
        disk(u, v, &dx, &dy);
        const vec3 lens_right = {frame.lens_right_x, frame.lens_right_y, frame.lens_right_z};
        const vec3 lens_up = {frame.lens_up_x, frame.lens_up_y, frame.lens_up_z};
        const vec3 aside = SCALE(lens_right, dx);
        const vec3 lens = ADD_SCALED(lens_up, dy, aside);
        const vec3 back = {-lens.x, -lens.y, -lens.z};
        const number focus = frame.focus;
        through = ADD_SCALED(through, focus, back);
        origin = (vec3){origin.x + lens.x, origin.y + lens.y, origin.z + lens.z};
        make_unit(&through);
    } else {
        through = SCALE(through, RECIPROCAL_LENGTH(through));
    }
    const size_t step = (size_t)stride;
    STORE3(origin, rays + RT_RAY_OX * step, step, i);
    STORE3(through, rays + RT_RAY_DX * step, step, i);
    rays[RT_RAY_TMIN * step + i] = 0.0f;
    /* A ray that hangs over the tile's edge ends before it begins. */
    rays[RT_RAY_TMAX * step + i] = p.inside ? INFINITY : -1.0f;
    if (RT_SUM && turn.sample == turn.begin) {
        vec3 before = {0.0f, 0.0f, 0.0f};
        if (turn.begin > 0 && p.inside)
            before = LOAD3(picture, 1, picture_place(tile, p));
        STORE3(before, colors, step, i);
    }
    if (RT_NEXT)
        begin_path(home, paths, marks, nesting.eye, step, i);
}
#endif
