/* The stages of a picture: the arrays between them, their kernels, their arguments. */
#ifndef RT_RENDER_PIPELINE_H
#define RT_RENDER_PIPELINE_H

#include "render/renderer.h"

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
    BUFFER_TALLIES, /* what is counted of rays: RT_TALLY_... */
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

/* Whether an effect is in the kernels. */
bool rt_renderer_has(const rt_renderer *renderer, enum rt_effect effect);
bool rt_renderer_has_next(const rt_renderer *renderer);
bool rt_renderer_has_probes(const rt_renderer *renderer);
bool rt_renderer_has_any_hit(const rt_renderer *renderer);

/* Makes the arrays between the stages, and a kernel for each stage with its arguments. After a
 * failure, too, the caller releases what there is. */
bool rt_pipeline_make(rt_renderer *renderer, const rt_scene *scene, rt_status *status);
void rt_pipeline_release(rt_renderer *renderer);

/* The stage whose kernel this one launches: several may be one kernel, timed apart. */
enum rt_stage rt_stage_of_kernel(enum rt_stage stage);

/* Rays that a work-item of the stage takes: RT_PACKET, RT_ITEM_RAYS or 1 of the kernels. */
size_t rt_pipeline_rays_an_item(const rt_renderer *renderer, enum rt_stage stage);

#endif
