/* The trace kernel against Embree: primary, shadow and bounce rays, and the building of the tree.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "bench/building.h"
#include "bench/embree.h"
#include "bench/meshes.h"
#include "bench/ours.h"
#include "bench/rays.h"
#include "bench/report.h"
#include "bench/samples.h"

#define SIZE_DEFAULT 1024
/* rt, then Embree: single rays and packets of 16, as packaged and with the robust flag. */
#define TRACERS 5
#define NAME_SIZE 64

enum pass { PASS_PRIMARY, PASS_SHADOW, PASS_BOUNCE, PASS_COUNT };

static const struct {
    const char *name;
    bool any_hit, is_coherent;
} passes[PASS_COUNT] = {
    {"primary rays", false, true}, {"shadow rays", true, true}, {"bounce rays", false, false}};

/* Ratios wanted at the sizes for which there is a bar: full pictures of two meshes. */
static const struct {
    size_t triangles;
    double primary, with_shadow, bounce;
} bars[] = {{81920, 2.0, 1.75, 1.25}, {1310720, 1.5, 1.25, 1.0}};

/* One tracer in one pass. */
typedef struct turn {
    bench_ours *ours;     /* or */
    bench_embree *embree; /* the other is NULL */
    const bench_packets *packets;
    enum bench_call call;
    enum pass pass;
    uint8_t *is_hit; /* owned */
    char name[NAME_SIZE];
} turn;

/* Everything over one input. */
typedef struct match {
    const bench_input *input;
    bench_ours ours;
    bench_embree *fast, *robust;
    bench_rays rays[PASS_COUNT];
    bench_packets packets[PASS_COUNT];
    turn turns[PASS_COUNT][TRACERS];
    bench_contender contenders[PASS_COUNT][TRACERS];
} match;

static bool take_turn(void *context, double *seconds, rt_status *status)
{
    turn *t = context;
    if (t->ours)
        return bench_ours_trace(t->ours, t->packets->rays, passes[t->pass].any_hit, t->is_hit,
                                seconds, status);
    if (!bench_embree_trace(t->embree, t->packets, t->call, passes[t->pass].is_coherent, seconds,
                            status))
        return false;
    bench_embree_is_hit(t->embree, t->is_hit);
    return true;
}

/* Shadow and bounce rays start from Embree's hits, so that they stay the same while rt changes. */
static bool make_rays(bench *b, match *m)
{
    const rt_scene *scene = &m->input->scene;
    bench_rays *primary = &m->rays[PASS_PRIMARY];
    double seconds;
    if (!bench_rays_primary(primary, scene, &b->status) ||
        !bench_packets_make(&m->packets[PASS_PRIMARY], primary, &b->status) ||
        !(m->fast =
              bench_embree_new(m->input, false, b->settings.threads, primary->count, &b->status)) ||
        !(m->robust =
              bench_embree_new(m->input, true, b->settings.threads, primary->count, &b->status)) ||
        !bench_embree_trace(m->robust, &m->packets[PASS_PRIMARY], BENCH_INTERSECT1, true, &seconds,
                            &b->status))
        return false;
    rt_hit *hits = malloc(primary->count * sizeof *hits);
    if (!hits)
        return rt_status_no_memory(&b->status, "hits");
    bench_embree_hits(m->robust, hits);
    const bool good =
        bench_rays_shadow(&m->rays[PASS_SHADOW], scene, primary, hits,
                          b->settings.shadow_from_light, &b->status) &&
        bench_rays_bounce(&m->rays[PASS_BOUNCE], scene, primary, hits, &b->status) &&
        bench_packets_make(&m->packets[PASS_SHADOW], &m->rays[PASS_SHADOW], &b->status) &&
        bench_packets_make(&m->packets[PASS_BOUNCE], &m->rays[PASS_BOUNCE], &b->status);
    free(hits);
    return good;
}

static bool set_up_turns(bench *b, match *m, enum pass pass)
{
    for (int i = 0; i < TRACERS; ++i) {
        turn *t = &m->turns[pass][i];
        const bool is_robust = i > 2, is_packet = i == 2 || i == 4;
        const bool any_hit = passes[pass].any_hit;
        *t = (turn){.packets = &m->packets[pass], .pass = pass};
        if (i == 0)
            t->ours = &m->ours;
        else
            t->embree = is_robust ? m->robust : m->fast;
        t->call = any_hit ? (is_packet ? BENCH_OCCLUDED16 : BENCH_OCCLUDED1)
                          : (is_packet ? BENCH_INTERSECT16 : BENCH_INTERSECT1);
        t->is_hit = malloc(m->rays[pass].count);
        if (!t->is_hit)
            return rt_status_no_memory(&b->status, "hits");
        snprintf(t->name, sizeof t->name, "Embree%s rtc%s%s%s", is_robust ? " robust" : "",
                 any_hit ? "Occluded" : "Intersect", is_packet ? "16" : "1",
                 !is_packet                 ? ""
                 : passes[pass].is_coherent ? " coherent"
                                            : " incoherent");
        m->contenders[pass][i] =
            (bench_contender){.name = i ? t->name : "rt", .run = take_turn, .context = t};
    }
    return true;
}

