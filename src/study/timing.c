/* What pictures take: every entry again and again, so that what changes on the machine meets all of
 * them, by the device's own clock, which tells of its kernels alone. */
#include <math.h>
#include <stdlib.h>

#include "common/clock.h"
#include "study/judge.h"
#include "study/load.h"
#include "study/parts.h"

/* A repeat is as many pictures as take this long together: what takes a few milliseconds alone is
 * at the mercy of every other process. */
#define REPEAT_SECONDS 0.025
#define REPEAT_PICTURES_MOST 16
/* Uneven times are taken more often: at most so many times as often as was planned. */
#define REPEATS_TIMES_MOST 2

static double stages_of(const rt_render_times *times)
{
    double sum = 0.0;
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        sum += times->stages[i];
    return sum;
}

bool rt_study_draw(study_state *s, size_t entry_index, rt_renderer *renderer, rt_image *image,
                   const rt_watch *watch, study_taken *t)
{
    rt_study_device *device = &s->study->devices[s->study->entries[entry_index].device];
    const rt_render_times before = *rt_renderer_times(renderer);
    const double start = rt_clock_seconds();
    if (!rt_renderer_draw(renderer, image, watch, s->status))
        return false;
    const rt_render_times *after = rt_renderer_times(renderer);
    t->wall = rt_clock_seconds() - start;
    t->kernel = stages_of(after) - stages_of(&before);
    t->readback = after->readback - before.readback;
    t->rays = rt_ray_counts_total(&after->rays) - rt_ray_counts_total(&before.rays);
    if (!(t->kernel > 0.0))
        device->kernel_is_wall = true;
    if (device->kernel_is_wall)
        t->kernel = t->wall;
    return true;
}

size_t rt_study_pictures_a_repeat(double seconds)
{
    return seconds * REPEAT_PICTURES_MOST > REPEAT_SECONDS ? (size_t)ceil(REPEAT_SECONDS / seconds)
                                                           : REPEAT_PICTURES_MOST;
}

/* Times of one count of samples, by entry and then by round. */
typedef struct timings {
    size_t entries, rounds, most;
    double *kernel, *readback, *wall, *ratio; /* owned, all in `kernel`'s block */
    rt_load before;                           /* the machine's when it began */
} timings;

static bool make_timings(study_state *s, timings *t)
{
    *t = (timings){.entries = s->study->entry_count,
                   .before = rt_load_read(),
                   .most = (size_t)s->study->plan.repeats * REPEATS_TIMES_MOST};
    const size_t count = t->entries * t->most;
    t->kernel = calloc(4 * count + 1, sizeof *t->kernel);
    if (!t->kernel)
        return rt_status_no_memory(s->status, "times");
    t->readback = t->kernel + count;
    t->wall = t->readback + count;
    t->ratio = t->wall + count;
    return true;
}

/* One repeat of an entry. */
static bool repeat(study_state *s, size_t entry, rt_renderer *renderer, rt_image *image,
                   size_t pictures, double done, timings *t)
{
    const size_t at = entry * t->most + t->rounds;
    for (size_t k = 0; k < pictures; ++k) {
        study_taken one;
        if (!rt_study_tick(s, done) || !rt_study_draw(s, entry, renderer, image, NULL, &one))
            return false;
        t->kernel[at] += one.kernel / (double)pictures;
        t->readback[at] += one.readback / (double)pictures;
        t->wall[at] += one.wall / (double)pictures;
    }
    return true;
}

/* The spread of an entry's times against another's, round by round. */
static rt_spread ratio_of(timings *t, size_t entry, size_t other)
{
    for (size_t i = 0; i < t->rounds; ++i)
        t->ratio[i] = t->kernel[entry * t->most + i] / t->kernel[other * t->most + i];
    return rt_spread_of(t->ratio, t->rounds);
}

static bool are_narrow(const rt_study *study, timings *t)
{
    for (size_t i = 0; i < t->entries; ++i) {
        const size_t first = rt_study_find(study, 0, study->entries[i].level);
        rt_spread ratio = ratio_of(t, i, rt_study_base_of(study, i));
        if (!rt_study_is_narrow(&ratio))
            return false;
        if (first < t->entries) {
            ratio = ratio_of(t, i, first);
            if (!rt_study_is_narrow(&ratio))
                return false;
        }
    }
    return true;
}

