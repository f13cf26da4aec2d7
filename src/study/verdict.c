#include "study/verdict.h"

#include <math.h>

/* Ratios from here on are told as "times", smaller ones in per cent. */
#define TIMES_FROM 1.95

static size_t last_of(const rt_study *study)
{
    return study->plan.sample_count - 1;
}

static bool has_level(const rt_study *study, enum rt_accuracy level)
{
    for (size_t i = 0; i < study->entry_count; ++i)
        if (study->entries[i].level == level)
            return true;
    return false;
}

/* "fast and standard": the levels that are wrong on some device, or those that are not. Returns how
 * many; NULL only counts. */
static int list_levels(const rt_study *study, bool wrong, FILE *out)
{
    int count = 0, left = 0;
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i)
        count += has_level(study, (enum rt_accuracy)i) &&
                 rt_study_level_is_wrong(study, (enum rt_accuracy)i) == wrong;
    left = count;
    for (int i = 0; out && i < RT_ACCURACY_COUNT; ++i)
        if (has_level(study, (enum rt_accuracy)i) &&
            rt_study_level_is_wrong(study, (enum rt_accuracy)i) == wrong) {
            --left;
            fprintf(out, "%s%s", rt_accuracy_name((enum rt_accuracy)i),
                    left > 1 ? ", "
                    : left   ? " and "
                             : "");
        }
    return count;
}

static const char *doubt_in_short(enum rt_doubt kind)
{
    static const char *const texts[] = {[RT_DOUBT_NONE] = "",
                                        [RT_DOUBT_FEW] = "too few repeats",
                                        [RT_DOUBT_BUSY] = "other programs kept the machine busy",
                                        [RT_DOUBT_NO_GROWTH] =
                                            "the times do not grow with the work",
                                        [RT_DOUBT_UNEVEN] = "the times are too uneven"};
    return texts[kind];
}

/* "fast and standard are visibly wrong". */
static void say_wrong_levels(const rt_study *study, FILE *out)
{
    const int wrong = list_levels(study, true, out);
    fprintf(out, " %s visibly wrong", wrong > 1 ? "are" : "is");
}

static void say_headline_in_doubt(const rt_study *study, enum rt_doubt doubt, FILE *out)
{
    fprintf(out, "Cannot tell what the levels cost: %s. ", doubt_in_short(doubt));
    if (list_levels(study, true, NULL) == 0) {
        fputs("None of them is visibly wrong.", out);
        return;
    }
    fputs("Visibly wrong: ", out);
    if (list_levels(study, true, out) > 0 && list_levels(study, false, NULL) > 0) {
        fputs("; right: ", out);
        list_levels(study, false, out);
    }
    fputc('.', out);
}

/* What the level to take costs, where it is not the one that times are held against. */
static void say_cost_of_taken(const rt_study *study, size_t taken, FILE *out)
{
    if (study->entries[taken].level == study->base)
        return;
    if (rt_study_is_free(&rt_study_cell_at(study, last_of(study), taken)->ratio)) {
        fprintf(out, " It takes no measurably longer than %s.", rt_accuracy_name(study->base));
        return;
    }
    fputs(" It takes ", out);
    rt_study_say_cost(study, taken, out);
    fputc('.', out);
}

void rt_study_say_headline(const rt_study *study, FILE *out)
{
    const int wrong = list_levels(study, true, NULL), right = list_levels(study, false, NULL);
    const enum rt_doubt doubt = rt_study_doubt_of(study, 0).kind;
    const size_t taken = rt_study_recommended(study, 0);
    if (wrong + right > 1 && doubt != RT_DOUBT_NONE) {
        say_headline_in_doubt(study, doubt, out);
    } else if (taken == study->entry_count) {
        say_wrong_levels(study, out);
        fputs(", and no other was studied.", out);
    } else if (wrong + right == 1) {
        fprintf(out, "Nothing is wrong at %s that you could see.",
                rt_accuracy_name(study->entries[taken].level));
    } else {
        fprintf(out, "Take %s: ", rt_accuracy_name(study->entries[taken].level));
        if (wrong > 0)
            say_wrong_levels(study, out);
        else
            fputs("you cannot see a difference between the levels, and none takes measurably less "
                  "time",
                  out);
        fputc('.', out);
        say_cost_of_taken(study, taken, out);
    }
}

static bool names_a_level(const rt_study *study, size_t device)
{
    return study->entry_count > 1 && rt_study_recommended(study, device) < study->entry_count &&
           rt_study_doubt_of(study, device).kind == RT_DOUBT_NONE;
}

