#include "cli/stats.h"

#include "common/json.h"

static json_t *count_of(size_t count)
{
    return json_integer((json_int_t)count);
}

static json_t *seconds_of(const rt_stats *s)
{
    return json_pack("{s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f}", "parse", s->parse, "accel", s->accel,
                     "program", s->program, "upload", s->upload, "kernel", s->kernel, "readback",
                     s->readback, "encode", s->encode, "total", s->total);
}

/* Every stage that was launched, with its seconds by the device's clock. */
static json_t *stages_of(const rt_stats *s)
{
    json_t *stages = json_object();
    for (int i = 0; s->times && i < RT_STAGE_COUNT; ++i)
        if (s->times->launches[i])
            json_object_set_new(stages, rt_stage_name((enum rt_stage)i),
                                json_real(s->times->stages[i]));
    return stages;
}

/* What each device has done of the picture. */
static json_t *devices_of(const rt_stats *s)
{
    json_t *devices = json_array();
    for (size_t i = 0; s->team && i < rt_team_count(s->team); ++i) {
        const rt_team_share share = rt_team_share_of(s->team, i);
        json_array_append_new(devices, json_pack("{s:s,s:o,s:o,s:f}", "name", share.device->name,
                                                 "tiles", count_of(share.tiles), "rays",
                                                 count_of(share.rays), "seconds", share.seconds));
    }
    return devices;
}

static json_t *effects_of(const rt_stats *s)
{
    json_t *effects = json_array();
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        if (s->effects.on[i])
            json_array_append_new(effects, json_string(rt_effect_name((enum rt_effect)i)));
    return effects;
}

/* By kind, those of the scalar path not counted beyond the primary ones. */
static json_t *rays_of(const rt_stats *s)
{
    static const rt_render_times none;
    const rt_render_times *t = s->times ? s->times : &none;
    const size_t total = s->primary_rays + t->shadow_rays + t->occlusion_rays + t->reflection_rays +
                         t->refraction_rays;
    return json_pack("{s:o,s:o,s:o,s:o,s:o,s:o}", "primary", count_of(s->primary_rays), "shadow",
                     count_of(t->shadow_rays), "occlusion", count_of(t->occlusion_rays),
                     "reflection", count_of(t->reflection_rays), "refraction",
                     count_of(t->refraction_rays), "total", count_of(total));
}

bool rt_stats_write(const rt_stats *s, rt_output *output, rt_status *status)
{
    json_t *root = json_pack(
        "{s:s,s:s,s:s,s:s,s:i,s:i,s:i,s:{s:o,s:o},s:o,s:o,s:o,s:o,s:o,s:o,s:o}", "device",
        s->device, "platform", s->platform, "driver", s->driver, "accuracy", s->accuracy, "lanes",
        s->lanes, "width", s->width, "height", s->height, "primitives", "spheres",
        count_of(s->spheres), "triangles", count_of(s->triangles), "lights", count_of(s->lights),
        "materials", count_of(s->materials), "rays", rays_of(s), "seconds", seconds_of(s), "stages",
        stages_of(s), "effects", effects_of(s), "devices", devices_of(s));
    return rt_json_write(root, "--stats", output, status);
}
