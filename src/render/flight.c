#include "render/flight.h"

#include "render/pipeline.h"
#include "render/state.h"

/* Seconds that a finished command ran; 0 where the device does not tell. */
static double event_seconds(cl_event event)
{
    cl_ulong start = 0, end = 0;
    if (clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, NULL) !=
            CL_SUCCESS ||
        clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL) !=
            CL_SUCCESS ||
        end < start)
        return 0.0;
    return 1e-9 * (double)(end - start);
}

void rt_flight_release(flight *f)
{
    for (size_t i = 0; i < f->count; ++i)
        clReleaseEvent(f->events[i]);
    f->count = 0;
    f->busy = false;
}

/* Waits for the commands so far and takes their times. */
static bool land(flight *f, rt_renderer *r, rt_status *status)
{
    const bool good = f->count == 0 || RT_CL(clWaitForEvents((cl_uint)f->count, f->events), status);
    for (size_t i = 0; good && i < f->count; ++i)
        *(f->stages[i] == EVENT_READ ? &r->times.readback : &r->times.stages[f->stages[i]]) +=
            event_seconds(f->events[i]);
    rt_flight_release(f);
    return good;
}

bool rt_flight_add(flight *f, rt_renderer *r, int stage, cl_event event, rt_status *status)
{
    f->busy = true;
    f->events[f->count] = event;
    f->stages[f->count++] = stage;
    if (f->count < EVENTS_IN_FLIGHT)
        return true;
    const bool good = land(f, r, status);
    f->busy = true;
    return good;
}

bool rt_flight_finish(flight *f, rt_renderer *r, rt_status *status)
{
    return !f->busy || land(f, r, status);
}

bool rt_flight_launch(flight *f, rt_renderer *r, enum rt_stage stage, size_t rays,
                      rt_status *status)
{
    const enum rt_stage kernel = rt_stage_of_kernel(stage);
    const size_t rays_per_item = rt_pipeline_rays_an_item(r, stage);
    const size_t global = rays / rays_per_item;
    const size_t local = RT_BLOCK_RAYS / rays_per_item;
    cl_event event = NULL;
    r->times.launches[stage]++;
    return RT_CL(clEnqueueNDRangeKernel(r->queue, r->kernels[kernel], 1, NULL, &global, &local, 0,
                                        NULL, &event),
                 status) &&
           rt_flight_add(f, r, (int)stage, event, status);
}
