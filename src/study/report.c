#define _GNU_SOURCE
#include "study/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/json.h"
#include "study/plot.h"
#include "study/table.h"
#include "study/verdict.h"

static bool open_one(rt_output *output, const char *report, const char *extension,
                     rt_status *status)
{
    char *path = NULL;
    if (asprintf(&path, "%s.%s", report, extension) < 0)
        return rt_status_no_memory(status, "a path");
    const bool good = rt_output_open(output, path, status);
    free(path);
    return good;
}

bool rt_study_files_open(rt_study_files *files, const char *report, rt_status *status)
{
    *files = RT_STUDY_FILES_INIT;
    const char *slash = strrchr(report, '/');
    files->name = strdup(slash ? slash + 1 : report);
    if (!files->name)
        return rt_status_no_memory(status, "a path");
    return open_one(&files->json, report, "json", status) &&
           open_one(&files->csv, report, "csv", status) &&
           open_one(&files->md, report, "md", status) &&
           open_one(&files->svg, report, "svg", status) &&
           open_one(&files->png, report, "png", status);
}

void rt_study_files_discard(rt_study_files *files)
{
    rt_output_discard(&files->json);
    rt_output_discard(&files->csv);
    rt_output_discard(&files->md);
    rt_output_discard(&files->svg);
    rt_output_discard(&files->png);
    free(files->name);
    files->name = NULL;
}

static const char *path_of(const rt_output *output)
{
    return output->temporary ? output->temporary : output->target;
}

/* Fills svg and png; false where there is no plot, which a warning tells of. */
static bool plot(rt_study_files *files, const rt_study *study, rt_status *status)
{
    switch (rt_study_plot(study, path_of(&files->svg), path_of(&files->png))) {
    case RT_PLOT_DRAWN:
        return true;
    case RT_PLOT_NO_GNUPLOT:
        rt_status_warn(status, "rt: warning: there is no plot, because there is no gnuplot; on "
                               "Debian: apt-get install gnuplot-nox");
        break;
    case RT_PLOT_FAILED:
        rt_status_warn(status, "rt: warning: there is no plot, because gnuplot failed");
        break;
    }
    return false;
}

bool rt_study_files_write(rt_study_files *files, const rt_study *study, const rt_watch *watch,
                          rt_status *status)
{
    char *picture = NULL;
    const bool has_plot = plot(files, study, status);
    if (!rt_watch_tick(watch, 1.0))
        return rt_status_fail(status, RT_INTERRUPTED, "rt: interrupted");
    if (has_plot && asprintf(&picture, "%s.svg", files->name) < 0)
        return rt_status_no_memory(status, "a path");
    const bool good = rt_study_write_json(study, &files->json, status) &&
                      rt_study_write_csv(study, &files->csv, status) &&
                      rt_study_write_md(study, picture, &files->md, status) &&
                      (!has_plot || (rt_output_commit(&files->svg, status) &&
                                     rt_output_commit(&files->png, status))) &&
                      rt_output_commit(&files->json, status) &&
                      rt_output_commit(&files->csv, status) && rt_output_commit(&files->md, status);
    free(picture);
    return good;
}

