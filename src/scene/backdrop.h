/* Pictures that show nothing. */
#ifndef RT_SCENE_BACKDROP_H
#define RT_SCENE_BACKDROP_H

#include <stdbool.h>

#include "image/image.h"
#include "scene/scene.h"

/* Whether a picture of the scene can be that of its background, or fog, alone: it is off by less
 * than a hundredth everywhere. What is in view may be of that colour too. */
bool rt_scene_is_backdrop(const rt_scene *scene, const rt_image *image);

/* Whether no component is as much as half an 8-bit step in the scene's encoding. */
bool rt_scene_is_black(const rt_scene *scene, const rt_image *image);

#endif
