#include "cli/stats.h"

#include "common/json.h"

static json_t *count_of(size_t count)
{
    return json_integer((json_int_t)count);
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

static json_t *primitives_of(const rt_scene *scene)
{
    json_t *primitives = json_object();
    for (int k = 0; k < RT_KIND_COUNT; ++k)
        json_object_set_new(primitives, rt_kinds[k].names, count_of(scene->kinds[k].count));
    return primitives;
}

static json_t *effects_of(const rt_effects *e)
{
    json_t *effects = json_array();
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        if (e->on[i])
            json_array_append_new(effects, json_string(rt_effect_name((enum rt_effect)i)));
    return effects;
}

/* Of all devices; of the scalar path the rays are counted, and no part is timed. */
static rt_render_times times_of(const rt_stats *s)
{
    if (s->team)
        return rt_team_times(s->team);
    return (rt_render_times){.rays = s->scalar_rays};
}

static json_t *rays_of(const rt_ray_counts *rays)
{
    return json_pack("{s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o}", "primary", count_of(rays->primary),
                     "shadow", count_of(rays->shadow), "occlusion", count_of(rays->occlusion),
                     "reflection", count_of(rays->reflection), "refraction",
                     count_of(rays->refraction), "total", count_of(rt_ray_counts_total(rays)),
                     "ended", count_of(rays->ended), "cut", count_of(rays->cut));
}

/* What is not reading back counts as the kernels'. */
static json_t *seconds_of(const rt_stats *s, const rt_render_times *t)
{
    return json_pack("{s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f}", "parse", s->parse, "accel", s->accel,
                     "program", t->program, "upload", t->upload, "kernel", s->draw - t->readback,
                     "readback", t->readback, "encode", s->encode, "total", s->total);
}

/* Every stage that was launched, with its seconds by the device's clock. */
static json_t *stages_of(const rt_render_times *t)
{
    json_t *stages = json_object();
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        if (t->launches[i])
            json_object_set_new(stages, rt_stage_name((enum rt_stage)i), json_real(t->stages[i]));
    return stages;
}

/* The first device's names; the scalar path has one of its own and no driver. */
typedef struct names {
    const char *device, *platform, *driver, *accuracy;
    int lanes;
} names;

static names names_of(const rt_stats *s)
{
    const char *accuracy = rt_accuracy_name(s->scene->accuracy);
    if (!s->team)
        return s->target == RT_TARGET_SCALAR_DOUBLE
                   ? (names){"scalar-double", "", "", "reference", 1}
                   : (names){"scalar", "", "", accuracy, 1};
    const rt_team_share first = rt_team_share_of(s->team, 0);
    return (names){first.device->name, first.device->platform_name, first.device->driver, accuracy,
                   first.lanes};
}

bool rt_stats_write(const rt_stats *s, rt_output *output, rt_status *status)
{
    const rt_scene *scene = s->scene;
    const rt_render_times t = times_of(s);
    const names n = names_of(s);
    json_t *root =
        json_pack("{s:s,s:s,s:s,s:s,s:i,s:i,s:i,s:o,s:o,s:o,s:o,s:f,s:o,s:o,s:o,s:o}", "device",
                  n.device, "platform", n.platform, "driver", n.driver, "accuracy", n.accuracy,
                  "lanes", n.lanes, "width", scene->width, "height", scene->height, "primitives",
                  primitives_of(scene), "lights", count_of(scene->light_count), "materials",
                  count_of(scene->material_count), "rays", rays_of(&t.rays), "light_cut",
                  rt_ray_counts_cut_part(&t.rays), "seconds", seconds_of(s, &t), "stages",
                  stages_of(&t), "effects", effects_of(s->effects), "devices", devices_of(s));
    json_object_set_new(root, "samples", json_integer(scene->samples));
    if (s->error > 0.0)
        json_object_set_new(root, "error", json_real(s->error));
    return rt_json_write(root, RT_JSON_DIGITS, "--stats", output, status);
}
