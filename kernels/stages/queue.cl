/* Between passes over a tile's paths: how many rays go on, and the arrays of those alone, in the
 * order that they had. What has ended takes no more time; the picture is the same. */

#if RT_HAS_SECONDARY && RT_NEXT
INLINE int goes_on(__global const number *next_rays, size_t step, size_t i)
{
    return next_rays[RT_RAY_TMAX * step + i] > next_rays[RT_RAY_TMIN * step + i];
}

/* The rays of each block that go on: all, and those that are refracted. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_count(const int stride, __global const number *next_rays, __global const int *next_home,
         __global const int *marks, __global int *counts)
{
    ASSUME_GROUP(RT_BLOCK_RAYS);
    __local int on[RT_BLOCK_RAYS], bent[RT_BLOCK_RAYS];
    const size_t i = get_global_id(0);
    const size_t step = (size_t)stride;
    const int lane = (int)get_local_id(0);
    const int alive = goes_on(next_rays, step, i);
    on[lane] = alive;
    bent[lane] = alive ? marks[RT_MARK_IS_REFRACTED * step + (size_t)next_home[i]] : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane == 0) {
        int all = 0, refracted_ones = 0;
        for (int k = 0; k < RT_BLOCK_RAYS; ++k) {
            all += on[k];
            refracted_ones += bent[k];
        }
        counts[get_group_id(0) * RT_COUNT_COMPONENTS + RT_COUNT_ALL] = all;
        counts[get_group_id(0) * RT_COUNT_COMPONENTS + RT_COUNT_REFRACTED] = refracted_ones;
    }
}

/* Moves the rays that go on to the front; `first` is where each block's begin, `total` how many
 * there are. The last block is filled up with rays that end before they begin. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_pack(const int stride, const int total, __global const int *first,
        __global const number *next_rays, __global const int *next_home, __global number *rays,
        __global int *home)
{
    ASSUME_GROUP(RT_BLOCK_RAYS);
    __local int on[RT_BLOCK_RAYS];
    const size_t i = get_global_id(0);
    const size_t step = (size_t)stride;
    const int lane = (int)get_local_id(0);
    const int alive = goes_on(next_rays, step, i);
    on[lane] = alive;
    barrier(CLK_LOCAL_MEM_FENCE);
    int before = 0;
    for (int k = 0; k < RT_BLOCK_RAYS; ++k)
        before += k < lane ? on[k] : 0;
    if (alive) {
        const size_t to = (size_t)(first[get_group_id(0)] + before);
        for (int c = 0; c < RT_RAY_COMPONENTS; ++c)
            rays[(size_t)c * step + to] = next_rays[(size_t)c * step + i];
        home[to] = next_home[i];
    }
    const int filler = total + lane;
    if (get_group_id(0) == 0 &&
        filler < (total + RT_BLOCK_RAYS - 1) / RT_BLOCK_RAYS * RT_BLOCK_RAYS) {
        rays[RT_RAY_TMIN * step + (size_t)filler] = 0.0f;
        rays[RT_RAY_TMAX * step + (size_t)filler] = -1.0f;
        home[filler] = 0;
    }
}
#endif
