/* The parts of a study, which study.c puts together; none knows another. */
#ifndef RT_STUDY_PARTS_H
#define RT_STUDY_PARTS_H

#include "image/image.h"
#include "study/state.h"

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

/* What one picture took. */
typedef struct study_taken {
    double kernel, readback, wall;
    size_t rays;
} study_taken;

/* pictures.c: one picture, and what it took. */
bool rt_study_draw(study_state *s, rt_renderer *renderer, rt_image *image, const rt_watch *watch,
                   study_taken *taken);

/* The pictures of a study that are alive at a time. */
typedef struct study_pictures {
    rt_image converged, reference, base, level;
} study_pictures;

/* Fills in the cells of all levels at one count of samples, whose references are drawn. `seconds`
 * is what one picture of each level takes together. */
bool rt_study_measure_pictures(study_state *s, size_t sample_index, study_pictures *pictures,
                               double seconds);

#endif
