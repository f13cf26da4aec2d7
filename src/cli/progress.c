#include "cli/progress.h"

#define SECONDS_OF_SILENCE 1.0
#define SECONDS_IN_PLACE 0.1
#define SECONDS_OF_LINES 1.0
/* 99:59:59: what is longer is not told to the second. */
#define SECONDS_MOST 359999.0
#define TIME_SIZE 16

void rt_progress_begin(rt_progress *p, FILE *out, bool in_place, double now)
{
    *p = (rt_progress){out, in_place, now, now + SECONDS_OF_SILENCE, 0};
}

/* "m:ss" or "h:mm:ss", rounded down. */
static const char *time_of(double seconds, char text[TIME_SIZE])
{
    const int whole = seconds < 0.0 ? 0 : (int)(seconds < SECONDS_MOST ? seconds : SECONDS_MOST);
    const int h = whole / 3600, m = whole / 60 % 60, s = whole % 60;
    if (h)
        snprintf(text, TIME_SIZE, "%d:%02d:%02d", h, m, s);
    else
        snprintf(text, TIME_SIZE, "%d:%02d", m, s);
    return text;
}

static void print(rt_progress *p, const char *line, int width, double now)
{
    if (p->in_place)
        fprintf(p->out, "\r%-*s", p->width, line); /* blanks over the end of a longer one */
    else
        fprintf(p->out, "%s\n", line);
    fflush(p->out);
    p->width = width;
    p->next = now + (p->in_place ? SECONDS_IN_PLACE : SECONDS_OF_LINES);
}

void rt_progress_tell(rt_progress *p, double done, double now)
{
    if (!p->out || now < p->next)
        return;
    char line[80], gone[TIME_SIZE], left[TIME_SIZE];
    const double elapsed = now - p->start;
    int width = snprintf(line, sizeof line, "rt: %3d %%, %s gone", (int)(100.0 * done),
                         time_of(elapsed, gone));
    /* Before anything is done there is nothing to reckon from. */
    if (done > 0.0)
        width += snprintf(line + width, sizeof line - (size_t)width, ", %s to go",
                          time_of(elapsed / done - elapsed, left));
    print(p, line, width, now);
}

void rt_progress_tell_of(rt_progress *p, const char *work, double now)
{
    if (!p->out || now < p->next)
        return;
    char line[80], gone[TIME_SIZE];
    const int width =
        snprintf(line, sizeof line, "rt: %.50s, %s gone", work, time_of(now - p->start, gone));
    print(p, line, width, now);
}

void rt_progress_clear(rt_progress *p)
{
    if (!p->out || !p->in_place || p->width == 0)
        return;
    fprintf(p->out, "\r%*s\r", p->width, "");
    fflush(p->out);
    p->width = 0;
}
