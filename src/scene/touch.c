/* Lights that a primitive passes through, such as a lamp in the very plane of a ceiling: on which
 * side of it the primitive is, no arithmetic in float can tell, and so shadow rays end before. */
#include <math.h>

#include "common/parallel.h"
#include "scene/places.h"

/* A primitive is at a point where it is nearer than this part of the coordinates of both: eight
 * half ulps, which is what float makes of where a ray meets it. */
#define TOUCH_BOUND 0x1p-22
/* The part of the way that is left out then: it is good for a ceiling a thousand times as large as
 * it is high. */
#define TOUCH_GAP 0x1p-12f

static double size_of(vec3 a)
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}

static double length_of(vec3 a)
{
    return sqrt(vec3_dot(a, a));
}

static bool is_sphere_at(const rt_sphere *s, vec3 point)
{
    const vec3 center = rt_sphere_center(s);
    const double radius = (double)s->radius;
    const double bound = TOUCH_BOUND * (size_of(center) + radius + size_of(point));
    return fabs(length_of(vec3_plus(point, -1.0, center)) - radius) <= bound;
}

static bool is_beside(double x, double a, double b, double c, double bound)
{
    return x < fmin(a, fmin(b, c)) - bound || x > fmax(a, fmax(b, c)) + bound;
}

static double distance_to_segment(vec3 a, vec3 b, vec3 point)
{
    const vec3 along = vec3_plus(b, -1.0, a), way = vec3_plus(point, -1.0, a);
    const double t = vec3_dot(way, along) / vec3_dot(along, along);
    return length_of(vec3_plus(way, -fmin(fmax(t, 0.0), 1.0), along));
}

/* From the plane where the point is above the triangle, else from the nearest edge. */
static double distance_to_triangle(vec3 a, vec3 b, vec3 c, vec3 point)
{
    const vec3 corners[3] = {a, b, c};
    const vec3 normal = vec3_cross(vec3_plus(b, -1.0, a), vec3_plus(c, -1.0, a));
    double least = INFINITY;
    bool is_above = true;
    for (int i = 0; i < 3; ++i) {
        const vec3 from = corners[i], to = corners[(i + 1) % 3];
        const vec3 across = vec3_cross(normal, vec3_plus(to, -1.0, from));
        is_above = is_above && vec3_dot(across, vec3_plus(point, -1.0, from)) >= 0.0;
        least = fmin(least, distance_to_segment(from, to, point));
    }
    const double height = fabs(vec3_dot(normal, vec3_plus(point, -1.0, a))) / length_of(normal);
    return is_above ? height : least;
}

static bool is_triangle_at(const rt_triangle *t, vec3 point)
{
    vec3 corners[3];
    rt_triangle_corners(t, corners);
    const vec3 a = corners[0], b = corners[1], c = corners[2];
    const double most = fmax(size_of(a), fmax(size_of(b), size_of(c)));
    const double bound = TOUCH_BOUND * (most + size_of(point));
    /* Nearly all are far away. */
    if (is_beside(point.x, a.x, b.x, c.x, bound) || is_beside(point.y, a.y, b.y, c.y, bound) ||
        is_beside(point.z, a.z, b.z, c.z, bound))
        return false;
    return distance_to_triangle(a, b, c, point) <= bound; /* one without area is at no point */
}

static bool is_touched(const rt_scene *scene, vec3 point)
{
#define IS_ANY_AT(name, names, NAMES)                                                              \
    for (size_t i = 0; i < scene->name##_count; ++i)                                               \
        if (is_##name##_at(&scene->names[i], point))                                               \
            return true;
    RT_KINDS(IS_ANY_AT)
    return false;
}

static void settle_light(void *context, size_t i)
{
    const rt_scene *scene = context;
    rt_light *l = &scene->lights[i];
    const vec3 place = {(double)l->x, (double)l->y, (double)l->z};
    /* Of a ball of light, the half that is on the other side is hidden lawfully. */
    const bool is_point = l->w != 0.0f && !(l->radius > 0.0f);
    l->gap = l->shadow && is_point && is_touched(scene, place) ? TOUCH_GAP : 0.0f;
}

void rt_scene_settle_lights(rt_scene *scene)
{
    rt_parallel(scene->light_count, rt_parallel_processors(), settle_light, scene);
}
