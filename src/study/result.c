#include "study/result.h"

#include <stdlib.h>

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

size_t rt_study_base_index(const rt_study *study)
{
    size_t i = 0;
    while (study->levels[i].level != study->base)
        ++i;
    return i;
}
