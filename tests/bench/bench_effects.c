/* What it is worth to compile only what a scene calls for. First against kernels that have every
 * effect and are switched at run time: pictures, builds, and after how many pictures a build of its
 * own has paid for itself. Then against one kernel written by hand for one kind of scene, in which
 * nothing lies between the stages. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "bench/fused.h"
#include "bench/samples.h"
#include "bench/switched.h"
#include "common/clock.h"
#include "common/parallel.h"
#include "render/renderer.h"
#include "scene_file/read.h"

#define SIZE_DEFAULT 512
/* The longer side of the pictures with effects, most of which have several samples a pixel. */
#define SIZE_EFFECTS 384
/* Pictures in a turn: one takes a millisecond. */
#define PICTURES 10
/* The most time that the stages may take of the one kernel's. */
#define BAR_FUSED 1.05

static const char *const scenes[] = {"icecream", "sphere", "triangle-spheres", "mesh", "mirrors",
                                     "glass",    "soft",   "gallery"};
#define SCENES (sizeof scenes / sizeof *scenes)

/* ---- Everything against what the scene calls for ---- */

static bool add_single(bench *b, const char *what, const bench_switched *s, const char *against,
                       const char *unit, double ours, double theirs)
{
    const bench_row row = {.what = what,
                           .input = s->input,
                           .against = against,
                           .unit = unit,
                           .ours = {ours, ours, ours},
                           .theirs = {theirs, theirs, theirs},
                           .ratio = {theirs / ours, theirs / ours, theirs / ours}};
    return bench_report_add(&b->report, &row, &b->status);
}

static bool report_switched(bench *b, const bench_switched *s)
{
    const bench_row row = {.what = "picture, kernels alone",
                           .input = s->input,
                           .against = "--effects all",
                           .unit = "s",
                           .ours = s->frame[0],
                           .theirs = s->frame[1],
                           .ratio = s->ratio};
    const double pictures = bench_switched_pictures(s);
    printf("| %s | %.3g | %.3g | %.2f (%.2f to %.2f) | %.2f | %.2f | %.0f | %.0f | ", s->input,
           1e3 * s->frame[0].median, 1e3 * s->frame[1].median, s->ratio.median, s->ratio.low,
           s->ratio.high, s->build[0], s->build[1], (double)s->binary[0] / 1024.0,
           (double)s->binary[1] / 1024.0);
    if (isfinite(pictures))
        printf("%.0f | %.3g |\n", ceil(pictures), 1e-6 * pictures * s->width * s->height);
    else
        printf("never | |\n");
    fflush(stdout);
    return bench_report_add(&b->report, &row, &b->status) &&
           add_single(b, "build of the kernels, cold", s, "--effects all", "s", s->build[0],
                      s->build[1]) &&
           add_single(b, "binary of the kernels", s, "--effects all", "KiB",
                      (double)s->binary[0] / 1024.0, (double)s->binary[1] / 1024.0) &&
           add_single(b, "pictures until the build is paid for", s, "--effects all, ready",
                      "pictures", pictures, NAN);
}

static bool measure_switched(bench *b)
{
    const int size = b->settings.size ? b->settings.size : SIZE_EFFECTS;
    puts("| scene | what it calls for, ms | everything, ms | ratio | build, s | build, s | binary, "
         "KiB | binary, KiB | paid for after pictures | million pixels |\n"
         "|---|---|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < SCENES; ++i) {
        bench_switched s;
        if (!bench_switched_measure(&s, b, scenes[i], size) || !report_switched(b, &s))
            return false;
    }
    puts("");
    return true;
}

/* ---- Stages against one kernel ---- */

/* One who draws, with the wall seconds a picture besides the kernels'. */
typedef struct drawer {
    rt_renderer *renderer; /* owned; NULL for one of the fused */
    bench_fused fused;     /* owned */
    rt_image image;        /* owned */
    double *walls;         /* owned: one value a repeat, the warm-up before them */
    int turns;
} drawer;

