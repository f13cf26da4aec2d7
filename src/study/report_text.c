#define _GNU_SOURCE
#include "study/report_text.h"

#include <stdlib.h>

#include "study/report_tables.h"
#include "study/verdict.h"

char *rt_study_said(void (*say)(const rt_study *, size_t, FILE *), const rt_study *study, size_t i)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out) {
        say(study, i, out);
        if (fclose(out) == 0)
            return text;
    }
    free(text);
    return NULL;
}

static void headline(const rt_study *study, size_t i, FILE *out)
{
    (void)i;
    rt_study_say_headline(study, out);
}

char *rt_study_headline(const rt_study *study)
{
    return rt_study_said(headline, study, 0);
}

const char *rt_study_shown_name(const rt_study *study, int which)
{
    const enum rt_accuracy shown = study->shown[which];
    return shown == RT_ACCURACY_COUNT ? "the reference" : rt_accuracy_name(shown);
}

/* A paragraph or a cell of what is said. */
static void say_paragraph(void (*say)(const rt_study *, size_t, FILE *), const rt_study *study,
                          size_t i, rt_doc *doc)
{
    char *text = rt_study_said(say, study, i);
    if (text && *text)
        rt_doc_paragraph(doc, "%s", text);
    free(text);
}

static void say_cell(void (*say)(const rt_study *, size_t, FILE *), const rt_study *study, size_t i,
                     rt_doc *doc)
{
    char *text = rt_study_said(say, study, i);
    rt_doc_cell(doc, "%s", text ? text : "");
    free(text);
}

void rt_report_first(const rt_study *study, rt_doc *doc)
{
    static const char *const columns[] = {"level", "is its picture right?",
                                          ">milliseconds a picture", "its time", NULL};
    const int samples = study->plan.samples[study->plan.sample_count - 1];
    say_paragraph(rt_study_say_how, study, 0, doc);
    rt_doc_table_begin(doc, columns);
    for (size_t i = 0; i < study->entry_count; ++i) {
        char name[RT_STUDY_NAME_SIZE];
        const rt_study_cell *cell = rt_study_cell_at(study, study->plan.sample_count - 1, i);
        rt_doc_cell(doc, "%s", rt_study_entry_name(study, i, name));
        say_cell(rt_study_say_right, study, i, doc);
        if (rt_study_doubt_of(study, study->entries[i].device).kind == RT_DOUBT_NONE)
            rt_doc_cell(doc, "%.3g", 1e3 * cell->kernel.median);
        else
            rt_doc_cell(doc, "-");
        say_cell(rt_study_say_cost, study, i, doc);
        rt_doc_row_end(doc);
    }
    rt_doc_table_end(doc);
    for (size_t d = 0; d < study->device_count; ++d) {
        if (d > 0)
            say_paragraph(rt_study_say_devices, study, d, doc);
        say_paragraph(rt_study_say_doubt, study, d, doc);
    }
    for (size_t d = 0; d < study->device_count; ++d) {
        const rt_study_device *device = &study->devices[d];
        char number[40] = "";
        if (study->device_count > 1)
            snprintf(number, sizeof number, "Device %zu: ", d);
        rt_doc_paragraph(doc, "%s%s (%s %s), %dx%d pixels, %d sample%s a pixel.", number,
                         device->name, device->platform, device->driver, study->width,
                         study->height, samples, samples > 1 ? "s" : "");
        for (int i = 0; i < RT_ACCURACY_COUNT; ++i)
            if (device->lacks[i])
                rt_doc_paragraph(doc, "This device does not have the level %s.",
                                 rt_accuracy_name((enum rt_accuracy)i));
    }
}

static size_t non_finite(const rt_study *study)
{
    size_t sum = 0;
    for (size_t i = 0; i < rt_study_cell_count(study); ++i)
        sum += study->cells[i].seen.non_finite;
    return sum;
}

static void note_reference(const rt_study *study, rt_doc *doc)
{
    if (study->reference_is_scalar)
        rt_doc_item(doc,
                    "The reference of the pictures is the scalar path in double, at %d samples a "
                    "pixel where it counts as converged.",
                    study->converged_samples);
    else
        rt_doc_item(doc,
                    "The scalar path in double would take %.3g s for one sample a pixel, so the "
                    "reference of the pictures is %s at %s, at %d samples a pixel where it counts "
                    "as converged. Its rays are held against the scalar path above.",
                    study->reference_seconds, study->devices[study->reference_device].name,
                    rt_accuracy_name(study->reference_level), study->converged_samples);
}

static void note_rays(const rt_study *study, rt_doc *doc)
{
    const rt_study_entry *e = &study->entries[0];
    const size_t pixels = (size_t)study->width * (size_t)study->height;
    rt_doc_item(
        doc,
        "Same rays: %zu primary rays in fp32, %s, against the scalar path in double; %zu of "
        "them hit. Next rays are handed to each level as fp32 rays too.",
        e->rays, e->rays == pixels ? "one a pixel" : "evenly spread over the picture", e->hits);
    if (study->edges == RT_EDGES_TRACED)
        rt_doc_item(doc,
                    "Leaks and double hits: %zu rays from inside the largest closed mesh (%zu "
                    "triangles) at its edges.",
                    e->edge_rays, study->edge_triangles);
    else
        rt_doc_item(doc, "Leaks and double hits: not applicable, %s.",
                    rt_study_no_edges(study->edges));
}

static void note_times(const rt_study *study, rt_doc *doc)
{
    rt_doc_item(
        doc,
        "Times: %d rounds after one that does not count, level by level there and back, and "
        "up to twice as many where they are uneven; medians, and quartiles where two "
        "numbers stand. Pictures of less than 25 ms are rendered several times a round. "
        "Ratios are taken round by round; where their quartiles have 1 between them, or "
        "the median is nearer to 1 than they are to each other, there is no measurable "
        "difference, and where they are more than a tenth apart, one cannot tell.",
        study->plan.repeats);
    for (size_t d = 0; d < study->device_count; ++d) {
        const rt_study_device *device = &study->devices[d];
        if (device->kernel_is_wall)
            rt_doc_item(doc, "%s has no clock: its kernel times are wall times.", device->name);
        if (device->held > 0.0)
            rt_doc_item(doc,
                        "While %s rendered, other programs held its processors for %.2g %% of the "
                        "time.",
                        device->name, 100.0 * device->held);
    }
    rt_doc_item(doc, "Building the program counts what the driver had to do: less where it keeps "
                     "programs from earlier runs.");
}

void rt_report_rest(const rt_study *study, rt_doc *doc)
{
    rt_report_tables(study, doc);
    rt_doc_heading(doc, "How it was measured");
    rt_doc_list_begin(doc);
    note_reference(study, doc);
    note_rays(study, doc);
    rt_doc_item(doc, "Pixels that are not finite: %zu.", non_finite(study));
    note_times(study, doc);
    rt_doc_item(doc, "Too few samples make noise, and noise hides errors. A pixel is visibly off "
                     "where arithmetic puts it off by more than one step, and by more than twice "
                     "what noise does in the pixels about it. A level is wrong where more than one "
                     "pixel in ten thousand is visibly off at some count of samples.");
    rt_doc_list_end(doc);
}
