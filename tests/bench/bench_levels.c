/* What each level of accuracy costs: the trace kernel at every level against `fast`, over the same
 * rays and the same tree, in turns within one run. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "bench/meshes.h"
#include "bench/ours.h"
#include "bench/rays.h"
#include "bench/report.h"
#include "bench/samples.h"

#define SIZE_DEFAULT 1024

enum pass { PASS_PRIMARY, PASS_SHADOW, PASS_BOUNCE, PASS_COUNT };

static const struct {
    const char *name;
    bool any_hit;
} passes[PASS_COUNT] = {{"primary rays", false}, {"shadow rays", true}, {"bounce rays", false}};

/* The most time that a level may take of fast's: full pictures of the mesh of 82 k triangles. */
#define BAR_TRIANGLES 81920
static const double bars[RT_ACCURACY_COUNT] = {
    [RT_ACCURACY_STANDARD] = 1.03, [RT_ACCURACY_ROBUST] = 1.10};

/* One level in one pass. */
typedef struct turn {
    bench_ours *ours;
    const bench_rays *rays;
    uint8_t *is_hit; /* owned */
    bool any_hit;
} turn;

/* Everything over one input. */
typedef struct match {
    bench_input *input;
    bench_ours ours[RT_ACCURACY_COUNT];
    bench_rays rays[PASS_COUNT];
    turn turns[RT_ACCURACY_COUNT];
    bench_contender contenders[RT_ACCURACY_COUNT];
    int levels; /* the device may lack the last one */
} match;

static bool take_turn(void *context, double *seconds, rt_status *status)
{
    turn *t = context;
    return bench_ours_trace(t->ours, t->rays, t->any_hit, t->is_hit, seconds, status);
}

/* Shadow and bounce rays start from the hits at standard, for every level. */
static bool make_rays(bench *b, match *m)
{
    const rt_scene *scene = &m->input->scene;
    bench_rays *primary = &m->rays[PASS_PRIMARY];
    bench_ours *standard = &m->ours[RT_ACCURACY_STANDARD];
    return bench_rays_primary(primary, scene, &b->status) &&
           rt_renderer_trace(standard->renderer, primary->rays, primary->count, standard->hits,
                             &b->status) &&
           bench_rays_shadow(&m->rays[PASS_SHADOW], scene, primary, standard->hits,
                             b->settings.shadow_from_light, &b->status) &&
           bench_rays_bounce(&m->rays[PASS_BOUNCE], scene, primary, standard->hits, &b->status);
}

static bool make_levels(bench *b, match *m)
{
    rt_scene *scene = &m->input->scene;
    const size_t pixels = (size_t)scene->width * (size_t)scene->height;
    m->levels = b->device->has_fp64 ? RT_ACCURACY_COUNT : RT_ACCURACY_DOUBLE;
    for (int i = 0; i < m->levels; ++i) {
        scene->accuracy = (enum rt_accuracy)i;
        if (!bench_ours_make(&m->ours[i], b->device, scene, pixels, &b->status))
            return false;
    }
    return true;
}

static double bar_of(const bench *b, const match *m, enum pass pass, int level)
{
    const bool has_bar = pass == PASS_PRIMARY && m->input->scene.triangle_count == BAR_TRIANGLES &&
                         m->input->scene.width == SIZE_DEFAULT && b->settings.threads == 2;
    return has_bar && bars[level] > 0.0 ? 1.0 / bars[level] : 0.0;
}

static bool report_pass(bench *b, match *m, enum pass pass)
{
    const int repeats = b->settings.repeats;
    const bench_contender *fast = &m->contenders[RT_ACCURACY_FAST];
    for (int i = RT_ACCURACY_STANDARD; i < m->levels; ++i) {
        const bench_contender *level = &m->contenders[i];
        const bench_row row = {.what = passes[pass].name,
                               .input = m->input->label,
                               .against = i == RT_ACCURACY_STANDARD ? "fast (ours: standard)"
                                          : i == RT_ACCURACY_ROBUST ? "fast (ours: robust)"
                                                                    : "fast (ours: double)",
                               .unit = "s",
                               .ours = bench_quartiles_of(level->seconds, repeats),
                               .theirs = bench_quartiles_of(fast->seconds, repeats),
                               .ratio = bench_ratio(fast->seconds, level->seconds, repeats),
                               .bar = bar_of(b, m, pass, i)};
        const bench_quartiles cost = bench_ratio(level->seconds, fast->seconds, repeats);
        printf("%-13s %-18s %-9s %8.3f ms  %6.3f of fast (%.3f to %.3f)\n", passes[pass].name,
               m->input->label, level->name, 1e3 * row.ours.median, cost.median, cost.low,
               cost.high);
        if (!bench_report_add(&b->report, &row, &b->status))
            return false;
    }
    return true;
}

static bool measure_pass(bench *b, match *m, enum pass pass)
{
    for (int i = 0; i < m->levels; ++i) {
        turn *t = &m->turns[i];
        free(t->is_hit);
        *t = (turn){&m->ours[i], &m->rays[pass], malloc(m->rays[pass].count), passes[pass].any_hit};
        if (!t->is_hit)
            return rt_status_no_memory(&b->status, "hits");
        m->contenders[i] = (bench_contender){
            .name = rt_accuracy_name((enum rt_accuracy)i), .run = take_turn, .context = t};
    }
    const bool good =
        bench_measure(m->contenders, (size_t)m->levels, b->settings.repeats, &b->status) &&
        report_pass(b, m, pass);
    bench_contenders_clear(m->contenders, (size_t)m->levels);
    return good;
}

static bool measure_input(bench *b, bench_input *input)
{
    match m = {.input = input};
    bool good = make_levels(b, &m) && make_rays(b, &m);
    for (int pass = 0; good && pass < PASS_COUNT; ++pass)
        good = measure_pass(b, &m, (enum pass)pass);
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i) {
        free(m.turns[i].is_hit);
        bench_ours_clear(&m.ours[i]);
    }
    for (int pass = 0; pass < PASS_COUNT; ++pass)
        bench_rays_clear(&m.rays[pass]);
    return good;
}

static bool measure_level(bench *b, int level)
{
    bench_input input;
    const bool good = bench_input_icosphere(&input, 1u << level, b->settings.size, &b->status) &&
                      measure_input(b, &input);
    bench_input_clear(&input);
    return good;
}

static bool measure_spheres(bench *b)
{
    bench_input input;
    const bool good =
        bench_input_spheres(&input, (size_t)b->settings.spheres, b->settings.size, &b->status) &&
        measure_input(b, &input);
    bench_input_clear(&input);
    return good;
}

static bool measure_all(bench *b)
{
    bench_settings *s = &b->settings;
    if (s->size == 0)
        s->size = SIZE_DEFAULT;
    if (!bench_find_device(b))
        return false;
    const bool meshes =
        s->level >= 0 ? measure_level(b, s->level) : measure_level(b, 6) && measure_level(b, 8);
    return meshes && (s->spheres == 0 || measure_spheres(b));
}

int main(int argc, char **argv)
{
    return bench_main(argc, argv, measure_all);
}
