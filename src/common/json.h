/* JSON on its way out, by jansson. */
#ifndef RT_COMMON_JSON_H
#define RT_COMMON_JSON_H

#include <jansson.h>

#include "common/file.h"

/* Writes a value, indented and ended by a newline, and releases it; NULL stands for one that found
 * no memory. `what` names what asked for it. The caller commits or discards the output. */
bool rt_json_write(json_t *root, const char *what, rt_output *output, rt_status *status);

#endif
