#include "study/report_tables.h"

#include <math.h>

#include "study/judge.h"

static bool is_reference(const rt_study *study, const rt_study_entry *entry)
{
    return !study->reference_is_scalar && entry->level == study->reference_level &&
           entry->device == study->reference_device;
}

static void cell_of_ratio(const rt_study *study, size_t entry, const rt_spread *r, rt_doc *doc)
{
    if (study->entries[entry].level == study->base)
        rt_doc_cell(doc, "1");
    else if (!rt_study_is_narrow(r))
        rt_doc_cell(doc, "cannot tell (%.2f to %.2f)", r->low, r->high);
    else if (rt_study_is_free(r))
        rt_doc_cell(doc, "no measurable difference (%.2f to %.2f)", r->low, r->high);
    else
        rt_doc_cell(doc, "%.2f (%.2f to %.2f)", r->median, r->low, r->high);
}

static void picture_row(const rt_study *study, size_t sample, size_t entry, rt_doc *doc)
{
    const rt_study_cell *c = rt_study_cell_at(study, sample, entry);
    const rt_study_error *a = &c->arithmetic;
    char name[RT_STUDY_NAME_SIZE];
    rt_doc_cell(doc, "%d", study->plan.samples[sample]);
    rt_doc_cell(doc, "%s", rt_study_entry_name(study, entry, name));
    rt_doc_cell(doc, "%.4g", 1e3 * c->kernel.median);
    cell_of_ratio(study, entry, &c->ratio, doc);
    rt_doc_cell(doc, "%.3g", c->seen.rms);
    rt_doc_cell(doc, "%zu", c->seen.over_1);
    if (is_reference(study, &study->entries[entry])) {
        rt_doc_cell(doc, "the reference");
        for (int i = 0; i < 3; ++i)
            rt_doc_cell(doc, " ");
    } else {
        rt_doc_cell(doc, "%zu", c->visible);
        rt_doc_cell(doc, "%.2g", a->rms);
        rt_doc_cell(doc, "%zu, %zu, %zu", a->over_0, a->over_1, a->over_8);
        rt_doc_cell(doc, "%d", a->max_step);
    }
    rt_doc_row_end(doc);
}

static void pictures(const rt_study *study, rt_doc *doc)
{
    char ratio[40];
    snprintf(ratio, sizeof ratio, "times %s", rt_accuracy_name(study->base));
    const char *const columns[] = {">samples",
                                   "level",
                                   ">kernel, ms",
                                   ratio,
                                   ">RMS to converged",
                                   ">pixels off it",
                                   ">visibly off",
                                   ">RMS of arithmetic",
                                   ">off by > 0, 1, 8 steps",
                                   ">worst, steps",
                                   NULL};
    rt_doc_heading(doc, "Pictures");
    rt_doc_paragraph(doc,
                     "A file of 8 bits has 256 steps from black to full. Errors are in such steps: "
                     "to the converged reference, which is what a viewer sees; and, from \"visibly "
                     "off\" on, to the reference at as many samples, which is arithmetic alone.");
    rt_doc_table_begin(doc, columns);
    for (size_t i = 0; i < study->plan.sample_count; ++i) {
        const rt_study_error *e = &study->sampling[i];
        for (size_t k = 0; k < study->entry_count; ++k)
            picture_row(study, i, k, doc);
        rt_doc_cell(doc, "%d", study->plan.samples[i]);
        rt_doc_cell(doc, "the reference");
        for (int k = 0; k < 2; ++k)
            rt_doc_cell(doc, " ");
        rt_doc_cell(doc, "%.3g", e->rms);
        rt_doc_cell(doc, "%zu", e->over_1);
        for (int k = 0; k < 4; ++k)
            rt_doc_cell(doc, " ");
        rt_doc_row_end(doc);
    }
    rt_doc_table_end(doc);
}

static void cell_of_million(size_t count, size_t of, rt_doc *doc)
{
    if (of == 0)
        rt_doc_cell(doc, "-");
    else
        rt_doc_cell(doc, "%.3g", 1e6 * (double)count / (double)of);
}

static void cell_of_ulp(double ulp, rt_doc *doc)
{
    if (isnan(ulp))
        rt_doc_cell(doc, "-");
    else
        rt_doc_cell(doc, "%.0f", ulp);
}

static void rays(const rt_study *study, rt_doc *doc)
{
    const bool has_edges = study->edges == RT_EDGES_TRACED;
    const char *const columns[] = {"level",
                                   ">other primitive, per M rays",
                                   ">t off, ulp: median",
                                   ">99 %",
                                   ">worst",
                                   ">self-hits, per M next rays",
                                   has_edges ? ">leaks, per M rays at edges" : NULL,
                                   ">double hits",
                                   NULL};
    rt_doc_heading(doc, "The same rays");
    rt_doc_table_begin(doc, columns);
    for (size_t i = 0; i < study->entry_count; ++i) {
        const rt_study_entry *e = &study->entries[i];
        char name[RT_STUDY_NAME_SIZE];
        rt_doc_cell(doc, "%s", rt_study_entry_name(study, i, name));
        cell_of_million(e->disagreements, e->rays, doc);
        cell_of_ulp(e->t_p50, doc);
        cell_of_ulp(e->t_p99, doc);
        cell_of_ulp(e->t_max, doc);
        cell_of_million(e->self_hits, e->next_rays, doc);
        if (has_edges) {
            cell_of_million(e->leaks, e->edge_rays, doc);
            cell_of_million(e->double_hits, e->edge_rays, doc);
        }
        rt_doc_row_end(doc);
    }
    rt_doc_table_end(doc);
}

static void times(const rt_study *study, rt_doc *doc)
{
    static const char *const columns[] = {">samples",
                                          "level",
                                          ">program, ms",
                                          ">upload, ms",
                                          ">kernel, ms: quartiles",
                                          ">rounds",
                                          ">read-back, ms",
                                          ">wall, ms: quartiles",
                                          ">rays",
                                          NULL};
    rt_doc_heading(doc, "Times");
    rt_doc_table_begin(doc, columns);
    for (size_t i = 0; i < study->plan.sample_count; ++i)
        for (size_t k = 0; k < study->entry_count; ++k) {
            const rt_study_cell *c = rt_study_cell_at(study, i, k);
            char name[RT_STUDY_NAME_SIZE];
            rt_doc_cell(doc, "%d", study->plan.samples[i]);
            rt_doc_cell(doc, "%s", rt_study_entry_name(study, k, name));
            rt_doc_cell(doc, "%.3g", 1e3 * c->program);
            rt_doc_cell(doc, "%.3g", 1e3 * c->upload);
            rt_doc_cell(doc, "%.4g to %.4g", 1e3 * c->kernel.low, 1e3 * c->kernel.high);
            rt_doc_cell(doc, "%d", study->rounds[i]);
            rt_doc_cell(doc, "%.3g", 1e3 * c->readback.median);
            rt_doc_cell(doc, "%.4g to %.4g", 1e3 * c->wall.low, 1e3 * c->wall.high);
            rt_doc_cell(doc, "%zu", c->rays);
            rt_doc_row_end(doc);
        }
    rt_doc_table_end(doc);
}

void rt_report_tables(const rt_study *study, rt_doc *doc)
{
    pictures(study, doc);
    rays(study, doc);
    times(study, doc);
}
