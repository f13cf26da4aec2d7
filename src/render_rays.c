/* Rays that a caller brings, through the same kernels that render. */
#include "render_state.h"

static void stage_number(const rt_renderer *r, size_t i, float value)
{
    if (r->number_size == sizeof(double))
        ((double *)r->staging)[i] = (double)value;
    else
        ((float *)r->staging)[i] = value;
}

/* Rounded to float where the kernels compute in double. */
static float staged_number(const rt_renderer *r, size_t i)
{
    return r->number_size == sizeof(double) ? (float)((double *)r->staging)[i]
                                            : ((float *)r->staging)[i];
}

/* Component `c` of `count` rays; the rest of the last block ends before it begins. */
static bool stage_component(rt_renderer *r, cl_mem target, const rt_ray *rays, size_t count,
                            size_t padded, size_t c, rt_status *status)
{
    for (size_t i = 0; i < padded; ++i) {
        const rt_ray *ray = &rays[i < count ? i : count - 1];
        stage_number(r, i,
                     c < RT_RAY_DX      ? ray->origin[c]
                     : c < RT_RAY_TMIN  ? ray->direction[c - RT_RAY_DX]
                     : c == RT_RAY_TMIN ? ray->tmin
                     : i < count        ? ray->tmax
                                        : -1.0f);
    }
    return RT_CL(clEnqueueWriteBuffer(r->queue, target, CL_TRUE,
                                      c * (size_t)r->stride * r->number_size,
                                      padded * r->number_size, r->staging, 0, NULL, NULL),
                 status);
}

/* Uploads rays and runs a stage over them. */
static bool trace_stage(rt_renderer *r, enum rt_stage stage, const rt_ray *rays, size_t count,
                        rt_status *status)
{
    const cl_mem target = r->tile[stage == RT_STAGE_TRACE ? BUFFER_RAYS : BUFFER_PROBES];
    const size_t padded = (count + RT_BLOCK_RAYS - 1) / RT_BLOCK_RAYS * RT_BLOCK_RAYS;
    for (size_t c = 0; c < RT_RAY_COMPONENTS; ++c)
        if (!stage_component(r, target, rays, count, padded, c, status))
            return false;
    flight *f = &r->flights[0];
    return rt_renderer_launch(r, stage, padded, f, status) && rt_renderer_finish(r, f, status);
}

/* Reads `count` values of `size` bytes of a buffer, from value `first` on, to r->staging. */
static bool read_values(rt_renderer *r, cl_mem buffer, size_t size, size_t first, size_t count,
                        rt_status *status)
{
    return RT_CL(clEnqueueReadBuffer(r->queue, buffer, CL_TRUE, first * size, count * size,
                                     r->staging, 0, NULL, NULL),
                 status);
}

/* The primitive index that lies at place i of r->staging. */
static int32_t staged_index(const rt_renderer *r, size_t i)
{
    return ((int32_t *)r->staging)[i];
}

static bool trace_part(rt_renderer *r, const rt_ray *rays, size_t count, rt_hit *hits,
                       rt_status *status)
{
    if (!trace_stage(r, RT_STAGE_TRACE, rays, count, status) ||
        !read_values(r, r->tile[BUFFER_HIT_INDEX], sizeof(int32_t), 0, count, status))
        return false;
    for (size_t i = 0; i < count; ++i)
        hits[i].primitive = staged_index(r, i);
    for (size_t c = 0; c < RT_HIT_COMPONENTS; ++c) {
        if (!read_values(r, r->tile[BUFFER_HIT_ARRAY], r->number_size, c * (size_t)r->stride, count,
                         status))
            return false;
        for (size_t i = 0; i < count; ++i)
            *(c == RT_HIT_T   ? &hits[i].t
              : c == RT_HIT_U ? &hits[i].u
                              : &hits[i].v) = staged_number(r, i);
    }
    return true;
}

bool rt_renderer_trace(rt_renderer *r, const rt_ray *rays, size_t count, rt_hit *hits,
                       rt_status *status)
{
    const size_t most = (size_t)r->stride;
    for (size_t done = 0; done < count; done += most) {
        const size_t part = count - done < most ? count - done : most;
        if (!trace_part(r, rays + done, part, hits + done, status))
            return false;
    }
    return true;
}

bool rt_renderer_occluded(rt_renderer *r, const rt_ray *rays, size_t count, uint8_t *occluded,
                          rt_status *status)
{
    const size_t most = (size_t)r->stride;
    for (size_t done = 0; done < count; done += most) {
        const size_t part = count - done < most ? count - done : most;
        if (!trace_stage(r, RT_STAGE_OCCLUDE, rays + done, part, status) ||
            !read_values(r, r->tile[BUFFER_BLOCKED], sizeof(int32_t), 0, part, status))
            return false;
        for (size_t i = 0; i < part; ++i)
            occluded[done + i] = staged_index(r, i) != RT_MISS;
    }
    return true;
}
