#include "study/result.h"

#include <stdio.h>
#include <stdlib.h>

void rt_study_clear(rt_study *study)
{
    for (size_t i = 0; i < study->device_count; ++i) {
        free(study->devices[i].name);
        free(study->devices[i].platform);
        free(study->devices[i].driver);
    }
    free(study->devices);
    free(study->scene);
    free(study->cells);
    *study = (rt_study){0};
}

const char *rt_study_no_edges(enum rt_study_edges edges)
{
    static const char *const reasons[RT_EDGES_COUNT] = {
        [RT_EDGES_NO_TRIANGLES] = "the scene has no triangles",
        [RT_EDGES_NOT_CLOSED] = "no mesh of the scene is closed: each has edges that not exactly "
                                "two triangles share",
        [RT_EDGES_NO_WAY_IN] = "no way into the closed mesh was found"};
    return reasons[edges];
}

size_t rt_study_cell_count(const rt_study *study)
{
    return study->plan.sample_count * study->entry_count;
}

bool rt_study_make_cells(rt_study *study, rt_status *status)
{
    study->cells = calloc(rt_study_cell_count(study) + 1, sizeof *study->cells);
    return study->cells || rt_status_no_memory(status, "the study");
}

rt_study_cell *rt_study_cell_at(const rt_study *study, size_t sample_index, size_t entry_index)
{
    return &study->cells[sample_index * study->entry_count + entry_index];
}

size_t rt_study_find(const rt_study *study, size_t device, enum rt_accuracy level)
{
    size_t i = 0;
    while (i < study->entry_count &&
           (study->entries[i].device != device || study->entries[i].level != level))
        ++i;
    return i;
}

size_t rt_study_base_of(const rt_study *study, size_t entry_index)
{
    return rt_study_find(study, study->entries[entry_index].device, study->base);
}

const char *rt_study_entry_name(const rt_study *study, size_t entry_index,
                                char text[RT_STUDY_NAME_SIZE])
{
    const rt_study_entry *entry = &study->entries[entry_index];
    const char *level = rt_accuracy_name(entry->level);
    if (study->device_count > 1)
        snprintf(text, RT_STUDY_NAME_SIZE, "%s, device %zu", level, entry->device);
    else
        snprintf(text, RT_STUDY_NAME_SIZE, "%s", level);
    return text;
}