static bench_agreement agreement_of(const turn *ours, const turn *theirs)
{
    bench_agreement a = {.rays = ours->packets->rays->count};
    for (size_t i = 0; i < a.rays; ++i) {
        a.ours += ours->is_hit[i];
        a.theirs += theirs->is_hit[i];
        a.apart += ours->is_hit[i] != theirs->is_hit[i];
    }
    return a;
}

/* The bar for a pass, or for primary and shadow rays together (PASS_SHADOW); 0 where there is none:
 * for other inputs, and against robust scenes as long as rt has no robust level. */
static double bar_of(const bench *b, const match *m, enum pass pass, int tracer)
{
    for (size_t i = 0; i < sizeof bars / sizeof *bars; ++i)
        if (m->input->scene.triangle_count == bars[i].triangles && tracer <= 2 &&
            m->input->scene.width == SIZE_DEFAULT && b->settings.threads == 2)
            return pass == PASS_PRIMARY  ? bars[i].primary
                   : pass == PASS_SHADOW ? bars[i].with_shadow
                                         : bars[i].bounce;
    return 0.0;
}

static bool report_pass(bench *b, const match *m, enum pass pass)
{
    const int repeats = b->settings.repeats;
    const bench_contender *ours = &m->contenders[pass][0];
    for (int i = 1; i < TRACERS; ++i) {
        const bench_contender *theirs = &m->contenders[pass][i];
        const bench_row row = {.what = passes[pass].name,
                               .input = m->input->label,
                               .against = theirs->name,
                               .unit = "s",
                               .ours = bench_quartiles_of(ours->seconds, repeats),
                               .theirs = bench_quartiles_of(theirs->seconds, repeats),
                               .ratio = bench_ratio(theirs->seconds, ours->seconds, repeats),
                               .bar = pass == PASS_SHADOW ? 0.0 : bar_of(b, m, pass, i),
                               .hits = agreement_of(&m->turns[pass][0], &m->turns[pass][i])};
        if (!bench_report_add(&b->report, &row, &b->status))
            return false;
    }
    return true;
}

/* Primary and shadow rays of one repeat, added up. */
static bool report_sum(bench *b, const match *m)
{
    const int repeats = b->settings.repeats;
    double *sums = malloc(2 * (size_t)repeats * sizeof *sums);
    if (!sums)
        return rt_status_no_memory(&b->status, "samples");
    double *ours = sums, *theirs = sums + repeats;
    bool good = true;
    for (int i = 1; good && i < TRACERS; ++i) {
        for (int k = 0; k < repeats; ++k) {
            ours[k] = m->contenders[PASS_PRIMARY][0].seconds[k] +
                      m->contenders[PASS_SHADOW][0].seconds[k];
            theirs[k] = m->contenders[PASS_PRIMARY][i].seconds[k] +
                        m->contenders[PASS_SHADOW][i].seconds[k];
        }
        char against[2 * NAME_SIZE];
        snprintf(against, sizeof against, "%s + %s", m->turns[PASS_PRIMARY][i].name,
                 m->turns[PASS_SHADOW][i].name + sizeof "Embree");
        const bench_row row = {.what = "primary + shadow rays",
                               .input = m->input->label,
                               .against = against,
                               .unit = "s",
                               .ours = bench_quartiles_of(ours, repeats),
                               .theirs = bench_quartiles_of(theirs, repeats),
                               .ratio = bench_ratio(theirs, ours, repeats),
                               .bar = bar_of(b, m, PASS_SHADOW, i)};
        good = bench_report_add(&b->report, &row, &b->status);
    }
    free(sums);
    return good;
}

static bool measure_passes(bench *b, match *m)
{
    for (int pass = 0; pass < PASS_COUNT; ++pass)
        if (!set_up_turns(b, m, (enum pass)pass) ||
            !bench_measure(m->contenders[pass], TRACERS, b->settings.repeats, &b->status) ||
            !report_pass(b, m, (enum pass)pass))
            return false;
    return report_sum(b, m);
}

static void clear_match(match *m)
{
    for (int pass = 0; pass < PASS_COUNT; ++pass) {
        for (int i = 0; i < TRACERS; ++i)
            free(m->turns[pass][i].is_hit);
        bench_contenders_clear(m->contenders[pass], TRACERS);
        bench_packets_clear(&m->packets[pass]);
        bench_rays_clear(&m->rays[pass]);
    }
    bench_embree_free(m->fast);
    bench_embree_free(m->robust);
    bench_ours_clear(&m->ours);
}

static bool measure_input(bench *b, const bench_input *input)
{
    match m = {.input = input};
    const size_t pixels = (size_t)input->scene.width * (size_t)input->scene.height;
    const bool good = make_rays(b, &m) &&
                      bench_ours_make(&m.ours, b->device, &input->scene, pixels, &b->status) &&
                      measure_passes(b, &m);
    clear_match(&m);
    return good && bench_measure_building(b, input);
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
    const bool meshes = s->level >= 0 ? measure_level(b, s->level)
                                      : measure_level(b, 6) && measure_level(b, 8) &&
                                            (!s->huge || measure_level(b, 10));
    return meshes && (s->spheres == 0 || measure_spheres(b));
}

int main(int argc, char **argv)
{
    return bench_main(argc, argv, measure_all);
}