void rt_study_say_how(const rt_study *study, size_t device, FILE *out)
{
    const size_t taken = rt_study_recommended(study, device);
    if (!names_a_level(study, device))
        return;
    const enum rt_accuracy level = study->entries[taken].level;
    const char *name = rt_accuracy_name(level);
    fprintf(out, "To take it: --accuracy %s, or 'accuracy %s' in the scene%s.", name, name,
            level == RT_ACCURACY_DEFAULT ? "; where neither names a level, it is this one" : "");
}

void rt_study_say_doubt(const rt_study *study, size_t device, FILE *out)
{
    const rt_study_doubt d = rt_study_doubt_of(study, device);
    const rt_study_cell *cell = rt_study_cell_at(study, d.sample_index, d.entry);
    char name[RT_STUDY_NAME_SIZE];
    rt_study_entry_name(study, d.entry, name);
    switch (d.kind) {
    case RT_DOUBT_NONE:
        return;
    case RT_DOUBT_FEW:
        fprintf(out, "Each picture was timed %d time%s; to tell times apart takes at least %d.",
                study->rounds[d.sample_index], study->rounds[d.sample_index] > 1 ? "s" : "",
                RT_STUDY_ROUNDS_LEAST);
        return;
    case RT_DOUBT_BUSY:
        fprintf(out,
                "Other programs held the processors for %.0f %% of the time that rt could "
                "have used them.",
                100.0 * study->devices[device].held);
        break;
    case RT_DOUBT_NO_GROWTH:
        fprintf(
            out,
            "At %s, %d samples a pixel took %.1f times the time of %d, for %.1f times the rays.",
            name, study->plan.samples[d.sample_index],
            cell->kernel.median /
                rt_study_cell_at(study, d.sample_index - 1, d.entry)->kernel.median,
            study->plan.samples[d.sample_index - 1],
            (double)cell->rays /
                (double)rt_study_cell_at(study, d.sample_index - 1, d.entry)->rays);
        break;
    case RT_DOUBT_UNEVEN:
        fprintf(out,
                "After %d rounds the time of %s is still between %.2f and %.2f of that of %s in "
                "half of them, and beyond in the others.",
                study->rounds[d.sample_index], name, cell->ratio.low, cell->ratio.high,
                rt_accuracy_name(study->base));
        break;
    }
    fputs(" Try again when nothing else runs.", out);
}

/* At which counts of samples an entry is off. */
static void say_where(const rt_study *study, size_t entry_index, FILE *out)
{
    const size_t count = study->plan.sample_count;
    size_t off = 0, left = 0;
    for (size_t i = 0; i < count; ++i)
        off += rt_study_is_off(study, i, entry_index);
    if (off == count) {
        fputs(count > 1 ? " at every count of samples" : "", out);
        return;
    }
    left = off;
    fputs(" at ", out);
    for (size_t i = 0; i < count; ++i)
        if (rt_study_is_off(study, i, entry_index)) {
            --left;
            fprintf(out, "%d%s", study->plan.samples[i], left > 1 ? ", " : left ? " and " : "");
        }
    fputs(" samples a pixel", out);
}

void rt_study_say_right(const rt_study *study, size_t entry_index, FILE *out)
{
    const size_t worst = rt_study_worst_count(study, entry_index);
    if (worst == study->plan.sample_count) {
        fputs("right, as far as you can see", out);
        return;
    }
    const rt_study_cell *cell = rt_study_cell_at(study, worst, entry_index);
    const double pixels = (double)study->width * study->height;
    fputs("visibly wrong", out);
    say_where(study, entry_index, out);
    fprintf(out, " (at %d: %.2g %% of the pixels, the worst by %d steps of 256)",
            study->plan.samples[worst], 100.0 * (double)cell->visible / pixels,
            cell->arithmetic.max_step);
}

void rt_study_say_cost(const rt_study *study, size_t entry_index, FILE *out)
{
    const rt_spread *r = &rt_study_cell_at(study, last_of(study), entry_index)->ratio;
    const char *base = rt_accuracy_name(study->base);
    if (rt_study_doubt_of(study, study->entries[entry_index].device).kind != RT_DOUBT_NONE)
        fputs("cannot tell", out);
    else if (study->entries[entry_index].level == study->base)
        fputs("what times are held against", out);
    else if (rt_study_is_free(r))
        fprintf(out, "no measurable difference to the time of %s", base);
    else if (r->median >= TIMES_FROM)
        fprintf(out, "%.1f times the time of %s", r->median, base);
    else
        fprintf(out, "%.0f %% %s time than %s", 100.0 * fabs(r->median - 1.0),
                r->median > 1.0 ? "more" : "less", base);
}

