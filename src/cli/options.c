#define _GNU_SOURCE
#include "cli/options.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#include "common/number.h"
#include "render/renderer.h"
#include "scene/scene.h"

enum {
    OPTION_DEVICE = 'd',
    OPTION_QUIET = 'q',
    OPTION_HELP = 'h',
    OPTION_ACCEL = 256,
    OPTION_ACCURACY,
    OPTION_EFFECTS,
    OPTION_EXPLAIN,
    OPTION_NO_COST,
    OPTION_LIST,
    OPTION_LANES,
    OPTION_TILE,
    OPTION_SIZE,
    OPTION_HITS,
    OPTION_VERIFY,
    OPTION_STATS,
    OPTION_GRAMMAR,
    OPTION_PROGRESS,
    OPTION_STUDY,
    OPTION_STUDY_LEVELS,
    OPTION_STUDY_REPEATS,
    OPTION_STUDY_SAMPLES,
    OPTION_VERSION
};

static const struct option long_options[] = {
    {"accel", required_argument, NULL, OPTION_ACCEL},
    {"accuracy", required_argument, NULL, OPTION_ACCURACY},
    {"device", required_argument, NULL, OPTION_DEVICE},
    {"effects", required_argument, NULL, OPTION_EFFECTS},
    {"explain", no_argument, NULL, OPTION_EXPLAIN},
    {"grammar", no_argument, NULL, OPTION_GRAMMAR},
    {"help", no_argument, NULL, OPTION_HELP},
    {"hits", required_argument, NULL, OPTION_HITS},
    {"lanes", required_argument, NULL, OPTION_LANES},
    {"list-devices", no_argument, NULL, OPTION_LIST},
    {"no-cost", no_argument, NULL, OPTION_NO_COST},
    {"progress", required_argument, NULL, OPTION_PROGRESS},
    {"quiet", no_argument, NULL, OPTION_QUIET},
    {"size", required_argument, NULL, OPTION_SIZE},
    {"stats", required_argument, NULL, OPTION_STATS},
    {"study", required_argument, NULL, OPTION_STUDY},
    {"study-levels", required_argument, NULL, OPTION_STUDY_LEVELS},
    {"study-repeats", required_argument, NULL, OPTION_STUDY_REPEATS},
    {"study-samples", required_argument, NULL, OPTION_STUDY_SAMPLES},
    {"tile", required_argument, NULL, OPTION_TILE},
    {"verify", no_argument, NULL, OPTION_VERIFY},
    {"version", no_argument, NULL, OPTION_VERSION},
    {NULL, 0, NULL, 0}};

