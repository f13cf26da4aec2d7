#include "cli/options_check.h"

#include <string.h>
#include <strings.h>

bool rt_usage_fail(rt_status *status, const char *message, const char *what)
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
            return rt_status_fail(status, RT_ERROR_USAGE,
                                  "rt: found '%s'; --device takes a name or index on each side of "
                                  "a comma",
                                  text);
        if ((length == 6 && strncasecmp(next, "scalar", length) == 0) ||
            (length == 13 && strncasecmp(next, "scalar-double", length) == 0))
            return rt_usage_fail(status, "the scalar path renders alone, not as in --device ",
                                 text);
        if (length == 3 && strncasecmp(next, "all", length) == 0)
            return rt_usage_fail(status, "all devices cannot be part of a list: --device ", text);
        next = next[length] ? next + length + 1 : NULL;
    }
    return true;
}

/* A study is of devices, at levels and counts of samples of its own, and writes its own files. */
static bool check_study(const rt_options *o, rt_status *status)
{
    if (!o->study)
        return !o->has_plan ||
               rt_usage_fail(status, "--study-levels, -repeats and -samples go with --study", "");
    if (o->output)
        return rt_usage_fail(status, "--study writes no picture, so there is no place for ",
                             o->output);
    if (o->verify || o->hits || o->stats)
        return rt_usage_fail(status, "--study does not go with --verify, --hits or --stats", "");
    if (o->has_accuracy)
        return rt_usage_fail(status, "--study takes --study-levels in the place of --accuracy", "");
    if (o->target != RT_TARGET_DEVICE)
        return rt_usage_fail(status, "--study holds a device against the scalar path; choose one",
                             "");
    return true;
}

/* --explain measures one device, and draws nothing that is kept. */
static bool check_explain(const rt_options *o, rt_status *status)
{
    if (o->no_cost && !o->explain)
        return rt_usage_fail(status, "--no-cost is for --explain", "");
    if (!o->explain)
        return true;
    if (o->output || o->verify || o->hits || o->study)
        return rt_usage_fail(status, "--explain renders no picture to keep, compare or study", "");
    if (o->effects == RT_EFFECTS_ALL)
        return rt_usage_fail(status, "--explain is of the scene's own effects, not of all", "");
    if (!o->no_cost && o->target != RT_TARGET_DEVICE)
        return rt_usage_fail(status, "--explain measures an OpenCL device, or nothing: --no-cost",
                             "");
    return true;
}

/* --seconds and --error add samples to a picture on devices. */
static bool check_refinement(const rt_options *o, rt_status *status)
{
    if (!(o->seconds > 0.0) && !(o->error > 0.0))
        return true;
    if (o->study || o->explain)
        return rt_usage_fail(status, "--seconds and --error are for one picture", "");
    return o->target == RT_TARGET_DEVICE ||
           rt_usage_fail(status, "--seconds and --error are for OpenCL devices", "");
}

/* --plot needs a file and nothing else. */
static bool check_plot(rt_options *o, rt_status *status)
{
    if (o->scene || o->study || o->has_plan || o->explain || o->verify || o->hits || o->stats)
        return rt_usage_fail(status, "--plot reads what a study has found, and renders nothing",
                             "");
    o->action = RT_ACTION_PLOT;
    return true;
}

/* --prepare is for devices, and knows no scene. */
static bool check_prepare(rt_options *o, rt_status *status)
{
    if (o->scene || o->study || o->explain || o->verify || o->hits || o->stats)
        return rt_usage_fail(status, "--prepare compiles what many scenes take, and renders none",
                             "");
    if (o->target != RT_TARGET_DEVICE)
        return rt_usage_fail(status, "--prepare is for OpenCL devices", "");
    if (o->quiet)
        o->progress = RT_PROGRESS_NEVER;
    o->action = RT_ACTION_PREPARE;
    return true;
}

bool rt_options_check(rt_options *o, rt_status *status)
{
    if (o->plot)
        return check_plot(o, status);
    if (o->prepare)
        return check_prepare(o, status);
    if (!o->scene)
        return rt_usage_fail(status, "no scene is given", "");
    if (!check_study(o, status))
        return false;
    if (!check_explain(o, status))
        return false;
    if (!check_refinement(o, status))
        return false;
    if (!o->output && !o->verify && !o->hits && !o->stats && !o->study && !o->explain)
        return rt_usage_fail(status, "no output is given", "");
    if (o->format && !o->output)
        return rt_usage_fail(status, "--format is of the picture, and none is to be written", "");
    if (o->quiet)
        o->progress = RT_PROGRESS_NEVER;
    if (o->output && !o->format) {
        char formats[RT_IMAGE_FORMATS_LIST_SIZE];
        rt_image_formats_list(".", formats, sizeof formats);
        return rt_status_fail(status, RT_ERROR_USAGE, "rt: '%s' does not end in %s", o->output,
                              formats);
    }
    const char *const outputs[] = {o->output, o->hits, o->stats};
    int to_stdout = 0;
    for (size_t i = 0; i < 3; ++i)
        to_stdout += outputs[i] && strcmp(outputs[i], "-") == 0;
    if (to_stdout > 1 || (to_stdout == 1 && o->verify))
        return rt_usage_fail(status, "only one thing can go to standard output", "");
    if (o->device && !check_devices(o->device, status))
        return false;
    if (o->verify && o->target != RT_TARGET_DEVICE)
        return rt_usage_fail(status, "--verify holds a device against the scalar path; choose one",
                             "");
    o->action = o->explain ? RT_ACTION_EXPLAIN : o->study ? RT_ACTION_STUDY : RT_ACTION_RENDER;
    return true;
}
