/* What a run did and how long it took, as JSON. */
#ifndef RT_CLI_STATS_H
#define RT_CLI_STATS_H

#include "common/file.h"
#include "render/renderer.h"
#include "render/team.h"
#include "scene/effects.h"

typedef struct rt_stats {
    const char *device;   /* the first one's name, "scalar" or "scalar-double" */
    const char *platform; /* the first one's, as driver and lanes; empty for the scalar path */
    const char *driver;
    const char *accuracy;
    int lanes, width, height;
    size_t spheres, triangles, lights, materials;
    size_t primary_rays;
    rt_effects effects;
    double parse, accel, program, upload, kernel, readback, encode, total; /* wall seconds */
    const rt_render_times *times; /* of all devices; NULL for the scalar path */
    const rt_team *team;          /* NULL for the scalar path */
} rt_stats;

bool rt_stats_write(const rt_stats *stats, rt_output *output, rt_status *status);

#endif
