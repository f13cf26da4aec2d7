#include "bench/building.h"

#include "bench/embree.h"
#include "bench/ours.h"

/* The smallest mesh whose tree takes long enough for a bar. */
#define BAR_FROM 80000

typedef struct job {
    const bench_input *input;
    int threads;
} job;

static bool build_ours(void *context, double *seconds, rt_status *status)
{
    const job *j = context;
    return bench_ours_build(&j->input->scene, seconds, status);
}

static bool build_theirs(void *context, double *seconds, rt_status *status)
{
    const job *j = context;
    bench_embree *e = bench_embree_new(j->input, false, j->threads, 0, status);
    if (!e)
        return false;
    *seconds = bench_embree_build_seconds(e);
    bench_embree_free(e);
    return true;
}

bool bench_measure_building(bench *b, const bench_input *input)
{
    job j = {input, b->settings.threads};
    bench_contender c[2] = {{.name = "rt", .run = build_ours, .context = &j},
                            {.name = "Embree", .run = build_theirs, .context = &j}};
    const int repeats = b->settings.repeats;
    bool good = bench_measure(c, 2, repeats, &b->status);
    if (good) {
        const bench_row row = {.what = "building the tree",
                               .input = input->label,
                               .against = "Embree rtcCommitScene, default quality",
                               .unit = "s",
                               .ours = bench_quartiles_of(c[0].seconds, repeats),
                               .theirs = bench_quartiles_of(c[1].seconds, repeats),
                               .ratio = bench_ratio(c[1].seconds, c[0].seconds, repeats),
                               .bar = input->scene.triangle_count >= BAR_FROM ? 1.0 : 0.0};
        good = bench_report_add(&b->report, &row, &b->status);
    }
    bench_contenders_clear(c, 2);
    return good;
}
