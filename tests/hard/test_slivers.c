/* Thin triangles, triangles without area, triangles seen edge-on, and huge ones: rows 9, 10, 12, 13
 * and 40 of the hard cases. */
#include "hard/exact.h"
#include "hard/naive.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TOLD HARD_REPORT
#define SLIVERS 32

static rt_ray rays[HARD_CHUNK];
static rt_hit hits[HARD_CHUNK];
static double errors[HARD_CHUNK];

static void random_vector(test_random *random, float size, float out[3])
{
    for (int k = 0; k < 3; ++k)
        out[k] = test_random_float(random, -size, size);
}

/* ---- Slivers ---- */

/* A sliver of length 2 about: its ends are opposite to each other and exact, its third corner is
 * `width` beside the origin, where floats are dense enough for a width that ends cannot have. */
static void add_sliver(rt_scene *scene, test_random *random, float width)
{
    float end[3], beside[3], corners[9];
    random_vector(random, 1.0f, end);
    random_vector(random, width, beside);
    for (int k = 0; k < 3; ++k) {
        corners[k] = -end[k];
        corners[3 + k] = end[k];
        corners[6 + k] = beside[k];
    }
    hard_add_triangle(scene, corners);
}

static void aim_at_slivers(const rt_scene *scene, size_t count)
{
    test_random random = {21};
    for (size_t i = 0; i < count; ++i) {
        const rt_triangle *s = &scene->triangles[i % scene->triangle_count];
        /* Away from the origin, where all slivers meet. */
        const float along = test_random_float(&random, 0.3f, 0.7f) * (i & 64 ? 1.0f : -1.0f);
        const float across = test_random_float(&random, 0.05f, 0.25f);
        const float end[3] = {s->bx, s->by, s->bz}, beside[3] = {s->cx, s->cy, s->cz};
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        random_vector(&random, 2.0f, rays[i].origin);
        for (int k = 0; k < 3; ++k)
            rays[i].direction[k] =
                (float)((double)along * (double)end[k] + (double)across * (double)beside[k] -
                        (double)rays[i].origin[k]);
    }
}

/* The errors of t in ulp where a ray hits its triangle by the truth and by what is measured, in
 * out[0..found); counts on the true hits and those that are lost. A nearer triangle that the ray
 * truly hits is no error. */
static size_t errors_of_t(const hard_way *way, rt_scene *scene, size_t count, double *out,
                          size_t *lost, size_t *true_hits)
{
    hard_tracer tracer;
    size_t found = 0;
    hard_open(&tracer, way, scene);
    hard_trace(&tracer, rays, count, hits);
    for (size_t i = 0; i < count; ++i) {
        const size_t own = i % scene->triangle_count;
        hard_truth truth = hard_true_triangle(&rays[i], &scene->triangles[own]);
        *true_hits += truth.is_hit;
        if (truth.is_hit && hits[i].primitive == RT_MISS)
            ++*lost;
        if (truth.is_hit && hits[i].primitive == (int)own)
            out[found++] = hard_ulps((double)hits[i].t, truth.t);
    }
    hard_close(&tracer);
    return found;
}

static void measure_slivers(const hard_way *way, const void *of, double figures[])
{
    test_random random = {22};
    rt_scene scene;
    hard_scene(&scene);
    for (int i = 0; i < SLIVERS; ++i)
        add_sliver(&scene, &random, *(const float *)of);
    aim_at_slivers(&scene, HARD_CHUNK);
    size_t lost = 0, true_hits = 0;
    const size_t found = errors_of_t(way, &scene, HARD_CHUNK, errors, &lost, &true_hits);
    figures[0] = hard_percentile(errors, found, 0.99);
    figures[1] = hard_percentile(errors, found, 1.0);
    figures[2] = hard_percentile(errors, found, 0.5);
    figures[3] = 100.0 * (double)lost / (double)true_hits;
    rt_scene_clear(&scene);
}

