#include "cli/actions.h"
#include "study/report.h"
#include "study/study.h"

static bool measure(rt_run *r, rt_study *study)
{
    const rt_options *o = &r->options;
    const rt_bvh *tree = NULL;
    if (!rt_run_choose_devices(r) || !rt_run_build_tree(r, &tree))
        return false;
    const rt_study_how how = {.device = r->chosen[0],
                              .bvh = tree,
                              .lanes = o->lanes,
                              .tile = o->tile,
                              .effects = o->effects};
    rt_run_begin_progress(r);
    const bool good =
        rt_study_run(study, &r->scene, o->scene, &o->plan, &how, &r->watch, &r->status);
    rt_progress_clear(&r->progress);
    return good;
}

bool rt_action_study(rt_run *r)
{
    rt_study study = {0};
    rt_study_files files = RT_STUDY_FILES_INIT;
    /* Opened before the work: a target that cannot be written is known at once. */
    const bool good =
        rt_run_begin(r) && rt_study_files_open(&files, r->options.study, &r->status) &&
        measure(r, &study) && rt_study_files_write(&files, &study, &r->watch, &r->status);
    if (good)
        rt_run_warn(r);
    rt_study_files_discard(&files);
    rt_study_clear(&study);
    return good;
}
