/* The renderer from inside: what renderer.c, which makes it and draws pictures, pipeline.c, which
 * makes the stages and what lies between them, arguments.c, which tells kernels what they ask for,
 * flight.c, which launches them, passes.c, which takes a tile through them, and rays.c, which
 * traces rays that a caller brings, all work on. */
#ifndef RT_RENDER_STATE_H
#define RT_RENDER_STATE_H

#include "opencl/cl.h"
#include "render/device_scene.h"
#include "render/flight.h"
#include "render/pipeline.h"
#include "render/programs.h"
#include "render/renderer.h"

/* Arguments that change from launch to launch: their places, or -1. */
typedef struct changing {
    int tile, turn, total;
} changing;

struct rt_renderer {
    cl_context context;
    cl_command_queue queue;
    rt_programs programs;
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
    int capacity;       /* rays that the tile arrays hold, a multiple of RT_BLOCK_RAYS */
    cl_int stride;      /* elements from one component of an array to the next, a few more */
    int tile_side, lanes, packet;
    int width, height;
    bool with_hits, with_occlusion;
    void *staging;  /* owned: capacity numbers, for rt_renderer_trace */
    cl_int *counts; /* owned: RT_COUNT_COMPONENTS a block, and the blocks' first rays after them */
    flight flights[TILES_IN_FLIGHT];
    rt_render_times times;
};

#endif
