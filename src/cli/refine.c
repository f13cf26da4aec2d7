#include "cli/refine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/clock.h"

/* A round that is cut to the time that is left is planned to end this part of it early. */
#define ROUND_MARGIN 0.05

/* A round that is cut to less than such a part of the samples before tells nothing of their error:
 * few samples are spread worse than many. */
#define SHORT_ROUND 4

/* One refinement in progress. */
typedef struct refinement {
    rt_run *r;
    double start;       /* of the first sample */
    double done;        /* the part that is told, which never falls */
    double from, share; /* what is done before a round, and what the round is of it all */
} refinement;

bool rt_refine_is_asked(const rt_options *o)
{
    return o->seconds > 0.0 || o->error > 0.0;
}

static double seen(double sum, int samples)
{
    const double mean = sum / samples;
    return mean < 0.0 ? 0.0 : mean > 1.0 ? 1.0 : mean;
}

double rt_refine_error(const float *first, int before, const float *all, int more, size_t count)
{
    double squares = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const double sum = (double)first[i], rest = (double)all[i] - sum;
        const double difference = seen(sum, before) - seen(rest, more);
        squares += difference * difference;
    }
    /* Of means of a and b samples the difference has the variance s^2 (1/a + 1/b), their common
     * mean s^2 / (a + b). */
    return 255.0 * sqrt(squares / (double)count * before * more) / (before + more);
}

static bool tick(void *context, double done)
{
    refinement *f = context;
    const rt_options *o = &f->r->options;
    double now = f->from + f->share * done;
    if (o->seconds > 0.0)
        now = fmax(now, (rt_clock_seconds() - f->r->start) / o->seconds);
    f->done = fmin(fmax(f->done, now), 1.0);
    return rt_watch_tick(&f->r->watch, f->done);
}

/* 4, 6, 8, 12, 16, 24 and so on: sums of few powers of two, at which the points are spread best. */
static int next_count(int samples)
{
    const bool is_power = (samples & (samples - 1)) == 0;
    const int next = is_power ? samples + samples / 2 : samples / 3 * 4;
    return samples == 0 ? RT_REFINE_LEAST : next < RT_SAMPLES_MAX ? next : RT_SAMPLES_MAX;
}

/* So many samples as there is time for; no more than there are where there is none. */
static int fit_count(const refinement *f, int samples, int next)
{
    const double now = rt_clock_seconds(), seconds = f->r->options.seconds;
    if (!(seconds > 0.0) || samples == 0)
        return next;
    const double left = f->r->start + seconds - now, a_sample = (now - f->start) / samples;
    const double room = left * (1.0 - ROUND_MARGIN) / a_sample;
    return room < next - samples ? samples + (room > 0.0 ? (int)room : 0) : next;
}

/* What the rounds to come are of all of them, as far as the error so far tells. */
static void expect(refinement *f, int samples, int next)
{
    const rt_options *o = &f->r->options;
    const double error = f->r->stats.error;
    double all = RT_SAMPLES_MAX;
    if (o->error > 0.0 && error > 0.0)
        all = fmin(all, samples * (error / o->error) * (error / o->error));
    f->from = fmin(samples / all, 1.0);
    f->share = fmin(next / all, 1.0) - f->from;
}

static void tell(const rt_run *r)
{
    if (r->options.quiet)
        return;
    fprintf(stderr, "rt: %d samples a pixel after %.2f s", r->scene.samples,
            rt_clock_seconds() - r->start);
    if (r->stats.error > 0.0)
        fprintf(stderr, "; the error is about %.2g steps of 256 (root mean square)",
                r->stats.error);
    fputc('\n', stderr);
    if (r->options.error > 0.0 && !(r->stats.error <= r->options.error))
        fprintf(stderr, "rt: warning: --error %g is not reached: %s\n", r->options.error,
                r->scene.samples == RT_SAMPLES_MAX ? "there are no more samples"
                                                   : "the seconds are over");
}

bool rt_refine(rt_run *r, rt_team *team, rt_image *image)
{
    const size_t count = 3 * (size_t)image->width * (size_t)image->height;
    float *before = malloc(count * sizeof *before);
    if (!before)
        return rt_status_no_memory(&r->status, "the samples before");
    refinement f = {.r = r, .start = rt_clock_seconds()};
    const rt_watch watch = {tick, &f};
    int samples = 0;
    bool good = true;
    while (good && samples < RT_SAMPLES_MAX) {
        const int next = fit_count(&f, samples, next_count(samples));
        if (next == samples)
            break;
        const rt_sample_range range = {samples, next - samples, true};
        expect(&f, samples, next);
        memcpy(before, image->rgb, count * sizeof *before);
        good = rt_team_draw_range(team, &range, image, &watch, &r->status);
        if (good && range.count * SHORT_ROUND < samples)
            r->stats.error *= sqrt((double)samples / next);
        else if (good && samples > 0)
            r->stats.error = rt_refine_error(before, samples, image->rgb, range.count, count);
        samples = next;
        if (r->options.error > 0.0 && r->stats.error > 0.0 && r->stats.error <= r->options.error)
            break;
    }
    free(before);
    for (size_t i = 0; good && i < count; ++i)
        image->rgb[i] = image->rgb[i] / (float)samples;
    r->scene.samples = samples;
    if (good)
        tell(r);
    return good;
}
