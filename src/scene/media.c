#include "scene/media.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/inside.h"
#include "scene/places.h"

/* The number of a medium, which joins the list where it is new. */
static int32_t number_of(rt_media *media, rt_medium medium)
{
    for (int i = 1; i < media->count; ++i)
        if (memcmp(&media->list[i], &medium, sizeof medium) == 0)
            return i;
    media->list[media->count] = medium;
    return media->count++;
}

static void list_media(rt_media *media, const rt_scene *scene)
{
    media->list[0] = (rt_medium){.ior = 1.0f};
    media->count = 1;
    for (size_t i = 0; i < scene->material_count; ++i) {
        const rt_material *m = &scene->materials[i];
        const rt_medium inside = {m->ior, m->absorb_r, m->absorb_g, m->absorb_b};
        media->of[i] = m->transmit > 0.0f ? number_of(media, inside) : 0;
    }
    media->bits = 1;
    while ((media->count - 1) >> media->bits)
        ++media->bits;
    media->nesting = RT_NESTING_MOST / media->bits;
}

/* Surfaces along the view that lead out of bodies which the eye is in, nearest first. */
typedef struct way_out {
    double t;
    int32_t material;
} way_out;

typedef struct ways_out {
    vec3 eye, view;
    way_out nearest[RT_NESTING_MOST];
    int count;
} ways_out;

static void add_way_out(ways_out *w, double t, int32_t material)
{
    if (w->count == RT_NESTING_MOST && !(t < w->nearest[RT_NESTING_MOST - 1].t))
        return;
    int at = w->count < RT_NESTING_MOST ? w->count++ : RT_NESTING_MOST - 1;
    for (; at > 0 && t < w->nearest[at - 1].t; --at)
        w->nearest[at] = w->nearest[at - 1];
    w->nearest[at] = (way_out){t, material};
}

static void look_at_sphere(ways_out *w, const rt_sphere *s, int32_t material)
{
    const vec3 to_eye = vec3_plus(w->eye, -1.0, rt_sphere_center(s));
    const double b = vec3_dot(to_eye, w->view);
    const double c = vec3_dot(to_eye, to_eye) - (double)s->radius * (double)s->radius;
    if (c < 0.0)
        add_way_out(w, -b + sqrt(b * b - c), material);
}

/* Moller and Trumbore's test, of the side from which the corners run clockwise. On an edge both of
 * its triangles are met: more ways out than bodies do no harm. */
#define EDGE_MARGIN 1e-9
static void look_at_triangle(ways_out *w, const rt_triangle *triangle, int32_t material)
{
    vec3 c[3];
    rt_triangle_corners(triangle, c);
    const vec3 e1 = vec3_plus(c[1], -1.0, c[0]), e2 = vec3_plus(c[2], -1.0, c[0]);
    const vec3 p = vec3_cross(w->view, e2), from_a = vec3_plus(w->eye, -1.0, c[0]);
    const double det = vec3_dot(e1, p);
    const vec3 q = vec3_cross(from_a, e1);
    const double u = vec3_dot(from_a, p) / det, v = vec3_dot(w->view, q) / det;
    const double t = vec3_dot(e2, q) / det;
    if (det < 0.0 && u > -EDGE_MARGIN && v > -EDGE_MARGIN && u + v < 1.0 + EDGE_MARGIN && t > 0.0)
        add_way_out(w, t, material);
}

/* The media about the eye; `windings` says how often it is inside of each material's bodies. */
static void nest(rt_media *media, const rt_scene *scene, const double *windings, ways_out *w)
{
    for (size_t i = 0; i < scene->sphere_count; ++i)
        if (media->of[scene->sphere_materials[i]])
            look_at_sphere(w, &scene->spheres[i], scene->sphere_materials[i]);
    for (size_t i = 0; i < scene->triangle_count; ++i) {
        const int32_t material = scene->triangle_materials[i];
        if (media->of[material] && windings[material] > 0.5)
            look_at_triangle(w, &scene->triangles[i], material);
    }
    for (size_t m = 0; m < scene->material_count; ++m) {
        double left = media->of[m] ? windings[m] : 0.0;
        for (int i = 0; i < w->count; ++i)
            if (w->nearest[i].material == (int32_t)m && !(left-- > 0.5))
                w->nearest[i].material = -1;
    }
    for (int i = 0; i < w->count && media->eye_count < media->nesting; ++i)
        if (w->nearest[i].material >= 0)
            media->eye[media->eye_count++] = media->of[w->nearest[i].material];
    for (int i = 0, k = media->eye_count - 1; i < k; ++i, --k) {
        const int32_t nearer = media->eye[i];
        media->eye[i] = media->eye[k];
        media->eye[k] = nearer;
    }
}

bool rt_media_find(rt_media *media, const rt_scene *scene, rt_status *status)
{
    *media = (rt_media){.list = malloc((scene->material_count + 1) * sizeof *media->list),
                        .of = calloc(scene->material_count + 1, sizeof *media->of)};
    ways_out w = {.eye = vec3_of_scene(scene->camera.from)};
    w.view = vec3_unit(vec3_plus(vec3_of_scene(scene->camera.at), -1.0, w.eye));
    if (!media->list || !media->of) {
        rt_media_clear(media);
        return rt_status_no_memory(status, "media");
    }
    list_media(media, scene);
    if (media->count == 1)
        return true;
    double *windings = rt_scene_windings(scene, w.eye, status);
    if (windings)
        nest(media, scene, windings, &w);
    else
        rt_media_clear(media);
    free(windings);
    return media->list != NULL;
}

void rt_media_clear(rt_media *media)
{
    free(media->list);
    free(media->of);
    *media = (rt_media){0};
}
