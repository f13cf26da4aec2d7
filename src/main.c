/* From argv to the exit code: reads the scene, renders it, writes what was asked for. */
#define _GNU_SOURCE
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bvh/bvh.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/stats.h"
#include "common/clock.h"
#include "common/file.h"
#include "common/parallel.h"
#include "common/status.h"
#include "image/image.h"
#include "opencl/device.h"
#include "reference/scalar.h"
#include "render/team.h"
#include "scene/effects.h"
#include "scene/scene.h"
#include "scene_text/grammar.h"
#include "scene_text/reader.h"
#include "study/explain.h"
#include "study/report.h"
#include "study/study.h"

/* Lock-free, so that a handler may set it, and threads may read it. */
static atomic_int was_interrupted;

static void on_signal(int signal_number)
{
    (void)signal_number;
    was_interrupted = 1;
}

/* Everything that one run opens, in one place, so that one function lets it go again. */
typedef struct run {
    rt_options options;
    rt_status status;
    rt_scene scene;
    rt_device_opening opening;
    rt_device_list devices;
    const rt_device **chosen; /* owned: room for all devices; NULL on the scalar path */
    size_t chosen_count;
    rt_bvh bvh;
    rt_team *team;
    rt_render_times times;
    rt_watch watch;
    rt_progress progress;
    rt_image image;
    rt_output picture, hits, stats_file;
    rt_study study;
    rt_study_files report;
    rt_stats stats;
    double start;
} run;

/* Called by one thread at a time, as a team promises. */
static bool keep_going(void *context, double done)
{
    run *r = context;
    rt_progress_tell(&r->progress, done, rt_clock_seconds());
    return !was_interrupted;
}

static void begin_progress(run *r)
{
    const bool is_terminal = isatty(STDERR_FILENO) != 0;
    const enum rt_progress_when when = r->options.progress;
    const bool shown = when == RT_PROGRESS_ALWAYS || (when == RT_PROGRESS_AUTO && is_terminal);
    rt_progress_begin(&r->progress, shown ? stderr : NULL, is_terminal, rt_clock_seconds());
}

/* Messages so far, so that they come before what is printed next. */
static void flush_messages(run *r)
{
    if (r->status.text)
        fputs(r->status.text, stderr);
    if (r->status.errors > RT_STATUS_SHOWN)
        fprintf(stderr, "rt: %zu more errors\n", r->status.errors - RT_STATUS_SHOWN);
    r->status.length = 0;
    if (r->status.text)
        r->status.text[0] = '\0';
}

static bool read_scene(run *r)
{
    const double start = rt_clock_seconds();
    if (!rt_scene_text_read(&r->scene, r->options.scene, &r->status))
        return false;
    if (r->options.width) {
        r->scene.width = r->options.width;
        r->scene.height = r->options.height;
    }
    if (r->options.has_accuracy)
        r->scene.accuracy = r->options.accuracy;
    if (r->options.effects == RT_EFFECTS_NONE)
        rt_effects_remove_all(&r->scene);
    r->stats.parse = rt_clock_seconds() - start;
    if (r->options.quiet)
        rt_status_clear(&r->status);
    flush_messages(r);
    return true;
}

/* Opened before the work: a target that cannot be written is known at once. */
static bool open_outputs(run *r)
{
    const rt_options *o = &r->options;
    return (!o->output || rt_output_open(&r->picture, o->output, &r->status)) &&
           (!o->hits || rt_output_open(&r->hits, o->hits, &r->status)) &&
           (!o->stats || rt_output_open(&r->stats_file, o->stats, &r->status)) &&
           (!o->study || rt_study_files_open(&r->report, o->study, &r->status));
}

static bool choose_devices(run *r)
{
    if (r->options.target != RT_TARGET_DEVICE)
        return true;
    if (!rt_device_list_end(&r->opening, &r->devices, &r->status))
        return false;
    r->chosen = calloc(r->devices.count + 1, sizeof(const rt_device *));
    if (!r->chosen)
        return rt_status_no_memory(&r->status, "devices");
    r->chosen_count = rt_device_choose_list(&r->devices, r->options.device, r->chosen, &r->status);
    for (size_t i = 0; i < r->chosen_count && !r->options.quiet; ++i)
        fprintf(stderr, "rt: device %d (%d:%d): %s [%s]\n", r->chosen[i]->index,
                r->chosen[i]->platform_index, r->chosen[i]->device_index, r->chosen[i]->name,
                r->chosen[i]->platform_name);
    return r->chosen_count > 0;
}

/* Leaves r->bvh empty where every primitive is to be tried. */
static bool build_tree(run *r)
{
    if (r->options.accel == RT_ACCEL_NONE)
        return true;
    const double start = rt_clock_seconds();
    const bool good = rt_bvh_build(&r->bvh, &r->scene, rt_parallel_processors(), &r->status);
    r->stats.accel = rt_clock_seconds() - start;
    return good;
}

