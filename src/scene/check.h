/* What makes a picture black or empty, as far as the scene alone tells. */
#ifndef RT_SCENE_CHECK_H
#define RT_SCENE_CHECK_H

#include "common/status.h"
#include "scene/effects.h"
#include "scene/scene.h"

/* Adds a warning, with what to add to the scene, for each of these that is so: there is no
 * primitive; no light falls on what there is; the eye is inside of a sphere or a closed mesh that
 * does not transmit, unless that is a room, with a light or something else in it. *count is how
 * many. False after an error. `effects` are the scene's. */
bool rt_scene_check(const rt_scene *scene, const rt_effects *effects, int *count,
                    rt_status *status);

/* Adds the warning that no primary ray hits a primitive, of which there are some. */
void rt_scene_warn_of_view(const rt_scene *scene, rt_status *status);
/* Adds the warning that what primary rays hit is black. */
void rt_scene_warn_of_black(const rt_scene *scene, rt_status *status);

#endif
