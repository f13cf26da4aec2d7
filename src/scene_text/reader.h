/* The native scene format: one statement a line, a keyword and then name/value pairs in any order
 * (scenes/README.md, "Scene format"). */
#ifndef RT_SCENE_TEXT_READER_H
#define RT_SCENE_TEXT_READER_H

#include <stdbool.h>

#include "common/file.h"
#include "common/status.h"
#include "scene/scene.h"

/* Reads the text of a scene, by that name in messages, with everything that it includes into
 * `scene`, which must have been initialised. On failure returns false with code RT_ERROR_SCENE and
 * up to RT_STATUS_SHOWN messages "file:line:column: error: ..."; lines count from 1, columns from 1
 * in characters of UTF-8. The scene may then be partly filled and is still the caller's to clear.
 */
bool rt_scene_text_read(rt_scene *scene, const char *name, const rt_file_text *text,
                        rt_status *status);

#endif
