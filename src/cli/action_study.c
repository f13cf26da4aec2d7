#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>

#include "cli/actions.h"
#include "cli/signals.h"
#include "study/report.h"
#include "study/study.h"
#include "study/study_json.h"

static bool measure(rt_run *r, rt_study *study, rt_study_strip *strip)
{
    const rt_options *o = &r->options;
    const rt_bvh *tree = NULL;
    if (!rt_run_choose_devices(r) || !rt_run_build_tree(r, &tree))
        return false;
    if (r->chosen_count > RT_STUDY_DEVICES_MOST)
        return rt_status_fail(&r->status, RT_ERROR_USAGE,
                              "rt: --study compares up to %d devices, and --device names %zu",
                              RT_STUDY_DEVICES_MOST, r->chosen_count);
    const rt_study_how how = {.devices = r->chosen,
                              .device_count = r->chosen_count,
                              .bvh = tree,
                              .lanes = o->lanes,
                              .tile = o->tile,
                              .effects = o->effects};
    rt_run_begin_progress(r);
    const bool good =
        rt_study_run(study, strip, &r->scene, o->scene, &o->plan, &how, &r->watch, &r->status);
    rt_progress_clear(&r->progress);
    return good;
}

bool rt_action_study(rt_run *r)
{
    rt_study study = {0};
    rt_study_strip strip = {0};
    rt_study_report report;
    rt_study_report_init(&report);
    bool good =
        rt_run_begin(r) && rt_study_report_open(&report, r->options.study, false, &r->status);
    if (good)
        rt_run_warn(r); /* of what will be missing, before the work */
    good = good && measure(r, &study, &strip) &&
           rt_study_report_write(&report, &study, &strip, &r->watch, &r->status);
    if (good) {
        rt_run_warn(r);
        rt_study_report_tell(&report, &study, stdout);
    }
    rt_study_report_clear(&report);
    rt_study_strip_clear(&strip);
    rt_study_clear(&study);
    return good;
}

/* REPORT.json is REPORT, whose other files are made anew. */
bool rt_action_plot(rt_run *r)
{
    rt_study study = {0};
    rt_study_report report;
    rt_signals_catch();
    rt_study_report_init(&report);
    char *name = strdup(r->options.plot);
    if (!name)
        return rt_status_no_memory(&r->status, "a path");
    name[strlen(name) - strlen(RT_PLOT_ENDING)] = '\0';
    const bool good = rt_study_read_json(&study, r->options.plot, &r->status) &&
                      rt_study_report_open(&report, name, true, &r->status) &&
                      rt_study_report_write(&report, &study, NULL, &rt_signals_watch, &r->status);
    if (good) {
        rt_run_warn(r);
        rt_study_report_tell(&report, &study, stdout);
    }
    rt_study_report_clear(&report);
    rt_study_clear(&study);
    free(name);
    return good;
}
