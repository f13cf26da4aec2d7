#include "study/state.h"

#include <string.h>

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

rt_renderer *rt_study_renderer(study_state *s, const rt_scene *scene, const rt_bvh *bvh,
                               enum rt_accuracy level, int samples)
{
    rt_scene copy = *scene; /* the arrays stay the caller's */
    copy.accuracy = level;
    copy.samples = samples;
    rt_effects effects = rt_effects_of(&copy);
    effects.mode = s->how->effects;
    const rt_render_options options = {
        .lanes = s->how->lanes, .tile = s->how->tile, .effects = &effects};
    return rt_renderer_new(s->how->device, &copy, bvh, &options, s->status);
}

bool rt_study_make_renderers(study_state *s, int samples, rt_renderer **renderers)
{
    memset(renderers, 0, RT_ACCURACY_COUNT * sizeof *renderers);
    for (size_t i = 0; i < s->study->level_count; ++i) {
        if (!rt_study_tick(s, 0.0))
            return false;
        renderers[i] =
            rt_study_renderer(s, s->scene, s->how->bvh, s->study->levels[i].level, samples);
        if (!renderers[i])
            return false;
    }
    return true;
}

void rt_study_free_renderers(rt_renderer **renderers)
{
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i)
        rt_renderer_free(renderers[i]);
}
