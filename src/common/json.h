/* JSON on its way out, by jansson. */
#ifndef RT_COMMON_JSON_H
#define RT_COMMON_JSON_H

#include <jansson.h>

#include "common/file.h"

/* Digits of a number: enough for what is measured, and so many that what is read again is the same.
 */
#define RT_JSON_DIGITS 9
#define RT_JSON_DIGITS_EXACT 17

/* Writes a value, indented and ended by a newline, and releases it; NULL stands for one that found
 * no memory. `what` names what asked for it. The caller commits or discards the output. */
bool rt_json_write(json_t *root, int digits, const char *what, rt_output *output,
                   rt_status *status);

#endif
