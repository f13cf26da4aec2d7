#include "scene/enclosure.h"

#include <math.h>
#include <stdlib.h>

#include "scene/inside.h"
#include "scene/places.h"

/* A mesh is taken for closed where it covers so much of all directions. */
#define CLOSED 0.99
/* Of what may be inside of a room, so many are tried. */
#define TRIED_MOST 16

/* A body that may be about a point. */
typedef struct body {
    const rt_sphere *sphere; /* or NULL: the triangles of `material` */
    int32_t material;
} body;

static bool is_opaque(const rt_scene *scene, int32_t material)
{
    return !(scene->materials[material].transmit > 0.0f && scene->depth > 0);
}

/* Whether the side that is turned inward is there at all, where the winding number about a point
 * inside is `winding`. */
static bool is_seen_from_inside(const rt_scene *scene, double winding)
{
    const int sign = rt_scene_cull_sign(scene);
    return sign == 0 || (winding > 0.0 ? sign < 0 : sign > 0);
}

/* Spheres first, so that what windings tell of a material later is of its triangles. False after an
 * error; *found tells. */
static bool find_body(const rt_scene *scene, body *b, bool *found, rt_status *status)
{
    const vec3 eye = vec3_of_scene(scene->camera.from);
    *found = false;
    for (size_t i = 0; i < scene->sphere_count && !*found; ++i) {
        *b = (body){&scene->spheres[i], scene->sphere_materials[i]};
        *found = is_opaque(scene, b->material) && rt_sphere_holds(b->sphere, eye);
    }
    if (*found || scene->triangle_count == 0)
        return true;
    double *windings = rt_scene_windings(scene, eye, status);
    for (size_t i = 0; windings && i < scene->material_count && !*found; ++i) {
        *b = (body){NULL, (int32_t)i};
        *found = is_opaque(scene, b->material) && fabs(windings[i]) > CLOSED &&
                 is_seen_from_inside(scene, windings[i]);
    }
    free(windings);
    return windings != NULL;
}

static bool is_in_body(const rt_scene *scene, const body *b, vec3 p)
{
    if (b->sphere)
        return rt_sphere_holds(b->sphere, p);
    rt_status ignored = RT_STATUS_INIT;
    double *windings = rt_scene_windings(scene, p, &ignored);
    const bool inside = windings && fabs(windings[b->material]) > CLOSED;
    free(windings);
    rt_status_clear(&ignored);
    return inside;
}

static bool holds_a_light(const rt_scene *scene, const body *b)
{
    for (size_t i = 0; i < scene->light_count && i < TRIED_MOST; ++i) {
        const rt_light *l = &scene->lights[i];
        if (l->w != 0.0f && is_in_body(scene, b, (vec3){(double)l->x, (double)l->y, (double)l->z}))
            return true;
    }
    return false;
}

/* Something else, by a point of its surface. */
static bool holds_a_primitive(const rt_scene *scene, const body *b)
{
    int tried = 0;
    for (size_t i = 0; i < scene->sphere_count && tried < TRIED_MOST; ++i) {
        const rt_sphere *s = &scene->spheres[i];
        if (s == b->sphere)
            continue;
        ++tried;
        if (is_in_body(scene, b,
                       (vec3){(double)s->cx + (double)s->radius, (double)s->cy, (double)s->cz}))
            return true;
    }
    for (size_t i = 0; i < scene->triangle_count && tried < 2 * TRIED_MOST; ++i) {
        const rt_triangle *t = &scene->triangles[i];
        if (!b->sphere && scene->triangle_materials[i] == b->material)
            continue;
        ++tried;
        if (is_in_body(scene, b, (vec3){(double)t->ax, (double)t->ay, (double)t->az}))
            return true;
    }
    return false;
}

bool rt_scene_enclosure(const rt_scene *scene, rt_enclosure *e, rt_status *status)
{
    body b;
    bool found = false;
    *e = (rt_enclosure){.material = -1};
    if (!find_body(scene, &b, &found, status))
        return false;
    if (found)
        *e = (rt_enclosure){b.material, b.sphere != NULL,
                            holds_a_light(scene, &b) || holds_a_primitive(scene, &b)};
    return true;
}
