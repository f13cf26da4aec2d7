/* The pictures of a study: every entry at one count of samples, held against the reference and
 * timed. */
#include "study/parts.h"

/* The untimed first pictures, what is wrong with them, and how many make a repeat. */
static bool compare(study_state *s, size_t sample_index, rt_renderer *const *renderers,
                    study_pictures *p, rt_study_strip *strip, size_t *pictures)
{
    rt_study *study = s->study;
    const rt_watch watch = rt_study_watch(s);
    const bool is_finest = sample_index + 1 == study->plan.sample_count;
    for (size_t i = 0; i < study->entry_count; ++i) {
        rt_study_cell *cell = rt_study_cell_at(study, sample_index, i);
        study_taken one;
        if (!rt_study_draw(s, i, renderers[i], &p->level, &watch, &one) ||
            (is_finest && !rt_study_strip_keep(strip, study, i, &p->level, s->status)))
            return false;
        pictures[i] = rt_study_pictures_a_repeat(one.kernel);
        cell->rays = one.rays;
        cell->arithmetic = rt_study_error_of(&p->level, &p->reference);
        cell->seen = rt_study_error_of(&p->level, &p->converged);
        cell->visible = rt_study_count_visible(&p->level, &p->reference, p->noise);
    }
    return true;
}

bool rt_study_measure_pictures(study_state *s, size_t sample_index, study_pictures *p,
                               rt_study_strip *strip)
{
    rt_study *study = s->study;
    const int samples = study->plan.samples[sample_index];
    rt_renderer *renderers[RT_STUDY_ENTRIES_MOST];
    size_t pictures[RT_STUDY_ENTRIES_MOST] = {0};
    bool good = rt_study_make_renderers(s, samples, renderers);
    for (size_t i = 0; good && i < study->entry_count; ++i) {
        rt_study_cell *cell = rt_study_cell_at(study, sample_index, i);
        cell->program = rt_renderer_times(renderers[i])->program;
        cell->upload = rt_renderer_times(renderers[i])->upload;
    }
    rt_study_begin_part(s, RT_WORK_PICTURES, samples);
    good = good && compare(s, sample_index, renderers, p, strip, pictures);
    good = good && rt_study_time(s, sample_index, renderers, &p->level, pictures);
    rt_study_free_renderers(renderers);
    return good;
}
