#include "study/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bvh/bvh.h"
#include "common/clock.h"
#include "common/parallel.h"
#include "study/state.h"

/* What tracing the same rays and those aimed at edges is reckoned to take. */
#define RAYS_SECONDS 2.0
#define EDGES_SECONDS 2.0

void rt_study_begin_part(study_state *s, double seconds)
{
    s->done += s->part;
    s->part = seconds;
}

static bool tick(void *context, double done)
{
    const study_state *s = context;
    const double all = s->all > 0.0 ? (s->done + s->part * done) / s->all : 0.0;
    return rt_watch_tick(s->watch, all < 1.0 ? all : 1.0);
}

bool rt_study_tick(study_state *s, double done)
{
    return tick(s, done) || rt_status_fail(s->status, RT_INTERRUPTED, "rt: interrupted");
}

rt_watch rt_study_watch(study_state *s)
{
    return (rt_watch){tick, s};
}

bool rt_study_device_has(const rt_device *device, enum rt_accuracy level)
{
    rt_status scratch = RT_STATUS_INIT; /* what is lacking is told in the report */
    const bool has = rt_device_check_level(device, level, &scratch);
    rt_status_clear(&scratch);
    return has;
}

rt_renderer *rt_study_renderer(study_state *s, const rt_scene *scene, enum rt_accuracy level,
                               int samples)
{
    rt_scene copy = *scene; /* the arrays stay the caller's */
    copy.accuracy = level;
    copy.samples = samples;
    rt_effects effects = rt_effects_of(&copy);
    effects.mode = s->how->effects;
    const rt_render_options options = {
        .lanes = s->how->lanes, .tile = s->how->tile, .effects = &effects};
    rt_bvh bvh = {0};
    if (s->how->has_tree && !rt_bvh_build(&bvh, &copy, rt_parallel_processors(), s->status))
        return NULL;
    rt_renderer *renderer =
        rt_renderer_new(s->how->device, &copy, s->how->has_tree ? &bvh : NULL, &options, s->status);
    rt_bvh_clear(&bvh);
    return renderer;
}

/* One renderer a level of the plan, in order; the rest of the array is NULL. */
static bool make_renderers(study_state *s, int samples, rt_renderer **renderers)
{
    memset(renderers, 0, RT_ACCURACY_COUNT * sizeof *renderers);
    for (size_t i = 0; i < s->study->level_count; ++i) {
        if (!rt_study_tick(s, 0.0))
            return false;
        renderers[i] = rt_study_renderer(s, s->scene, s->study->levels[i].level, samples);
        if (!renderers[i])
            return false;
    }
    return true;
}

static void free_renderers(rt_renderer **renderers)
{
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i)
        rt_renderer_free(renderers[i]);
}

/* What one picture took. */
typedef struct taken {
    double kernel, readback, wall;
    size_t rays;
} taken;

/* Of every kind. */
static size_t rays_of(const rt_render_times *times)
{
    return times->primary_rays + times->shadow_rays + times->occlusion_rays +
           times->reflection_rays + times->refraction_rays;
}

static double stages_of(const rt_render_times *times)
{
    double sum = 0.0;
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        sum += times->stages[i];
    return sum;
}

static bool draw(study_state *s, rt_renderer *renderer, rt_image *image, const rt_watch *watch,
                 taken *t)
{
    const rt_render_times before = *rt_renderer_times(renderer);
    const double start = rt_clock_seconds();
    if (!rt_renderer_draw(renderer, image, watch, s->status))
        return false;
    const rt_render_times *after = rt_renderer_times(renderer);
    t->wall = rt_clock_seconds() - start;
    t->kernel = stages_of(after) - stages_of(&before);
    t->readback = after->readback - before.readback;
    t->rays = rays_of(after) - rays_of(&before);
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
                taken one;
                if (!rt_study_tick(s,
                                   (double)(round * levels + i) / (double)(t->repeats * levels)) ||
                    !draw(s, renderers[level], image, NULL, &one))
                    return false;
                t->kernel[at] += one.kernel / (double)t->pictures;
                t->readback[at] += one.readback / (double)t->pictures;
                t->wall[at] += one.wall / (double)t->pictures;
            }
        }
    return true;
}

static size_t base_index(const rt_study *study)
{
    size_t i = 0;
    while (study->levels[i].level != study->base)
        ++i;
    return i;
}

