#define _GNU_SOURCE
#include "cli/options.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options_check.h"
#include "common/number.h"
#include "render/renderer.h"
#include "scene/scene.h"

static bool read_whole(const char *text, size_t length, int64_t low, int64_t high, int *out)
{
    int64_t value = 0;
    if (rt_number_int(text, length, &value) != RT_NUMBER_OK || value < low || value > high)
        return false;
    *out = (int)value;
    return true;
}

/* The options' values. Each is false for a value that its option does not take; those of options
 * without one get NULL. */

static bool read_accel(rt_options *o, const char *value)
{
    o->accel = strcmp(value, "none") == 0 ? RT_ACCEL_NONE : RT_ACCEL_BVH;
    return o->accel == RT_ACCEL_NONE || strcmp(value, "bvh") == 0;
}

static bool read_accuracy(rt_options *o, const char *value)
{
    o->has_accuracy = true;
    return rt_accuracy_of_name(value, &o->accuracy);
}

static bool read_device(rt_options *o, const char *value)
{
    o->device = value;
    o->target = RT_TARGET_DEVICE;
    if (strcasecmp(value, "scalar") == 0)
        o->target = RT_TARGET_SCALAR;
    else if (strcasecmp(value, "scalar-double") == 0)
        o->target = RT_TARGET_SCALAR_DOUBLE;
    return *value != '\0';
}

static bool read_effects(rt_options *o, const char *value)
{
    return rt_effects_mode_of_name(value, &o->effects);
}

static bool read_format(rt_options *o, const char *value)
{
    o->format = rt_image_format_named(value);
    return o->format != NULL;
}

static bool read_positive(const char *value, double *out)
{
    float number = 0.0f;
    if (rt_number_float(value, strlen(value), &number) != RT_NUMBER_OK || !(number > 0.0f))
        return false;
    *out = (double)number;
    return true;
}

static bool read_error(rt_options *o, const char *value)
{
    return read_positive(value, &o->error);
}

static bool read_seconds(rt_options *o, const char *value)
{
    return read_positive(value, &o->seconds);
}

static bool read_lanes(rt_options *o, const char *value)
{
    return read_whole(value, strlen(value), 1, 16, &o->lanes) &&
           (o->lanes == 1 || o->lanes == 4 || o->lanes == 8 || o->lanes == 16);
}

static bool read_plot(rt_options *o, const char *value)
{
    const size_t length = strlen(value), ending = strlen(RT_PLOT_ENDING);
    o->plot = value;
    return length > ending && strcmp(value + length - ending, RT_PLOT_ENDING) == 0;
}

static bool read_progress(rt_options *o, const char *value)
{
    static const char *const names[] = {[RT_PROGRESS_AUTO] = "auto",
                                        [RT_PROGRESS_ALWAYS] = "always",
                                        [RT_PROGRESS_NEVER] = "never"};
    for (int i = 0; i < 3; ++i)
        if (strcmp(value, names[i]) == 0) {
            o->progress = (enum rt_progress_when)i;
            return true;
        }
    return false;
}

static bool read_size(rt_options *o, const char *value)
{
    const char *x = strchr(value, 'x');
    return x && read_whole(value, (size_t)(x - value), 1, RT_IMAGE_SIDE_MAX, &o->width) &&
           read_whole(x + 1, strlen(x + 1), 1, RT_IMAGE_SIDE_MAX, &o->height) &&
           (int64_t)o->width * o->height <= RT_IMAGE_PIXELS_MAX;
}

static bool read_study(rt_options *o, const char *value)
{
    o->study = value;
    return *value != '\0';
}

static bool read_study_levels(rt_options *o, const char *value)
{
    o->has_plan = true;
    return rt_study_plan_read_levels(&o->plan, value);
}

static bool read_study_repeats(rt_options *o, const char *value)
{
    o->has_plan = true;
    return read_whole(value, strlen(value), 1, RT_STUDY_REPEATS_MAX, &o->plan.repeats);
}

static bool read_study_samples(rt_options *o, const char *value)
{
    o->has_plan = true;
    return rt_study_plan_read_samples(&o->plan, value);
}

static bool read_tile(rt_options *o, const char *value)
{
    return read_whole(value, strlen(value), 1, RT_TILE_MAX, &o->tile);
}

/* Those that take any value or none. */
#define READER(name, effect)                                                                       \
    static bool read_##name(rt_options *o, const char *value)                                      \
    {                                                                                              \
        (void)value;                                                                               \
        effect;                                                                                    \
        return true;                                                                               \
    }

READER(cache, o->action = RT_ACTION_CACHE)
READER(cache_clear, o->action = RT_ACTION_CACHE_CLEAR)
READER(explain, o->explain = true)
READER(grammar, o->action = RT_ACTION_GRAMMAR)
READER(help, o->action = RT_ACTION_HELP)
READER(hits, o->hits = value)
READER(list_devices, o->action = RT_ACTION_LIST)
READER(no_cost, o->no_cost = true)
READER(prepare, o->prepare = true)
READER(quiet, o->quiet = true)
READER(stats, o->stats = value)
READER(verify, o->verify = true)
READER(version, o->action = RT_ACTION_VERSION)

