#include "common/json.h"

#include <stdlib.h>
#include <string.h>

bool rt_json_write(json_t *root, int digits, const char *what, rt_output *output, rt_status *status)
{
    char *text =
        root ? json_dumps(root, JSON_INDENT(2) | JSON_REAL_PRECISION((size_t)digits)) : NULL;
    json_decref(root);
    if (!text)
        return rt_status_no_memory(status, what);
    const bool good = rt_output_write(output, text, strlen(text), status) &&
                      rt_output_write(output, "\n", 1, status);
    free(text);
    return good;
}