static void slivers(void **state)
{
    (void)state;
    /* 16 ulp hold for 99 of 100 hits, not for all: a corner's rounding moves a ray across a sliver
     * by a good part of its width, and where it is tilted t moves with it, 55 ulp at most here. */
    static const float widths[] = {1e-6f, 1e-8f};
    static const char *const names[] = {"slivers 1e6 : 1", "slivers 1e8 : 1"};
    for (int i = 0; i < 2; ++i) {
        const hard_case c = {.row = 9,
                             .name = names[i],
                             .figures = {{"p99 of t, ulp", {TOLD, TOLD, 16, 1}},
                                         {"most of t, ulp", {TOLD, TOLD, TOLD, 1}},
                                         {"median of t, ulp", {TOLD, TOLD, TOLD, TOLD}},
                                         {"true hits lost, %", {TOLD, TOLD, TOLD, TOLD}}},
                             .naives = {&hard_naive_moller},
                             .measure = measure_slivers,
                             .of = &widths[i]};
        hard_hold(&c);
    }
    hard_finish();
}

/* ---- Huge triangles ---- */

/* A triangle of any slope whose middle is about the origin. */
static void add_huge(rt_scene *scene, test_random *random, float size)
{
    float corners[9];
    random_vector(random, size, corners);
    random_vector(random, size, corners + 3);
    for (int k = 0; k < 3; ++k)
        corners[6 + k] = -corners[k] - corners[3 + k];
    hard_add_triangle(scene, corners);
}

/* From within two of its plane: as seen from a floor that reaches to the horizon. One triangle at a
 * time, or they would hide each other. */
static void measure_huge(const hard_way *way, const void *of, double figures[])
{
    const size_t each = HARD_CHUNK / SLIVERS;
    test_random random = {26};
    size_t found = 0, lost = 0, true_hits = 0;
    for (int i = 0; i < SLIVERS; ++i) {
        rt_scene scene;
        hard_scene(&scene);
        add_huge(&scene, &random, *(const float *)of);
        for (size_t k = 0; k < each; ++k) {
            rays[k] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
            random_vector(&random, 2.0f, rays[k].origin);
            random_vector(&random, 1.0f, rays[k].direction);
        }
        found += errors_of_t(way, &scene, each, errors + found, &lost, &true_hits);
        rt_scene_clear(&scene);
    }
    figures[0] = hard_percentile(errors, found, 0.5);
    figures[1] = hard_percentile(errors, found, 0.99);
    figures[2] = 1e6 * (double)lost / (double)true_hits;
}

static void huge_triangles(void **state)
{
    (void)state;
    static const hard_naive mean = {.mutant = MUTANT_MEAN_OF_FAR_CORNERS, .at_robust = true};
    static const float sizes[] = {1e4f, 1e6f, 1e8f};
    static const char *const names[] = {"a plane of 1e4, 1 away", "a plane of 1e6, 1 away",
                                        "a plane of 1e8, 1 away"};
    for (int i = 0; i < 3; ++i) {
        /* What is nearer than 2e-4 is nearer than the rounding of 1e8. */
        const double lost = i < 2 ? 0 : 1000;
        const hard_case c = {.row = 40,
                             .name = names[i],
                             .figures = {{"median of t, ulp", {TOLD, TOLD, 2, 1}},
                                         {"p99 of t, ulp", {TOLD, TOLD, i < 2 ? 64 : 128, 1}},
                                         {"true hits lost, a million", {TOLD, TOLD, lost, 0}}},
                             .naives = {&hard_naive_moller, &mean},
                             .measure = measure_huge,
                             .of = &sizes[i]};
        hard_hold(&c);
    }
    hard_finish();
}

/* ---- Without area ---- */

/* Triangles whose corners are on a line exactly, in whole numbers, and rays aimed at the line. All
 * readers bring triangles through rt_triangle_settle; a naive variant gets them as they are. */
