/* Closed meshes hold water, and no ray crosses one twice at a time: rows 1 to 8 of the hard cases.
 * That a ray from inside crosses a closed mesh once is topology, true whatever is rounded. */
#define _GNU_SOURCE
#include "hard/mesh.h"
#include "hard/naive.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define BALL 10 /* 800 triangles */
#define SMALL 3 /* 72, for brute force */
#define TOLD HARD_REPORT

/* A mesh and what to aim at. `part` of the rays of a full measurement. */
typedef struct subject {
    int n;
    double center[3], size;
    enum hard_aim aim;
    size_t part;
} subject;

static void measure_ball(const hard_way *way, const void *of, double figures[])
{
    const subject *s = of;
    hard_mesh mesh;
    hard_mesh_ball(&mesh, way->naive ? SMALL : s->n, s->center, s->size);
    size_t count = hard_rays(way);
    count = way->naive || count < 100 * s->part ? count : count / s->part;
    const hard_crossings c = hard_count(way, &mesh, s->aim, count);
    figures[0] = hard_per_million(c.none, c.rays);
    figures[1] = hard_per_million(c.several, c.rays);
    hard_mesh_clear(&mesh);
}

#define LEAKS(fast, standard)                                                                      \
    {                                                                                              \
        "leaks a million",                                                                         \
        {                                                                                          \
            fast, standard, 0, 0                                                                   \
        }                                                                                          \
    }
#define TWICE                                                                                      \
    {                                                                                              \
        "hit twice a million",                                                                     \
        {                                                                                          \
            TOLD, TOLD, 0, 0                                                                       \
        }                                                                                          \
    }

static void random_rays(void **state)
{
    (void)state;
    const subject s = {BALL, {0, 0, 0}, 1.0, HARD_AIM_ANYWHERE, 1};
    /* One in ten million is what plain Moller-Trumbore loses: a variant that can be shown to fail
     * on random rays has to be worse. */
    const hard_case c = {.row = 1,
                         .name = "closed mesh, random rays",
                         .figures = {LEAKS(1, 1), TWICE},
                         .naives = {&hard_naive_inside},
                         .measure = measure_ball,
                         .of = &s};
    hard_hold(&c);
    hard_finish();
}

static void aimed_rays(void **state)
{
    (void)state;
    static const enum hard_aim aims[] = {HARD_AIM_EDGES, HARD_AIM_VERTICES};
    static const char *const names[] = {"closed mesh, aimed at edges",
                                        "closed mesh, aimed at vertices"};
    /* Plain Woop loses edges when it is contracted; vertices, as it happens, it does not. */
    for (int i = 0; i < 2; ++i) {
        const subject s = {BALL, {0, 0, 0}, 1.0, aims[i], 1};
        const hard_case c = {.row = 2 + i,
                             .name = names[i],
                             .figures = {LEAKS(TOLD, TOLD), TWICE},
                             .naives = {&hard_naive_moller, i ? NULL : &hard_naive_woop},
                             .measure = measure_ball,
                             .of = &s};
        hard_hold(&c);
    }
    hard_finish();
}

static void aimed_rays_by_brute_force(void **state)
{
    (void)state;
    static const enum hard_aim aims[] = {HARD_AIM_EDGES, HARD_AIM_VERTICES};
    static const char *const names[] = {"aimed at edges, no tree", "aimed at vertices, no tree"};
    for (int i = 0; i < 2; ++i) {
        const subject s = {SMALL, {0, 0, 0}, 1.0, aims[i], 2};
        const hard_case c = {.row = 2 + i,
                             .name = names[i],
                             .figures = {LEAKS(TOLD, TOLD), TWICE},
                             .naives = {&hard_naive_moller, i ? NULL : &hard_naive_woop},
                             .measure = measure_ball,
                             .of = &s,
                             .by_brute_force = true};
        hard_hold(&c);
    }
    hard_finish();
}

static void measure_seam(const hard_way *way, const void *of, double figures[])
{
    const size_t count = *(const size_t *)of;
    figures[0] = figures[1] = 0.0;
    for (int across = 0; across < 2; ++across) {
        hard_mesh mesh;
        hard_mesh_quad(&mesh, across);
        const hard_crossings c = hard_count(way, &mesh, HARD_AIM_SEAM, count);
        figures[0] += (double)c.none;
        figures[1] += (double)c.several;
        hard_mesh_clear(&mesh);
    }
}