static bool draw_on_devices(run *r)
{
    rt_effects effects = rt_effects_of(&r->scene);
    effects.mode = r->options.effects;
    const rt_render_options options = {.lanes = r->options.lanes,
                                       .tile = r->options.tile,
                                       .with_hits = r->image.hits != NULL,
                                       .effects = &effects};
    if (!build_tree(r))
        return false;
    r->team = rt_team_new(r->chosen, r->chosen_count, &r->scene, r->bvh.nodes ? &r->bvh : NULL,
                          &options, &r->status);
    if (!r->team)
        return false;
    const double start = rt_clock_seconds();
    begin_progress(r);
    if (!rt_team_draw(r->team, &r->image, &r->watch, &r->status))
        return false;
    r->times = rt_team_times(r->team);
    r->stats.team = r->team;
    r->stats.times = &r->times;
    r->stats.program = r->times.program;
    r->stats.upload = r->times.upload;
    r->stats.readback = r->times.readback;
    r->stats.kernel = rt_clock_seconds() - start - r->times.readback;
    r->stats.primary_rays = r->times.primary_rays;
    r->stats.lanes = rt_team_share_of(r->team, 0).lanes;
    r->stats.device = r->chosen[0]->name;
    r->stats.platform = r->chosen[0]->platform_name;
    r->stats.driver = r->chosen[0]->driver;
    return true;
}

static bool draw_scalar(run *r)
{
    const bool is_double = r->options.target == RT_TARGET_SCALAR_DOUBLE;
    const double start = rt_clock_seconds();
    begin_progress(r);
    if (!(is_double ? rt_scalar_double_render : rt_scalar_float_render)(&r->scene, &r->image,
                                                                        &r->watch, &r->status))
        return false;
    r->stats.kernel = rt_clock_seconds() - start;
    r->stats.primary_rays = (size_t)r->image.width * (size_t)r->image.height;
    r->stats.lanes = 1;
    r->stats.device = is_double ? "scalar-double" : "scalar";
    r->stats.platform = r->stats.driver = "";
    return true;
}

static bool draw(run *r)
{
    const bool with_hits = r->options.hits || r->options.verify;
    if (!rt_image_init(&r->image, r->scene.width, r->scene.height, with_hits, &r->status))
        return false;
    const bool good = r->chosen ? draw_on_devices(r) : draw_scalar(r);
    rt_progress_clear(&r->progress);
    return good;
}

/* Holds the picture against the scalar path's; false, with code RT_DIFFERENT, where they differ. */
static bool verify(run *r)
{
    rt_image expected;
    if (!rt_image_init(&expected, r->image.width, r->image.height, true, &r->status))
        return false;
    begin_progress(r);
    /* The scalar path at the device's own precision. */
    const bool is_double = r->scene.accuracy == RT_ACCURACY_DOUBLE;
    const bool good = (is_double ? rt_scalar_double_render : rt_scalar_float_render)(
        &r->scene, &expected, &r->watch, &r->status);
    rt_progress_clear(&r->progress);
    if (!good) {
        rt_image_clear(&expected);
        return false;
    }
    const rt_image_difference d = rt_image_compare(&r->image, &expected);
    rt_image_clear(&expected);
    printf("hit records that differ:         %zu of %zu\n"
           "pixels off by more than 1 step:  %zu\n"
           "largest difference:              %d steps\n"
           "root mean square difference:     %.6f steps\n"
           "pixels that are not finite:      %zu\n",
           d.hits, (size_t)r->image.width * (size_t)r->image.height, d.pixels, d.max_step,
           d.rms_step, d.non_finite);
    if (fflush(stdout) != 0)
        return rt_status_fail(&r->status, RT_ERROR_OUTPUT, "rt: cannot write standard output");
    if (d.hits == 0 && d.pixels == 0)
        return true;
    return rt_status_fail(&r->status, RT_DIFFERENT,
                          "rt: the device and the scalar path differ, first at pixel %d,%d",
                          d.first_x, d.first_y);
}

static bool write_picture(run *r)
{
    const double start = rt_clock_seconds();
    const rt_options *o = &r->options;
    const bool good =
        (!o->output || (rt_image_write(&r->image, o->format, &r->picture, &r->status) &&
                        rt_output_commit(&r->picture, &r->status))) &&
        (!o->hits || (rt_image_write_hits(&r->image, &r->hits, &r->status) &&
                      rt_output_commit(&r->hits, &r->status)));
    r->stats.encode = rt_clock_seconds() - start;
    return good;
}

static bool write_stats(run *r)
{
    if (!r->options.stats)
        return true;
    rt_stats *s = &r->stats;
    s->accuracy = r->options.target == RT_TARGET_SCALAR_DOUBLE
                      ? "reference"
                      : rt_accuracy_name(r->scene.accuracy);
    s->width = r->image.width;
    s->height = r->image.height;
    s->spheres = r->scene.sphere_count;
    s->triangles = r->scene.triangle_count;
    s->lights = r->scene.light_count;
    s->materials = r->scene.material_count;
    s->effects = rt_effects_of(&r->scene);
    s->total = rt_clock_seconds() - r->start;
    return rt_stats_write(s, &r->stats_file, &r->status) &&
           rt_output_commit(&r->stats_file, &r->status);
}