static void measure_collinear(const hard_way *way, const void *of, double figures[])
{
    test_random random = {23};
    const size_t per_triangle = HARD_CHUNK / 512;
    (void)of;
    rt_scene scene;
    hard_scene(&scene);
    for (size_t i = 0; i < 512; ++i) {
        float step[3], at[3], corners[9];
        for (int k = 0; k < 3; ++k) {
            step[k] = (float)(test_random_bits(&random) % 4096) - 2048.0f;
            at[k] = (float)(test_random_bits(&random) % 65536) - 32768.0f;
            corners[k] = at[k];
            corners[3 + k] = at[k] + 3.0f * step[k];
            corners[6 + k] = at[k] + step[k];
        }
        for (size_t r = 0; r < per_triangle; ++r) {
            rt_ray *ray = &rays[i * per_triangle + r];
            const float f = 3.0f * test_random_float(&random, 0.0f, 1.0f);
            *ray = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
            random_vector(&random, 1e5f, ray->origin);
            for (int k = 0; k < 3; ++k)
                ray->direction[k] = at[k] + f * step[k] - ray->origin[k];
        }
        rt_triangle triangle;
        memcpy(&triangle, corners, sizeof triangle);
        const bool has_area = !way->naive && rt_triangle_settle(&triangle, NULL);
        assert_false(has_area);
        memcpy(corners, &triangle, sizeof triangle);
        hard_add_triangle(&scene, corners);
    }
    hard_tracer tracer;
    hard_open(&tracer, way, &scene);
    hard_trace(&tracer, rays, HARD_CHUNK, hits);
    figures[0] = 0.0;
    for (size_t i = 0; i < HARD_CHUNK; ++i)
        figures[0] += hits[i].primitive != RT_MISS;
    hard_close(&tracer);
    rt_scene_clear(&scene);
}

static void collinear(void **state)
{
    (void)state;
    const hard_case c = {.row = 10,
                         .name = "corners on a line, 65536 rays at it",
                         .figures = {{"hits", {0, 0, 0, 0}}},
                         .naives = {&hard_naive_woop, &hard_naive_moller},
                         .measure = measure_collinear};
    hard_hold(&c);
    hard_finish();
}

/* ---- Edge-on ---- */