void rt_options_help(FILE *out)
{
    fputs(
        "Usage: rt [OPTION]... SCENE OUTPUT\n"
        "       rt [OPTION]... --verify SCENE [OUTPUT]\n"
        "       rt [OPTION]... --explain SCENE\n"
        "       rt [OPTION]... --study=REPORT SCENE\n"
        "Renders the text scene SCENE (- for standard input) with OpenCL to the picture OUTPUT:\n"
        "png, bmp, tga, jpg or hdr by its extension, - for a PNG on standard output. OUTPUT may\n"
        "be left out with --verify, --hits or --stats.\n"
        "\n"
        "      --accel=HOW      bvh, the default, or none: try every primitive with every ray;\n"
        "                       the picture is the same\n"
        "      --accuracy=LEVEL fast, standard (the default), robust or double, whatever the\n"
        "                       scene says\n"
        "  -d, --device=DEVICE  where to render: an index of --list-devices, P:D, cpu, gpu,\n"
        "                       accelerator, any part of a name, scalar (plain C in float) or\n"
        "                       scalar-double; several with commas between them, or all,\n"
        "                       share the picture; by default RT_DEVICE, else the first GPU,\n"
        "                       else the first CPU\n"
        "      --effects=WHICH  what is compiled into the kernels: scene, what the scene calls "
        "for,\n"
        "                       the default; all, everything, switched at run time, for the\n"
        "                       same picture; none, Phong alone\n"
        "      --explain        print which effects the scene calls for, by which line, and what\n"
        "                       each costs on this device\n"
        "      --grammar        print the scene format as a table and exit\n"
        "  -h, --help           print this help and exit\n"
        "      --hits=FILE      write what each pixel hits: int32 primitive, float32 t, u, v\n"
        "      --lanes=N        rays in a vector when tracing: 1, 4, 8 or 16; by default the\n"
        "                       device's native float width, 1 on a GPU\n"
        "      --list-devices   list the OpenCL devices and exit\n"
        "      --no-cost        explain without measuring, and without a device\n"
        "      --progress=WHEN  tell on standard error how far a long render is: auto (the\n"
        "                       default: on a terminal), always or never\n"
        "  -q, --quiet          print errors only\n"
        "      --size=WxH       picture size in pixels, whatever the scene says\n"
        "      --stats=FILE     write what was done and how long it took as JSON (- for\n"
        "                       standard output)\n"
        "      --study=REPORT   measure what accuracy costs: the scene at every level and several\n"
        "                       counts of samples, its errors and times, to REPORT.json, .csv,\n"
        "                       .md, .svg and .png\n"
        "      --study-levels=LEVELS\n"
        "                       levels to study, with commas between them; all by default\n"
        "      --study-repeats=N\n"
        "                       timed repeats, 9 by default\n"
        "      --study-samples=LIST\n"
        "                       samples a pixel to study, 1,4,16,64 by default\n"
        "      --tile=N         side of the tiles that the picture is rendered in, in pixels\n"
        "      --verify         render with the scalar path too and compare\n"
        "      --version        print the version and exit\n"
        "\n"
        "Exit codes: 0 success, 1 bad scene, 2 bad usage, 3 no usable OpenCL device or a kernel\n"
        "that does not build, 4 output cannot be written, 5 --verify found a difference,\n"
        "130 interrupted.\n",
        out);
}

static bool fail(rt_status *status, const char *option, const char *value, const char *expected)
{
    return rt_status_fail(status, RT_ERROR_USAGE, "rt: found '%s'; %s takes %s", value, option,
                          expected);
}

static bool read_whole(const char *text, size_t length, int64_t low, int64_t high, int *out)
{
    int64_t value = 0;
    if (rt_number_int(text, length, &value) != RT_NUMBER_OK || value < low || value > high)
        return false;
    *out = (int)value;
    return true;
}

static bool read_size(rt_options *options, const char *text, rt_status *status)
{
    const char *x = strchr(text, 'x');
    if (!x || !read_whole(text, (size_t)(x - text), 1, RT_IMAGE_SIDE_MAX, &options->width) ||
        !read_whole(x + 1, strlen(x + 1), 1, RT_IMAGE_SIDE_MAX, &options->height) ||
        (int64_t)options->width * options->height > RT_IMAGE_PIXELS_MAX)
        return fail(status, "--size", text,
                    "WxH, such as 640x480, each from 1 to 65535, at most 268435456 pixels in all");
    return true;
}

static bool read_lanes(rt_options *options, const char *text, rt_status *status)
{
    int lanes = 0;
    if (!read_whole(text, strlen(text), 1, 16, &lanes) ||
        (lanes != 1 && lanes != 4 && lanes != 8 && lanes != 16))
        return fail(status, "--lanes", text, "1, 4, 8 or 16");
    options->lanes = lanes;
    return true;
}

static void read_device(rt_options *options, const char *text)
{
    options->device = text;
    options->target = RT_TARGET_DEVICE;
    if (strcasecmp(text, "scalar") == 0)
        options->target = RT_TARGET_SCALAR;
    else if (strcasecmp(text, "scalar-double") == 0)
        options->target = RT_TARGET_SCALAR_DOUBLE;
}

static bool read_progress(rt_options *options, const char *text, rt_status *status)
{
    static const char *const names[] = {[RT_PROGRESS_AUTO] = "auto",
                                        [RT_PROGRESS_ALWAYS] = "always",
                                        [RT_PROGRESS_NEVER] = "never"};
    for (int i = 0; i < 3; ++i)
        if (strcmp(text, names[i]) == 0) {
            options->progress = (enum rt_progress_when)i;
            return true;
        }
    return fail(status, "--progress", text, "auto, always or never");
}

