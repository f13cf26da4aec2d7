/* Scenes from files of any format that there is a reader for. */
#ifndef RT_SCENE_FILE_READ_H
#define RT_SCENE_FILE_READ_H

#include <stdbool.h>

#include "common/status.h"
#include "scene/scene.h"

/* Reads the scene at `path` ("-" for standard input) into `scene`, which must have been
 * initialised, and chooses its unit of length. The format is told by the content, not by the name.
 * On failure returns false with code RT_ERROR_SCENE and messages; the scene may then be partly
 * filled and is still the caller's to clear. */
bool rt_scene_read(rt_scene *scene, const char *path, rt_status *status);

#endif