/* Triangles of size about 1 in space, each met at an angle of `angle` to its plane. */
static void measure_grazing(const hard_way *way, const void *of, double figures[])
{
    const double angle = *(const double *)of;
    test_random random = {24};
    rt_scene scene;
    hard_scene(&scene);
    float corners[9];
    random_vector(&random, 1.0f, corners);
    for (int k = 0; k < 2; ++k)
        random_vector(&random, 1.0f, corners + 3 + 3 * k);
    hard_add_triangle(&scene, corners);
    double e[2][3], normal[3], length = 0.0;
    for (int k = 0; k < 3; ++k) {
        e[0][k] = (double)corners[3 + k] - (double)corners[k];
        e[1][k] = (double)corners[6 + k] - (double)corners[k];
    }
    for (int k = 0; k < 3; ++k) {
        normal[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
        length += normal[k] * normal[k];
    }
    for (size_t i = 0; i < HARD_CHUNK; ++i) {
        const double u = (double)test_random_float(&random, 0.05f, 0.45f);
        const double v = (double)test_random_float(&random, 0.05f, 0.45f);
        const double p = (double)test_random_float(&random, -1.0f, 1.0f);
        const double q = (double)test_random_float(&random, -1.0f, 1.0f);
        const double way_back = (double)test_random_float(&random, 0.5f, 2.0f);
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        for (int k = 0; k < 3; ++k) {
            const double target = (double)corners[k] + u * e[0][k] + v * e[1][k];
            const double d = p * e[0][k] + q * e[1][k] - angle * normal[k] / sqrt(length);
            rays[i].origin[k] = (float)(target - way_back * d);
            rays[i].direction[k] = (float)d;
        }
    }
    size_t lost = 0, true_hits = 0;
    const size_t found = errors_of_t(way, &scene, HARD_CHUNK, errors, &lost, &true_hits);
    figures[0] = hard_percentile(errors, found, 0.99);
    figures[1] = hard_percentile(errors, found, 0.5);
    figures[2] = 100.0 * (double)lost / (double)true_hits;
    rt_scene_clear(&scene);
}

static void grazing(void **state)
{
    (void)state;
    static const double angles[] = {1e-3, 1e-5};
    /* 500 and 5e4 were a guess, and are what is measured: a half more for other devices' luck. */
    static const double gates[] = {750.0, 7.5e4};
    static const char *const names[] = {"grazing at 1e-3", "grazing at 1e-5"};
    for (int i = 0; i < 2; ++i) {
        const hard_case c = {.row = 12,
                             .name = names[i],
                             .figures = {{"p99 of t, ulp", {TOLD, TOLD, gates[i], 1}},
                                         {"median of t, ulp", {TOLD, TOLD, TOLD, TOLD}},
                                         {"true hits lost, %", {TOLD, TOLD, TOLD, TOLD}}},
                             .naives = {&hard_naive_moller},
                             .measure = measure_grazing,
                             .of = &angles[i]};
        hard_hold(&c);
    }
    hard_finish();
}

/* Whether the point at t is in the triangle's box, give or take rounding. */
static bool is_in_box(const rt_ray *ray, float t, const float corners[9])
{
    for (int k = 0; k < 3; ++k) {
        const double lo =
            fmin((double)corners[k], fmin((double)corners[3 + k], (double)corners[6 + k]));
        const double hi =
            fmax((double)corners[k], fmax((double)corners[3 + k], (double)corners[6 + k]));
        const double at = (double)ray->origin[k] + (double)t * (double)ray->direction[k];
        const double slack = 1e-5 * (fabs(lo) + fabs(hi) + fabs((double)ray->origin[k]));
        if (!(at >= lo - slack && at <= hi + slack))
            return false;
    }
    return true;
}

/* Rays exactly in the planes of their triangles, in whole numbers up to about `size`. */
static void measure_in_plane(const hard_way *way, const void *of, double figures[])
{
    const int64_t size = *(const int *)of;
    test_random random = {25};
    rt_scene scene;
    hard_tracer tracer;
    figures[0] = 0.0;
    hard_scene(&scene);
    int64_t e[2][3];
    float corners[9];
    for (int k = 0; k < 3; ++k) {
        const int64_t a = (int64_t)(test_random_bits(&random) % 64) - 32;
        for (int i = 0; i < 2; ++i)
            e[i][k] = (int64_t)(test_random_bits(&random) % (uint64_t)(2 * size)) - size;
        corners[k] = (float)a;
        corners[3 + k] = (float)(a + e[0][k]);
        corners[6 + k] = (float)(a + e[1][k]);
    }
    hard_add_triangle(&scene, corners);
    for (size_t i = 0; i < HARD_CHUNK; ++i) {
        int64_t w[4];
        for (int k = 0; k < 4; ++k)
            w[k] = (int64_t)(test_random_bits(&random) % 15) - 7;
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        for (int k = 0; k < 3; ++k) {
            rays[i].origin[k] = corners[k] + (float)(w[0] * e[0][k] + w[1] * e[1][k]);
            rays[i].direction[k] = (float)(w[2] * e[0][k] + w[3] * e[1][k]);
        }
    }
    hard_open(&tracer, way, &scene);
    hard_trace(&tracer, rays, HARD_CHUNK, hits);
    size_t found = 0, outside = 0;
    for (size_t i = 0; i < HARD_CHUNK; ++i) {
        found += hits[i].primitive != RT_MISS;
        outside += hits[i].primitive != RT_MISS && !is_in_box(&rays[i], hits[i].t, corners);
    }
    figures[0] = hard_per_million(found, HARD_CHUNK);
    figures[1] = hard_per_million(outside, HARD_CHUNK);
    hard_close(&tracer);
    rt_scene_clear(&scene);
}

static void in_plane(void **state)
{
    (void)state;
    static const int sizes[] = {32, 100000};
    static const char *const names[] = {"in the plane, products exact",
                                        "in the plane, products rounded"};
    /* Where products are exact, Moller and Trumbore's determinant is 0 and nothing is hit. The
     * watertight test shears first, which rounds: it sees the triangle a rounding away from
     * edge-on, and so do its neighbours, which is what keeps the mesh tight. A ray that runs in the
     * triangle touches it, so a hit is lawful; it must be where the triangle is. Where products are
     * rounded, no test but the reference can tell. */
    for (int i = 0; i < 2; ++i) {
        const double gate = i ? TOLD : 0;
        const hard_case c = {.row = 13,
                             .name = names[i],
                             .figures = {{"hits a million", {gate, gate, TOLD, TOLD}},
                                         {"hits where it is not, a million", {0, 0, 0, 0}}},
                             .naives = {i ? NULL : &hard_naive_woop},
                             .naive_level = RT_ACCURACY_STANDARD,
                             .measure = measure_in_plane,
                             .of = &sizes[i]};
        hard_hold(&c);
    }
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slivers), cmocka_unit_test(huge_triangles),
                                       cmocka_unit_test(collinear), cmocka_unit_test(grazing),
                                       cmocka_unit_test(in_plane)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