static bool read_plan(rt_options *options, int code, const char *value, rt_status *status)
{
    rt_study_plan *plan = &options->plan;
    options->has_plan = true;
    if (code == OPTION_STUDY_LEVELS)
        return rt_study_plan_read_levels(plan, value) ||
               fail(status, "--study-levels", value,
                    "fast, standard, robust or double, or several with commas between them");
    if (code == OPTION_STUDY_SAMPLES)
        return rt_study_plan_read_samples(plan, value) ||
               fail(status, "--study-samples", value,
                    "up to 16 whole numbers from 1 to 4096 with commas between them");
    return read_whole(value, strlen(value), 1, RT_STUDY_REPEATS_MAX, &plan->repeats) ||
           fail(status, "--study-repeats", value, "a whole number from 1 to 1000");
}

static bool read_option(rt_options *options, int code, const char *value, rt_status *status)
{
    switch (code) {
    case OPTION_ACCEL:
        options->accel = strcmp(value, "none") == 0 ? RT_ACCEL_NONE : RT_ACCEL_BVH;
        return options->accel == RT_ACCEL_NONE || strcmp(value, "bvh") == 0 ||
               fail(status, "--accel", value, "bvh or none");
    case OPTION_ACCURACY:
        options->has_accuracy = true;
        return rt_accuracy_of_name(value, &options->accuracy) ||
               fail(status, "--accuracy", value, "fast, standard, robust or double");
    case OPTION_DEVICE:
        read_device(options, value);
        return *value || fail(status, "--device", value, "the name or index of a device");
    case OPTION_EFFECTS:
        return rt_effects_mode_of_name(value, &options->effects) ||
               fail(status, "--effects", value, "scene, all or none");
    case OPTION_EXPLAIN:
        options->explain = true;
        return true;
    case OPTION_NO_COST:
        options->no_cost = true;
        return true;
    case OPTION_LANES:
        return read_lanes(options, value, status);
    case OPTION_TILE:
        return read_whole(value, strlen(value), 1, RT_TILE_MAX, &options->tile) ||
               fail(status, "--tile", value, "a whole number from 1 to 4096");
    case OPTION_SIZE:
        return read_size(options, value, status);
    case OPTION_HITS:
        options->hits = value;
        return true;
    case OPTION_STATS:
        options->stats = value;
        return true;
    case OPTION_STUDY:
        options->study = value;
        return *value || fail(status, "--study", value, "what the names of the report begin with");
    case OPTION_STUDY_LEVELS:
    case OPTION_STUDY_REPEATS:
    case OPTION_STUDY_SAMPLES:
        return read_plan(options, code, value, status);
    case OPTION_PROGRESS:
        return read_progress(options, value, status);
    case OPTION_VERIFY:
        options->verify = true;
        return true;
    case OPTION_QUIET:
        options->quiet = true;
        return true;
    case OPTION_LIST:
        options->action = RT_ACTION_LIST;
        return true;
    case OPTION_GRAMMAR:
        options->action = RT_ACTION_GRAMMAR;
        return true;
    case OPTION_HELP:
        options->action = RT_ACTION_HELP;
        return true;
    case OPTION_VERSION:
        options->action = RT_ACTION_VERSION;
        return true;
    default:
        return false;
    }
}

static bool fail_usage(rt_status *status, const char *message, const char *what)
{
    return rt_status_fail(status, RT_ERROR_USAGE, "rt: %s%s; try 'rt --help'", message, what);
}

/* A list of devices: no empty place in it, and none that is not a device. */
static bool check_devices(const char *text, rt_status *status)
{
    if (!strchr(text, ','))
        return true;
    for (const char *next = text; next;) {
        next += strspn(next, " ");
        const size_t length = strcspn(next, ",");
        if (length == 0)
            return fail(status, "--device", text, "a name or index on each side of a comma");
        if ((length == 6 && strncasecmp(next, "scalar", length) == 0) ||
            (length == 13 && strncasecmp(next, "scalar-double", length) == 0))
            return fail_usage(status, "the scalar path renders alone, not as in --device ", text);
        if (length == 3 && strncasecmp(next, "all", length) == 0)
            return fail_usage(status, "all devices cannot be part of a list: --device ", text);
        next = next[length] ? next + length + 1 : NULL;
    }
    return true;
}