static void summarise(const rt_study *study, timings *t, rt_study_cell *cells)
{
    const double *base = t->kernel + base_index(study) * t->repeats;
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

/* The pictures of a study that are alive at a time. */
typedef struct pictures {
    rt_image converged, reference, base, level;
} pictures;

static void clear_pictures(pictures *p)
{
    rt_image_clear(&p->converged);
    rt_image_clear(&p->reference);
    rt_image_clear(&p->base);
    rt_image_clear(&p->level);
}

static bool make_pictures(study_state *s, pictures *p)
{
    const int width = s->scene->width, height = s->scene->height;
    *p = (pictures){0};
    const bool good = rt_image_init(&p->converged, width, height, false, s->status) &&
                      rt_image_init(&p->reference, width, height, false, s->status) &&
                      rt_image_init(&p->base, width, height, false, s->status) &&
                      rt_image_init(&p->level, width, height, false, s->status);
    if (!good)
        clear_pictures(p);
    return good;
}

/* The untimed first pictures of a count of samples, and what is wrong with them. */
static bool compare(study_state *s, rt_renderer *const *renderers, pictures *p,
                    rt_study_cell *cells, timings *t)
{
    rt_study *study = s->study;
    const size_t base = base_index(study);
    const rt_watch watch = rt_study_watch(s);
    for (size_t k = 0; k < study->level_count; ++k) {
        /* The base first: others are compared to it. */
        const size_t i = k == 0 ? base : k <= base ? k - 1 : k;
        rt_image *image = i == base ? &p->base : &p->level;
        taken one;
        if (!draw(s, renderers[i], image, &watch, &one))
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

/* All levels at one count of samples. `seconds` is what one picture of each takes together. */
static bool measure_samples(study_state *s, size_t sample_index, pictures *p, double seconds,
                            double reference_seconds)
{
    rt_study *study = s->study;
    const int samples = study->plan.samples[sample_index];
    rt_study_cell *cells = study->cells + sample_index * study->level_count;
    rt_renderer *renderers[RT_ACCURACY_COUNT];
    timings t = {0};
    rt_study_begin_part(s, reference_seconds);
    bool good = rt_study_draw_reference(s, samples, &p->reference);
    if (good)
        study->sampling[sample_index] = rt_study_error_of(&p->reference, &p->converged);
    rt_study_begin_part(s, seconds);
    good = make_renderers(s, good ? samples : 1, renderers) && good;
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
    free_renderers(renderers);
    return good;
}

/* Seconds of one sample a pixel: at all levels of the plan together, and as a reference. */
typedef struct reckoned {
    double levels, reference;
} reckoned;

/* The rays, which need a renderer a level; their first pictures tell how long the rest will take.
 */
static bool measure_rays(study_state *s, reckoned *r)
{
    rt_study *study = s->study;
    rt_renderer *renderers[RT_ACCURACY_COUNT];
    rt_image image;
    if (!rt_image_init(&image, s->scene->width, s->scene->height, false, s->status))
        return false;
    bool good = make_renderers(s, 1, renderers);
    *r = (reckoned){0.0, 0.0};
    for (size_t i = 0; good && i < study->level_count; ++i) {
        taken one;
        /* Twice: the first one compiles. */
        good = draw(s, renderers[i], &image, NULL, &one) && rt_study_tick(s, 0.0) &&
               draw(s, renderers[i], &image, NULL, &one);
        r->levels += good ? one.wall : 0.0;
        r->reference = good ? one.wall : 0.0; /* the last level is the nearest to it */
    }
    good = good && rt_study_choose_reference(s, r->reference);
    if (good) {
        double samples = 0.0;
        for (size_t i = 0; i < study->plan.sample_count; ++i)
            samples += study->plan.samples[i];
        s->all =
            RAYS_SECONDS + samples * r->levels * (1 + study->plan.repeats) +
            rt_study_reference_seconds(s, (int)samples + study->converged_samples, r->reference);
        rt_study_begin_part(s, RAYS_SECONDS);
        good = rt_study_trace_rays(s, renderers);
        rt_study_begin_part(s, EDGES_SECONDS);
        good = good && rt_study_trace_edges(s);
    }
    free_renderers(renderers);
    rt_image_clear(&image);
    return good;
}

static bool measure(study_state *s)
{
    rt_study *study = s->study;
    pictures p;
    reckoned r;
    if (!measure_rays(s, &r) || !make_pictures(s, &p))
        return false;
    rt_study_begin_part(s, rt_study_reference_seconds(s, study->converged_samples, r.reference));
    bool good = rt_study_draw_reference(s, study->converged_samples, &p.converged);
    for (size_t i = 0; good && i < study->plan.sample_count; ++i) {
        const int samples = study->plan.samples[i];
        good = measure_samples(s, i, &p, r.levels * samples,
                               rt_study_reference_seconds(s, samples, r.reference));
    }
    clear_pictures(&p);
    return good;
}

/* The levels that the device has; false, with code RT_ERROR_DEVICE, for none. */
static bool choose_levels(rt_study *study, rt_status *status)
{
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i) {
        const enum rt_accuracy level = (enum rt_accuracy)i;
        const bool has = rt_study_device_has(study->device, level);
        if (has)
            study->reference_level = level;
        study->lacks[i] = study->plan.levels[i] && !has;
        if (study->lacks[i])
            rt_status_warn(status, "rt: warning: '%s' does not have the level %s",
                           study->device->name, rt_accuracy_name(level));
        study->plan.levels[i] = study->plan.levels[i] && has;
        if (study->plan.levels[i])
            study->levels[study->level_count++].level = level;
    }
    if (study->level_count == 0)
        return rt_status_fail(status, RT_ERROR_DEVICE, "rt: '%s' has none of the levels to study",
                              study->device->name);
    study->base =
        study->plan.levels[RT_ACCURACY_STANDARD] ? RT_ACCURACY_STANDARD : study->levels[0].level;
    return true;
}

bool rt_study_run(rt_study *study, const rt_scene *scene, const char *scene_name,
                  const rt_study_plan *plan, const rt_study_how *how, const rt_watch *watch,
                  rt_status *status)
{
    *study = (rt_study){.scene = scene_name,
                        .device = how->device,
                        .width = scene->width,
                        .height = scene->height,
                        .plan = *plan};
    study_state s = {.study = study, .scene = scene, .how = how, .watch = watch, .status = status};
    if (!choose_levels(study, status))
        return false;
    study->cell_count = study->level_count * plan->sample_count;
    study->cells = calloc(study->cell_count, sizeof *study->cells);
    const bool good = study->cells ? measure(&s) : rt_status_no_memory(status, "the study");
    if (good)
        rt_study_conclude(study);
    else
        rt_study_clear(study);
    return good;
}

void rt_study_clear(rt_study *study)
{
    free(study->cells);
    *study = (rt_study){0};
}

const rt_study_cell *rt_study_cell_at(const rt_study *study, size_t sample_index,
                                      size_t level_index)
{
    return &study->cells[sample_index * study->level_count + level_index];
}
