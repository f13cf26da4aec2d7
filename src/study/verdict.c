#define _GNU_SOURCE
#include "study/verdict.h"

#include <stdio.h>
#include <stdlib.h>

/* A level has to change more than one pixel for so many that too few samples make wrong. */
#define HIDDEN_BY 100
/* Ratios are told to two digits: a quartile that reads 1.00 is 1. */
#define RATIO_MARGIN 0.005

void rt_study_conclude(rt_study *study)
{
    rt_study_point points[RT_STUDY_SAMPLES_LISTED * RT_ACCURACY_COUNT];
    for (size_t i = 0; i < study->cell_count; ++i)
        points[i] = (rt_study_point){study->cells[i].kernel, study->cells[i].seen.rms};
    for (size_t i = 0; i < study->cell_count; ++i)
        study->cells[i].seen_is_dominated = rt_study_is_dominated(points, study->cell_count, i);
    /* More samples do not make arithmetic better: here a level competes at its own count only. */
    for (size_t i = 0; i < study->cell_count; ++i) {
        const size_t first = i / study->level_count * study->level_count;
        for (size_t k = 0; k < study->level_count; ++k)
            points[k] = (rt_study_point){study->cells[first + k].kernel,
                                         study->cells[first + k].arithmetic.rms};
        study->cells[i].arithmetic_is_dominated =
            rt_study_is_dominated(points, study->level_count, i - first);
    }
}

static bool is_seen(const rt_study *study, size_t sample_index, size_t pixels)
{
    return pixels * HIDDEN_BY > study->sampling[sample_index].over_1;
}

bool rt_study_can_be_seen(const rt_study *study, size_t sample_index, size_t level_index)
{
    return is_seen(study, sample_index,
                   rt_study_cell_at(study, sample_index, level_index)->changed);
}

bool rt_study_errs_visibly(const rt_study *study, size_t level_index)
{
    for (size_t i = 0; i < study->plan.sample_count; ++i)
        if (is_seen(study, i, rt_study_cell_at(study, i, level_index)->arithmetic.over_1))
            return true;
    return false;
}

bool rt_study_is_free(const rt_spread *ratio)
{
    return ratio->low < 1.0 + RATIO_MARGIN && ratio->high > 1.0 - RATIO_MARGIN;
}

/* "1, 4 and 16": the counts at which the level can be seen, or those at which it cannot. */
static void list_counts(const rt_study *study, size_t level_index, bool seen, FILE *out)
{
    size_t left = 0;
    for (size_t i = 0; i < study->plan.sample_count; ++i)
        left += rt_study_can_be_seen(study, i, level_index) == seen;
    for (size_t i = 0; i < study->plan.sample_count; ++i)
        if (rt_study_can_be_seen(study, i, level_index) == seen) {
            --left;
            fprintf(out, "%d%s", study->plan.samples[i], left > 1 ? ", " : left ? " and " : "");
        }
}

/* What the level does to the picture at the finest count at which it can be seen. */
static void say_how_much(const rt_study *study, size_t level_index, FILE *out)
{
    size_t i = study->plan.sample_count - 1;
    while (!rt_study_can_be_seen(study, i, level_index))
        --i;
    const size_t base = rt_study_base_index(study);
    const rt_study_cell *cell = rt_study_cell_at(study, i, level_index);
    fprintf(
        out,
        " (at %d: %zu of %zu pixels by more than one step; arithmetic alone makes %zu pixels of "
        "%s wrong by more than one step, and %zu of %s)",
        study->plan.samples[i], cell->changed, (size_t)study->width * (size_t)study->height,
        rt_study_cell_at(study, i, base)->arithmetic.over_1, rt_accuracy_name(study->base),
        cell->arithmetic.over_1, rt_accuracy_name(cell->level));
}

/* At which counts a level can be seen: none, all, those from `turn` on, those before it, or some
 * other set. */
enum pattern { SEEN_NEVER, SEEN_ALWAYS, SEEN_FROM, SEEN_BELOW, SEEN_HERE_AND_THERE };

static enum pattern pattern_of(const rt_study *study, size_t level_index, size_t *turn)
{
    const size_t count = study->plan.sample_count;
    const bool first = rt_study_can_be_seen(study, 0, level_index);
    size_t i = 1;
    while (i < count && rt_study_can_be_seen(study, i, level_index) == first)
        ++i;
    *turn = i;
    if (i == count)
        return first ? SEEN_ALWAYS : SEEN_NEVER;
    while (i < count && rt_study_can_be_seen(study, i, level_index) != first)
        ++i;
    if (i < count)
        return SEEN_HERE_AND_THERE;
    return first ? SEEN_BELOW : SEEN_FROM;
}

