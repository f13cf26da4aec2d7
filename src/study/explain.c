#include "study/explain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/clock.h"

#define PAIRS 8
/* What all measured pictures together should take; where kernels are built that adds to it. */
#define BUDGET_SECONDS 40.0
/* The longer side of the first picture that is tried for size. */
#define SIDE_FIRST 64

rt_explanation rt_explain(const rt_scene *scene, const rt_effects *effects)
{
    return (rt_explanation){
        .effects = *effects, .picture_width = scene->width, .picture_height = scene->height};
}

/* Whether a stage is there for an effect alone, or for one of its kind. */
static bool is_own_stage(enum rt_effect effect, enum rt_stage stage)
{
    switch (effect) {
    case RT_EFFECT_HARD_SHADOWS:
    case RT_EFFECT_SOFT_SHADOWS:
        return stage == RT_STAGE_SHADOW_RAYS || stage == RT_STAGE_SHADOW ||
               stage == RT_STAGE_SHADOW_TALLY;
    case RT_EFFECT_AMBIENT_OCCLUSION:
        return stage == RT_STAGE_AMBIENT_RAYS || stage == RT_STAGE_AMBIENT ||
               stage == RT_STAGE_AMBIENT_TALLY;
    case RT_EFFECT_REFLECT:
    case RT_EFFECT_REFRACT:
        return stage == RT_STAGE_COUNT_NEXT || stage == RT_STAGE_PACK ||
               stage == RT_STAGE_NEXT_TRACE || stage == RT_STAGE_NEXT_SHADE;
    default:
        return false;
    }
}

static double own_stages(const rt_renderer *renderer, enum rt_effect effect)
{
    double seconds = 0.0;
    for (int stage = 0; stage < RT_STAGE_COUNT; ++stage)
        if (is_own_stage(effect, (enum rt_stage)stage))
            seconds += rt_renderer_times(renderer)->stages[stage];
    return seconds;
}

/* A scene with arrays of its own where an effect is taken away. */
static bool copy_scene(rt_scene *copy, const rt_scene *scene, rt_status *status)
{
    *copy = *scene;
    copy->materials = malloc((scene->material_count + 1) * sizeof *copy->materials);
    copy->lights = malloc((scene->light_count + 1) * sizeof *copy->lights);
    copy->triangle_normals = malloc((scene->triangle_count + 1) * sizeof(int32_t));
    if (!copy->materials || !copy->lights || !copy->triangle_normals) {
        free(copy->materials);
        free(copy->lights);
        free(copy->triangle_normals);
        return rt_status_no_memory(status, "a scene");
    }
    for (size_t i = 0; i < scene->material_count; ++i)
        copy->materials[i] = scene->materials[i];
    for (size_t i = 0; i < scene->light_count; ++i)
        copy->lights[i] = scene->lights[i];
    for (size_t i = 0; i < scene->triangle_count; ++i)
        copy->triangle_normals[i] = scene->triangle_normals[i];
    return true;
}

static void free_copy(rt_scene *copy)
{
    free(copy->materials);
    free(copy->lights);
    free(copy->triangle_normals);
}

/* What a measurement works on. */
typedef struct bench {
    const rt_bvh *bvh;
    const rt_device *device;
    const rt_render_options *options;
    const rt_effects *effects; /* all of the scene's */
    const rt_watch *outer;
    rt_watch watch;
    double done;            /* what the outer watch is told, whatever the part of one picture is */
    double picture_seconds; /* what one picture may take */
    rt_status *status;
} bench;

static bool tick(void *context, double done)
{
    const bench *b = context;
    (void)done;
    return rt_watch_tick(b->outer, b->done);
}

static rt_renderer *make_renderer(const bench *b, const rt_scene *scene, const rt_effects *effects)
{
    rt_render_options options = *b->options;
    options.effects = effects;
    options.building = &b->watch;
    return rt_renderer_new(b->device, scene, b->bvh, &options, b->status);
}

/* Adds the wall time of one picture. */
static bool draw(const bench *b, rt_renderer *renderer, rt_image *image, double *seconds)
{
    const double start = rt_clock_seconds();
    const bool good = rt_renderer_draw(renderer, image, &b->watch, b->status);
    *seconds = rt_clock_seconds() - start;
    return good;
}

/* Draws one picture to warm up, then one that counts. */
static bool time_size(const bench *b, const rt_scene *scene, double *seconds)
{
    rt_image image;
    if (!rt_image_init(&image, scene->width, scene->height, false, b->status))
        return false;
    rt_renderer *renderer = make_renderer(b, scene, b->effects);
    const bool good =
        renderer && draw(b, renderer, &image, seconds) && draw(b, renderer, &image, seconds);
    rt_renderer_free(renderer);
    rt_image_clear(&image);
    return good;
}

