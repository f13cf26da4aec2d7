/* Stage 1: the primary rays of a tile, unit directions through the pixels' centres. */

__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_camera(const rt_frame frame, const rt_tile tile, const int stride, __global number *rays)
{
    const pixel p = tile_pixel(tile);
    const size_t i = get_global_id(0);
    /* Whole numbers, exact in float; the pixel size is in the frame's vectors. */
    const number across = (number)(2 * (tile.x + p.column) + 1 - frame.width);
    const number upward = (number)(frame.height - 1 - 2 * (tile.y + p.row));
    const vec3 through = {fma(frame.right_x, across, fma(frame.up_x, upward, frame.forward_x)),
                          fma(frame.right_y, across, fma(frame.up_y, upward, frame.forward_y)),
                          fma(frame.right_z, across, fma(frame.up_z, upward, frame.forward_z))};
    const vec3 direction = SCALE(through, RECIPROCAL_LENGTH(through));
    rays[RT_RAY_OX * (size_t)stride + i] = frame.ox;
    rays[RT_RAY_OY * (size_t)stride + i] = frame.oy;
    rays[RT_RAY_OZ * (size_t)stride + i] = frame.oz;
    rays[RT_RAY_DX * (size_t)stride + i] = direction.x;
    rays[RT_RAY_DY * (size_t)stride + i] = direction.y;
    rays[RT_RAY_DZ * (size_t)stride + i] = direction.z;
    rays[RT_RAY_TMIN * (size_t)stride + i] = 0.0f;
    /* A ray that hangs over the tile's edge ends before it begins. */
    rays[RT_RAY_TMAX * (size_t)stride + i] = p.inside ? INFINITY : -1.0f;
}
