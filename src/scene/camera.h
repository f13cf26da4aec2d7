/* The eye of a scene as vectors, and what it sees where there is nothing else. */
#ifndef RT_SCENE_CAMERA_H
#define RT_SCENE_CAMERA_H

#include "scene/scene.h"

/* The camera as vectors, in double: the direction of pixel (x, y) is
 * right * (2x + 1 - width) + up * (height - 1 - 2y) + forward, not unit. */
typedef struct rt_view {
    double origin[3], right[3], up[3], forward[3];
    double lens_right[3], lens_up[3]; /* the lens's radii, to the right and upward; 0 for none */
    double focus;                     /* distance along `forward` of what is sharp */
} rt_view;

/* Where `up` is parallel to the view, the axis least along the view stands in for it. */
rt_view rt_scene_view(const rt_scene *scene);

/* The background's colours and the unit vector along which they change. */
rt_gradient rt_scene_gradient(const rt_scene *scene);

/* The view rounded to what the kernels and the float reference take. */
rt_frame rt_scene_frame(const rt_scene *scene);
/* The same in double, for the kernels that compute in it. */
rt_frame_double rt_scene_frame_double(const rt_scene *scene);

#endif
