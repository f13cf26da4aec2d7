#include "bench/report.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "common/file.h"

bool bench_report_open(bench_report *report, const char *path, rt_status *status)
{
    *report = (bench_report){.path = path, .agrees = true};
    if (path && access(path, F_OK) == 0) {
        json_error_t error;
        report->root = json_load_file(path, 0, &error);
        if (!json_is_array(json_object_get(report->root, "rows")))
            return rt_status_fail(status, RT_ERROR_USAGE, "bench: '%s' is not a report: %s", path,
                                  error.text);
        return true;
    }
    report->root = json_pack("{s:[]}", "rows");
    return report->root || rt_status_no_memory(status, "the report");
}

void bench_report_close(bench_report *report)
{
    json_decref(report->root);
    report->root = NULL;
}

static json_t *number_of(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *quartiles_json(bench_quartiles q)
{
    return json_pack("{s:o,s:o,s:o}", "low", number_of(q.low), "median", number_of(q.median),
                     "high", number_of(q.high));
}

static json_t *agreement_json(const bench_agreement *a)
{
    return a->rays ? json_pack("{s:I,s:I,s:I,s:I}", "rays", (json_int_t)a->rays, "rt",
                               (json_int_t)a->ours, "other", (json_int_t)a->theirs, "apart",
                               (json_int_t)a->apart)
                   : json_null();
}

/* The part of the rays by which the two counts differ. */
static double counts_apart(const bench_agreement *a)
{
    const size_t difference = a->ours > a->theirs ? a->ours - a->theirs : a->theirs - a->ours;
    return a->rays ? (double)difference / (double)a->rays : 0.0;
}

bool bench_report_add(bench_report *report, const bench_row *row, rt_status *status)
{
    json_t *json = json_pack(
        "{s:s,s:s,s:s,s:s,s:o,s:o,s:o,s:o,s:o}", "what", row->what, "input", row->input, "against",
        row->against, "unit", row->unit, "rt", quartiles_json(row->ours), "other",
        quartiles_json(row->theirs), "ratio", quartiles_json(row->ratio), "bar",
        row->bar > 0.0 ? json_real(row->bar) : json_null(), "hits", agreement_json(&row->hits));
    if (!json || json_array_append_new(json_object_get(report->root, "rows"), json) != 0)
        return rt_status_no_memory(status, "the report");
    fprintf(stderr, "bench: %s, %s, against %s: ratio %.3g\n", row->what, row->input, row->against,
            row->ratio.median);
    if (counts_apart(&row->hits) > BENCH_APART_MAX) {
        fprintf(stderr, "bench: hit counts differ: rt %zu, %s %zu of %zu rays\n", row->hits.ours,
                row->against, row->hits.theirs, row->hits.rays);
        report->agrees = false;
    }
    return true;
}

bool bench_report_write(const bench_report *report, rt_status *status)
{
    if (!report->path)
        return true;
    char *text = json_dumps(report->root, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    if (!text)
        return rt_status_no_memory(status, "the report");
    rt_output output = RT_OUTPUT_INIT;
    const bool good = rt_output_open(&output, report->path, status) &&
                      rt_output_write(&output, text, strlen(text), status) &&
                      rt_output_write(&output, "\n", 1, status) &&
                      rt_output_commit(&output, status);
    rt_output_discard(&output);
    free(text);
    return good;
}

static const char *text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "n/a";
}

/* A member of quartiles, seconds as milliseconds; "n/a" where there is none. */
static void print_number(const json_t *quartiles, const char *key, double scale, FILE *out)
{
    const json_t *value = json_object_get(quartiles, key);
    if (json_is_number(value))
        fprintf(out, "%.4g", scale * json_number_value(value));
    else
        fputs("n/a", out);
}

static void print_hits(const json_t *hits, FILE *out)
{
    if (!json_is_object(hits)) {
        fputs("|", out);
        return;
    }
    const json_int_t ours = json_integer_value(json_object_get(hits, "rt"));
    const json_int_t theirs = json_integer_value(json_object_get(hits, "other"));
    fprintf(out, "| %+lld of %lld; %lld ", (long long)(ours - theirs), (long long)ours,
            (long long)json_integer_value(json_object_get(hits, "apart")));
}

static void print_bar(const json_t *row, FILE *out)
{
    const json_t *bar = json_object_get(row, "bar");
    const json_t *median = json_object_get(json_object_get(row, "ratio"), "median");
    if (!json_is_number(bar)) {
        fputs("| | ", out);
        return;
    }
    fprintf(out, "| %.3g | %s ", json_number_value(bar),
            !json_is_number(median)                               ? "n/a"
            : json_number_value(median) >= json_number_value(bar) ? "yes"
                                                                  : "no");
}

static void print_row(const json_t *row, FILE *out)
{
    const bool is_time = strcmp(text_of(row, "unit"), "s") == 0;
    const double scale = is_time ? 1e3 : 1.0;
    const json_t *ratio = json_object_get(row, "ratio");
    fprintf(out, "| %s | %s | %s | %s | ", text_of(row, "what"), text_of(row, "input"),
            text_of(row, "against"), is_time ? "ms" : text_of(row, "unit"));
    print_number(json_object_get(row, "rt"), "median", scale, out);
    fputs(" | ", out);
    print_number(json_object_get(row, "other"), "median", scale, out);
    fputs(" | ", out);
    print_number(ratio, "median", 1.0, out);
    fputs(" | ", out);
    if (json_is_number(json_object_get(ratio, "median"))) {
        print_number(ratio, "low", 1.0, out);
        fputs(" to ", out);
        print_number(ratio, "high", 1.0, out);
    }
    fputs(" ", out);
    print_bar(row, out);
    print_hits(json_object_get(row, "hits"), out);
    fputs("|\n", out);
}

void bench_report_markdown(const bench_report *report, FILE *out)
{
    json_t *machine = json_object_get(report->root, "machine");
    for (void *i = json_object_iter(machine); i; i = json_object_iter_next(machine, i))
        fprintf(out, "- %s: %s\n", json_object_iter_key(i),
                json_string_value(json_object_iter_value(i)));
    fputs(
        "\nMedians; ratio = other / rt, taken repeat by repeat, so above 1 rt is ahead. Hits: rt's"
        " count less the other's, of rt's; rays on which they disagree.\n\n"
        "| what | input | against | unit | rt | other | ratio | quartiles | bar | met | hits |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n",
        out);
    const json_t *rows = json_object_get(report->root, "rows");
    for (size_t i = 0; i < json_array_size(rows); ++i)
        print_row(json_array_get(rows, i), out);
}