/* A round: level by level, there and back again. */
static bool take_round(study_state *s, rt_renderer *const *renderers, rt_image *image,
                       const size_t *pictures, timings *t, size_t first, size_t end)
{
    for (size_t i = 0; i < t->entries; ++i) {
        const size_t entry = t->rounds % 2 ? t->entries - 1 - i : i;
        const double done =
            (double)((t->rounds - first) * t->entries + i) / (double)((end - first) * t->entries);
        if (!repeat(s, entry, renderers[entry], image, pictures[entry], done, t))
            return false;
    }
    ++t->rounds;
    return true;
}

/* The planned rounds, and where the times are uneven after them, more of them. Whether that will be
 * so shows in the middle of the first ones, and is part of the forecast from there on. */
static bool take_times(study_state *s, rt_renderer *const *renderers, rt_image *image,
                       const size_t *pictures, timings *t, double work)
{
    const size_t planned = (size_t)s->study->plan.repeats;
    double reserve = rt_study_reserve(work);
    rt_study_begin_part(s, RT_WORK_PICTURES, work);
    while (t->rounds < planned) {
        if (!take_round(s, renderers, image, pictures, t, 0, planned))
            return false;
        if (t->rounds == planned / 2 && !are_narrow(s->study, t)) {
            rt_forecast_plan(&s->forecast, RT_WORK_PICTURES, work - reserve);
            reserve = work;
        }
    }
    if (are_narrow(s->study, t)) {
        rt_forecast_drop(&s->forecast, RT_WORK_PICTURES, reserve);
        return true;
    }
    rt_forecast_plan(&s->forecast, RT_WORK_PICTURES, work - reserve);
    rt_study_begin_part(s, RT_WORK_PICTURES, work);
    while (t->rounds < t->most && !are_narrow(s->study, t))
        if (!take_round(s, renderers, image, pictures, t, planned, t->most))
            return false;
    return true;
}

static void summarise(rt_study *study, timings *t, size_t sample_index)
{
    study->rounds[sample_index] = (int)t->rounds;
    for (size_t i = 0; i < t->entries; ++i) {
        rt_study_cell *cell = rt_study_cell_at(study, sample_index, i);
        const size_t first = rt_study_find(study, 0, study->entries[i].level);
        cell->ratio = ratio_of(t, i, rt_study_base_of(study, i));
        cell->ratio_to_first =
            first < t->entries ? ratio_of(t, i, first) : (rt_spread){NAN, NAN, NAN};
    }
    for (size_t i = 0; i < t->entries; ++i) { /* sorts, so nothing is taken round by round now */
        rt_study_cell *cell = rt_study_cell_at(study, sample_index, i);
        cell->kernel = rt_spread_of(t->kernel + i * t->most, t->rounds);
        cell->readback = rt_spread_of(t->readback + i * t->most, t->rounds);
        cell->wall = rt_spread_of(t->wall + i * t->most, t->rounds);
    }
}

/* On a CPU pictures wait where other programs hold its processors. The finest pictures, which are
 * measured last, are those that the verdict goes by. */
static void note_load(study_state *s, const timings *t)
{
    const rt_load after = rt_load_read();
    for (size_t d = 0; d < s->study->device_count; ++d)
        s->study->devices[d].held =
            s->how->devices[d]->type & CL_DEVICE_TYPE_CPU ? rt_load_held(&t->before, &after) : 0.0;
}

double rt_study_reserve(double work)
{
    return 0.5 * work * (REPEATS_TIMES_MOST - 1);
}

bool rt_study_time(study_state *s, size_t sample_index, rt_renderer *const *renderers,
                   rt_image *image, const size_t *pictures)
{
    timings t;
    double sum = 0.0;
    for (size_t i = 0; i < s->study->entry_count; ++i)
        sum += (double)pictures[i];
    const double work = s->study->plan.samples[sample_index] * s->study->plan.repeats * sum /
                        (double)s->study->entry_count;
    if (!make_timings(s, &t))
        return false;
    const bool good = take_times(s, renderers, image, pictures, &t, work);
    if (good) {
        note_load(s, &t);
        summarise(s->study, &t, sample_index);
    }
    free(t.kernel);
    return good;
}
