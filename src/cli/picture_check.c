#include "cli/picture_check.h"

#include "cli/signals.h"
#include "render/renderer.h"
#include "scene/backdrop.h"
#include "scene/check.h"

/* Two, so that the kernels that are there for several samples do. */
#define SAMPLES_MOST 2

static bool has_hits(const rt_image *image)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; ++i)
        if (image->hits[i].primitive != RT_MISS)
            return true;
    return false;
}

/* Draws the picture again, on the first device and with the kernels that are there. */
static bool draw_hits(rt_run *r, rt_image *image)
{
    const rt_render_options options = {.lanes = r->options.lanes,
                                       .with_hits = true,
                                       .effects = &r->effects,
                                       .building = &rt_signals_watch};
    const rt_bvh *tree = r->bvh.node_count ? &r->bvh : NULL;
    rt_scene scene = r->scene; /* its arrays are shared */
    if (scene.samples > SAMPLES_MOST)
        scene.samples = SAMPLES_MOST;
    if (!rt_image_init(image, scene.width, scene.height, true, &r->status))
        return false;
    rt_renderer *renderer = rt_renderer_new(r->chosen[0], &scene, tree, &options, &r->status);
    const bool good = renderer && rt_renderer_draw(renderer, image, &rt_signals_watch, &r->status);
    rt_renderer_free(renderer);
    return good;
}

static bool find_hits(rt_run *r, const rt_image *image, bool *hits)
{
    if (image->hits) {
        *hits = has_hits(image);
        return true;
    }
    rt_image again;
    const bool good = draw_hits(r, &again);
    *hits = good && has_hits(&again);
    rt_image_clear(&again);
    return good;
}

bool rt_run_check_picture(rt_run *r, const rt_image *image)
{
    bool hits = false;
    if (r->options.quiet || !r->effects.has_primitives)
        return true;
    const bool is_black = rt_scene_is_black(&r->scene, image);
    if (!is_black && !rt_scene_is_backdrop(&r->scene, image))
        return true;
    if (!find_hits(r, image, &hits))
        return false;
    if (!hits)
        rt_scene_warn_of_view(&r->scene, &r->status);
    else if (is_black && r->doubts == 0)
        rt_scene_warn_of_black(&r->scene, &r->status);
    rt_run_warn(r);
    return true;
}
