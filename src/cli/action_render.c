#include "cli/actions.h"
#include "cli/picture_check.h"
#include "cli/refine.h"
#include "common/clock.h"

typedef struct outputs {
    rt_output picture, hits, stats;
} outputs;

/* Opened before the work: a target that cannot be written is known at once. */
static bool open_outputs(rt_run *r, outputs *out)
{
    const rt_options *o = &r->options;
    return (!o->output || rt_output_open(&out->picture, o->output, &r->status)) &&
           (!o->hits || rt_output_open(&out->hits, o->hits, &r->status)) &&
           (!o->stats || rt_output_open(&out->stats, o->stats, &r->status));
}

static void discard_outputs(outputs *out)
{
    rt_output_discard(&out->picture);
    rt_output_discard(&out->hits);
    rt_output_discard(&out->stats);
}

static bool make_team(rt_run *r, bool with_hits, rt_team **team)
{
    const rt_render_options options = {.lanes = r->options.lanes,
                                       .tile = r->options.tile,
                                       .with_hits = with_hits,
                                       .effects = &r->effects,
                                       .building = &r->building};
    const rt_bvh *tree = NULL;
    if (!rt_run_build_tree(r, &tree))
        return false;
    rt_run_begin_progress(r);
    *team = rt_team_new(r->chosen, r->chosen_count, &r->scene, tree, &options, &r->status);
    rt_progress_clear(&r->progress);
    return *team != NULL;
}

/* Leaves *team NULL for the scalar path. */
static bool draw(rt_run *r, rt_image *image, rt_team **team)
{
    /* The scalar path has them anyway, and what a black picture hits is asked. */
    const bool with_hits = r->options.hits || r->options.verify || !r->chosen;
    if (!rt_image_init(image, r->scene.width, r->scene.height, with_hits, &r->status) ||
        (r->chosen && !make_team(r, with_hits, team)))
        return false;
    const double start = rt_clock_seconds();
    bool good;
    if (*team) {
        rt_run_begin_progress(r);
        good = rt_refine_is_asked(&r->options) ? rt_refine(r, *team, image)
                                               : rt_team_draw(*team, image, &r->watch, &r->status);
        rt_progress_clear(&r->progress);
    } else {
        good = rt_run_draw_scalar(r, r->options.target == RT_TARGET_SCALAR_DOUBLE, image);
    }
    r->stats.draw = rt_clock_seconds() - start;
    return good;
}

/* Less of the picture's light than this may be cut off without a word. */
#define CUT_UNSAID 1e-4

static void tell_what_is_cut(rt_run *r, const rt_team *team)
{
    const rt_ray_counts rays = team ? rt_team_times(team).rays : r->stats.scalar_rays;
    const double part = rt_ray_counts_cut_part(&rays);
    if (part < CUT_UNSAID)
        return;
    rt_status_warn(
        &r->status,
        "rt: warning: %zu mirror and refracted rays ended at 'depth %d': up to %.2g %% of "
        "the picture's light is missing; a greater 'depth' follows them on",
        rays.cut, r->scene.depth, 100.0 * part);
    rt_run_warn(r);
}

static bool write_picture(rt_run *r, const rt_image *image, outputs *out)
{
    const double start = rt_clock_seconds();
    const rt_options *o = &r->options;
    const bool good = (!o->output || (rt_image_write(image, o->format, &r->scene.encoding,
                                                     &out->picture, &r->status) &&
                                      rt_output_commit(&out->picture, &r->status))) &&
                      (!o->hits || (rt_image_write_hits(image, &out->hits, &r->status) &&
                                    rt_output_commit(&out->hits, &r->status)));
    r->stats.encode = rt_clock_seconds() - start;
    return good;
}

static bool write_stats(rt_run *r, const rt_team *team, rt_output *output)
{
    if (!r->options.stats)
        return true;
    rt_stats *s = &r->stats;
    s->target = r->options.target;
    s->scene = &r->scene;
    s->effects = &r->effects;
    s->team = team;
    s->total = rt_clock_seconds() - r->start;
    return rt_stats_write(s, output, &r->status) && rt_output_commit(output, &r->status);
}

bool rt_action_render(rt_run *r)
{
    outputs out = {RT_OUTPUT_INIT, RT_OUTPUT_INIT, RT_OUTPUT_INIT};
    rt_image image = {0};
    rt_team *team = NULL;
    bool good = rt_run_begin(r) && open_outputs(r, &out) && rt_run_choose_devices(r) &&
                draw(r, &image, &team) && rt_run_check_picture(r, &image);
    if (good) {
        tell_what_is_cut(r, team);
        /* A picture that differs is still written: it is what there is to look at. */
        const bool verified = !r->options.verify || rt_action_verify(r, &image);
        good = (verified || r->status.code == RT_DIFFERENT) && write_picture(r, &image, &out) &&
               write_stats(r, team, &out.stats) && verified;
    }
    rt_team_free(team);
    rt_image_clear(&image);
    discard_outputs(&out);
    return good;
}