static void catch_signals(void)
{
    struct sigaction action = {.sa_handler = on_signal};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    /* A reader that has gone away is an error of write(), with a message and an exit code. */
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, NULL);
}

/* Renders the scene at every level and writes what that costs. */
static bool study(run *r)
{
    const rt_options *o = &r->options;
    if (!read_scene(r) || !open_outputs(r) || !choose_devices(r))
        return false;
    const rt_study_how how = {.device = r->chosen[0],
                              .has_tree = o->accel == RT_ACCEL_BVH,
                              .lanes = o->lanes,
                              .tile = o->tile,
                              .effects = o->effects};
    begin_progress(r);
    const bool good =
        rt_study_run(&r->study, &r->scene, o->scene, &o->plan, &how, &r->watch, &r->status);
    rt_progress_clear(&r->progress);
    if (!good || !rt_study_files_write(&r->report, &r->study, &r->watch, &r->status))
        return false;
    if (o->quiet)
        rt_status_clear(&r->status);
    return true;
}

static bool measure_effects(run *r, rt_explanation *e)
{
    const rt_render_options options = {.lanes = r->options.lanes, .tile = r->options.tile};
    if (!choose_devices(r) || !build_tree(r))
        return false;
    begin_progress(r);
    const bool good = rt_explain_measure(e, &r->scene, r->bvh.nodes ? &r->bvh : NULL, r->chosen[0],
                                         &options, &r->watch, &r->status);
    rt_progress_clear(&r->progress);
    return good;
}

/* Tells what the scene calls for and, unless told not to, what that costs. */
static bool explain(run *r)
{
    if (!read_scene(r) || !open_outputs(r))
        return false;
    rt_explanation e = rt_explain(&r->scene);
    if (!r->options.no_cost && !measure_effects(r, &e))
        return false;
    const char *stats = r->options.stats;
    if (!stats || strcmp(stats, "-") != 0)
        rt_explain_print(&e, stdout);
    return !stats || (rt_explain_write(&e, &r->stats_file, &r->status) &&
                      rt_output_commit(&r->stats_file, &r->status));
}

static bool render(run *r)
{
    /* A picture that differs is still written: it is what there is to look at. */
    const bool drawn = read_scene(r) && open_outputs(r) && choose_devices(r) && draw(r);
    if (!drawn)
        return false;
    const bool verified = !r->options.verify || verify(r);
    if (!verified && r->status.code != RT_DIFFERENT)
        return false;
    return write_picture(r) && write_stats(r) && verified;
}

static bool list_devices(run *r)
{
    if (!rt_device_list_read(&r->devices, &r->status))
        return false;
    if (r->devices.count == 0)
        return rt_device_choose(&r->devices, NULL, &r->status) != NULL;
    rt_device_list_print(&r->devices, stdout);
    return true;
}

static bool act(run *r)
{
    switch (r->options.action) {
    case RT_ACTION_HELP:
        rt_options_help(stdout);
        return true;
    case RT_ACTION_VERSION:
        printf("rt %s\n", RT_VERSION);
        return true;
    case RT_ACTION_GRAMMAR:
        rt_grammar_print(stdout);
        return true;
    case RT_ACTION_LIST:
        return list_devices(r);
    case RT_ACTION_RENDER:
        break;
    }
    catch_signals();
    r->watch = (rt_watch){keep_going, r};
    rt_scene_init(&r->scene);
    if (r->options.target == RT_TARGET_DEVICE && !r->options.no_cost)
        rt_device_list_begin(&r->opening);
    if (r->options.explain)
        return explain(r);
    return r->options.study ? study(r) : render(r);
}

static void release(run *r)
{
    rt_team_free(r->team);
    rt_bvh_clear(&r->bvh);
    rt_output_discard(&r->picture);
    rt_output_discard(&r->hits);
    rt_output_discard(&r->stats_file);
    rt_study_files_discard(&r->report);
    rt_study_clear(&r->study);
    rt_image_clear(&r->image);
    free(r->chosen);
    if (r->opening.has_begun)
        rt_device_list_end(&r->opening, &r->devices, &r->status);
    rt_device_list_clear(&r->devices);
    rt_scene_clear(&r->scene);
    rt_status_clear(&r->status);
}

int main(int argc, char **argv)
{
    run r = {.picture = RT_OUTPUT_INIT,
             .hits = RT_OUTPUT_INIT,
             .stats_file = RT_OUTPUT_INIT,
             .report = RT_STUDY_FILES_INIT,
             .start = rt_clock_seconds()};
    bool good = rt_options_read(&r.options, argc, argv, &r.status) && act(&r);
    /* Text on standard output may still be in a buffer that a full disk refuses. */
    if (fflush(stdout) != 0 || ferror(stdout))
        good = rt_status_fail(&r.status, RT_ERROR_OUTPUT, "rt: cannot write standard output");
    flush_messages(&r);
    const enum rt_code code = good ? RT_OK : r.status.code;
    release(&r);
    return (int)code;
}
