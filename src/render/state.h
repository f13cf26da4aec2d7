/* The renderer from inside: what renderer.c, which makes it and draws pictures, pipeline.c, which
 * makes the stages and what lies between them, passes.c, which takes a tile through the stages, and
 * rays.c, which traces rays that a caller brings, all work on. */
#ifndef RT_RENDER_STATE_H
#define RT_RENDER_STATE_H

#include "opencl/cl.h"
#include "render/device_scene.h"
#include "render/renderer.h"

/* Tiles whose commands may be in the queue at a time: one runs while the host prepares another. */
#define TILES_IN_FLIGHT 2
/* Commands that wait to be timed; the host waits for them where they are as many. */
#define EVENTS_IN_FLIGHT 256
/* The times of reads are taken like a stage's. */
#define EVENT_READ RT_STAGE_COUNT

typedef struct flight {
    cl_event events[EVENTS_IN_FLIGHT];
    int stages[EVENTS_IN_FLIGHT]; /* enum rt_stage of each, or EVENT_READ */
    size_t count;
    bool busy;
} flight;

/* Arrays between the stages, for one tile; those of effects are there where the effect is. */
enum tile_buffer {
    BUFFER_RAYS,
    BUFFER_HIT_INDEX,
    BUFFER_HIT_SLOT,
    BUFFER_HIT_ARRAY,
    BUFFER_COLORS,
    BUFFER_PICTURE,
    BUFFER_RECORDS,
    BUFFER_PROBES,  /* rays that ask whether the way is free ... */
    BUFFER_BLOCKED, /* ... and what any-hit says of each */
    BUFFER_OPEN,    /* probes that got through: a row a light, and one for ambient light */
    BUFFER_CAST,    /* probes that were cast, for shadows and for ambient light */
    BUFFER_HOME,    /* a ray's place in the tile */
    BUFFER_PATHS,
    BUFFER_MARKS,
    BUFFER_NEXT_RAYS,
    BUFFER_NEXT_HOME,
    BUFFER_COUNTS, /* by block */
    BUFFER_FIRST,
    BUFFER_WAITING,
    BUFFER_WAITING_MARKS,
    BUFFER_COUNT
};

/* Arguments that change from launch to launch: their places, or -1. */
typedef struct changing {
    int tile, turn, total;
} changing;

struct rt_renderer {
    cl_context context;
    cl_command_queue queue;
    cl_program program;
    rt_effects effects;
    cl_kernel kernels[RT_STAGE_COUNT]; /* NULL where the scene does not call for the stage */
    changing changing[RT_STAGE_COUNT];
    rt_device_scene scene;
    cl_mem tile[BUFFER_COUNT];
    rt_light *lights; /* owned: light_count, for their shadows */
    int light_count;
    int samples, depth, occlusion_samples;
    int unit_exponent;  /* the scene's */
    size_t number_size; /* of a `number` of the kernels */
    cl_int stride;      /* rays that the tile arrays hold, a multiple of RT_BLOCK_RAYS */
    int tile_side, lanes, packet;
    int width, height;
    bool with_hits, with_occlusion;
    void *staging;  /* owned: stride numbers, for rt_renderer_trace */
    cl_int *counts; /* owned: RT_COUNT_COMPONENTS a block, and the blocks' first rays after them */
    flight flights[TILES_IN_FLIGHT];
    rt_render_times times;
};

/* pipeline.c: whether an effect is in the kernels. */
bool rt_renderer_has(const rt_renderer *renderer, enum rt_effect effect);
bool rt_renderer_has_next(const rt_renderer *renderer);
bool rt_renderer_has_probes(const rt_renderer *renderer);

/* Makes the arrays between the stages, and a kernel for each stage with its arguments. */
bool rt_pipeline_make(rt_renderer *renderer, const rt_scene *scene, rt_status *status);
void rt_pipeline_release(rt_renderer *renderer);

/* The stage whose kernel this one launches: several may be one kernel, timed apart. */
enum rt_stage rt_stage_of_kernel(enum rt_stage stage);

/* One stage over `rays` rays, a multiple of RT_BLOCK_RAYS. A work-group is a block of rays at every
 * lane width; the kernels say so themselves too. */
bool rt_renderer_launch(rt_renderer *renderer, enum rt_stage stage, size_t rays, flight *f,
                        rt_status *status);

/* Keeps a command's event until its time is taken. */
bool rt_flight_add(rt_renderer *renderer, flight *f, int stage, cl_event event, rt_status *status);

/* Waits for a tile's commands and takes their times. */
bool rt_renderer_finish(rt_renderer *renderer, flight *f, rt_status *status);

/* passes.c: takes a tile through all stages, and queues the reads of what comes of it. Where that
 * takes several passes, asks the watch between them; `done` and `share` are the parts of the
 * picture that are done before and that the tile is. */
bool rt_renderer_start_tile(rt_renderer *renderer, const rt_tile *tile, rt_image *image, flight *f,
                            const rt_watch *watch, double done, double share, rt_status *status);

/* Brings the times' counts of probes up to date. */
bool rt_renderer_count_probes(rt_renderer *renderer, rt_status *status);

#endif
