/* What a run did and how long it took, as JSON. */
#ifndef RT_CLI_STATS_H
#define RT_CLI_STATS_H

#include "cli/options.h"
#include "common/file.h"
#include "render/team.h"
#include "scene/effects.h"

/* All pointers are the caller's. */
typedef struct rt_stats {
    enum rt_target target;
    const rt_scene *scene;
    const rt_effects *effects;
    const rt_team *team;                      /* NULL for the scalar path, ... */
    rt_ray_counts scalar_rays;                /* ... which takes these */
    double parse, accel, draw, encode, total; /* wall seconds */
    double error; /* root mean square in 8-bit steps, where it was estimated, else 0 */
} rt_stats;

bool rt_stats_write(const rt_stats *stats, rt_output *output, rt_status *status);

#endif
