/* The command line. */
#ifndef RT_CLI_OPTIONS_H
#define RT_CLI_OPTIONS_H

#include <stdbool.h>
#include <stdio.h>

#include "common/accuracy.h"
#include "common/status.h"
#include "image/formats.h"
#include "scene/effects.h"
#include "study/plan.h"

#define RT_VERSION "0.2.0"

/* How the file of a study's figures is called. */
#define RT_PLOT_ENDING ".json"

enum rt_action {
    RT_ACTION_RENDER,
    RT_ACTION_STUDY,
    RT_ACTION_PLOT,
    RT_ACTION_EXPLAIN,
    RT_ACTION_HELP,
    RT_ACTION_VERSION,
    RT_ACTION_LIST,
    RT_ACTION_CACHE,
    RT_ACTION_CACHE_CLEAR,
    RT_ACTION_PREPARE,
    RT_ACTION_GRAMMAR
};

/* How rays find primitives: by a tree, or by trying all. */
enum rt_accel { RT_ACCEL_AUTO, RT_ACCEL_BVH, RT_ACCEL_NONE };

enum rt_target { RT_TARGET_DEVICE, RT_TARGET_SCALAR, RT_TARGET_SCALAR_DOUBLE };

enum rt_progress_when { RT_PROGRESS_AUTO, RT_PROGRESS_ALWAYS, RT_PROGRESS_NEVER };

/* All strings are the caller's argv or environment. */
typedef struct rt_options {
    enum rt_action action;
    const char *scene;             /* "-" for standard input */
    const char *output;            /* NULL where no picture is asked for; "-" for standard output */
    const rt_image_format *format; /* of `output`, by its name or --format; NULL for none */
    enum rt_target target;
    enum rt_accel accel;
    bool has_accuracy; /* else the scene decides */
    enum rt_accuracy accuracy;
    const char *device; /* selectors with commas between them, or NULL for the default */
    const char *hits, *stats;
    int width, height;              /* 0 where the scene decides */
    int lanes, tile;                /* 0 for the default */
    double seconds, error;          /* that decide how many samples there are; 0 for none */
    enum rt_progress_when progress; /* RT_PROGRESS_NEVER with quiet */
    enum rt_effects_mode effects;
    bool verify, quiet;
    bool explain, no_cost; /* a table of effects in place of a picture; without measuring */
    bool prepare;          /* compile, and draw nothing */
    const char *study;     /* what the names of the report begin with, or NULL */
    const char *plot;      /* the figures of an earlier study, or NULL; ends in RT_PLOT_ENDING */
    bool has_plan;         /* whether an option narrows the study */
    rt_study_plan plan;
} rt_options;

/* Reads argv and the environment variable RT_DEVICE. On misuse returns false with code
 * RT_ERROR_USAGE. */
bool rt_options_read(rt_options *options, int argc, char **argv, rt_status *status);

/* Prints the text of `--help`. */
void rt_options_help(FILE *out);

#endif
