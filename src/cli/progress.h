/* A line on standard error that tells how far a long computation is. */
#ifndef RT_CLI_PROGRESS_H
#define RT_CLI_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

/* Whoever calls it from several threads holds a lock. */
typedef struct rt_progress {
    FILE *out;          /* NULL for none at all */
    bool in_place;      /* one line rewritten with carriage returns, else whole lines */
    double start, next; /* by the caller's clock, in seconds: the beginning, the next line */
    int width;          /* columns of the line that stands there */
} rt_progress;

/* Begins at time `now`. Nothing is printed in the first second: a quick computation says nothing.
 */
void rt_progress_begin(rt_progress *progress, FILE *out, bool in_place, double now);

/* Prints "rt:  42 %, 0:12 gone, 0:17 to go" for the part `done`, 0 to 1, unless the last one is
 * younger than a tenth of a second in place, or a second as lines. */
void rt_progress_tell(rt_progress *progress, double done, double now);

/* Prints "rt: WORK, 0:12 gone" likewise, of work of which nobody knows how long it takes. */
void rt_progress_tell_of(rt_progress *progress, const char *work, double now);

/* Clears the line, so that what is printed next finds an empty one; telling may go on. */
void rt_progress_clear(rt_progress *progress);

#endif
