/* Which pixel a work-item of the camera and resolve stages stands for. One work-group is one 8x8
 * block; blocks go row by row through the tile, and the last ones may hang over its edge. */

typedef struct pixel {
    int column, row; /* within the tile */
    int inside;      /* 0 where a block hangs over the tile's edge */
} pixel;

/* Of place `i` of a block. */
INLINE pixel block_pixel(rt_tile tile, int block, int i)
{
    const int blocks_per_row = (tile.width + RT_BLOCK_SIDE - 1) / RT_BLOCK_SIDE;
    pixel p;
    p.column = block % blocks_per_row * RT_BLOCK_SIDE + RT_BLOCK_COLUMN(i);
    p.row = block / blocks_per_row * RT_BLOCK_SIDE + RT_BLOCK_ROW(i);
    p.inside = (p.column < tile.width) & (p.row < tile.height);
    return p;
}

INLINE pixel tile_pixel(rt_tile tile)
{
    return block_pixel(tile, (int)get_group_id(0), (int)get_local_id(0));
}

/* What a kernel's attributes say of its work-groups, in the form that PoCL's optimiser sees too
 * where it compiles for groups of any size: without it every kernel is a loop in three dimensions,
 * up to a quarter slower. */
#if HAS_BUILTIN(__builtin_assume)
#define ASSUME_GROUP(size)                                                                         \
    do {                                                                                           \
        const size_t x_ = get_local_size(0), y_ = get_local_size(1), z_ = get_local_size(2);       \
        const size_t offset_ = get_global_offset(0);                                               \
        __builtin_assume(x_ == (size));                                                            \
        __builtin_assume(y_ == 1);                                                                 \
        __builtin_assume(z_ == 1);                                                                 \
        __builtin_assume(offset_ == 0);                                                            \
    } while (0)
#else
#define ASSUME_GROUP(size) (void)0
#endif

/* Where a pixel's colour is in the tile's rows, whose components lie side by side. */
INLINE size_t picture_place(rt_tile tile, pixel p)
{
    return ((size_t)p.row * (size_t)tile.width + (size_t)p.column) * RT_COLOR_COMPONENTS;
}

/* The random numbers of the pixel of any place in the tile's arrays. */
INLINE uint sequence_at(rt_tile tile, int slot, uint seed, uint purpose, int bounce)
{
    const pixel p = block_pixel(tile, slot / RT_BLOCK_RAYS, slot % RT_BLOCK_RAYS);
    return sequence_of(seed, tile.x + p.column, tile.y + p.row, purpose, bounce);
}

/* Where a loop does not become one of vectors, that is no mistake. */
#ifdef __clang__
#pragma clang diagnostic ignored "-Wpass-failed"
#endif

/* The rays of a work-item, each without a thought to the others. */
#define EACH_RAY(k)                                                                                \
    _Pragma("clang loop vectorize(assume_safety)") for (size_t k = 0; k < RT_ITEM_RAYS; ++k)

/* Sets of three numbers a ray of a work-item: one array a component, so that loops over the rays
 * become vectors. */
#define ITEM_VECTORS (3 * RT_ITEM_RAYS)
#define ITEM_VECTOR(array, k) LOAD3(array, RT_ITEM_RAYS, k)
#define STORE_ITEM_VECTOR(v, array, k) STORE3(v, array, RT_ITEM_RAYS, k)

/* Whether one of them hits anything. */
INLINE int any_hit(__global const int *hit_index, size_t first)
{
    int any = 0;
    for (int k = 0; k < RT_ITEM_RAYS; ++k)
        any |= hit_index[first + (size_t)k] ^ RT_MISS;
    return any != 0;
}
