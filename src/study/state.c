#include "study/state.h"

#include <string.h>

#include "common/clock.h"

void rt_study_begin_part(study_state *s, enum rt_work kind, double amount)
{
    rt_forecast_begin(&s->forecast, kind, amount, rt_clock_seconds());
}

static bool tick(void *context, double done)
{
    study_state *s = context;
    return rt_watch_tick(s->watch, rt_forecast_done(&s->forecast, done, rt_clock_seconds()));
}

bool rt_study_tick(study_state *s, double done)
{
    return tick(s, done) || rt_status_fail(s->status, RT_INTERRUPTED, "rt: interrupted");
}

rt_watch rt_study_watch(study_state *s)
{
    return (rt_watch){tick, s};
}

static bool tick_still(void *context, double done)
{
    (void)done;
    return tick(context, 0.0);
}

rt_watch rt_study_watch_still(study_state *s)
{
    return (rt_watch){tick_still, s};
}

rt_renderer *rt_study_renderer(study_state *s, const rt_scene *scene, const rt_bvh *bvh,
                               size_t device, enum rt_accuracy level, int samples)
{
    rt_scene copy = *scene; /* the arrays stay the caller's */
    copy.accuracy = level;
    copy.samples = samples;
    rt_effects effects = rt_effects_of(&copy);
    effects.mode = s->how->effects;
    const rt_watch building = rt_study_watch_still(s);
    const rt_render_options options = {
        .lanes = s->how->lanes, .tile = s->how->tile, .effects = &effects, .building = &building};
    return rt_renderer_new(s->how->devices[device], &copy, bvh, &options, s->status);
}

bool rt_study_make_renderers(study_state *s, int samples, rt_renderer **renderers)
{
    memset(renderers, 0, RT_STUDY_ENTRIES_MOST * sizeof *renderers);
    for (size_t i = 0; i < s->study->entry_count; ++i) {
        if (!rt_study_tick(s, (double)i / (double)s->study->entry_count))
            return false;
        const rt_study_entry *entry = &s->study->entries[i];
        renderers[i] =
            rt_study_renderer(s, s->scene, s->how->bvh, entry->device, entry->level, samples);
        if (!renderers[i])
            return false;
    }
    return true;
}

void rt_study_free_renderers(rt_renderer **renderers)
{
    for (size_t i = 0; i < RT_STUDY_ENTRIES_MOST; ++i) {
        rt_renderer_free(renderers[i]);
        renderers[i] = NULL;
    }
}