static void say_what_it_buys(const rt_study *study, size_t level_index, FILE *out)
{
    const char *name = rt_accuracy_name(study->levels[level_index].level);
    const int *samples = study->plan.samples;
    const size_t count = study->plan.sample_count;
    size_t turn = 0;
    const enum pattern pattern = pattern_of(study, level_index, &turn);
    switch (pattern) {
    case SEEN_NEVER:
        fprintf(out, "%s %d sample%s a pixel, %s changes nothing that you can see on this scene",
                count > 1 ? "Up to" : "At", samples[count - 1], samples[count - 1] > 1 ? "s" : "",
                name);
        break;
    case SEEN_ALWAYS:
        fprintf(out, "At every count of samples, %s changes what you see on this scene", name);
        break;
    case SEEN_FROM:
        fprintf(out,
                "Below %d samples a pixel, %s changes nothing that you can see on this scene; from "
                "%d on it does",
                samples[turn], name, samples[turn]);
        break;
    case SEEN_BELOW:
        fprintf(out,
                "From %d samples a pixel on, %s changes nothing that you can see on this scene; "
                "below it does",
                samples[turn], name);
        break;
    case SEEN_HERE_AND_THERE:
        fputs("At ", out);
        list_counts(study, level_index, false, out);
        fprintf(out, " samples a pixel, %s changes nothing that you can see on this scene; at ",
                name);
        list_counts(study, level_index, true, out);
        fputs(" it does", out);
        break;
    }
    if (pattern != SEEN_NEVER)
        say_how_much(study, level_index, out);
    fputc('.', out);
}

/* By the finest pictures, whose times are the longest and therefore the surest. */
static void say_what_it_costs(const rt_study *study, size_t level_index, FILE *out)
{
    const rt_study_cell *cell = rt_study_cell_at(study, study->plan.sample_count - 1, level_index);
    const rt_spread *r = &cell->ratio;
    const char *base = rt_accuracy_name(study->base);
    const char *time = study->kernel_is_wall ? "time" : "kernel time";
    if (rt_study_is_free(r))
        fprintf(out,
                " Against %s it has no measurable cost: %.2f of its %s, quartiles %.2f to "
                "%.2f.",
                base, r->median, time, r->low, r->high);
    else
        fprintf(out, " It takes %.2f times the %s of %s, quartiles %.2f to %.2f.", r->median, time,
                base, r->low, r->high);
}

void rt_study_say_briefly(const rt_study *study, size_t level_index, FILE *out)
{
    const int *samples = study->plan.samples;
    const size_t last = study->plan.sample_count - 1;
    const rt_spread *r = &rt_study_cell_at(study, last, level_index)->ratio;
    const char *base = rt_accuracy_name(study->base);
    size_t turn = 0;
    fprintf(out, "%s: ", rt_accuracy_name(study->levels[level_index].level));
    if (study->levels[level_index].level == study->base) {
        fputs("what the others are held against", out);
        fputs(rt_study_errs_visibly(study, level_index) ? "; wrong where you can see it" : "", out);
        return;
    }
    switch (pattern_of(study, level_index, &turn)) {
    case SEEN_NEVER:
        fprintf(out, "changes nothing that you can see up to %d samples", samples[last]);
        break;
    case SEEN_ALWAYS:
        fputs("changes what you see at every count of samples", out);
        break;
    case SEEN_FROM:
        fprintf(out, "changes what you see from %d samples on", samples[turn]);
        break;
    case SEEN_BELOW:
        fprintf(out, "changes what you see below %d samples", samples[turn]);
        break;
    case SEEN_HERE_AND_THERE:
        fputs("changes what you see at ", out);
        list_counts(study, level_index, true, out);
        fputs(" samples", out);
        break;
    }
    if (rt_study_is_free(r))
        fputs("; no measurable cost", out);
    else
        fprintf(out, "; %.2f times the time of %s", r->median, base);
    fputs(rt_study_errs_visibly(study, level_index) ? "; wrong where you can see it" : "", out);
}

static bool levels_agree(const rt_study *study)
{
    size_t turn = 0;
    for (size_t i = 0; i < study->level_count; ++i)
        if (pattern_of(study, i, &turn) != SEEN_NEVER || rt_study_errs_visibly(study, i))
            return false;
    return study->level_count > 1;
}

/* Which levels go wrong where one can see it, and what to take in their place. */
static void say_what_is_wrong(const rt_study *study, FILE *out)
{
    const size_t last = study->plan.sample_count - 1;
    size_t wrong = 0, left = 0, best = study->level_count;
    for (size_t k = 0; k < study->level_count; ++k) {
        wrong += rt_study_errs_visibly(study, k);
        if (!rt_study_errs_visibly(study, k) &&
            (best == study->level_count || rt_study_cell_at(study, last, k)->kernel.median <
                                               rt_study_cell_at(study, last, best)->kernel.median))
            best = k;
    }
    left = wrong;
    for (size_t k = 0; k < study->level_count; ++k)
        if (rt_study_errs_visibly(study, k)) {
            --left;
            fprintf(out, "%s%s", rt_accuracy_name(study->levels[k].level),
                    left > 1 ? ", "
                    : left   ? " and "
                             : "");
        }
    if (wrong > 0)
        fprintf(out, " put%s pixels off by arithmetic where you can see it", wrong > 1 ? "" : "s");
    else
        fprintf(out, "No level studied puts pixels off by arithmetic where you could see it");
    if (best == study->level_count)
        fputs(", and no other was studied.\n", out);
    else if (study->level_count == 1)
        fputs(".\n", out);
    else
        fprintf(out, "; %s%s takes the least time.\n", wrong > 0 ? "of the others, " : "",
                rt_accuracy_name(study->levels[best].level));
}

char *rt_study_verdict(const rt_study *study)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    if (levels_agree(study))
        fputs("The levels agree: this scene has no case so hard that one could see a difference. ",
              out);
    say_what_is_wrong(study, out);
    for (size_t i = 0; i < study->level_count; ++i) {
        if (study->levels[i].level == study->base)
            continue;
        fputc('\n', out);
        say_what_it_buys(study, i, out);
        say_what_it_costs(study, i, out);
        fputc('\n', out);
    }
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}
