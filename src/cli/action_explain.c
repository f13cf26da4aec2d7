#include <stdio.h>
#include <string.h>

#include "cli/actions.h"
#include "study/explain.h"

static bool measure(rt_run *r, rt_explanation *e)
{
    const rt_render_options options = {.lanes = r->options.lanes, .tile = r->options.tile};
    const rt_bvh *tree = NULL;
    if (!rt_run_choose_devices(r) || !rt_run_build_tree(r, &tree))
        return false;
    rt_run_begin_progress(r);
    const bool good =
        rt_explain_measure(e, &r->scene, tree, r->chosen[0], &options, &r->watch, &r->status);
    rt_progress_clear(&r->progress);
    return good;
}

/* The table, unless standard output is to have the figures, and the figures for `stats`. */
static bool tell(rt_run *r, const rt_explanation *e, rt_output *stats)
{
    if (!r->options.stats || strcmp(r->options.stats, "-") != 0)
        rt_explain_print(e, stdout);
    return !r->options.stats ||
           (rt_explain_write(e, stats, &r->status) && rt_output_commit(stats, &r->status));
}

bool rt_action_explain(rt_run *r)
{
    rt_output stats = RT_OUTPUT_INIT;
    if (!rt_run_begin(r) ||
        (r->options.stats && !rt_output_open(&stats, r->options.stats, &r->status)))
        return false;
    rt_explanation e = rt_explain(&r->scene, &r->effects);
    const bool good = (r->options.no_cost || measure(r, &e)) && tell(r, &e, &stats);
    rt_output_discard(&stats);
    return good;
}
