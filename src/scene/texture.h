/* Pictures that materials take colours from. */
#ifndef RT_SCENE_TEXTURE_H
#define RT_SCENE_TEXTURE_H

#include "scene/scene.h"

#define RT_TEXTURE_REASON_SIZE 128

/* Adds the picture at `path`, png, jpg or bmp, to the scene's textures, or finds it there: a file
 * is loaded once. Returns true with its index in *index; else false with the reason in `reason` and
 * the scene as it was. Components come as the file has them, without gamma; transparency and a
 * second colour behind it are passed over. */
bool rt_texture_load(rt_scene *scene, const char *path, int32_t *index,
                     char reason[RT_TEXTURE_REASON_SIZE]);

#endif
