/* Where rounding could make the tree differ from brute force, and where several hits are equal:
 * rows 26 and 27 of the hard cases. */
#include "hard/naive.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TOLD HARD_REPORT

static rt_ray rays[HARD_CHUNK];
static rt_hit hits[HARD_CHUNK], others[HARD_CHUNK];

/* ---- Slabs ---- */

/* A checkerboard of whole-number squares on each of the three planes through the origin and the
 * three at 4: all boxes are flat, and all faces are on whole numbers. */
static void add_squares(rt_scene *scene)
{
    for (int plane = 0; plane < 6; ++plane)
        for (int i = -4; i < 4; ++i)
            for (int j = -4; j < 4; ++j) {
                const int axis = plane % 3;
                float p[4][3];
                if ((i + j) % 2)
                    continue;
                for (int k = 0; k < 4; ++k) {
                    p[k][axis] = plane < 3 ? 0.0f : 4.0f;
                    p[k][(axis + 1) % 3] = (float)(i + (k == 1 || k == 2));
                    p[k][(axis + 2) % 3] = (float)(j + (k >= 2));
                }
                for (int half = 0; half < 2; ++half) {
                    float corners[9];
                    memcpy(corners, p[0], sizeof p[0]);
                    memcpy(corners + 3, p[1 + half], sizeof p[0]);
                    memcpy(corners + 6, p[2 + half], sizeof p[0]);
                    hard_add_triangle(scene, corners);
                }
            }
}

/* Rays that start on whole numbers, on the planes of faces, with directions that have zeros of both
 * signs, and rays aimed at whole-number points. */
static void fill_rays(size_t count)
{
    test_random random = {31};
    for (size_t i = 0; i < count; ++i) {
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        for (int k = 0; k < 3; ++k) {
            const uint64_t bits = test_random_bits(&random);
            const float whole = (float)(bits % 17) - 8.0f;
            rays[i].origin[k] = bits >> 8 & 1 ? whole : whole + 0.5f;
            const float target = (float)(bits >> 16 & 7) - 4.0f;
            const uint64_t kind = bits >> 24 & 3;
            rays[i].direction[k] = kind == 0   ? 0.0f
                                   : kind == 1 ? -0.0f
                                               : target - rays[i].origin[k];
        }
    }
}

/* At fast the two are two programs, which may round quotients differently, as the processor's
 * estimate of a reciprocal has it: there t may be off by some ulp, and which of two triangles that
 * are met in their common edge is the nearer. */
static bool is_same(const rt_hit *a, const rt_hit *b, enum rt_accuracy level)
{
    if (level != RT_ACCURACY_FAST)
        return memcmp(a, b, sizeof *a) == 0;
    return (a->primitive == RT_MISS) == (b->primitive == RT_MISS) &&
           (a->t == b->t || fabsf(a->t - b->t) <= 1e-6f * b->t);
}

static size_t differing(size_t count, enum rt_accuracy level)
{
    size_t different = 0;
    for (size_t i = 0; i < count; ++i)
        different += !is_same(&hits[i], &others[i], level);
    return different;
}

static void trace_in(hard_way way, rt_scene *scene, bool by_brute_force, size_t count, rt_hit *out)
{
    hard_tracer tracer;
    way.by_brute_force = by_brute_force;
    if (way.naive && by_brute_force)
        way.naive = &hard_naive_moller;
    hard_open(&tracer, &way, scene);
    hard_trace(&tracer, rays, count, out);
    hard_close(&tracer);
}

static void measure_slabs(const hard_way *way, const void *of, double figures[])
{
    const size_t count = way->naive ? 4096 : HARD_CHUNK;
    (void)of;
    rt_scene scene;
    hard_scene(&scene);
    add_squares(&scene);
    fill_rays(count);
    trace_in(*way, &scene, false, count, hits);
    trace_in(*way, &scene, true, count, others);
    size_t found = 0;
    for (size_t i = 0; i < count; ++i)
        found += others[i].primitive != RT_MISS;
    assert_true(found > count / 100); /* there is something to differ in */
    figures[0] = hard_per_million(differing(count, way->level), count);
    rt_scene_clear(&scene);
}

static void slabs(void **state)
{
    (void)state;
    const hard_case c = {
        .row = 27,
        .name = "directions +-0, origins on slabs, flat boxes",
        .figures = {{"hits that differ from brute force, a million", {0, 0, 0, 0}}},
        .naives = {&hard_naive_slab},
        .measure = measure_slabs};
    hard_hold(&c);
    hard_finish();
}

/* ---- Equal hits ---- */

#define COPIES 1000
#define OTHERS 1000

static int shuffled(const void *a, const void *b)
{
    const uint64_t *x = a, *y = b;
    return (x[0] > y[0]) - (x[0] < y[0]);
}

/* Copies of one triangle and others behind it, in an order that the seed gives. Returns the lowest
 * index among the copies. */
static int fill_shuffled(rt_scene *scene, uint64_t seed)
{
    static uint64_t order[COPIES + OTHERS][2];
    test_random random = {seed};
    int lowest = -1;
    for (uint64_t i = 0; i < COPIES + OTHERS; ++i) {
        order[i][0] = test_random_bits(&random);
        order[i][1] = i;
    }
    qsort(order, COPIES + OTHERS, sizeof order[0], shuffled);
    hard_scene(scene);
    for (int i = 0; i < COPIES + OTHERS; ++i) {
        float corners[9] = {-1.0f, -1.0f, 0.25f, 1.5f, -0.75f, -0.125f, 0.0f, 1.25f, 0.0625f};
        if (order[i][1] < COPIES) {
            lowest = lowest < 0 ? i : lowest;
        } else {
            test_random other = {order[i][1]};
            const float z = test_random_float(&other, -3.0f, -2.0f);
            for (int k = 0; k < 9; ++k)
                corners[k] = k % 3 == 2 ? z : test_random_float(&other, -1.0f, 1.0f);
        }
        hard_add_triangle(scene, corners);
    }
    return lowest;
}

static void measure_copies(const hard_way *way, const void *of, double figures[])
{
    const size_t count = 1024;
    (void)of;
    figures[0] = figures[1] = 0.0;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        test_random random = {32};
        rt_scene scene;
        hard_tracer tracer;
        const int lowest = fill_shuffled(&scene, seed);
        for (size_t i = 0; i < count; ++i)
            rays[i] = (rt_ray){{0.1f, 0.2f, 5.0f},
                               {test_random_float(&random, -0.05f, 0.05f),
                                test_random_float(&random, -0.05f, 0.05f), -1.0f},
                               0.0f,
                               INFINITY};
        hard_open(&tracer, way, &scene);
        hard_trace(&tracer, rays, count, hits);
        hard_close(&tracer);
        for (size_t i = 0; i < count; ++i) {
            figures[0] += hits[i].primitive != lowest;
            figures[1] += seed > 1 && memcmp(&hits[i].t, &others[i].t, sizeof hits[i].t) != 0;
        }
        memcpy(others, hits, sizeof others);
        rt_scene_clear(&scene);
    }
}

static void copies(void **state)
{
    (void)state;
    const hard_case c = {.row = 26,
                         .name = "1000 copies of a triangle, 4 orders",
                         .figures = {{"hits of another than the lowest index", {0, 0, 0, 0}},
                                     {"t that differ from order to order", {0, 0, 0, 0}}},
                         .naives = {&hard_naive_last},
                         .measure = measure_copies};
    hard_hold(&c);
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slabs), cmocka_unit_test(copies)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
