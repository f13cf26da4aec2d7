#define _GNU_SOURCE
#include "study/study.h"

#include <stdlib.h>
#include <string.h>

#include "common/clock.h"
#include "study/judge.h"
#include "study/parts.h"

/* What parts are reckoned to take before anything of them is known: rather too long than too short,
 * since what has been told of the progress is not taken back. */
#define BUILD_SECONDS 4.0
#define TRY_SECONDS 2.0
#define RAYS_SECONDS 1.0
#define EDGES_SECONDS 4.0
#define REFERENCE_SECONDS 30.0
#define PICTURES_SECONDS 30.0
/* Samples a pixel of the pictures that are tried: programs of one sample are others than those of
 * several, which take nearly all the time. */
#define TRIED_SAMPLES 2

static void clear_pictures(study_pictures *p)
{
    rt_image_clear(&p->converged);
    rt_image_clear(&p->reference);
    rt_image_clear(&p->level);
    free(p->noise);
}

static bool make_pictures(study_state *s, study_pictures *p)
{
    const int width = s->scene->width, height = s->scene->height;
    return rt_image_init(&p->converged, width, height, false, s->status) &&
           rt_image_init(&p->reference, width, height, false, s->status) &&
           rt_image_init(&p->level, width, height, false, s->status);
}

/* What is known before anything has been done. */
static void plan_work(study_state *s)
{
    const rt_study *study = s->study;
    rt_forecast *f = &s->forecast;
    const double entries = (double)study->entry_count;
    *f = (rt_forecast){.start = rt_clock_seconds()};
    f->began = f->start;
    rt_forecast_expect(f, RT_WORK_BUILD, BUILD_SECONDS);
    rt_forecast_expect(f, RT_WORK_TRY, TRY_SECONDS);
    rt_forecast_expect(f, RT_WORK_RAYS, RAYS_SECONDS);
    rt_forecast_expect(f, RT_WORK_EDGES, EDGES_SECONDS);
    rt_forecast_expect(f, RT_WORK_REFERENCE, REFERENCE_SECONDS);
    rt_forecast_expect(f, RT_WORK_PICTURES, PICTURES_SECONDS);
    rt_forecast_plan(f, RT_WORK_BUILD, study->plan.samples[0] == 1 ? 2.0 * entries : entries);
    rt_forecast_plan(f, RT_WORK_TRY, 1.0);
    rt_forecast_plan(f, RT_WORK_RAYS, 1.0);
    rt_forecast_plan(f, RT_WORK_EDGES, s->scene->triangle_count ? entries : 0.0);
    rt_forecast_plan(f, RT_WORK_REFERENCE, 1.0);
    rt_forecast_plan(f, RT_WORK_PICTURES, 1.0);
}

/* Replaces what was guessed of the pictures by what a sample has been seen to take. */
static void plan_pictures(study_state *s, double seconds_a_sample)
{
    const rt_study_plan *plan = &s->study->plan;
    rt_forecast *f = &s->forecast;
    rt_forecast_drop(f, RT_WORK_PICTURES, 1.0);
    rt_forecast_expect(f, RT_WORK_PICTURES, seconds_a_sample);
    for (size_t i = 0; i < plan->sample_count; ++i) {
        const double one = seconds_a_sample * plan->samples[i] / (double)s->study->entry_count;
        const double timing =
            plan->samples[i] * plan->repeats * (double)rt_study_pictures_a_repeat(one);
        rt_forecast_plan(f, RT_WORK_PICTURES, plan->samples[i] + timing + rt_study_reserve(timing));
    }
}

/* Draws with every renderer once. Tells what a sample takes on all entries together, and on the one
 * nearest to the reference. */
static bool draw_all(study_state *s, rt_renderer *const *renderers, int samples, double *all,
                     double *reference)
{
    const rt_study *study = s->study;
    rt_image image;
    if (!rt_image_init(&image, s->scene->width, s->scene->height, false, s->status))
        return false;
    const rt_watch watch = rt_study_watch_still(s);
    bool good = true;
    *all = *reference = 0.0;
    for (size_t i = 0; good && i < study->entry_count; ++i) {
        study_taken one = {0};
        good = rt_study_draw(s, i, renderers[i], &image, &watch, &one);
        *all += one.wall / samples;
        if (study->entries[i].device == study->reference_device)
            *reference = one.wall / samples;
    }
    rt_image_clear(&image);
    return good;
}

/* Some runtimes compile a part of a program when it first runs. */
static bool build_one(study_state *s, int samples, rt_renderer **renderers)
{
    double all, reference;
    rt_study_begin_part(s, RT_WORK_BUILD, (double)s->study->entry_count);
    return rt_study_make_renderers(s, samples, renderers) &&
           draw_all(s, renderers, samples, &all, &reference);
}

/* All programs are built before anything else: with them what is left can be told. */
static bool build(study_state *s, rt_renderer **renderers)
{
    bool good = true;
    if (s->study->plan.samples[0] == 1) {
        good = build_one(s, 1, renderers);
        rt_study_free_renderers(renderers);
    }
    return good && build_one(s, TRIED_SAMPLES, renderers);
}

