/* The renderer from inside: what render.c, which draws pictures, and render_rays.c, which traces
 * rays that a caller brings, both work on. */
#ifndef RT_RENDER_STATE_H
#define RT_RENDER_STATE_H

#include "cl.h"
#include "device_scene.h"
#include "render.h"

/* Tiles whose commands may be in the queue at a time: one runs while the host prepares another. */
#define TILES_IN_FLIGHT 2
/* Commands of a tile that are timed: the stages, and the reads of colours and of hits. */
#define EVENTS_PER_TILE (RT_STAGE_COUNT + 2)

enum event_slot { EVENT_READ_COLORS = RT_STAGE_COUNT, EVENT_READ_HITS };

typedef struct flight {
    cl_event events[EVENTS_PER_TILE]; /* NULL where there was no such command */
    bool busy;
} flight;

/* Arrays between the stages, for one tile. */
typedef struct tile_buffers {
    cl_mem rays, hit_index, hit_slot, hit_array, colors, picture, records;
} tile_buffers;

struct rt_renderer {
    cl_context context;
    cl_command_queue queue;
    cl_program program;
    cl_kernel kernels[RT_STAGE_COUNT];
    rt_device_scene scene;
    tile_buffers tile;
    cl_int stride; /* rays that the tile arrays hold, a multiple of RT_BLOCK_RAYS */
    int tile_side, lanes, packet;
    int width, height;
    bool with_hits, with_occlusion;
    float *staging; /* owned: stride values, for rt_renderer_trace */
    flight flights[TILES_IN_FLIGHT];
    rt_render_times times;
};

/* One stage over `rays` rays, a multiple of RT_BLOCK_RAYS. A work-group is a block of rays at every
 * lane width; the kernels say so themselves too. */
bool rt_renderer_launch(rt_renderer *renderer, enum rt_stage stage, size_t rays, cl_event *event,
                        rt_status *status);

/* Waits for a tile and takes its times. */
bool rt_renderer_finish(rt_renderer *renderer, flight *f, rt_status *status);

#endif