static void seam(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 65536};
    static const char *const names[] = {"a quad's seam, one ray", "a quad's seam, 131072 rays"};
    for (int i = 0; i < 2; ++i) {
        const hard_case c = {
            .row = 4,
            .name = names[i],
            .figures = {{"missed", {TOLD, TOLD, 0, 0}}, {"hit twice", {TOLD, TOLD, 0, 0}}},
            .naives = {&hard_naive_moller, &hard_naive_woop},
            .measure = measure_seam,
            .of = &counts[i]};
        hard_hold(&c);
    }
    hard_finish();
}

static void hold_places(int row, const subject *subjects, size_t count, const hard_naive *naive,
                        double gate)
{
    static const char *const what[] = {"", "edges", "vertices", ""};
    for (size_t i = 0; i < count; ++i) {
        char name[100];
        const subject *s = &subjects[i];
        if (s->center[0] != 0.0)
            snprintf(name, sizeof name, "%s, size %g at %.0f %.0f %.0f", what[s->aim], s->size,
                     s->center[0], s->center[1], s->center[2]);
        else
            snprintf(name, sizeof name, "%s, size %g", what[s->aim], s->size);
        const hard_case c = {.row = row,
                             .name = name,
                             .figures = {LEAKS(gate, gate), TWICE},
                             .naives = {naive},
                             .measure = measure_ball,
                             .of = s};
        hard_hold(&c);
    }
}

static void offsets(void **state)
{
    (void)state;
    static const subject subjects[] = {
        {BALL, {1e3, 1e3, 1e3}, 1.0, HARD_AIM_EDGES, 4},
        {BALL, {1e3, 1e3, 1e3}, 1.0, HARD_AIM_VERTICES, 4},
        {BALL, {148376, 1234, -223423}, 10.0, HARD_AIM_EDGES, 4},
        {BALL, {148376, 1234, -223423}, 10.0, HARD_AIM_VERTICES, 4},
        {BALL, {1e7, 1e7, 1e7}, 1e3, HARD_AIM_EDGES, 4},
        {BALL, {1e7, 1e7, 1e7}, 1e3, HARD_AIM_VERTICES, 4},
    };
    hold_places(5, subjects, sizeof subjects / sizeof *subjects, &hard_naive_moller, TOLD);
    hard_finish();
}

static void scales(void **state)
{
    (void)state;
    static const subject small[] = {
        {BALL, {0, 0, 0}, 1e-14, HARD_AIM_EDGES, 4},
        {BALL, {0, 0, 0}, 1e-14, HARD_AIM_VERTICES, 4},
        {BALL, {0, 0, 0}, 1e-10, HARD_AIM_EDGES, 4},
    };
    /* Where fast and standard must hit, which a fixed epsilon does not: nearly all rays. */
    static const subject moderate[] = {
        {BALL, {0, 0, 0}, 1e-5, HARD_AIM_EDGES, 4},
        {BALL, {0, 0, 0}, 1e-5, HARD_AIM_VERTICES, 4},
    };
    static const subject large[] = {
        {BALL, {0, 0, 0}, 1e6, HARD_AIM_EDGES, 4},     {BALL, {0, 0, 0}, 1e6, HARD_AIM_VERTICES, 4},
        {BALL, {0, 0, 0}, 1e12, HARD_AIM_EDGES, 4},    {BALL, {0, 0, 0}, 1e18, HARD_AIM_EDGES, 4},
        {BALL, {0, 0, 0}, 1e18, HARD_AIM_VERTICES, 4},
    };
    hold_places(6, small, sizeof small / sizeof *small, &hard_naive_epsilon, TOLD);
    hold_places(6, moderate, sizeof moderate / sizeof *moderate, &hard_naive_epsilon, 5e5);
    hold_places(6, large, 2, &hard_naive_moller, 5e5);
    hold_places(6, large + 2, 3, &hard_naive_moller, TOLD);
    hard_finish();
}

static void extreme_scales(void **state)
{
    (void)state;
    static const subject subjects[] = {
        {BALL, {0, 0, 0}, 1e-18, HARD_AIM_EDGES, 4},
        {BALL, {0, 0, 0}, 1e-18, HARD_AIM_VERTICES, 4},
        {BALL, {0, 0, 0}, 1e-30, HARD_AIM_EDGES, 4},
        {BALL, {0, 0, 0}, 1e-30, HARD_AIM_VERTICES, 4},
    };
    hold_places(7, subjects, sizeof subjects / sizeof *subjects, &hard_naive_moller, TOLD);
    hard_finish();
}

/* ---- Other builds ---- */

/* What a build may do to arithmetic. Options come from outside (RT_BUILD_OPTIONS); what is said in
 * the kernels' text is replaced there. */