enum { STAGES, FUSED_TREE, FUSED_BRUTE, FUSED_BRUTE_VECTOR, DRAWERS };
static const char *const names[DRAWERS] = {"the stages", "one kernel, tree",
                                           "one kernel, every primitive",
                                           "one kernel, every primitive, 16 rays at a time"};

static bool draw_once(drawer *d, double *seconds, rt_status *status)
{
    if (!d->renderer)
        return bench_fused_draw(&d->fused, d->image.rgb, seconds, status);
    const rt_render_times *times = rt_renderer_times(d->renderer);
    double sum = 0.0;
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        sum -= times->stages[i];
    if (!rt_renderer_draw(d->renderer, &d->image, NULL, status))
        return false;
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        sum += times->stages[i];
    *seconds = sum;
    return true;
}

static bool take_turn(void *context, double *seconds, rt_status *status)
{
    drawer *d = context;
    const double start = rt_clock_seconds();
    *seconds = 0.0;
    for (int i = 0; i < PICTURES; ++i) {
        double one;
        if (!draw_once(d, &one, status))
            return false;
        *seconds += one / PICTURES;
    }
    d->walls[d->turns++] = (rt_clock_seconds() - start) / PICTURES;
    return true;
}

static bool make_drawers(bench *b, const rt_scene *scene, const rt_bvh *bvh, drawer *drawers)
{
    const rt_render_options options = {0};
    const int lanes = rt_device_lanes(b->device, scene->accuracy);
    for (int i = 0; i < DRAWERS; ++i) {
        drawer *d = &drawers[i];
        d->walls = malloc(((size_t)b->settings.repeats + 1) * sizeof *d->walls);
        if (!d->walls)
            return rt_status_no_memory(&b->status, "times");
        if (!rt_image_init(&d->image, scene->width, scene->height, false, &b->status))
            return false;
    }
    drawers[STAGES].renderer = rt_renderer_new(b->device, scene, bvh, &options, &b->status);
    return drawers[STAGES].renderer &&
           bench_fused_make(&drawers[FUSED_TREE].fused, b->device, scene, bvh, RT_BLOCK_RAYS,
                            &b->status) &&
           bench_fused_make(&drawers[FUSED_BRUTE].fused, b->device, scene, NULL, RT_BLOCK_RAYS,
                            &b->status) &&
           bench_fused_make(&drawers[FUSED_BRUTE_VECTOR].fused, b->device, scene, NULL, lanes,
                            &b->status);
}

static bool report_pair(bench *b, const char *what, const char *input, const char *against,
                        const double *ours, const double *theirs, double bar)
{
    const int repeats = b->settings.repeats;
    const bench_row row = {.what = what,
                           .input = input,
                           .against = against,
                           .unit = "s",
                           .ours = bench_quartiles_of(ours, repeats),
                           .theirs = bench_quartiles_of(theirs, repeats),
                           .ratio = bench_ratio(theirs, ours, repeats),
                           .bar = bar};
    return bench_report_add(&b->report, &row, &b->status);
}

/* Where the stages' time goes: seconds and launches a picture, over all pictures so far. */
static void print_stages(const drawer *stages, const char *input)
{
    const rt_render_times *times = rt_renderer_times(stages->renderer);
    const double pictures = (double)stages->turns * PICTURES;
    printf("\n%s, a picture:", input);
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        if (times->launches[i])
            printf(" %s %.3f ms in %.0f,", rt_stage_name((enum rt_stage)i),
                   1e3 * times->stages[i] / pictures, (double)times->launches[i] / pictures);
    printf(" reads %.3f ms\n\n", 1e3 * times->readback / pictures);
}