static bool measure_rays(study_state *s)
{
    rt_renderer *renderers[RT_STUDY_ENTRIES_MOST] = {NULL};
    double all = 0.0, reference = 0.0;
    bool good = build(s, renderers);
    if (good) {
        rt_study_begin_part(s, RT_WORK_TRY, 1.0);
        good = draw_all(s, renderers, TRIED_SAMPLES, &all, &reference);
    }
    if (good) {
        plan_pictures(s, all);
        rt_forecast_drop(&s->forecast, RT_WORK_REFERENCE, 1.0);
        good = rt_study_choose_reference(s, reference);
    }
    good = good && rt_study_trace_rays(s, renderers);
    rt_study_free_renderers(renderers);
    return good && rt_study_trace_edges(s);
}

static bool measure_pictures(study_state *s, study_pictures *p, rt_study_strip *strip)
{
    rt_study *study = s->study;
    bool good = rt_study_draw_reference(s, study->converged_samples, &p->converged) &&
                rt_study_strip_keep_reference(strip, &p->converged, s->status);
    for (size_t i = 0; good && i < study->plan.sample_count; ++i) {
        good = rt_study_draw_reference(s, study->plan.samples[i], &p->reference);
        free(p->noise);
        p->noise = good ? rt_study_noise_of(&p->reference, &p->converged) : NULL;
        if (good && !p->noise)
            return rt_status_no_memory(s->status, "the study");
        if (good) {
            study->sampling[i] = rt_study_error_of(&p->reference, &p->converged);
            good = rt_study_measure_pictures(s, i, p, strip);
        }
    }
    return good;
}

static bool measure(study_state *s, rt_study_strip *strip)
{
    study_pictures p = {0};
    plan_work(s);
    s->tree = rt_scalar_double_tree(s->scene);
    const bool good = measure_rays(s) && make_pictures(s, &p) && measure_pictures(s, &p, strip);
    rt_scalar_double_tree_free(s->tree);
    clear_pictures(&p);
    return good;
}

static bool device_has(const rt_device *device, enum rt_accuracy level)
{
    rt_status scratch = RT_STATUS_INIT; /* what is lacking is told in the report */
    const bool has = rt_device_check_level(device, level, &scratch);
    rt_status_clear(&scratch);
    return has;
}

/* The levels that a device has become entries, in order. */
static void add_entries(rt_study *study, size_t d, const rt_device *device, rt_status *status)
{
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i) {
        const enum rt_accuracy level = (enum rt_accuracy)i;
        const bool has = device_has(device, level), wanted = study->plan.levels[i];
        if (has && level > study->reference_level) {
            study->reference_level = level;
            study->reference_device = d;
        }
        study->devices[d].lacks[i] = wanted && !has;
        if (wanted && !has)
            rt_status_warn(status, "rt: warning: '%s' does not have the level %s", device->name,
                           rt_accuracy_name(level));
        else if (wanted)
            study->entries[study->entry_count++] = (rt_study_entry){.device = d, .level = level};
    }
}

/* False, with code RT_ERROR_DEVICE, for a device without any of the levels. */
static bool choose_entries(rt_study *study, const rt_study_how *how, rt_status *status)
{
    bool good = true;
    study->devices = calloc(how->device_count, sizeof *study->devices);
    if (!study->devices)
        return rt_status_no_memory(status, "the study");
    study->device_count = how->device_count;
    for (size_t d = 0; good && d < how->device_count; ++d) {
        const rt_device *device = how->devices[d];
        study->devices[d].name = strdup(device->name);
        study->devices[d].platform = strdup(device->platform_name);
        study->devices[d].driver = strdup(device->driver);
        if (!study->devices[d].name || !study->devices[d].platform || !study->devices[d].driver)
            return rt_status_no_memory(status, "the study");
        const size_t before = study->entry_count;
        add_entries(study, d, device, status);
        good = study->entry_count > before ||
               rt_status_fail(status, RT_ERROR_DEVICE, "rt: '%s' has none of the levels to study",
                              device->name);
    }
    int lowest = 0;
    while (!study->plan.levels[lowest])
        ++lowest;
    study->base =
        study->plan.levels[RT_ACCURACY_STANDARD] ? RT_ACCURACY_STANDARD : (enum rt_accuracy)lowest;
    return good;
}

bool rt_study_run(rt_study *study, rt_study_strip *strip, const rt_scene *scene,
                  const char *scene_name, const rt_study_plan *plan, const rt_study_how *how,
                  const rt_watch *watch, rt_status *status)
{
    *study = (rt_study){
        .scene = strdup(scene_name), .width = scene->width, .height = scene->height, .plan = *plan};
    study_state s = {.study = study, .scene = scene, .how = how, .watch = watch, .status = status};
    const bool good = (study->scene || rt_status_no_memory(status, "the study")) &&
                      choose_entries(study, how, status) && rt_study_make_cells(study, status) &&
                      measure(&s, strip);
    if (good)
        rt_study_conclude(study);
    else
        rt_study_clear(study);
    return good;
}
