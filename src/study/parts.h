/* The parts of a study, which study.c puts together; none knows another. */
#ifndef RT_STUDY_PARTS_H
#define RT_STUDY_PARTS_H

#include "image/image.h"
#include "study/state.h"
#include "study/strip.h"

/* reference.c: finds out what the scalar path takes and decides what the pictures' reference
 * is, and at how many samples it counts as converged. `device_seconds` is what one sample a pixel
 * takes at study->reference_level. From then on the forecast knows what a sample takes. */
bool rt_study_choose_reference(study_state *s, double device_seconds);
bool rt_study_draw_reference(study_state *s, int samples, rt_image *image);

/* rays.c: the same rays through every entry, and next rays from what they hit. */
bool rt_study_trace_rays(study_state *s, rt_renderer *const *renderers);

/* edges.c: rays from inside of a closed mesh at its edges. Where there is none, or one cannot
 * get into it, study->edges says so and nothing else happens. */
bool rt_study_trace_edges(study_state *s);

/* What one picture took. */
typedef struct study_taken {
    double kernel, readback, wall;
    size_t rays;
} study_taken;

/* timing.c: one picture of an entry, and what it took. */
bool rt_study_draw(study_state *s, size_t entry_index, rt_renderer *renderer, rt_image *image,
                   const rt_watch *watch, study_taken *taken);

/* How many pictures a repeat takes, where one takes so many seconds. */
size_t rt_study_pictures_a_repeat(double seconds);

/* Work that is planned beside so much of the timing, since it may have to go on. */
double rt_study_reserve(double work);

/* timing.c: times all entries at one count of samples, level by level there and back again, again
 * and again until the ratios of times are narrow or a limit is reached. A repeat of an entry is so
 * many `pictures`. Fills in the cells' times; `image` is scratch. */
bool rt_study_time(study_state *s, size_t sample_index, rt_renderer *const *renderers,
                   rt_image *image, const size_t *pictures);

/* The pictures of a study that are alive at a time. */
typedef struct study_pictures {
    rt_image converged, reference, level;
    uint8_t *noise; /* owned: of the reference; NULL before there is one */
} study_pictures;

/* pictures.c: fills in the cells of all entries at one count of samples, whose references are
 * drawn, and keeps what is shown of them. */
bool rt_study_measure_pictures(study_state *s, size_t sample_index, study_pictures *pictures,
                               rt_study_strip *strip);

#endif
