/* The opaque body that the eye is inside of. */
#ifndef RT_SCENE_ENCLOSURE_H
#define RT_SCENE_ENCLOSURE_H

#include <stdbool.h>

#include "common/status.h"
#include "scene/scene.h"

typedef struct rt_enclosure {
    int32_t material; /* of the body; -1 where the eye is in the open, or in what transmits */
    bool is_sphere;   /* else a closed mesh: the triangles of the material */
    bool is_room;     /* a light, or some other primitive, is inside too */
} rt_enclosure;

/* A sphere that does not transmit and that the eye is inside of, else such a mesh, of whose sides
 * the inner one is not culled. A mesh counts as closed where a hundredth of all directions is open
 * at most. False after an error. */
bool rt_scene_enclosure(const rt_scene *scene, rt_enclosure *enclosure, rt_status *status);

#endif
