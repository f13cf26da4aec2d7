/* The last stage: from colours, or sums of them, and hits in block order to the tile's rows. */

#if RT_HAS_STAGES
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_resolve(const rt_tile tile, const int stride, __global const float *colors,
           __global float *picture, const rt_turn turn, const int flags)
{
    ASSUME_GROUP(RT_BLOCK_RAYS);
    const pixel p = tile_pixel(tile);
    if (!p.inside)
        return;
    vec3 color = LOAD3(colors, stride, get_global_id(0));
    if (ON(ANTIALIAS)) {
        color.x = color.x / (number)turn.divisor;
        color.y = color.y / (number)turn.divisor;
        color.z = color.z / (number)turn.divisor;
    }
    STORE3(color, picture, 1, picture_place(tile, p));
}

/* Hit records of four words a pixel: primitive index, then t, in the file's unit of length, u, v.
 */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_resolve_hits(const rt_tile tile, const int stride, __global const int *hit_index,
                __global const number *hit_array, __global int *records, const int unit_exponent)
{
    ASSUME_GROUP(RT_BLOCK_RAYS);
    const pixel p = tile_pixel(tile);
    if (!p.inside)
        return;
    const size_t i = get_global_id(0);
    const vec3 tuv = LOAD3(hit_array, stride, i);
    __global int *out = records + ((size_t)p.row * (size_t)tile.width + (size_t)p.column) * 4;
    out[0] = hit_index[i];
    out[1] = as_int((float)ldexp(tuv.x, -unit_exponent));
    out[2] = as_int((float)tuv.y);
    out[3] = as_int((float)tuv.z);
}
#endif
