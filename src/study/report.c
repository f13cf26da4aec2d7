#define _GNU_SOURCE
#include "study/report.h"

#include <stdlib.h>
#include <string.h>

#include "study/csv.h"
#include "study/html.h"
#include "study/markdown.h"
#include "study/plot.h"
#include "study/study_json.h"
#include "study/verdict.h"

/* What stands behind REPORT, and what it is. */
static const struct {
    const char *ending, *what;
} rows[RT_STUDY_FILES] = {
    [RT_STUDY_HTML] = {".html", "the whole report in one file: begin here"},
    [RT_STUDY_MD] = {".md", "the same as text"},
    [RT_STUDY_SVG] = {".svg", "the plot"},
    [RT_STUDY_PNG] = {".png", "the plot in pixels"},
    [RT_STUDY_CSV] = {".csv", "every figure, for a spreadsheet"},
    [RT_STUDY_JSON] = {".json", "every figure; rt --plot makes the others of it"},
    [RT_STUDY_PICTURES] = {"-pictures.png", "two pictures of the scene, and their difference"}};

static char *path_of(const rt_study_report *r, enum rt_study_file file, rt_status *status)
{
    char *path = NULL;
    if (asprintf(&path, "%s%s", r->report, rows[file].ending) >= 0)
        return path;
    (void)rt_status_no_memory(status, "a path");
    return NULL;
}

void rt_study_report_init(rt_study_report *r)
{
    *r = (rt_study_report){0};
    for (int i = 0; i < RT_STUDY_FILES; ++i)
        r->files[i] = RT_OUTPUT_INIT;
}

void rt_study_report_clear(rt_study_report *r)
{
    for (int i = 0; i < RT_STUDY_FILES; ++i)
        rt_output_discard(&r->files[i]);
    free(r->report);
    r->report = NULL;
}

static bool is_written(const rt_study_report *r, enum rt_study_file file)
{
    if (file == RT_STUDY_SVG || file == RT_STUDY_PNG)
        return r->with_plot;
    return !r->is_redrawn || (file != RT_STUDY_JSON && file != RT_STUDY_PICTURES);
}

/* A user who waits for minutes is not to learn at their end that something is missing. */
static bool look_for_gnuplot(rt_study_report *r, rt_status *status)
{
    static const char *const reasons[] = {
        [RT_PLOT_NO_GNUPLOT] = "there is no gnuplot; on Debian: apt-get install gnuplot-nox",
        [RT_PLOT_FAILED] = "gnuplot fails"};
    const enum rt_plot_result result = rt_gnuplot_try();
    r->with_plot = result == RT_PLOT_DRAWN;
    if (r->with_plot)
        return true;
    if (r->is_redrawn)
        return rt_status_fail(status, RT_ERROR_OUTPUT, "rt: cannot draw: %s", reasons[result]);
    rt_status_warn(status,
                   "rt: warning: the report will be without its plot: %s. Afterwards "
                   "'rt --plot %s.json' draws it without measuring anew",
                   reasons[result], r->report);
    return true;
}

bool rt_study_report_open(rt_study_report *r, const char *name, bool is_redrawn, rt_status *status)
{
    r->is_redrawn = is_redrawn;
    r->report = strdup(name);
    if (!r->report)
        return rt_status_no_memory(status, "a path");
    bool good = look_for_gnuplot(r, status);
    for (int i = 0; good && i < RT_STUDY_FILES; ++i) {
        if (!is_written(r, (enum rt_study_file)i))
            continue;
        char *path = path_of(r, (enum rt_study_file)i, status);
        good = path && rt_output_open(&r->files[i], path, status);
        free(path);
    }
    return good;
}

static const char *temporary_of(const rt_output *output)
{
    return output->temporary ? output->temporary : output->target;
}