void rt_study_say_briefly(const rt_study *study, size_t entry_index, FILE *out)
{
    char name[RT_STUDY_NAME_SIZE];
    fprintf(out, "%s: %s", rt_study_entry_name(study, entry_index, name),
            rt_study_is_wrong(study, entry_index) ? "visibly wrong" : "right");
    if (study->entries[entry_index].level == study->base)
        return;
    fputs(rt_study_doubt_of(study, study->entries[entry_index].device).kind != RT_DOUBT_NONE
              ? "; its time: "
              : "; ",
          out);
    rt_study_say_cost(study, entry_index, out);
}

void rt_study_say_entry(const rt_study *study, size_t entry_index, FILE *out)
{
    const rt_study_cell *cell = rt_study_cell_at(study, last_of(study), entry_index);
    const rt_study_entry *e = &study->entries[entry_index];
    char name[RT_STUDY_NAME_SIZE];
    fprintf(out, "%s: ", rt_study_entry_name(study, entry_index, name));
    rt_study_say_right(study, entry_index, out);
    if (e->leaks + e->double_hits > 0)
        fprintf(out, "; of a million rays at the edges of a closed mesh %.0f go wrong",
                1e6 * (double)(e->leaks + e->double_hits) / (double)e->edge_rays);
    if (rt_study_doubt_of(study, e->device).kind != RT_DOUBT_NONE) {
        fputs(". What it costs: cannot tell.", out);
        return;
    }
    fprintf(out, ". At %d sample%s a pixel a picture takes %.3g ms",
            study->plan.samples[last_of(study)], study->plan.samples[last_of(study)] > 1 ? "s" : "",
            1e3 * cell->kernel.median);
    if (e->level != study->base) {
        fputs(", ", out);
        rt_study_say_cost(study, entry_index, out);
        fprintf(out, " (quartiles of the ratio: %.2f to %.2f)", cell->ratio.low, cell->ratio.high);
    }
    fputc('.', out);
}

static void say_device(const rt_study *study, size_t device, FILE *out)
{
    fprintf(out, "device %zu (%s)", device, study->devices[device].name);
}

void rt_study_say_devices(const rt_study *study, size_t device, FILE *out)
{
    const size_t taken = rt_study_recommended(study, 0);
    const enum rt_accuracy level =
        taken == study->entry_count ? study->base : study->entries[taken].level;
    const size_t here = rt_study_find(study, device, level), first = rt_study_find(study, 0, level);
    const enum rt_doubt mine = rt_study_doubt_of(study, device).kind;
    const enum rt_doubt doubt = mine != RT_DOUBT_NONE ? mine : rt_study_doubt_of(study, 0).kind;
    if (here == study->entry_count || first == study->entry_count) {
        say_device(study, here == study->entry_count ? device : 0, out);
        fprintf(out, " does not have the level %s, so there is nothing to compare.",
                rt_accuracy_name(level));
        return;
    }
    const rt_study_cell *cell = rt_study_cell_at(study, last_of(study), here);
    const rt_spread *r = &cell->ratio_to_first;
    const bool is_free = rt_study_is_free(r), is_slower = r->median > 1.0;
    if (doubt != RT_DOUBT_NONE || !rt_study_is_narrow(r)) {
        fputs("Cannot tell which is faster, ", out);
        say_device(study, 0, out);
        fputs(" or ", out);
        say_device(study, device, out);
        fprintf(out, ": %s.", doubt_in_short(doubt != RT_DOUBT_NONE ? doubt : RT_DOUBT_UNEVEN));
        return;
    }
    say_device(study, is_slower ? 0 : device, out);
    if (is_free)
        fputs(" is as fast as ", out);
    else
        fprintf(out, " is %.3g times as fast as ", is_slower ? r->median : 1.0 / r->median);
    say_device(study, is_slower ? device : 0, out);
    fprintf(out, " at %s: %.3g ms a picture to %.3g ms.", rt_accuracy_name(level),
            1e3 * rt_study_cell_at(study, last_of(study), is_slower ? first : here)->kernel.median,
            1e3 * rt_study_cell_at(study, last_of(study), is_slower ? here : first)->kernel.median);
}

void rt_study_say_all(const rt_study *study, FILE *out)
{
    rt_study_say_headline(study, out);
    fputs("\n\n", out);
    if (names_a_level(study, 0)) {
        rt_study_say_how(study, 0, out);
        fputs("\n\n", out);
    }
    for (size_t d = 0; d < study->device_count; ++d) {
        if (d > 0) {
            rt_study_say_devices(study, d, out);
            fputs("\n\n", out);
        }
        if (rt_study_doubt_of(study, d).kind != RT_DOUBT_NONE) {
            rt_study_say_doubt(study, d, out);
            fputs("\n\n", out);
        }
    }
    for (size_t i = 0; i < study->entry_count; ++i) {
        rt_study_say_entry(study, i, out);
        fputs(i + 1 < study->entry_count ? "\n\n" : "\n", out);
    }
}
