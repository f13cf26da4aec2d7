/* Results: rows of one JSON file that several programs add to, and the Markdown table of it. */
#ifndef BENCH_REPORT_H
#define BENCH_REPORT_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "bench/samples.h"
#include "common/status.h"

/* How many rays hit something, by each side's count, and on how many rays the two disagree. */
typedef struct bench_agreement {
    size_t rays, ours, theirs, apart; /* rays is 0 where nothing was compared */
} bench_agreement;

typedef struct bench_row {
    const char *what, *input, *against;
    const char *unit; /* "s", or what else is shown as it is */
    bench_quartiles ours, theirs;
    bench_quartiles ratio; /* theirs / ours: above 1 is better */
    double bar;            /* the least ratio wanted; 0 for none */
    bench_agreement hits;
} bench_row;

typedef struct bench_report {
    json_t *root;     /* owned */
    const char *path; /* NULL for no file */
    bool agrees;      /* no row so far is off by more than BENCH_APART_MAX of its rays */
} bench_report;

/* Hit counts of two tracers may differ by this part of the rays. */
#define BENCH_APART_MAX 1e-5

/* Takes up the rows that the file has, if there is one. */
bool bench_report_open(bench_report *report, const char *path, rt_status *status);
/* Adds a row and tells it on stderr. */
bool bench_report_add(bench_report *report, const bench_row *row, rt_status *status);
bool bench_report_write(const bench_report *report, rt_status *status);
void bench_report_close(bench_report *report);

/* The whole file as text: what was measured where, then one table. */
void bench_report_markdown(const bench_report *report, FILE *out);

#endif