/* A study is of one device, at levels and counts of samples of its own, and writes its own files.
 */
static bool check_study(const rt_options *o, rt_status *status)
{
    if (!o->study)
        return !o->has_plan ||
               fail_usage(status, "--study-levels, -repeats and -samples go with --study", "");
    if (o->output)
        return fail_usage(status, "--study writes no picture, so there is no place for ",
                          o->output);
    if (o->verify || o->hits || o->stats)
        return fail_usage(status, "--study does not go with --verify, --hits or --stats", "");
    if (o->has_accuracy)
        return fail_usage(status, "--study takes --study-levels in the place of --accuracy", "");
    if (o->target != RT_TARGET_DEVICE)
        return fail_usage(status, "--study holds a device against the scalar path; choose one", "");
    if (o->device && (strchr(o->device, ',') || strcasecmp(o->device, "all") == 0))
        return fail_usage(status, "--study is of one device, not of --device ", o->device);
    return true;
}

/* --explain measures one device, and draws nothing that is kept. */
static bool check_explain(const rt_options *o, rt_status *status)
{
    if (o->no_cost && !o->explain)
        return fail_usage(status, "--no-cost is for --explain", "");
    if (!o->explain)
        return true;
    if (o->output || o->verify || o->hits || o->study)
        return fail_usage(status, "--explain renders no picture to keep, compare or study", "");
    if (o->effects == RT_EFFECTS_ALL)
        return fail_usage(status, "--explain is of the scene's own effects, not of all", "");
    if (!o->no_cost && o->target != RT_TARGET_DEVICE)
        return fail_usage(status, "--explain measures an OpenCL device, or nothing: --no-cost", "");
    return true;
}

/* What options mean together. */
static bool check(rt_options *o, rt_status *status)
{
    if (!o->scene)
        return fail_usage(status, "no scene is given", "");
    if (!check_study(o, status))
        return false;
    if (!check_explain(o, status))
        return false;
    if (!o->output && !o->verify && !o->hits && !o->stats && !o->study && !o->explain)
        return fail_usage(status, "no output is given", "");
    if (o->quiet)
        o->progress = RT_PROGRESS_NEVER;
    if (o->output && o->format == RT_IMAGE_UNKNOWN)
        return rt_status_fail(status, RT_ERROR_USAGE,
                              "rt: '%s' does not end in .png, .bmp, .tga, .jpg or .hdr", o->output);
    const char *const outputs[] = {o->output, o->hits, o->stats};
    int to_stdout = 0;
    for (size_t i = 0; i < 3; ++i)
        to_stdout += outputs[i] && strcmp(outputs[i], "-") == 0;
    if (to_stdout > 1 || (to_stdout == 1 && o->verify))
        return fail_usage(status, "only one thing can go to standard output", "");
    if (o->device && !check_devices(o->device, status))
        return false;
    if (o->verify && o->target != RT_TARGET_DEVICE)
        return fail_usage(status, "--verify holds a device against the scalar path; choose one",
                          "");
    return true;
}

bool rt_options_read(rt_options *options, int argc, char **argv, rt_status *status)
{
    *options = (rt_options){.format = RT_IMAGE_UNKNOWN, .plan = rt_study_plan_default()};
    const char *environment = getenv("RT_DEVICE");
    if (environment && *environment)
        read_device(options, environment);
    opterr = 0;
    optind = 0; /* GNU's sign to begin afresh */
    for (;;) {
        const int code = getopt_long(argc, argv, ":d:hq", long_options, NULL);
        if (code == -1)
            break;
        if (code == ':')
            return fail_usage(status, "a value is missing after ", argv[optind - 1]);
        if (code == '?')
            return fail_usage(status, "cannot make sense of ", argv[optind - 1]);
        if (!read_option(options, code, optarg, status))
            return false;
        if (options->action != RT_ACTION_RENDER)
            return true;
    }
    if (argc - optind > 2)
        return fail_usage(status, "one argument too many: ", argv[optind + 2]);
    if (optind < argc)
        options->scene = argv[optind];
    if (optind + 1 < argc) {
        options->output = argv[optind + 1];
        options->format = rt_image_format_of(options->output);
    }
    return check(options, status);
}