/* Everything about an option, in the order of --help. */
static const struct row {
    const char *name;
    char letter;       /* that stands for it behind one dash, or 0 */
    const char *value; /* what --help calls it; NULL for an option without one */
    bool (*read)(rt_options *o, const char *value);
    const char *takes; /* what it says of a value that it does not take; NULL where it takes all */
    const char *help;  /* lines */
} rows[] = {
    {"accel", 0, "HOW", read_accel, "bvh or none",
     "bvh, or none: try every primitive with every ray, the default for\n"
     "up to 4; the picture is the same\n"},
    {"accuracy", 0, "LEVEL", read_accuracy, "fast, standard, robust or double",
     "fast, standard, robust (the default) or double, whatever the\n"
     "scene says\n"},
    {"cache", 0, NULL, read_cache, NULL, "tell what is kept of built programs and exit\n"},
    {"cache-clear", 0, NULL, read_cache_clear, NULL, "remove it and exit\n"},
    {"device", 'd', "DEVICE", read_device, "the name or index of a device",
     "where to render: an index of --list-devices, P:D, cpu, gpu,\n"
     "accelerator, any part of a name, scalar (plain C in float) or\n"
     "scalar-double; several with commas between them, or all,\n"
     "share the picture; by default RT_DEVICE, else the first GPU,\n"
     "else the first CPU\n"},
    {"effects", 0, "WHICH", read_effects, "scene, all or none",
     "what is compiled into the kernels: scene, what the scene calls for,\n"
     "the default; all, everything, switched at run time, for the\n"
     "same picture; none, Phong alone\n"},
    {"error", 0, "STEPS", read_error, "a number above 0",
     "add samples to the picture until its error, the root mean\n"
     "square in steps of 256, is about that\n"},
    {"explain", 0, NULL, read_explain, NULL,
     "print which effects the scene calls for, by which line, and what\n"
     "each costs on this device\n"},
    {"format", 0, "NAME", read_format, "png, bmp, tga, jpg, hdr, exr or png16",
     "what the picture is written as, whatever its name ends in: png,\n"
     "bmp, tga, jpg, hdr, exr or png16, a PNG of 16 bits\n"},
    {"grammar", 0, NULL, read_grammar, NULL, "print the scene format as a table and exit\n"},
    {"help", 'h', NULL, read_help, NULL, "print this help and exit\n"},
    {"hits", 0, "FILE", read_hits, NULL,
     "write what each pixel hits: int32 primitive, float32 t, u, v\n"},
    {"lanes", 0, "N", read_lanes, "1, 4, 8 or 16",
     "rays in a vector when tracing: 1, 4, 8 or 16; by default the\n"
     "device's native float width, 1 on a GPU\n"},
    {"list-devices", 0, NULL, read_list_devices, NULL, "list the OpenCL devices and exit\n"},
    {"no-cost", 0, NULL, read_no_cost, NULL, "explain without measuring, and without a device\n"},
    {"plot", 0, "FILE", read_plot, "the REPORT.json of a study",
     "make the report of an earlier study anew from its REPORT.json\n"},
    {"prepare", 0, NULL, read_prepare, NULL,
     "compile what scenes of any primitives take, for --device and\n"
     "--accuracy, and exit: their first pictures then wait less\n"},
    {"progress", 0, "WHEN", read_progress, "auto, always or never",
     "tell on standard error how far a long render is: auto (the\n"
     "default: on a terminal), always or never\n"},
    {"quiet", 'q', NULL, read_quiet, NULL, "print errors only\n"},
    {"seconds", 0, "T", read_seconds, "a number above 0",
     "add samples to the picture until the run has taken so long\n"},
    {"size", 0, "WxH", read_size,
     "WxH, such as 640x480, each from 1 to 65535, at most 268435456 pixels in all",
     "picture size in pixels, whatever the scene says\n"},
    {"stats", 0, "FILE", read_stats, NULL,
     "write what was done and how long it took as JSON (- for\n"
     "standard output)\n"},
    {"study", 0, "REPORT", read_study, "what the names of the report begin with",
     "measure what accuracy costs: the scene at every level and several\n"
     "counts of samples, its errors and times, on one device or on\n"
     "several side by side; a verdict, and a report in REPORT.html\n"},
    {"study-levels", 0, "LEVELS", read_study_levels,
     "fast, standard, robust or double, or several with commas between them",
     "levels to study, with commas between them; all by default\n"},
    {"study-repeats", 0, "N", read_study_repeats, "a whole number from 1 to 1000",
     "timed repeats, 9 by default\n"},
    {"study-samples", 0, "LIST", read_study_samples,
     "up to 16 whole numbers from 1 to 4096 with commas between them",
     "samples a pixel to study, 1,4,16,64 by default\n"},
    {"tile", 0, "N", read_tile, "a whole number from 1 to 4096",
     "side of the tiles that the picture is rendered in, in pixels\n"},
    {"verify", 0, NULL, read_verify, NULL, "render with the scalar path too and compare\n"},
    {"version", 0, NULL, read_version, NULL, "print the version and exit\n"},
};

