#include "scene/inside.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "scene/places.h"

#define PI 3.14159265358979323846

/* The box of a material's triangles. */
typedef struct extent {
    float lo[3], hi[3];
} extent;

/* Comparisons, since fminf and its like are calls. */
static void widen_axis(extent *box, int axis, float a, float b, float c)
{
    const float lo_ab = a < b ? a : b, hi_ab = a > b ? a : b;
    const float lo = c < lo_ab ? c : lo_ab, hi = c > hi_ab ? c : hi_ab;
    box->lo[axis] = lo < box->lo[axis] ? lo : box->lo[axis];
    box->hi[axis] = hi > box->hi[axis] ? hi : box->hi[axis];
}

static void widen(extent *box, const rt_triangle *t)
{
    widen_axis(box, 0, t->ax, t->bx, t->cx);
    widen_axis(box, 1, t->ay, t->by, t->cy);
    widen_axis(box, 2, t->az, t->bz, t->cz);
}

static bool holds(const extent *box, vec3 p)
{
    return p.x >= (double)box->lo[0] && p.x <= (double)box->hi[0] && p.y >= (double)box->lo[1] &&
           p.y <= (double)box->hi[1] && p.z >= (double)box->lo[2] && p.z <= (double)box->hi[2];
}

/* The solid angle of a triangle as seen from the origin, positive where its corners run clockwise
 * as seen from there (Van Oosterom and Strackee 1983). */
static double solid_angle(vec3 a, vec3 b, vec3 c)
{
    const double la = sqrt(vec3_dot(a, a)), lb = sqrt(vec3_dot(b, b)), lc = sqrt(vec3_dot(c, c));
    const double below =
        la * lb * lc + vec3_dot(a, b) * lc + vec3_dot(b, c) * la + vec3_dot(c, a) * lb;
    return 2.0 * atan2(vec3_dot(a, vec3_cross(b, c)), below);
}

static double winding_of(const rt_triangle *t, vec3 p)
{
    vec3 c[3];
    rt_triangle_corners(t, c);
    for (int i = 0; i < 3; ++i)
        c[i] = vec3_plus(c[i], -1.0, p);
    return solid_angle(c[0], c[1], c[2]) / (4.0 * PI);
}

static void add_spheres(double *windings, const rt_scene *scene, vec3 p)
{
    for (size_t i = 0; i < scene->sphere_count; ++i)
        if (rt_sphere_holds(&scene->spheres[i], p))
            windings[scene->sphere_materials[i]] += 1.0;
}

static void add_triangles(double *windings, extent *boxes, const rt_scene *scene, vec3 p)
{
    for (size_t i = 0; i < scene->material_count; ++i)
        boxes[i] = (extent){{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    /* They mostly come in runs of one material, whose box then stays in registers. */
    for (size_t i = 0; i < scene->triangle_count;) {
        const int32_t material = scene->triangle_materials[i];
        extent box = boxes[material];
        for (; i < scene->triangle_count && scene->triangle_materials[i] == material; ++i)
            widen(&box, &scene->triangles[i]);
        boxes[material] = box;
    }
    for (size_t i = 0; i < scene->triangle_count; ++i) {
        const int32_t material = scene->triangle_materials[i];
        if (holds(&boxes[material], p))
            windings[material] += winding_of(&scene->triangles[i], p);
    }
}

double *rt_scene_windings(const rt_scene *scene, vec3 point, rt_status *status)
{
    /* One more than there are, so that a scene without materials is no lack of memory. */
    double *windings = calloc(scene->material_count + 1, sizeof *windings);
    extent *boxes = calloc(scene->material_count + 1, sizeof *boxes);
    if (windings && boxes) {
        add_spheres(windings, scene, point);
        add_triangles(windings, boxes, scene, point);
        free(boxes);
        return windings;
    }
    free(windings);
    free(boxes);
    rt_status_no_memory(status, "the bodies about a point");
    return NULL;
}