static bool draw_plot(rt_study_report *r, const rt_study *study, rt_status *status)
{
    if (!r->with_plot)
        return true;
    r->with_plot = rt_study_plot(study, temporary_of(&r->files[RT_STUDY_SVG]),
                                 temporary_of(&r->files[RT_STUDY_PNG])) == RT_PLOT_DRAWN;
    if (!r->with_plot)
        rt_status_warn(status, "rt: warning: there is no plot, because gnuplot failed");
    return true;
}

/* What the page holds of other files, empty where they are not there. */
static void read_back(const rt_study_report *r, enum rt_study_file file, rt_file_text *text)
{
    rt_status scratch = RT_STATUS_INIT;
    *text = (rt_file_text){NULL, 0};
    char *beside = path_of(r, file, &scratch);
    const char *path = is_written(r, file) ? temporary_of(&r->files[file]) : beside;
    if (path && (file == RT_STUDY_PICTURES || r->with_plot))
        (void)rt_file_read(path, text);
    free(beside);
    rt_status_clear(&scratch);
}

/* The files that are printed, each by its own function. */
static void print_file(const rt_study_report *r, const rt_study *study, enum rt_study_file file,
                       FILE *out)
{
    const char *slash = strrchr(r->report, '/');
    const char *name = slash ? slash + 1 : r->report;
    rt_file_text strip, plot;
    read_back(r, RT_STUDY_PICTURES, &strip);
    read_back(r, RT_STUDY_SVG, &plot);
    if (file == RT_STUDY_CSV)
        rt_study_print_csv(study, out);
    else if (file == RT_STUDY_HTML)
        rt_study_print_html(study, &strip, &plot, out);
    else
        rt_study_print_markdown(study, name, strip.length > 0, r->with_plot, out);
    rt_file_free(&strip);
    rt_file_free(&plot);
}

static bool write_printed(rt_study_report *r, const rt_study *study, enum rt_study_file file,
                          rt_status *status)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out)
        print_file(r, study, file, out);
    const bool printed = out && fclose(out) == 0;
    const bool good = printed ? rt_output_write(&r->files[file], text, length, status)
                              : rt_status_no_memory(status, "--study");
    free(text);
    return good;
}

static bool commit_all(rt_study_report *r, rt_status *status)
{
    for (int i = 0; i < RT_STUDY_FILES; ++i) {
        if (!is_written(r, (enum rt_study_file)i))
            continue;
        if (!rt_output_commit(&r->files[i], status))
            return false;
        r->has[i] = true;
    }
    return true;
}

bool rt_study_report_write(rt_study_report *r, const rt_study *study, const rt_study_strip *strip,
                           const rt_watch *watch, rt_status *status)
{
    if (!draw_plot(r, study, status))
        return false;
    if (!rt_watch_tick(watch, 1.0))
        return rt_status_fail(status, RT_INTERRUPTED, "rt: interrupted");
    return (r->is_redrawn ||
            (rt_study_strip_write(strip, study, &r->files[RT_STUDY_PICTURES], status) &&
             rt_study_write_json(study, &r->files[RT_STUDY_JSON], status))) &&
           write_printed(r, study, RT_STUDY_CSV, status) &&
           write_printed(r, study, RT_STUDY_MD, status) &&
           write_printed(r, study, RT_STUDY_HTML, status) && commit_all(r, status);
}

void rt_study_report_tell(const rt_study_report *r, const rt_study *study, FILE *out)
{
    int width = 0;
    rt_study_say_all(study, out);
    fputc('\n', out);
    for (int i = 0; i < RT_STUDY_FILES; ++i) {
        const int length = (int)(strlen(r->report) + strlen(rows[i].ending));
        width = r->has[i] && length > width ? length : width;
    }
    for (int i = 0; i < RT_STUDY_FILES; ++i)
        if (r->has[i])
            fprintf(out, "%s%-*s  %s\n", r->report, width - (int)strlen(r->report), rows[i].ending,
                    rows[i].what);
}
