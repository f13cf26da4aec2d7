/* What fills space: the open, and what is inside of the bodies that transmit. */
#ifndef RT_SCENE_MEDIA_H
#define RT_SCENE_MEDIA_H

#include "common/status.h"
#include "scene/scene.h"

/* Bodies that a ray can be inside of at once, at most; less where there are many media. */
#define RT_NESTING_MOST 64

typedef struct rt_media {
    rt_medium *list; /* owned, `count`: the open, then one for each ior and absorption in use */
    int32_t *of;     /* owned, one for each material: 0 where it does not transmit */
    int count;
    int bits;                     /* that hold the number of one */
    int nesting;                  /* bodies that a ray remembers being in: the innermost so many */
    int32_t eye[RT_NESTING_MOST]; /* the media of those that the eye is in, outermost first */
    int eye_count;
} rt_media;

/* Finds the media of a scene. The eye is inside of spheres as their distance says and of meshes as
 * their winding number does (inside.h); of several bodies that whose surface is the first along the
 * view is the innermost. False, with the status set, without memory. */
bool rt_media_find(rt_media *media, const rt_scene *scene, rt_status *status);
void rt_media_clear(rt_media *media);

#endif