static int scale_side(int side, double factor)
{
    const double scaled = round(side * factor);
    return scaled < 1.0 ? 1 : scaled < side ? (int)scaled : side;
}

/* Makes the picture small enough; the way there begins with one that is small for certain. */
static bool choose_size(const bench *b, rt_scene *scene)
{
    const int width = scene->width, height = scene->height;
    const double longer = width > height ? width : height;
    double factor = SIDE_FIRST / longer;
    while (factor < 1.0) {
        double seconds = 0.0;
        scene->width = scale_side(width, factor);
        scene->height = scale_side(height, factor);
        if (!time_size(b, scene, &seconds))
            return false;
        /* Small pictures have a part of the time that does not grow: steps of twice the side. */
        if (seconds > 0.3 * b->picture_seconds)
            return true;
        factor *= 2.0;
    }
    scene->width = width;
    scene->height = height;
    return true;
}

/* Pairs of pictures, with the effect and without it, in turn. */
static bool draw_pairs(const bench *b, rt_renderer *with, rt_renderer *without, rt_image *image,
                       enum rt_effect effect, rt_explain_cost *cost)
{
    double stages[PAIRS], times[2][PAIRS], differences[PAIRS], warm = 0.0;
    if (!draw(b, with, image, &warm) || !draw(b, without, image, &warm))
        return false;
    for (int i = 0; i < PAIRS; ++i) {
        const double with_before = own_stages(with, effect);
        const double without_before = own_stages(without, effect);
        /* The second of a pair finds other caches and clocks than the first: each is it in turn. */
        for (int k = 0; k < 2; ++k) {
            const int which = (i + k) % 2;
            if (!draw(b, which ? without : with, image, &times[which][i]))
                return false;
        }
        stages[i] =
            own_stages(with, effect) - with_before - (own_stages(without, effect) - without_before);
        differences[i] = times[0][i] - times[1][i];
    }
    cost->is_measured = true;
    for (int stage = 0; stage < RT_STAGE_COUNT; ++stage)
        cost->has_stages = cost->has_stages || is_own_stage(effect, (enum rt_stage)stage);
    cost->stages = rt_spread_of(stages, PAIRS);
    cost->with = rt_spread_of(times[0], PAIRS);
    cost->without = rt_spread_of(times[1], PAIRS);
    cost->difference = rt_spread_of(differences, PAIRS);
    return true;
}

static bool measure_effect(const bench *b, const rt_scene *scene, rt_renderer *with,
                           rt_image *image, enum rt_effect effect, rt_explain_cost *cost)
{
    rt_scene less;
    if (!copy_scene(&less, scene, b->status))
        return false;
    rt_effects_remove(&less, effect);
    const rt_effects effects = rt_effects_of(&less);
    rt_renderer *without = make_renderer(b, &less, &effects);
    const bool good = without && draw_pairs(b, with, without, image, effect, cost);
    rt_renderer_free(without);
    free_copy(&less);
    return good;
}

bool rt_explain_measure(rt_explanation *e, const rt_scene *scene, const rt_bvh *bvh,
                        const rt_device *device, const rt_render_options *options,
                        const rt_watch *watch, rt_status *status)
{
    bench b = {bvh, device, options, &e->effects, watch, {tick, NULL}, 0.0, 0.0, status};
    int count = 0;
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        count += e->effects.on[i];
    if (count == 0)
        return true;
    b.watch.context = &b;
    b.picture_seconds = BUDGET_SECONDS / (2 * (PAIRS + 1) * count);
    rt_scene small = *scene; /* shares all arrays, and is never cleared */
    rt_image image = {0};
    rt_renderer *with = NULL;
    bool good = choose_size(&b, &small) &&
                rt_image_init(&image, small.width, small.height, false, status) &&
                (with = make_renderer(&b, &small, b.effects)) != NULL;
    for (int i = 0; good && i < RT_EFFECT_COUNT; ++i) {
        b.done = (double)i / (int)RT_EFFECT_COUNT;
        if (e->effects.on[i])
            good = measure_effect(&b, &small, with, &image, (enum rt_effect)i, &e->costs[i]);
    }
    rt_renderer_free(with);
    rt_image_clear(&image);
    e->device = device;
    e->width = small.width;
    e->height = small.height;
    e->pairs = PAIRS;
    return good;
}
