#include "scene/check.h"

#include <math.h>
#include <stdio.h>

#include "scene/enclosure.h"
#include "scene/places.h"

/* Room for "file:line:1". */
#define PLACE_SIZE 4200
/* Room for a point as a scene's text has it. */
#define POINT_SIZE 64
#define PI 3.14159265358979323846

/* What a warning begins with: the place of a statement, or the file where there is none. */
static const char *name_place(const rt_scene *scene, rt_place place, char text[PLACE_SIZE])
{
    if (place.line)
        snprintf(text, PLACE_SIZE, "%s:%d:1", place.file, place.line);
    else
        snprintf(text, PLACE_SIZE, "%s", scene->file_count ? scene->files[0] : "rt");
    return text;
}

static const rt_place nowhere = {NULL, 0};

/* A point in the file's unit of length. */
static const char *name_point(const rt_scene *scene, vec3 p, char text[POINT_SIZE])
{
    const int by = -scene->unit_exponent;
    snprintf(text, POINT_SIZE, "%.7g %.7g %.7g", ldexp(p.x, by), ldexp(p.y, by), ldexp(p.z, by));
    return text;
}

/* What to add where light is missing: at the eye it lights all that is seen. */
static void warn_of_light(const rt_scene *scene, const char *what, rt_status *status)
{
    char place[PLACE_SIZE], eye[POINT_SIZE];
    rt_status_warn(status,
                   "%s: warning: %s: add 'ambient 0.2 0.2 0.2' or a light, such as one at the "
                   "eye, 'light point at %s'",
                   name_place(scene, nowhere, place), what,
                   name_point(scene, vec3_of_scene(scene->camera.from), eye));
}

void rt_scene_warn_of_black(const rt_scene *scene, rt_status *status)
{
    warn_of_light(scene,
                  "the picture is black, since no light reaches what is in view or its materials "
                  "send none back",
                  status);
}

static bool is_bright(rt_vec3 color)
{
    return color.x > 0.0f || color.y > 0.0f || color.z > 0.0f;
}

static bool has_lights(const rt_scene *scene)
{
    for (size_t i = 0; i < scene->light_count; ++i) {
        const rt_light *l = &scene->lights[i];
        if (is_bright((rt_vec3){l->r, l->g, l->b}))
            return true;
    }
    return false;
}

/* Surfaces have light from lights and the ambient; the background is seen in mirrors and through
 * glass, and fog before them all. */
static bool check_light(const rt_scene *scene, const rt_effects *effects, rt_status *status)
{
    const bool sky =
        is_bright(scene->background) || (scene->has_gradient && is_bright(scene->background_top));
    const bool fog = scene->fog_density > 0.0f && is_bright(scene->fog);
    if (has_lights(scene) || is_bright(scene->ambient) || fog ||
        (sky && (effects->on[RT_EFFECT_REFLECT] || effects->on[RT_EFFECT_REFRACT])))
        return true;
    warn_of_light(scene,
                  sky ? "all surfaces are black, since there is no light"
                      : "the picture is black, since there is no light",
                  status);
    return false;
}

/* *good is false where the eye is inside of something. */
static bool check_eye(const rt_scene *scene, bool *good, rt_status *status)
{
    rt_enclosure e;
    if (!rt_scene_enclosure(scene, &e, status))
        return false;
    *good = e.material < 0 || e.is_room;
    if (*good)
        return true;
    char place[PLACE_SIZE];
    const rt_place material = scene->material_places[e.material];
    rt_status_warn(
        status,
        "%s: warning: the camera is inside of %s that does not transmit (its material is "
        "at %s:%d): give the camera a 'from' outside, or the material 'transmit 1'",
        name_place(scene, scene->camera_place, place), e.is_sphere ? "a sphere" : "a closed mesh",
        material.line ? material.file : "rt", material.line);
    return true;
}

bool rt_scene_check(const rt_scene *scene, const rt_effects *effects, int *count, rt_status *status)
{
    char place[PLACE_SIZE];
    bool good = true;
    *count = 0;
    if (!effects->has_primitives) {
        rt_status_warn(status,
                       "%s: warning: there is nothing to see, since the scene has no primitive: "
                       "add one, such as 'sphere center 0 0 -5 radius 1 material NAME', below its "
                       "'material NAME kd 1 0 0'",
                       name_place(scene, nowhere, place));
        *count = 1;
        return true;
    }
    *count += !check_light(scene, effects, status);
    if (!check_eye(scene, &good, status))
        return false;
    *count += !good;
    return true;
}

static void take_in(vec3 *lo, vec3 *hi, vec3 p)
{
    *lo = (vec3){fmin(lo->x, p.x), fmin(lo->y, p.y), fmin(lo->z, p.z)};
    *hi = (vec3){fmax(hi->x, p.x), fmax(hi->y, p.y), fmax(hi->z, p.z)};
}

/* The box of all primitives. */
static void find_box(const rt_scene *scene, vec3 *lo, vec3 *hi)
{
    *lo = (vec3){INFINITY, INFINITY, INFINITY};
    *hi = (vec3){-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < scene->sphere_count; ++i) {
        const vec3 c = rt_sphere_center(&scene->spheres[i]);
        const double r = (double)scene->spheres[i].radius;
        take_in(lo, hi, (vec3){c.x - r, c.y - r, c.z - r});
        take_in(lo, hi, (vec3){c.x + r, c.y + r, c.z + r});
    }
    for (size_t i = 0; i < scene->triangle_count; ++i) {
        vec3 corners[3];
        rt_triangle_corners(&scene->triangles[i], corners);
        for (int k = 0; k < 3; ++k)
            take_in(lo, hi, corners[k]);
    }
}

/* From where the camera's cone, which is narrower across where the picture is upright, holds the
 * ball about the box of all. */
static vec3 outside_eye(const rt_scene *scene, vec3 middle, double radius)
{
    const double up = tan((double)scene->camera.vfov * PI / 360.0);
    const double across = up * scene->width / scene->height;
    const double distance = radius > 0.0 ? radius / sin(atan(fmin(up, across))) : 1.0;
    return vec3_plus(middle, distance, (vec3){0.0, 0.0, 1.0});
}

void rt_scene_warn_of_view(const rt_scene *scene, rt_status *status)
{
    char place[PLACE_SIZE], from[POINT_SIZE], at[POINT_SIZE];
    vec3 lo, hi;
    find_box(scene, &lo, &hi);
    const vec3 diagonal = vec3_plus(hi, -1.0, lo);
    const vec3 middle = vec3_plus(lo, 0.5, diagonal);
    const double radius = 0.5 * sqrt(vec3_dot(diagonal, diagonal));
    rt_status_warn(status,
                   "%s: warning: nothing is in view: no ray from the camera hits a primitive%s; "
                   "try 'camera from %s at %s vfov %.7g'",
                   name_place(scene, scene->camera_place, place),
                   scene->cull == RT_CULL_NONE ? "" : " that 'cull' leaves",
                   name_point(scene, outside_eye(scene, middle, radius), from),
                   name_point(scene, middle, at), (double)scene->camera.vfov);
}
