#include "study/judge.h"

#include <math.h>

/* A level is wrong where one pixel in so many is visibly off. */
#define PIXELS_A_WRONG_ONE 10000
/* Ratios are told to two digits: a quartile that reads 1.00 is 1. */
#define RATIO_MARGIN 0.005
/* Quartiles of a ratio may be that far apart, as a part of it. */
#define RATIO_WIDTH 0.10
/* What other programs take slows one level more than another, and evenly, so that no quartile tells
 * of it: caches that they fill, cores that two threads share, threads of one picture that begin and
 * end apart. */
#define HELD_MOST 0.05
/* The time of a ray may fall or rise by so much from one count of samples to the next. */
#define GROWTH_FALL 0.5
#define GROWTH_RISE 3.0

bool rt_study_is_off(const rt_study *study, size_t sample_index, size_t entry_index)
{
    const size_t pixels = (size_t)study->width * (size_t)study->height;
    return rt_study_cell_at(study, sample_index, entry_index)->visible * PIXELS_A_WRONG_ONE >
           pixels;
}

size_t rt_study_worst_count(const rt_study *study, size_t entry_index)
{
    for (size_t i = study->plan.sample_count; i > 0; --i)
        if (rt_study_is_off(study, i - 1, entry_index))
            return i - 1;
    return study->plan.sample_count;
}

bool rt_study_is_wrong(const rt_study *study, size_t entry_index)
{
    return rt_study_worst_count(study, entry_index) < study->plan.sample_count;
}

bool rt_study_level_is_wrong(const rt_study *study, enum rt_accuracy level)
{
    for (size_t i = 0; i < study->entry_count; ++i)
        if (study->entries[i].level == level && rt_study_is_wrong(study, i))
            return true;
    return false;
}

bool rt_study_is_narrow(const rt_spread *ratio)
{
    return ratio->high - ratio->low <= RATIO_WIDTH * ratio->median;
}

bool rt_study_is_free(const rt_spread *ratio)
{
    return (ratio->low < 1.0 + RATIO_MARGIN && ratio->high > 1.0 - RATIO_MARGIN) ||
           fabs(ratio->median - 1.0) < ratio->high - ratio->low;
}

/* Whether from a count to the next one the time grows as the rays do. */
static bool grows(const rt_study *study, size_t sample_index, size_t entry_index)
{
    const rt_study_cell *before = rt_study_cell_at(study, sample_index - 1, entry_index);
    const rt_study_cell *after = rt_study_cell_at(study, sample_index, entry_index);
    const double work = (double)after->rays / (double)before->rays;
    const double growth = after->kernel.median / before->kernel.median / work;
    return growth > GROWTH_FALL && growth < GROWTH_RISE;
}

rt_study_doubt rt_study_doubt_of(const rt_study *study, size_t device)
{
    const size_t last = study->plan.sample_count - 1;
    if (study->rounds[last] < RT_STUDY_ROUNDS_LEAST)
        return (rt_study_doubt){RT_DOUBT_FEW, 0, last};
    if (study->devices[device].held > HELD_MOST)
        return (rt_study_doubt){RT_DOUBT_BUSY, 0, last};
    for (size_t i = 0; i < study->entry_count; ++i) {
        if (study->entries[i].device != device)
            continue;
        for (size_t k = 1; k <= last; ++k)
            if (!grows(study, k, i))
                return (rt_study_doubt){RT_DOUBT_NO_GROWTH, i, k};
        if (!rt_study_is_narrow(&rt_study_cell_at(study, last, i)->ratio))
            return (rt_study_doubt){RT_DOUBT_UNEVEN, i, last};
    }
    return (rt_study_doubt){RT_DOUBT_NONE, 0, last};
}

size_t rt_study_recommended(const rt_study *study, size_t device)
{
    const size_t last = study->plan.sample_count - 1, none = study->entry_count;
    const bool has_times = rt_study_doubt_of(study, device).kind == RT_DOUBT_NONE;
    size_t best = none;
    for (size_t i = 0; i < study->entry_count; ++i)
        if (study->entries[i].device == device && !rt_study_is_wrong(study, i) &&
            (best == none || (has_times && rt_study_cell_at(study, last, i)->ratio.median <
                                               rt_study_cell_at(study, last, best)->ratio.median)))
            best = i;
    size_t taken = best;
    for (size_t i = 0; has_times && best != none && i < study->entry_count; ++i)
        if (study->entries[i].device == device &&
            study->entries[i].level > study->entries[best].level && !rt_study_is_wrong(study, i) &&
            rt_study_cell_at(study, last, i)->ratio.low <=
                rt_study_cell_at(study, last, best)->ratio.high)
            taken = i;
    return taken;
}

static void mark_dominated(rt_study *study)
{
    rt_study_point points[RT_STUDY_SAMPLES_LISTED * RT_ACCURACY_COUNT];
    rt_study_cell *cells[RT_STUDY_SAMPLES_LISTED * RT_ACCURACY_COUNT];
    for (size_t device = 0; device < study->device_count; ++device) {
        size_t count = 0;
        for (size_t i = 0; i < study->plan.sample_count; ++i) {
            const size_t first = count;
            for (size_t k = 0; k < study->entry_count; ++k)
                if (study->entries[k].device == device)
                    cells[count++] = rt_study_cell_at(study, i, k);
            /* More samples do not make arithmetic better: a level competes at its own count. */
            for (size_t k = first; k < count; ++k)
                points[k] = (rt_study_point){cells[k]->kernel, cells[k]->arithmetic.rms};
            for (size_t k = first; k < count; ++k)
                cells[k]->arithmetic_is_dominated =
                    rt_study_is_dominated(points + first, count - first, k - first);
        }
        for (size_t k = 0; k < count; ++k)
            points[k] = (rt_study_point){cells[k]->kernel, cells[k]->seen.rms};
        for (size_t k = 0; k < count; ++k)
            cells[k]->seen_is_dominated = rt_study_is_dominated(points, count, k);
    }
}

/* The least accurate level beside the one to take; where these are the same, or there is none to
 * take, beside the most accurate one; and a single one beside the reference. */
static void choose_shown(rt_study *study)
{
    size_t first = study->entry_count, last = first;
    for (size_t i = 0; i < study->entry_count; ++i)
        if (study->entries[i].device == 0) {
            first = first == study->entry_count ? i : first;
            last = i;
        }
    const size_t taken = rt_study_recommended(study, 0);
    const size_t other = taken == study->entry_count || taken == first ? last : taken;
    study->shown[0] = study->entries[first].level;
    study->shown[1] = other == first ? RT_ACCURACY_COUNT : study->entries[other].level;
}

void rt_study_conclude(rt_study *study)
{
    mark_dominated(study);
    choose_shown(study);
}