static json_t *number_of(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *count_of(size_t count)
{
    return json_integer((json_int_t)count);
}

static json_t *spread_of(const rt_spread *s)
{
    return json_pack("{s:o,s:o,s:o}", "q1", number_of(s->low), "median", number_of(s->median), "q3",
                     number_of(s->high));
}

static json_t *error_of(const rt_study_error *e)
{
    return json_pack("{s:o,s:o,s:o,s:i,s:o,s:o}", "pixels_over_0", count_of(e->over_0),
                     "pixels_over_1", count_of(e->over_1), "pixels_over_8", count_of(e->over_8),
                     "max_steps", e->max_step, "rms_steps", number_of(e->rms), "non_finite_pixels",
                     count_of(e->non_finite));
}

/* The figures of edges are null where there is no closed mesh: nothing was asked, so nothing is 0.
 */
static json_t *level_of(const rt_study *study, const rt_study_level *l)
{
    const bool has_edges = study->no_edges == NULL;
    return json_pack("{s:s,s:o,s:o,s:o,s:{s:o,s:o,s:o},s:o,s:o,s:o,s:o,s:o}", "level",
                     rt_accuracy_name(l->level), "rays", count_of(l->rays), "hits",
                     count_of(l->hits), "hit_index_disagreements", count_of(l->disagreements),
                     "t_error_ulp", "p50", number_of(l->t_p50), "p99", number_of(l->t_p99), "max",
                     number_of(l->t_max), "next_rays", count_of(l->next_rays), "self_hits",
                     count_of(l->self_hits), "edge_rays",
                     has_edges ? count_of(l->edge_rays) : json_null(), "leaks",
                     has_edges ? count_of(l->leaks) : json_null(), "double_hits",
                     has_edges ? count_of(l->double_hits) : json_null());
}

static json_t *cell_of(const rt_study_cell *c)
{
    return json_pack("{s:s,s:i,s:o,s:{s:o,s:o,s:o,s:o,s:o},s:o,s:o,s:o,s:o,s:b,s:b}", "level",
                     rt_accuracy_name(c->level), "samples", c->samples, "rays", count_of(c->rays),
                     "seconds", "program", number_of(c->program), "upload", number_of(c->upload),
                     "kernel", spread_of(&c->kernel), "readback", spread_of(&c->readback), "wall",
                     spread_of(&c->wall), "kernel_ratio_to_base", spread_of(&c->ratio),
                     "against_same_samples", error_of(&c->arithmetic), "against_converged",
                     error_of(&c->seen), "pixels_changed_from_base", count_of(c->changed),
                     "dominated_arithmetic", c->arithmetic_is_dominated, "dominated_seen",
                     c->seen_is_dominated);
}

static json_t *reference_of(const rt_study *study)
{
    json_t *sampling = json_array();
    for (size_t i = 0; i < study->plan.sample_count; ++i)
        json_array_append_new(sampling,
                              json_pack("{s:i,s:o}", "samples", study->plan.samples[i],
                                        "against_converged", error_of(&study->sampling[i])));
    return json_pack("{s:s,s:s,s:i,s:o,s:o}", "pictures",
                     study->reference_is_scalar ? "scalar path in double" : "device", "level",
                     study->reference_is_scalar ? "reference"
                                                : rt_accuracy_name(study->reference_level),
                     "converged_samples", study->converged_samples, "scalar_seconds_a_sample",
                     number_of(study->reference_seconds), "sampling_alone", sampling);
}

static json_t *json_of(const rt_study *study, char *verdict)
{
    json_t *levels = json_array(), *cells = json_array(), *lacking = json_array();
    for (size_t i = 0; i < study->level_count; ++i)
        json_array_append_new(levels, level_of(study, &study->levels[i]));
    for (size_t i = 0; i < study->cell_count; ++i)
        json_array_append_new(cells, cell_of(&study->cells[i]));
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i)
        if (study->lacks[i])
            json_array_append_new(lacking, json_string(rt_accuracy_name((enum rt_accuracy)i)));
    return json_pack("{s:s,s:{s:s,s:s,s:s},s:i,s:i,s:i,s:s,s:b,s:o,s:o,s:s?,s:o,s:o,s:s}", "scene",
                     study->scene, "device", "name", study->device->name, "platform",
                     study->device->platform_name, "driver", study->device->driver, "width",
                     study->width, "height", study->height, "repeats", study->plan.repeats, "base",
                     rt_accuracy_name(study->base), "kernel_is_wall_time", study->kernel_is_wall,
                     "levels_lacking", lacking, "reference", reference_of(study),
                     "no_edge_rays_because", study->no_edges, "same_rays", levels, "pictures",
                     cells, "verdict", verdict);
}

bool rt_study_write_json(const rt_study *study, rt_output *output, rt_status *status)
{
    char *verdict = rt_study_verdict(study);
    json_t *root = verdict ? json_of(study, verdict) : NULL;
    free(verdict);
    return rt_json_write(root, "--study", output, status);
}
