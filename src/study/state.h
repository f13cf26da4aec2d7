/* A study from inside: what its files share while it runs. */
#ifndef RT_STUDY_STATE_H
#define RT_STUDY_STATE_H

#include "study/study.h"

typedef struct study_state {
    rt_study *study;
    const rt_scene *scene;
    const rt_study_how *how;
    const rt_watch *watch;
    rt_status *status;
    /* Progress, in seconds as they were reckoned: of all parts, of those done, of this one. */
    double all, done, part;
} study_state;

/* Begins a part of the work that is reckoned to take so many seconds, after the part before. */
void rt_study_begin_part(study_state *s, double seconds);
/* Tells how far the part is, 0 to 1; false, with code RT_INTERRUPTED, when it is to stop. */
bool rt_study_tick(study_state *s, double done);
/* The same as a watch. */
rt_watch rt_study_watch(study_state *s);

bool rt_study_device_has(const rt_device *device, enum rt_accuracy level);

/* A renderer of `scene` at that level and count of samples. */
rt_renderer *rt_study_renderer(study_state *s, const rt_scene *scene, enum rt_accuracy level,
                               int samples);

/* reference.c: finds out what the scalar path takes and decides what the pictures' reference
 * is, and at how many samples it counts as converged. `device_seconds` is what one sample a pixel
 * takes on the device at study->reference_level. */
bool rt_study_choose_reference(study_state *s, double device_seconds);
/* Seconds that the reference will take at so many samples. */
double rt_study_reference_seconds(const study_state *s, int samples, double device_seconds);
bool rt_study_draw_reference(study_state *s, int samples, rt_image *image);

/* rays.c: the same rays through every level, and next rays from what they hit. The renderers,
 * one a level of the plan, are at one sample a pixel. */
bool rt_study_trace_rays(study_state *s, rt_renderer *const *renderers);

/* edges.c: rays from inside of a closed mesh at its edges. Where there is none, or one cannot
 * get into it, study->no_edges says so and nothing else happens. */
bool rt_study_trace_edges(study_state *s);

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
