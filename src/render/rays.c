/* Rays that a caller brings, through the same kernels that render. */
#include <math.h>

#include "render/state.h"

/* Exponents of the powers of two that a ray's lengths and direction are multiplied by on the way to
 * the kernels: so a direction of any length is of moderate size there. */
typedef struct ray_units {
    int length, direction;
} ray_units;

static ray_units units_of(const rt_renderer *r, const rt_ray *ray)
{
    const float *d = ray->direction;
    const float most = fmaxf(fabsf(d[0]), fmaxf(fabsf(d[1]), fabsf(d[2])));
    return (ray_units){r->unit_exponent, most > 0.0f && isfinite(most) ? -ilogbf(most) : 0};
}

/* Component `c` of a ray as the kernels take it. */
static double component_of(const rt_renderer *r, const rt_ray *ray, size_t c)
{
    const ray_units u = units_of(r, ray);
    if (c < RT_RAY_DX)
        return ldexp((double)ray->origin[c], u.length);
    if (c < RT_RAY_TMIN)
        return ldexp((double)ray->direction[c - RT_RAY_DX], u.direction);
    return ldexp((double)(c == RT_RAY_TMIN ? ray->tmin : ray->tmax), u.length - u.direction);
}

static void stage_number(const rt_renderer *r, size_t i, double value)
{
    if (r->number_size == sizeof(double))
        ((double *)r->staging)[i] = value;
    else
        ((float *)r->staging)[i] = (float)value;
}

static double staged_number(const rt_renderer *r, size_t i)
{
    return r->number_size == sizeof(double) ? ((double *)r->staging)[i]
                                            : (double)((float *)r->staging)[i];
}

/* Component `c` of `count` rays; the rest of the last block ends before it begins. */
static bool stage_component(rt_renderer *r, cl_mem target, const rt_ray *rays, size_t count,
                            size_t padded, size_t c, rt_status *status)
{
    for (size_t i = 0; i < padded; ++i) {
        const rt_ray *ray = &rays[i < count ? i : count - 1];
        stage_number(r, i, i >= count && c == RT_RAY_TMAX ? -1.0 : component_of(r, ray, c));
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
    return rt_flight_launch(f, r, stage, padded, status) && rt_flight_finish(f, r, status);
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
        for (size_t i = 0; i < count; ++i) {
            const ray_units u = units_of(r, &rays[i]);
            const double value = staged_number(r, i);
            if (c == RT_HIT_T)
                hits[i].t = (float)ldexp(value, u.direction - u.length);
            else
                *(c == RT_HIT_U ? &hits[i].u : &hits[i].v) = (float)value;
        }
    }
    return true;
}

bool rt_renderer_trace(rt_renderer *r, const rt_ray *rays, size_t count, rt_hit *hits,
                       rt_status *status)
{
    const size_t most = (size_t)r->capacity;
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
    const size_t most = (size_t)r->capacity;
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
