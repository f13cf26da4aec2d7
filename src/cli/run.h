/* What every run on a scene opens, in one place, so that one function lets it go again. */
#ifndef RT_CLI_RUN_H
#define RT_CLI_RUN_H

#include "bvh/bvh.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/stats.h"
#include "common/status.h"
#include "common/watch.h"
#include "image/image.h"
#include "opencl/device.h"
#include "scene/effects.h"
#include "scene/scene.h"

typedef struct rt_run {
    rt_options options;
    rt_status status;
    double start; /* by rt_clock_seconds */
    rt_watch watch;
    rt_watch building; /* of kernels that are compiled */
    rt_progress progress;
    rt_scene scene;
    rt_effects effects; /* of the scene */
    int doubts;         /* warnings that rt_scene_check has given */
    rt_device_opening opening;
    rt_device_list devices;
    const rt_device **chosen; /* owned: room for all devices; NULL until they are chosen */
    size_t chosen_count;
    rt_bvh bvh;
    rt_stats stats; /* as far as it is known */
} rt_run;

/* From here on signals stop the run by its watches. */
void rt_run_heed(rt_run *run);

/* Each of these returns false after an error, which is in the run's status. */

/* Begins a run whose options are there: heeds signals, and while devices open it
 * reads the scene, as the options change it, and tells the warnings. */
bool rt_run_begin(rt_run *run);

/* Finds the devices to render on; there is nothing to find for the scalar path. */
bool rt_run_choose_devices(rt_run *run);

/* *tree is the run's, or NULL where every primitive is to be tried. */
bool rt_run_build_tree(rt_run *run, const rt_bvh **tree);

/* Renders the scene with the scalar path, which tells its progress. */
bool rt_run_draw_scalar(rt_run *run, bool in_double, rt_image *image);

/* After a failure: what came with a signal is no error of its own. Ctrl-C goes to the processes of
 * the kernels' compiler too, which then fails. */
void rt_run_heed_signals(rt_run *run);

/* Lets go what the run has opened, however far it came. */
void rt_run_end(rt_run *run);

/* Tells the warnings so far, unless the run is quiet, and forgets them. */
void rt_run_warn(rt_run *run);

/* From here on the watch tells the progress of one computation, until rt_progress_clear. */
void rt_run_begin_progress(rt_run *run);

#endif
