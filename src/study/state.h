/* A study from inside: what its files share while it runs. */
#ifndef RT_STUDY_STATE_H
#define RT_STUDY_STATE_H

#include <stdint.h>

#include "common/watch.h"
#include "reference/scalar.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "study/forecast.h"
#include "study/result.h"

typedef struct study_state {
    rt_study *study;
    const rt_scene *scene;
    const rt_study_how *how;
    const rt_watch *watch;
    rt_status *status;
    rt_scalar_tree *tree; /* owned: the reference's, of the scene, or NULL */
    rt_forecast forecast;
} study_state;

/* Begins a part of the work that is planned. */
void rt_study_begin_part(study_state *s, enum rt_work kind, double amount);
/* Tells how far the part is, 0 to 1; false, with code RT_INTERRUPTED, when it is to stop. */
bool rt_study_tick(study_state *s, double done);
/* The same as a watch, and as one of work that is no part's measure. */
rt_watch rt_study_watch(study_state *s);
rt_watch rt_study_watch_still(study_state *s);

/* A renderer of `scene`, by its tree or NULL, on the study's device of that index. */
rt_renderer *rt_study_renderer(study_state *s, const rt_scene *scene, const rt_bvh *bvh,
                               size_t device, enum rt_accuracy level, int samples);

/* One renderer an entry, in order, of the scene studied; the rest of the array, which has
 * RT_STUDY_ENTRIES_MOST, is NULL. To be freed after a failure too. */
bool rt_study_make_renderers(study_state *s, int samples, rt_renderer **renderers);
/* Leaves NULL everywhere, so that it may be called again. */
void rt_study_free_renderers(rt_renderer **renderers);

/* A number in [0, 1) that depends on its arguments alone (Wellons' lowbias32). */
static inline double rt_study_random(uint32_t index, uint32_t stream)
{
    uint32_t x = index * 8u + stream + 1u;
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x * 0x1p-32;
}

#endif
