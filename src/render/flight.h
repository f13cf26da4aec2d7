/* Commands on their way: kernels are launched, and the times of all that runs are taken. */
#ifndef RT_RENDER_FLIGHT_H
#define RT_RENDER_FLIGHT_H

#include "opencl/cl.h"
#include "render/renderer.h"

/* Tiles whose commands may be in the queue at a time: one runs while the host prepares another. */
#define TILES_IN_FLIGHT 2
/* Commands that wait to be timed; the host waits for them where they are as many. */
#define EVENTS_IN_FLIGHT 256
/* The times of reads are taken like a stage's. */
#define EVENT_READ RT_STAGE_COUNT

/* The commands of one tile. */
typedef struct flight {
    cl_event events[EVENTS_IN_FLIGHT]; /* owned: count of them */
    int stages[EVENTS_IN_FLIGHT];      /* enum rt_stage of each, or EVENT_READ */
    size_t count;
    bool busy;
} flight;

/* One stage over `rays` rays, a multiple of RT_BLOCK_RAYS. A work-group is a block of rays at every
 * lane width; the kernels say so themselves too. */
bool rt_flight_launch(flight *f, rt_renderer *renderer, enum rt_stage stage, size_t rays,
                      rt_status *status);

/* Takes a command's event, and keeps it until its time is taken. */
bool rt_flight_add(flight *f, rt_renderer *renderer, int stage, cl_event event, rt_status *status);

/* Waits for a tile's commands and takes their times. */
bool rt_flight_finish(flight *f, rt_renderer *renderer, rt_status *status);

/* Lets go of events whose times nobody asks for. */
void rt_flight_release(flight *f);

#endif
