/* The pictures of a study: every level at one count of samples, held against the reference and
 * timed. */
#include <math.h>
#include <stdlib.h>

#include "common/clock.h"
#include "study/parts.h"

static double stages_of(const rt_render_times *times)
{
    double sum = 0.0;
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        sum += times->stages[i];
    return sum;
}

bool rt_study_draw(study_state *s, rt_renderer *renderer, rt_image *image, const rt_watch *watch,
                   study_taken *t)
{
    const rt_render_times before = *rt_renderer_times(renderer);
    const double start = rt_clock_seconds();
    if (!rt_renderer_draw(renderer, image, watch, s->status))
        return false;
    const rt_render_times *after = rt_renderer_times(renderer);
    t->wall = rt_clock_seconds() - start;
    t->kernel = stages_of(after) - stages_of(&before);
    t->readback = after->readback - before.readback;
    t->rays = rt_render_times_rays(after) - rt_render_times_rays(&before);
    if (!(t->kernel > 0.0))
        s->study->kernel_is_wall = true;
    if (s->study->kernel_is_wall)
        t->kernel = t->wall;
    return true;
}

/* A repeat is as many pictures as take this long together: what takes a few milliseconds alone is
 * at the mercy of every other process. */
#define REPEAT_SECONDS 0.025
#define REPEAT_PICTURES_MOST 16

/* Times of one count of samples: `repeats` a level, of so many pictures each. */
typedef struct timings {
    size_t repeats, pictures;
    double *kernel, *readback, *wall, *ratio; /* owned, all in `kernel`'s block */
} timings;

static bool make_timings(study_state *s, timings *t)
{
    t->repeats = (size_t)s->study->plan.repeats;
    const size_t count = s->study->level_count * t->repeats;
    t->kernel = calloc(4 * count + 1, sizeof *t->kernel);
    if (!t->kernel)
        return rt_status_no_memory(s->status, "times");
    t->readback = t->kernel + count;
    t->wall = t->readback + count;
    t->ratio = t->wall + count;
    return true;
}

/* Level by level there and back again, so that what drifts on the machine meets all of them. */
static bool repeat(study_state *s, rt_renderer *const *renderers, rt_image *image, timings *t,
                   double seconds)
{
    const size_t levels = s->study->level_count;
    rt_study_begin_part(s, seconds);
    for (size_t round = 0; round < t->repeats; ++round)
        for (size_t i = 0; i < levels; ++i) {
            const size_t level = round % 2 ? levels - 1 - i : i;
            const size_t at = level * t->repeats + round;
            for (size_t k = 0; k < t->pictures; ++k) {
                study_taken one;
                if (!rt_study_tick(s,
                                   (double)(round * levels + i) / (double)(t->repeats * levels)) ||
                    !rt_study_draw(s, renderers[level], image, NULL, &one))
                    return false;
                t->kernel[at] += one.kernel / (double)t->pictures;
                t->readback[at] += one.readback / (double)t->pictures;
                t->wall[at] += one.wall / (double)t->pictures;
            }
        }
    return true;
}

static void summarise(const rt_study *study, timings *t, rt_study_cell *cells)
{
    const double *base = t->kernel + rt_study_base_index(study) * t->repeats;
    for (size_t i = 0; i < study->level_count; ++i)
        for (size_t k = 0; k < t->repeats; ++k)
            t->ratio[i * t->repeats + k] = t->kernel[i * t->repeats + k] / base[k];
    for (size_t i = 0; i < study->level_count; ++i) {
        cells[i].kernel = rt_spread_of(t->kernel + i * t->repeats, t->repeats);
        cells[i].readback = rt_spread_of(t->readback + i * t->repeats, t->repeats);
        cells[i].wall = rt_spread_of(t->wall + i * t->repeats, t->repeats);
        cells[i].ratio = rt_spread_of(t->ratio + i * t->repeats, t->repeats);
    }
}

/* The untimed first pictures of a count of samples, and what is wrong with them. */
static bool compare(study_state *s, rt_renderer *const *renderers, study_pictures *p,
                    rt_study_cell *cells, timings *t)
{
    rt_study *study = s->study;
    const size_t base = rt_study_base_index(study);
    const rt_watch watch = rt_study_watch(s);
    for (size_t k = 0; k < study->level_count; ++k) {
        /* The base first: others are compared to it. */
        const size_t i = k == 0 ? base : k <= base ? k - 1 : k;
        rt_image *image = i == base ? &p->base : &p->level;
        study_taken one;
        if (!rt_study_draw(s, renderers[i], image, &watch, &one))
            return false;
        if (i == base)
            t->pictures = one.kernel * REPEAT_PICTURES_MOST > REPEAT_SECONDS
                              ? (size_t)ceil(REPEAT_SECONDS / one.kernel)
                              : REPEAT_PICTURES_MOST;
        cells[i].rays = one.rays;
        cells[i].arithmetic = rt_study_error_of(image, &p->reference);
        cells[i].seen = rt_study_error_of(image, &p->converged);
        cells[i].changed = i == base ? 0 : rt_study_error_of(image, &p->base).over_1;
    }
    return true;
}

bool rt_study_measure_pictures(study_state *s, size_t sample_index, study_pictures *p,
                               double seconds)
{
    rt_study *study = s->study;
    const int samples = study->plan.samples[sample_index];
    rt_study_cell *cells = study->cells + sample_index * study->level_count;
    rt_renderer *renderers[RT_ACCURACY_COUNT];
    timings t = {0};
    rt_study_begin_part(s, seconds);
    bool good = rt_study_make_renderers(s, samples, renderers);
    for (size_t i = 0; good && i < study->level_count; ++i) {
        cells[i].level = study->levels[i].level;
        cells[i].samples = samples;
        cells[i].program = rt_renderer_times(renderers[i])->program;
        cells[i].upload = rt_renderer_times(renderers[i])->upload;
    }
    good = good && compare(s, renderers, p, cells, &t) && make_timings(s, &t) &&
           repeat(s, renderers, &p->level, &t, seconds * study->plan.repeats);
    if (good)
        summarise(study, &t, cells);
    free(t.kernel);
    rt_study_free_renderers(renderers);
    return good;
}
