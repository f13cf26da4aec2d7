/* Lights, and which of them cast shadows. */
#include <math.h>

#include "scene_text/parser.h"

/* Fields that both kinds of lights have, in the grammar's order. */
enum field { PLACE, COLOR, SHADOW, RADIUS, SAMPLES };

/* A light's `shadow` until `shadows`, which may stand below it, is known. */
#define UNDECIDED (-1)

/* What both kinds of lights have. */
static rt_light read_light(const rt_line *l)
{
    const rt_vec3 place = rt_value_vector(&l->values[PLACE], (rt_vec3){0.0f, 0.0f, 0.0f});
    const rt_vec3 color = rt_value_vector(&l->values[COLOR], (rt_vec3){1.0f, 1.0f, 1.0f});
    const rt_value *shadow = &l->values[SHADOW];
    return (rt_light){.x = place.x,
                      .y = place.y,
                      .z = place.z,
                      .w = 1.0f,
                      .r = color.x,
                      .g = color.y,
                      .b = color.z,
                      .shadow = shadow->given ? shadow->choice == 0 : UNDECIDED,
                      .samples = 1};
}

static bool add_light(rt_scene *scene, const rt_light *light, const rt_source *src)
{
    if (!rt_scene_add_light(scene, light, src->status))
        return false;
    scene->light_places[scene->light_count - 1] = rt_source_place(src);
    return true;
}

bool rt_scene_apply_light_point(rt_parser *p, rt_source *src, const rt_line *l)
{
    rt_light light = read_light(l);
    light.radius = rt_value_number(&l->values[RADIUS], 0.0f);
    if (light.radius > 0.0f)
        light.samples = rt_value_count(&l->values[SAMPLES], 16);
    return add_light(p->scene, &light, src);
}

bool rt_scene_apply_light_directional(rt_parser *p, rt_source *src, const rt_line *l)
{
    rt_light light = read_light(l);
    const double x = (double)light.x, y = (double)light.y, z = (double)light.z;
    const double inverse = -1.0 / hypot(hypot(x, y), z);
    light.x = (float)(x * inverse);
    light.y = (float)(y * inverse);
    light.z = (float)(z * inverse);
    light.w = 0.0f;
    return add_light(p->scene, &light, src);
}

bool rt_scene_apply_shadows(rt_parser *p, rt_source *src, const rt_line *l)
{
    p->has_shadows = l->values[0].choice == 0;
    p->shadows_place = rt_source_place(src);
    return true;
}

void rt_scene_settle_shadows(rt_parser *p)
{
    rt_scene *scene = p->scene;
    for (size_t i = 0; i < scene->light_count; ++i) {
        rt_light *light = &scene->lights[i];
        if (light->shadow != UNDECIDED)
            continue;
        light->shadow = p->has_shadows;
        /* It is the radius, at the light itself, that calls for a soft one. */
        if (p->has_shadows && light->radius == 0.0f)
            scene->light_places[i] = p->shadows_place;
    }
}