#define ROWS (sizeof rows / sizeof *rows)
/* Where the lines of --help about an option begin. */
#define HELP_COLUMN 23

static void print_row(const struct row *row, FILE *out)
{
    int width = row->letter ? fprintf(out, "  -%c, ", row->letter) : fprintf(out, "      ");
    width +=
        fprintf(out, "--%s%s%s", row->name, row->value ? "=" : "", row->value ? row->value : "");
    if (width >= HELP_COLUMN) {
        fputc('\n', out);
        width = 0;
    }
    for (const char *line = row->help; *line;) {
        const char *end = strchr(line, '\n') + 1;
        fprintf(out, "%*s%.*s", HELP_COLUMN - width, "", (int)(end - line), line);
        line = end;
        width = 0;
    }
}

void rt_options_help(FILE *out)
{
    char formats[RT_IMAGE_FORMATS_LIST_SIZE];
    rt_image_formats_list("", formats, sizeof formats);
    fprintf(
        out,
        "Usage: rt [OPTION]... SCENE OUTPUT\n"
        "       rt [OPTION]... --verify SCENE [OUTPUT]\n"
        "       rt [OPTION]... --explain SCENE\n"
        "       rt [OPTION]... --study=REPORT SCENE\n"
        "       rt [OPTION]... --plot=REPORT.json\n"
        "Renders the text scene SCENE (- for standard input) with OpenCL to the picture OUTPUT:\n"
        "%s by its extension, - for a PNG on standard output. OUTPUT may\n"
        "be left out with --verify, --hits or --stats.\n"
        "\n",
        formats);
    for (size_t i = 0; i < ROWS; ++i)
        print_row(&rows[i], out);
    fputs("\n"
          "Exit codes: 0 success, 1 bad scene, 2 bad usage, 3 no usable OpenCL device or a kernel\n"
          "that does not build, 4 output cannot be written, 5 --verify found a difference\n"
          "or pixels that are not finite, 130 interrupted.\n",
          out);
}

/* The rows as getopt_long takes them; its code for a row is the row's letter or this much and the
 * row's index. */
#define CODE_FIRST 256

static void list_for_getopt(struct option longs[ROWS + 1], char letters[2 * ROWS + 2])
{
    char *letter = letters;
    *letter++ = ':'; /* a missing value is told apart from an unknown option */
    for (size_t i = 0; i < ROWS; ++i) {
        longs[i] = (struct option){rows[i].name, rows[i].value ? required_argument : no_argument,
                                   NULL, CODE_FIRST + (int)i};
        if (rows[i].letter)
            *letter++ = rows[i].letter;
        if (rows[i].letter && rows[i].value)
            *letter++ = ':';
    }
    longs[ROWS] = (struct option){0};
    *letter = '\0';
}

static bool read_option(rt_options *options, int code, const char *value, rt_status *status)
{
    size_t i = code >= CODE_FIRST ? (size_t)(code - CODE_FIRST) : 0;
    while (code < CODE_FIRST && rows[i].letter != code)
        ++i;
    if (rows[i].read(options, value))
        return true;
    return rt_status_fail(status, RT_ERROR_USAGE, "rt: found '%s'; --%s takes %s", value,
                          rows[i].name, rows[i].takes);
}

bool rt_options_read(rt_options *options, int argc, char **argv, rt_status *status)
{
    *options = (rt_options){.plan = rt_study_plan_default()};
    const char *environment = getenv("RT_DEVICE");
    if (environment && *environment)
        (void)read_device(options, environment);
    struct option longs[ROWS + 1];
    char letters[2 * ROWS + 2];
    list_for_getopt(longs, letters);
    opterr = 0;
    optind = 0; /* GNU's sign to begin afresh */
    for (;;) {
        const int code = getopt_long(argc, argv, letters, longs, NULL);
        if (code == -1)
            break;
        if (code == ':')
            return rt_usage_fail(status, "a value is missing after ", argv[optind - 1]);
        if (code == '?')
            return rt_usage_fail(status, "cannot make sense of ", argv[optind - 1]);
        if (!read_option(options, code, optarg, status))
            return false;
        if (options->action != RT_ACTION_RENDER)
            return true;
    }
    if (argc - optind > 2)
        return rt_usage_fail(status, "one argument too many: ", argv[optind + 2]);
    if (optind < argc)
        options->scene = argv[optind];
    if (optind + 1 < argc) {
        options->output = argv[optind + 1];
        if (!options->format)
            options->format = rt_image_format_of(options->output);
    }
    return rt_options_check(options, status);
}
