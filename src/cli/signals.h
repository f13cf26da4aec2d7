/* A run that is asked to stop. */
#ifndef RT_CLI_SIGNALS_H
#define RT_CLI_SIGNALS_H

#include <stdbool.h>

#include "common/watch.h"

/* From now on SIGINT and SIGTERM are only noted. */
void rt_signals_catch(void);

/* Whether one has come; any thread may ask. */
bool rt_signals_have_come(void);

/* Of work that stops once one has come, and tells nobody how far it is. */
extern const rt_watch rt_signals_watch;

#endif
