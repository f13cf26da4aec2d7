/* What a scene holds, as vectors of the host. */
#ifndef RT_SCENE_PLACES_H
#define RT_SCENE_PLACES_H

#include <stdbool.h>

#include "common/vec3.h"
#include "kernels/primitives/kinds.h"
#include "scene/scene.h"

static inline vec3 vec3_of_scene(rt_vec3 p)
{
    return (vec3){(double)p.x, (double)p.y, (double)p.z};
}

static inline vec3 rt_sphere_center(const rt_sphere *s)
{
    return (vec3){(double)s->cx, (double)s->cy, (double)s->cz};
}

/* Whether a point is inside; one on the surface is not. */
static inline bool rt_sphere_holds(const rt_sphere *s, vec3 point)
{
    const vec3 d = vec3_plus(point, -1.0, rt_sphere_center(s));
    return vec3_dot(d, d) < (double)s->radius * (double)s->radius;
}

static inline void rt_triangle_corners(const rt_triangle *t, vec3 corners[3])
{
    corners[0] = (vec3){(double)t->ax, (double)t->ay, (double)t->az};
    corners[1] = (vec3){(double)t->bx, (double)t->by, (double)t->bz};
    corners[2] = (vec3){(double)t->cx, (double)t->cy, (double)t->cz};
}

#endif
