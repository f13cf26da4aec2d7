/* The renderer: a scene on a device, launched tile by tile in the stages of kernels/. */
#ifndef RT_RENDER_RENDERER_H
#define RT_RENDER_RENDERER_H

#include <stdbool.h>
#include <stddef.h>

#include "bvh/bvh.h"
#include "common/ray.h"
#include "common/watch.h"
#include "image/image.h"
#include "opencl/device.h"
#include "render/tiles.h"
#include "scene/effects.h"
#include "scene/scene.h"

#define RT_TILE_DEFAULT 256
#define RT_TILE_MAX 4096

typedef struct rt_render_options {
    int lanes;           /* rays a vector: 1, 4, 8, 16, or 0 for what suits the device */
    int packet;          /* rays a work-item: a multiple of lanes up to 64, or 0 for the default */
    int tile;            /* side of a tile in pixels, 1 to RT_TILE_MAX, or 0 for the default */
    bool with_hits;      /* whether rt_renderer_draw may be asked for hit records */
    bool with_occlusion; /* whether rt_renderer_occluded may be called */
    const rt_effects *effects; /* what to build the kernels for; NULL: rt_effects_of the scene */
    const rt_watch *building;  /* told how far they are while compilers run, and may stop them with
                                * RT_INTERRUPTED; a team tells by one thread at a time */
} rt_render_options;

enum rt_stage {
    RT_STAGE_CAMERA,
    RT_STAGE_TRACE,
    RT_STAGE_SHADE,
    RT_STAGE_RESOLVE,
    RT_STAGE_OCCLUDE,     /* any hit; only by rt_renderer_occluded */
    RT_STAGE_HITS,        /* hit records into rows; only where they are asked for */
    RT_STAGE_SHADOW_RAYS, /* these three a light and a share of its samples */
    RT_STAGE_SHADOW,
    RT_STAGE_SHADOW_TALLY,
    RT_STAGE_AMBIENT_RAYS, /* and these for ambient occlusion */
    RT_STAGE_AMBIENT,
    RT_STAGE_AMBIENT_TALLY,
    RT_STAGE_NEXT,       /* rays that go on: what they are, ... */
    RT_STAGE_COUNT_NEXT, /* ... how many, ... */
    RT_STAGE_PACK,       /* those alone ... */
    RT_STAGE_NEXT_TRACE, /* ... and trace and shade again */
    RT_STAGE_NEXT_SHADE,
    RT_STAGE_COUNT
};

/* Seconds by the device's own clock (0 where it has none), and rays, added up since the renderer
 * was made. `program` and `upload` are of the making. */
typedef struct rt_render_times {
    double program, upload, readback;
    double stages[RT_STAGE_COUNT];
    size_t launches[RT_STAGE_COUNT];
    size_t tiles;
    rt_ray_counts rays;
} rt_render_times;

typedef struct rt_renderer rt_renderer;

/* Builds the kernels for the scene and uploads its arrays. The tree is the scene's own, or NULL to
 * hold every ray against every primitive, which gives the same bits. Scene and tree may be cleared
 * afterwards. Returns NULL after an error, with code RT_ERROR_DEVICE. */
rt_renderer *rt_renderer_new(const rt_device *device, const rt_scene *scene, const rt_bvh *bvh,
                             const rt_render_options *options, rt_status *status);
void rt_renderer_free(rt_renderer *renderer);

/* Renders the picture, whose size must be the scene's; hit records are filled in where the picture
 * has room for them, of the first sample of each pixel. Stops with code RT_INTERRUPTED between
 * tiles, and between samples and passes of a tile, when the watch says so. */
bool rt_renderer_draw(rt_renderer *renderer, rt_image *image, const rt_watch *watch,
                      rt_status *status);

/* Some of each pixel's samples, `first` to `first + count - 1`; of a picture of one sample all. */
typedef struct rt_sample_range {
    int first, count;
    bool as_sums; /* whether the picture is left as sums, so that more can be added */
} rt_sample_range;

/* Renders the tiles that are left, of a side that is the renderer's, until none is. With a range of
 * samples that begins above 0 the picture holds the sums of those before; the sums, and so the
 * bytes, are the same in however many ranges they are made. NULL: all of the scene's samples. */
bool rt_renderer_draw_tiles(rt_renderer *renderer, rt_tiles *tiles, const rt_sample_range *range,
                            rt_image *image, const rt_watch *watch, rt_status *status);

/* The nearest hits of `count` rays, through the trace kernel that renders. */
bool rt_renderer_trace(rt_renderer *renderer, const rt_ray *rays, size_t count, rt_hit *hits,
                       rt_status *status);

/* Whether each of `count` rays hits anything: 1 or 0. */
bool rt_renderer_occluded(rt_renderer *renderer, const rt_ray *rays, size_t count,
                          uint8_t *occluded, rt_status *status);

int rt_renderer_lanes(const rt_renderer *renderer);
const rt_render_times *rt_renderer_times(const rt_renderer *renderer);

/* "camera", "trace", ... */
const char *rt_stage_name(enum rt_stage stage);

#endif
