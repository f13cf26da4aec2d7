#include "study/study.h"

#include <stdlib.h>

#include "study/parts.h"
#include "study/verdict.h"

/* What tracing the same rays and those aimed at edges is reckoned to take. */
#define RAYS_SECONDS 2.0
#define EDGES_SECONDS 2.0

static void clear_pictures(study_pictures *p)
{
    rt_image_clear(&p->converged);
    rt_image_clear(&p->reference);
    rt_image_clear(&p->base);
    rt_image_clear(&p->level);
}

static bool make_pictures(study_state *s, study_pictures *p)
{
    const int width = s->scene->width, height = s->scene->height;
    *p = (study_pictures){0};
    const bool good = rt_image_init(&p->converged, width, height, false, s->status) &&
                      rt_image_init(&p->reference, width, height, false, s->status) &&
                      rt_image_init(&p->base, width, height, false, s->status) &&
                      rt_image_init(&p->level, width, height, false, s->status);
    if (!good)
        clear_pictures(p);
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
    bool good = rt_study_make_renderers(s, 1, renderers);
    *r = (reckoned){0.0, 0.0};
    for (size_t i = 0; good && i < study->level_count; ++i) {
        study_taken one;
        /* Twice: the first one compiles. */
        good = rt_study_draw(s, renderers[i], &image, NULL, &one) && rt_study_tick(s, 0.0) &&
               rt_study_draw(s, renderers[i], &image, NULL, &one);
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
    rt_study_free_renderers(renderers);
    rt_image_clear(&image);
    return good;
}

static bool measure(study_state *s)
{
    rt_study *study = s->study;
    study_pictures p;
    reckoned r;
    if (!measure_rays(s, &r) || !make_pictures(s, &p))
        return false;
    rt_study_begin_part(s, rt_study_reference_seconds(s, study->converged_samples, r.reference));
    bool good = rt_study_draw_reference(s, study->converged_samples, &p.converged);
    for (size_t i = 0; good && i < study->plan.sample_count; ++i) {
        const int samples = study->plan.samples[i];
        rt_study_begin_part(s, rt_study_reference_seconds(s, samples, r.reference));
        good = rt_study_draw_reference(s, samples, &p.reference);
        if (good) {
            study->sampling[i] = rt_study_error_of(&p.reference, &p.converged);
            good = rt_study_measure_pictures(s, i, &p, r.levels * samples);
        }
    }
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

/* The levels that the device has; false, with code RT_ERROR_DEVICE, for none. */
static bool choose_levels(rt_study *study, rt_status *status)
{
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i) {
        const enum rt_accuracy level = (enum rt_accuracy)i;
        const bool has = device_has(study->device, level);
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
