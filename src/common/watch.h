/* How a long computation tells how far it is, and is asked to stop. */
#ifndef RT_COMMON_WATCH_H
#define RT_COMMON_WATCH_H

#include <stdbool.h>
#include <stddef.h>

typedef struct rt_watch {
    /* Called now and then with the part done, 0 to 1; false stops the computation. */
    bool (*tick)(void *context, double done);
    void *context;
} rt_watch;

/* True where the computation goes on; a NULL watch never stops it. */
static inline bool rt_watch_tick(const rt_watch *watch, double done)
{
    return !watch || watch->tick(watch->context, done);
}

#endif
