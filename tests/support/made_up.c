#define _GNU_SOURCE
#include "support/made_up.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/judge.h"
#include "support/support.h"

static rt_spread about(double value)
{
    return (rt_spread){0.99 * value, value, 1.01 * value};
}

static void make_up_cell(rt_study *study, size_t sample, size_t entry)
{
    const rt_study_entry *e = &study->entries[entry];
    const double ratio = e->level == RT_ACCURACY_ROBUST ? 1.5 : 1.0;
    const double slower = (double)(1u << e->device);
    const int samples = study->plan.samples[sample];
    *rt_study_cell_at(study, sample, entry) = (rt_study_cell){
        .kernel = about(1e-3 * samples * ratio * slower),
        .readback = about(1e-4),
        .wall = about(2e-3 * samples * ratio * slower),
        .ratio = e->level == study->base ? (rt_spread){1.0, 1.0, 1.0} : about(ratio),
        .ratio_to_first = about(slower),
        .rays = (size_t)(10000 * samples),
        .seen = {.over_1 = 1000, .max_step = 9, .rms = 4.0 / (double)(1 + sample)},
        .arithmetic = {.rms = e->level == RT_ACCURACY_ROBUST ? 0.0 : 0.01}};
}

void test_make_up_study(rt_study *study, size_t devices)
{
    rt_status status = RT_STATUS_INIT;
    *study = (rt_study){.scene = strdup("made, up.txt"),
                        .width = 100,
                        .height = 100,
                        .plan = {{false, true, true, false}, {1, 4, 16}, 3, 9},
                        .base = RT_ACCURACY_STANDARD,
                        .reference_is_scalar = true,
                        .reference_level = RT_ACCURACY_DOUBLE,
                        .reference_seconds = 0.5,
                        .converged_samples = 64,
                        .rounds = {9, 9, 9},
                        .edges = RT_EDGES_NO_TRIANGLES,
                        .devices = calloc(devices, sizeof(rt_study_device)),
                        .device_count = devices};
    assert_true(study->scene && study->devices);
    for (size_t d = 0; d < devices; ++d) {
        study->devices[d] = (rt_study_device){
            .name = strdup("a \"device\""), .platform = strdup("platform"), .driver = strdup("1")};
        for (int i = 0; i < 2; ++i)
            study->entries[study->entry_count++] =
                (rt_study_entry){.device = d,
                                 .level = i ? RT_ACCURACY_ROBUST : RT_ACCURACY_STANDARD,
                                 .rays = 10000,
                                 .hits = 5000,
                                 .t_p50 = NAN,
                                 .t_p99 = NAN,
                                 .t_max = NAN};
    }
    assert_good(rt_study_make_cells(study, &status), &status);
    for (size_t i = 0; i < study->plan.sample_count; ++i) {
        study->sampling[i] = (rt_study_error){.over_1 = 1000, .rms = 4.0};
        for (size_t k = 0; k < study->entry_count; ++k)
            make_up_cell(study, i, k);
    }
    rt_study_conclude(study);
}

rt_study_cell *test_cell(const rt_study *study, enum rt_accuracy level, size_t sample_index)
{
    return rt_study_cell_at(study, sample_index, rt_study_find(study, 0, level));
}
