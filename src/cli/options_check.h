/* What options mean together, once each has been read. */
#ifndef RT_CLI_OPTIONS_CHECK_H
#define RT_CLI_OPTIONS_CHECK_H

#include <stdbool.h>

#include "cli/options.h"
#include "common/status.h"

/* Says which action is meant, and fails for options that do not go together. */
bool rt_options_check(rt_options *o, rt_status *status);

/* "rt: MESSAGEWHAT; try 'rt --help'". */
bool rt_usage_fail(rt_status *status, const char *message, const char *what);

#endif