/* Against each of the fused; the bar is for the fastest of them. */
static bool report_fused(bench *b, const char *input, const bench_contender *c,
                         const drawer *drawers)
{
    const int repeats = b->settings.repeats;
    double medians[DRAWERS];
    int best = FUSED_TREE;
    for (int i = 0; i < DRAWERS; ++i)
        medians[i] = bench_quartiles_of(c[i].seconds, repeats).median;
    for (int i = FUSED_TREE; i < DRAWERS; ++i)
        best = medians[i] < medians[best] ? i : best;
    puts("| picture | by | kernels, ms | the stages' time of it | with reading it back, ms |\n"
         "|---|---|---|---|---|");
    for (int i = 0; i < DRAWERS; ++i) {
        const bench_quartiles cost = bench_ratio(c[STAGES].seconds, c[i].seconds, repeats);
        const double wall = bench_quartiles_of(drawers[i].walls + 1, repeats).median;
        printf("| %s | %s | %.3f | %.3f (%.3f to %.3f) | %.3f |\n", input, names[i],
               1e3 * medians[i], cost.median, cost.low, cost.high, 1e3 * wall);
    }
    print_stages(&drawers[STAGES], input);
    for (int i = FUSED_TREE; i < DRAWERS; ++i) {
        const double bar = i == best && b->settings.threads == 2 ? 1.0 / BAR_FUSED : 0.0;
        if (!report_pair(b, "picture, kernels alone", input, names[i], c[STAGES].seconds,
                         c[i].seconds, bar))
            return false;
    }
    return report_pair(b, "picture, with reading it back", input, names[best],
                       drawers[STAGES].walls + 1, drawers[best].walls + 1, 0.0);
}

static bool measure_drawers(bench *b, const rt_scene *scene, const rt_bvh *bvh, const char *input)
{
    drawer drawers[DRAWERS] = {{.renderer = NULL}};
    bench_contender contenders[DRAWERS] = {{.name = NULL}};
    bool good = make_drawers(b, scene, bvh, drawers);
    for (int i = 0; i < DRAWERS; ++i)
        contenders[i] =
            (bench_contender){.name = names[i], .run = take_turn, .context = &drawers[i]};
    good = good && bench_measure(contenders, DRAWERS, b->settings.repeats, &b->status);
    for (int i = FUSED_TREE; good && i < DRAWERS; ++i) {
        const rt_image_difference apart =
            rt_image_compare(&drawers[STAGES].image, &drawers[i].image);
        if (apart.max_step > 1 || apart.non_finite > 0)
            good = rt_status_fail(&b->status, RT_DIFFERENT,
                                  "bench: %s: %s differs from the stages by %d steps", input,
                                  names[i], apart.max_step);
    }
    good = good && report_fused(b, input, contenders, drawers);
    bench_contenders_clear(contenders, DRAWERS);
    for (int i = 0; i < DRAWERS; ++i) {
        rt_renderer_free(drawers[i].renderer);
        bench_fused_clear(&drawers[i].fused);
        rt_image_clear(&drawers[i].image);
        free(drawers[i].walls);
    }
    return good;
}

static bool measure_fused(bench *b, int size)
{
    char input[64];
    rt_scene scene;
    rt_bvh bvh = {0};
    rt_scene_init(&scene);
    bool good = rt_scene_read(&scene, "scenes/icecream.txt", &b->status);
    scene.accuracy = RT_ACCURACY_STANDARD; /* fused.cl's */
    scene.width = scene.height = size;
    snprintf(input, sizeof input, "icecream %dx%d", size, size);
    good = good && rt_bvh_build(&bvh, &scene, rt_parallel_processors(), &b->status) &&
           bench_find_device(b) && measure_drawers(b, &scene, &bvh, input);
    rt_bvh_clear(&bvh);
    rt_scene_clear(&scene);
    return good;
}

static bool measure_all(bench *b)
{
    const int size = b->settings.size;
    if (!measure_switched(b))
        return false;
    return size ? measure_fused(b, size)
                : measure_fused(b, SIZE_DEFAULT) && measure_fused(b, 2 * SIZE_DEFAULT);
}

int main(int argc, char **argv)
{
    return bench_main(argc, argv, measure_all);
}