typedef struct build {
    const char *name, *options;
    const hard_naive *text;
} build;

typedef struct variant {
    const build *build;
    subject subject;
} variant;

static void measure_variant(const hard_way *way, const void *of, double figures[])
{
    const variant *v = of;
    const subject *s = &v->subject;
    hard_way built = *way;
    hard_mesh mesh;
    const bool seam = s->aim == HARD_AIM_SEAM;
    const size_t all = hard_rays(way), count = all < 1000 || way->naive ? all : all / 10;
    if (!way->naive)
        built.naive = v->build->text;
    if (seam)
        hard_mesh_quad(&mesh, false);
    else
        hard_mesh_ball(&mesh, way->naive ? SMALL : s->n, s->center, s->size);
    setenv("RT_BUILD_OPTIONS", v->build->options, 1);
    const hard_crossings c = hard_count(&built, &mesh, s->aim, count);
    unsetenv("RT_BUILD_OPTIONS");
    figures[0] = hard_per_million(c.none, c.rays);
    figures[1] = hard_per_million(c.several, c.rays);
    hard_mesh_clear(&mesh);
}

/* What holds where kernels are built otherwise: only the build as it is promises anything, and the
 * others are left to the long form. */
static void builds(void **state)
{
    (void)state;
    static const hard_naive contracted = {.mutant = MUTANT_CONTRACTED};
    static const build all[] = {{"as built", "", NULL},
                                {"FP_CONTRACT ON", "", &contracted},
                                {"-cl-fast-relaxed-math", "-cl-fast-relaxed-math", NULL},
                                {"-cl-denorms-are-zero", "-cl-denorms-are-zero", NULL}};
    static const struct {
        int row;
        const char *name;
        subject subject;
    } rows[] = {{2, "edges", {BALL, {0, 0, 0}, 1.0, HARD_AIM_EDGES, 1}},
                {3, "vertices", {BALL, {0, 0, 0}, 1.0, HARD_AIM_VERTICES, 1}},
                {4, "a quad's seam", {0, {0, 0, 0}, 5.0, HARD_AIM_SEAM, 1}},
                {5, "edges, size 1e3 at 1e7", {BALL, {1e7, 1e7, 1e7}, 1e3, HARD_AIM_EDGES, 1}},
                {6, "vertices, size 1e-14", {BALL, {0, 0, 0}, 1e-14, HARD_AIM_VERTICES, 1}},
                {6, "edges, size 1e18", {BALL, {0, 0, 0}, 1e18, HARD_AIM_EDGES, 1}}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        for (size_t b = 0; b < (test_is_long() ? sizeof all / sizeof *all : 1); ++b) {
            char name[100];
            const variant v = {&all[b], rows[i].subject};
            const double gate = b == 0 ? 0 : TOLD;
            snprintf(name, sizeof name, "%s, %s", rows[i].name, all[b].name);
            const hard_case c = {.row = rows[i].row,
                                 .name = name,
                                 .figures = {{"leaks a million", {TOLD, TOLD, gate, gate}},
                                             {"hit twice a million", {TOLD, TOLD, gate, gate}}},
                                 .naives = {b == 0 ? &hard_naive_moller : NULL},
                                 .measure = measure_variant,
                                 .of = &v};
            hard_hold(&c);
        }
    hard_finish();
}

static void measure_fan(const hard_way *way, const void *of, double figures[])
{
    hard_mesh mesh;
    (void)of;
    hard_mesh_fan(&mesh, 10000);
    const hard_crossings c = hard_count(way, &mesh, HARD_AIM_VERTICES, way->naive ? 100 : 2048);
    figures[0] = hard_per_million(c.none, c.rays);
    figures[1] = hard_per_million(c.several, c.rays);
    hard_mesh_clear(&mesh);
}

static void fan(void **state)
{
    (void)state;
    const hard_case c = {.row = 8,
                         .name = "the hub of a flat fan of 10000",
                         .figures = {LEAKS(TOLD, TOLD), TWICE},
                         .naives = {&hard_naive_moller, &hard_naive_woop},
                         .measure = measure_fan};
    hard_hold(&c);
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_rays),
                                       cmocka_unit_test(aimed_rays),
                                       cmocka_unit_test(aimed_rays_by_brute_force),
                                       cmocka_unit_test(seam),
                                       cmocka_unit_test(offsets),
                                       cmocka_unit_test(scales),
                                       cmocka_unit_test(extreme_scales),
                                       cmocka_unit_test(builds),
                                       cmocka_unit_test(fan)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
