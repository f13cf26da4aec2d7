/* A picture by one device or by several at once: each has its own renderer and thread, and all take
 * tiles from one queue. The picture does not depend on who rendered what. */
#ifndef RT_RENDER_TEAM_H
#define RT_RENDER_TEAM_H

#include "render/renderer.h"

typedef struct rt_team rt_team;

/* What one device has had of the pictures. */
typedef struct rt_team_share {
    const rt_device *device; /* the caller's */
    int lanes;
    size_t tiles, rays;
    double seconds; /* wall time from the start to the end of its last tile */
} rt_team_share;

/* Makes a renderer on each of the `count` devices, 1 or more, all at the same time. The same device
 * may be there more than once. The devices must outlive the team. With several, a tile side of 0
 * means one that gives each device many tiles. Returns NULL after an error, which names the device
 * where there are several. */
rt_team *rt_team_new(const rt_device *const *devices, size_t count, const rt_scene *scene,
                     const rt_bvh *bvh, const rt_render_options *options, rt_status *status);
void rt_team_free(rt_team *team);

/* As rt_renderer_draw. The first device that fails stops the others. The watch is never asked by
 * two threads at a time. */
bool rt_team_draw(rt_team *team, rt_image *image, const rt_watch *watch, rt_status *status);

/* The same of some of each pixel's samples, as rt_renderer_draw_tiles. */
bool rt_team_draw_range(rt_team *team, const rt_sample_range *range, rt_image *image,
                        const rt_watch *watch, rt_status *status);

size_t rt_team_count(const rt_team *team);
rt_team_share rt_team_share_of(const rt_team *team, size_t member);

/* Of all devices: launches, rays and the stages' seconds are sums; of `program`, `upload` and
 * `readback`, which devices do side by side, the longest counts. */
rt_render_times rt_team_times(const rt_team *team);

#endif
