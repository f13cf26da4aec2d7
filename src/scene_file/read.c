#include "scene_file/read.h"

#include <string.h>

#include "common/file.h"
#include "scene_text/reader.h"

/* The formats, in the order in which a content is held against them. The native one is what is
 * left, so that a text that is no scene gets its messages. */
static const struct {
    bool (*recognises)(const rt_file_text *text); /* NULL: any */
    bool (*read)(rt_scene *scene, const char *name, const rt_file_text *text, rt_status *status);
} formats[] = {{NULL, rt_scene_text_read}};

bool rt_scene_read(rt_scene *scene, const char *path, rt_status *status)
{
    const bool is_stdin = strcmp(path, "-") == 0;
    rt_file_text text;
    const char *reason = rt_file_read(is_stdin ? NULL : path, &text);
    if (reason)
        return rt_status_fail(status, RT_ERROR_SCENE, "rt: cannot read '%s': %s", path, reason);
    size_t i = 0;
    while (formats[i].recognises && !formats[i].recognises(&text))
        ++i;
    const bool good = formats[i].read(scene, is_stdin ? "<stdin>" : path, &text, status);
    rt_file_free(&text);
    rt_scene_choose_unit(scene);
    rt_scene_settle_lights(scene);
    return good;
}
