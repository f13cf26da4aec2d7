/* The last stage: from colours, or sums of them, and hits in block order to the tile's rows. */

/* A quarter of a block is four rows of four pixels, one after another: what compilers turn into
 * vectors. */
#define RT_QUARTER_SIDE (RT_BLOCK_SIDE / 2)

/* The mean of a pixel's samples, ray i's, in three numbers from `out` on. */
INLINE void put_mean(size_t stride, __global const float *colors, size_t i, __global float *out,
                     int divisor, const int flags)
{
    vec3 color = LOAD3(colors, stride, i);
    if (ON(ANTIALIAS)) {
        color.x = color.x / (number)divisor;
        color.y = color.y / (number)divisor;
        color.z = color.z / (number)divisor;
    }
    STORE3(color, out, 1, 0);
}

#if RT_HAS_STAGES
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_ITEM_RAYS, 1, 1))) void
rt_resolve(const rt_tile tile, const int stride, __global const float *colors,
           __global float *picture, const rt_turn turn, const int flags)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_ITEM_RAYS);
    const size_t first = get_global_id(0) * RT_ITEM_RAYS;
    const int block = (int)(first / RT_BLOCK_RAYS);
    if (RT_ITEM_RAYS > 1 && block_pixel(tile, block, RT_BLOCK_RAYS - 1).inside) {
        for (int i = 0; i < RT_BLOCK_RAYS; i += RT_QUARTER_SIDE) {
            __global float *row = picture + picture_place(tile, block_pixel(tile, block, i));
            for (size_t k = 0; k < RT_QUARTER_SIDE; ++k)
                put_mean((size_t)stride, colors, first + (size_t)i + k,
                         row + k * RT_COLOR_COMPONENTS, turn.divisor, flags);
        }
        return;
    }
    for (size_t k = 0; k < RT_ITEM_RAYS; ++k) {
        const pixel p = block_pixel(tile, block, (int)((first + k) % RT_BLOCK_RAYS));
        if (p.inside)
            put_mean((size_t)stride, colors, first + k, picture + picture_place(tile, p),
                     turn.divisor, flags);
    }
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
