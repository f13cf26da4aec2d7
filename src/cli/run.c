#define _GNU_SOURCE
#include "cli/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli/refine.h"
#include "cli/signals.h"
#include "common/clock.h"
#include "common/parallel.h"
#include "reference/scalar.h"
#include "scene/check.h"
#include "scene_file/read.h"

/* Called by one thread at a time, as a team promises. */
static bool keep_going(void *context, double done)
{
    rt_run *r = context;
    rt_progress_tell(&r->progress, done, rt_clock_seconds());
    return !rt_signals_have_come();
}

static bool keep_building(void *context, double done)
{
    rt_run *r = context;
    (void)done;
    rt_progress_tell_of(&r->progress, "compiling kernels, once", rt_clock_seconds());
    return !rt_signals_have_come();
}

void rt_run_heed_signals(rt_run *r)
{
    if (!rt_signals_have_come() || r->status.code == RT_INTERRUPTED)
        return;
    rt_status_clear(&r->status);
    rt_status_fail(&r->status, RT_INTERRUPTED, "rt: interrupted");
}

void rt_run_end(rt_run *r)
{
    rt_bvh_clear(&r->bvh);
    free(r->chosen);
    if (r->opening.has_begun)
        rt_device_list_end(&r->opening, &r->devices, &r->status);
    rt_device_list_clear(&r->devices);
    rt_scene_clear(&r->scene);
    rt_status_clear(&r->status);
}

void rt_run_warn(rt_run *r)
{
    if (r->options.quiet)
        rt_status_clear(&r->status);
    else
        rt_status_print(&r->status, stderr);
}

void rt_run_begin_progress(rt_run *r)
{
    const bool is_terminal = isatty(STDERR_FILENO) != 0;
    const enum rt_progress_when when = r->options.progress;
    const bool shown = when == RT_PROGRESS_ALWAYS || (when == RT_PROGRESS_AUTO && is_terminal);
    rt_progress_begin(&r->progress, shown ? stderr : NULL, is_terminal, rt_clock_seconds());
}

static bool read_scene(rt_run *r)
{
    const rt_options *o = &r->options;
    const double start = rt_clock_seconds();
    if (!rt_scene_read(&r->scene, o->scene, &r->status))
        return false;
    if (o->width) {
        r->scene.width = o->width;
        r->scene.height = o->height;
    }
    if (o->has_accuracy)
        r->scene.accuracy = o->accuracy;
    if (rt_refine_is_asked(o))
        r->scene.samples = RT_SAMPLES_MAX;
    if (o->effects == RT_EFFECTS_NONE)
        rt_effects_remove_all(&r->scene);
    r->stats.parse = rt_clock_seconds() - start;
    r->effects = rt_effects_of(&r->scene);
    r->effects.mode = o->effects;
    if (!o->quiet && !rt_scene_check(&r->scene, &r->effects, &r->doubts, &r->status))
        return false;
    rt_run_warn(r);
    return true;
}

void rt_run_heed(rt_run *r)
{
    rt_signals_catch();
    r->watch = (rt_watch){keep_going, r};
    r->building = (rt_watch){keep_building, r};
}

bool rt_run_begin(rt_run *r)
{
    rt_run_heed(r);
    rt_scene_init(&r->scene);
    if (r->options.target == RT_TARGET_DEVICE && !r->options.no_cost)
        rt_device_list_begin(&r->opening);
    return read_scene(r);
}

bool rt_run_choose_devices(rt_run *r)
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

/* So many primitives are tried one by one in at most the time that a tree takes, by a kernel that
 * is compiled in half the time: traces of 1, 2 and 4 spheres took 0.85 to 0.94 of it, of as many
 * triangles 0.92 to 1.01, of 6 primitives 1.2 to 1.3. */
#define PRIMITIVES_WITHOUT_TREE 4

bool rt_run_build_tree(rt_run *r, const rt_bvh **tree)
{
    *tree = NULL;
    if (r->options.accel == RT_ACCEL_NONE ||
        (r->options.accel == RT_ACCEL_AUTO &&
         rt_scene_primitive_count(&r->scene) <= PRIMITIVES_WITHOUT_TREE))
        return true;
    const double start = rt_clock_seconds();
    const bool good = rt_bvh_build(&r->bvh, &r->scene, rt_parallel_processors(), &r->status);
    r->stats.accel = rt_clock_seconds() - start;
    *tree = &r->bvh;
    return good;
}

bool rt_run_draw_scalar(rt_run *r, bool in_double, rt_image *image)
{
    rt_run_begin_progress(r);
    const bool good =
        (in_double ? rt_scalar_double_render_counted : rt_scalar_float_render_counted)(
            &r->scene, image, &r->stats.scalar_rays, &r->watch, &r->status);
    rt_progress_clear(&r->progress);
    return good;
}
