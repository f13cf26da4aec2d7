/* Spheres that are small, far, huge or only just touched: rows 14 to 17 and 19 of the hard cases.
 */
#include "hard/exact.h"
#include "hard/naive.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TOLD HARD_REPORT
#define FAR_SPHERES 32

static rt_ray rays[HARD_CHUNK];
static rt_hit hits[HARD_CHUNK];

/* ---- Small or far: is there a hit at all? ---- */

typedef struct far_sphere {
    float radius, distance;
} far_sphere;

/* A direction with few bits, so that `distance` times it is exact. */
static void few_bits(test_random *random, float out[3])
{
    float length;
    do {
        length = 0.0f;
        for (int k = 0; k < 3; ++k) {
            out[k] = (float)((int)(test_random_bits(random) % 127) - 63) / 64.0f;
            length += out[k] * out[k];
        }
    } while (!(length > 0.5f && length < 1.5f));
}

/* The sphere lies at distance * d; the ray starts within two radii of the origin and goes along d.
 * So it passes the centre at an offset that has all its bits, however far away that is. */
static void aim_at_far(const rt_scene *scene, const float d[][3], size_t count, float radius)
{
    test_random random = {11};
    for (size_t i = 0; i < count; ++i) {
        const float *direction = d[i % scene->sphere_count];
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        memcpy(rays[i].direction, direction, 3 * sizeof *direction);
        for (int k = 0; k < 3; ++k)
            rays[i].origin[k] = radius * test_random_float(&random, -1.2f, 1.2f);
    }
}

static void measure_far(const hard_way *way, const void *of, double figures[])
{
    const far_sphere *far = of;
    float d[FAR_SPHERES][3];
    test_random random = {12};
    rt_scene scene;
    hard_scene(&scene);
    for (int i = 0; i < FAR_SPHERES; ++i) {
        few_bits(&random, d[i]);
        hard_add_sphere(&scene, far->distance * d[i][0], far->distance * d[i][1],
                        far->distance * d[i][2], far->radius);
    }
    hard_tracer tracer;
    hard_open(&tracer, way, &scene);
    aim_at_far(&scene, (const float(*)[3])d, HARD_CHUNK, far->radius);
    hard_trace(&tracer, rays, HARD_CHUNK, hits);
    size_t judged = 0, false_hits = 0, false_misses = 0;
    for (size_t i = 0; i < HARD_CHUNK; ++i) {
        const hard_truth truth = hard_true_sphere(&rays[i], &scene.spheres[i % FAR_SPHERES]);
        if (truth.margin < 8.0)
            continue;
        const bool is_hit = hits[i].primitive == (int)(i % FAR_SPHERES);
        ++judged;
        false_hits += is_hit && !truth.is_hit;
        false_misses += !is_hit && truth.is_hit;
    }
    figures[0] = hard_per_million(false_hits, judged);
    figures[1] = hard_per_million(false_misses, judged);
    hard_close(&tracer);
    rt_scene_clear(&scene);
}

static void far_spheres(void **state)
{
    (void)state;
    static const hard_naive too_sure = {.mutant = MUTANT_SPHERE_SURE_TOO_SOON, .at_robust = true};
    static const far_sphere subjects[] = {{1.0f, 1e3f},  {1.0f, 1e4f},  {1e-3f, 1e4f},
                                          {1e-3f, 1e5f}, {1e-3f, 1e6f}, {1e3f, 1e6f}};
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; ++i) {
        /* A hundred in a million are 6 rays, as many as the arithmetic of float brings; at fast the
         * processor's own estimate of a reciprocal comes in too. */
        const double gate = i < 2 ? 100.0 : TOLD, fast = i < 2 ? 500.0 : TOLD;
        /* At 1000 radii the plain test is right about every ray that is tried. */
        const hard_naive *sure = i > 0 ? &too_sure : NULL;
        char name[64];
        snprintf(name, sizeof name, "sphere of radius %g at %g", (double)subjects[i].radius,
                 (double)subjects[i].distance);
        const hard_case c = {.row = i < 2 ? 14 : 15,
                             .name = name,
                             .figures = {{"false hits a million", {fast, gate, 0, 0}},
                                         {"false misses a million", {fast, gate, 0, 0}}},
                             .naives = {&hard_naive_quadratic, sure},
                             .measure = measure_far,
                             .of = &subjects[i]};
        hard_hold(&c);
    }
    hard_finish();
}

/* ---- How exact t is ---- */

/* Traces rays[0..count) at sphere 0; tells the errors of t in ulp where both say hit, and counts
 * the hits that are lost or made up beyond 8 ulp of tangency. */
static size_t errors_of_t(const hard_way *way, rt_scene *scene, size_t count, double *errors,
                          size_t *wrong)
{
    hard_tracer tracer;
    size_t found = 0;
    *wrong = 0;
    hard_open(&tracer, way, scene);
    hard_trace(&tracer, rays, count, hits);
    for (size_t i = 0; i < count; ++i) {
        const hard_truth truth = hard_true_sphere(&rays[i], &scene->spheres[0]);
        const bool is_hit = hits[i].primitive == 0;
        if (is_hit && truth.is_hit)
            errors[found++] = hard_ulps((double)hits[i].t, truth.t);
        else if (is_hit != truth.is_hit && truth.margin > 8.0)
            ++*wrong;
    }
    hard_close(&tracer);
    return found;
}

static double errors[HARD_CHUNK];

static void measure_floor(const hard_way *way, const void *of, double figures[])
{
    const float height = *(const float *)of;
    test_random random = {13};
    rt_scene scene;
    hard_scene(&scene);
    hard_add_sphere(&scene, 0.0f, -1e6f, 0.0f, 1e6f);
    for (size_t i = 0; i < HARD_CHUNK; ++i)
        rays[i] = (rt_ray){{0.0f, height, 0.0f},
                           {test_random_float(&random, -1.0f, 1.0f),
                            test_random_float(&random, -1.0f, 0.0f),
                            test_random_float(&random, -1.0f, 1.0f)},
                           0.0f,
                           INFINITY};
    size_t wrong = 0;
    const size_t found = errors_of_t(way, &scene, HARD_CHUNK, errors, &wrong);
    figures[0] = hard_percentile(errors, found, 0.5);
    figures[1] = hard_percentile(errors, found, 0.99);
    figures[2] = hard_per_million(wrong, HARD_CHUNK);
    rt_scene_clear(&scene);
}

static void floor_sphere(void **state)
{
    (void)state;
    static const hard_naive plain = {.mutant = MUTANT_SPHERE_PLAIN_NEAR_BY, .at_robust = true};
    static const float heights[] = {1.0f, 0.01f};
    static const char *const names[] = {"floor of radius 1e6, eye 1 up",
                                        "floor of radius 1e6, eye 0.01 up"};
    for (int i = 0; i < 2; ++i) {
        const hard_case c = {.row = 16,
                             .name = names[i],
                             .figures = {{"median of t, ulp", {TOLD, TOLD, 1, 1}},
                                         {"p99 of t, ulp", {TOLD, TOLD, 128, 1}},
                                         {"wrong hits a million", {TOLD, TOLD, 0, 0}}},
                             .naives = {&hard_naive_quadratic, &plain},
                             .measure = measure_floor,
                             .of = &heights[i]};
        hard_hold(&c);
    }
    hard_finish();
}

static void measure_inside(const hard_way *way, const void *of, double figures[])
{
    test_random random = {14};
    (void)of;
    rt_scene scene;
    hard_scene(&scene);
    hard_add_sphere(&scene, 0.0f, 0.0f, 0.0f, 1.0f);
    for (size_t i = 0; i < HARD_CHUNK; ++i) {
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        for (int k = 0; k < 3; ++k) {
            rays[i].origin[k] = test_random_float(&random, -0.55f, 0.55f);
            rays[i].direction[k] = test_random_float(&random, -1.0f, 1.0f);
        }
    }
    size_t wrong = 0;
    const size_t found = errors_of_t(way, &scene, HARD_CHUNK, errors, &wrong);
    figures[0] = hard_percentile(errors, found, 1.0);
    figures[1] = hard_per_million(wrong, HARD_CHUNK);
    rt_scene_clear(&scene);
}

static void inside(void **state)
{
    (void)state;
    static const hard_naive behind = {.mutant = MUTANT_SPHERE_BEHIND_FROM_INSIDE,
                                      .at_robust = true};
    const hard_case c = {
        .row = 17,
        .name = "from inside a sphere",
        .figures = {{"most of t, ulp", {16, 16, 8, 1}}, {"wrong hits a million", {0, 0, 0, 0}}},
        .naives = {&hard_naive_quadratic, &behind},
        .measure = measure_inside};
    hard_hold(&c);
    hard_finish();
}

/* ---- Tangents ---- */

static void measure_tangent(const hard_way *way, const void *of, double figures[])
{
    (void)of;
    rt_scene scene;
    hard_scene(&scene);
    hard_add_sphere(&scene, 0.0f, 0.0f, 0.0f, 1.0f);
    size_t count = 0;
    for (int k = -8; k <= 8; ++k, ++count)
        rays[count] =
            (rt_ray){{1.0f + (float)k * 0x1p-23f, 0.0f, 5.0f}, {0.0f, 0.0f, -1.0f}, 0.0f, INFINITY};
    hard_tracer tracer;
    hard_open(&tracer, way, &scene);
    hard_trace(&tracer, rays, count, hits);
    figures[0] = 0.0;
    for (size_t i = 0; i < count; ++i)
        figures[0] += (hits[i].primitive == 0) != hard_true_tangent(&rays[i], &scene.spheres[0]);
    hard_close(&tracer);
    rt_scene_clear(&scene);
}

/* Two unit vectors at right angles, about. */
static void right_angle(test_random *random, double u[3], double v[3])
{
    double a[3], b[3], la = 0.0, lb = 0.0, ab = 0.0;
    for (int k = 0; k < 3; ++k) {
        a[k] = (double)test_random_float(random, -1.0f, 1.0f);
        b[k] = (double)test_random_float(random, -1.0f, 1.0f);
        la += a[k] * a[k];
        ab += a[k] * b[k];
    }
    for (int k = 0; k < 3; ++k) {
        u[k] = a[k] / sqrt(la);
        v[k] = b[k] - a[k] * ab / la;
        lb += v[k] * v[k];
    }
    for (int k = 0; k < 3; ++k)
        v[k] /= sqrt(lb);
}

static void measure_skew(const hard_way *way, const void *of, double figures[])
{
    const size_t count = 8192;
    test_random random = {15};
    (void)of;
    rt_scene scene;
    hard_scene(&scene);
    hard_add_sphere(&scene, 0.0f, 0.0f, 0.0f, 1.0f);
    for (size_t i = 0; i < count; ++i) {
        double along[3], across[3];
        right_angle(&random, along, across);
        const double offset = 1.0 + ((double)(i % 17) - 8.0) * 0x1p-23;
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        for (int k = 0; k < 3; ++k) {
            rays[i].direction[k] = (float)along[k];
            rays[i].origin[k] = (float)(offset * across[k] - 5.0 * along[k]);
        }
    }
    hard_tracer tracer;
    hard_open(&tracer, way, &scene);
    hard_trace(&tracer, rays, count, hits);
    size_t wrong = 0;
    for (size_t i = 0; i < count; ++i)
        wrong += (hits[i].primitive == 0) != hard_true_tangent(&rays[i], &scene.spheres[0]);
    figures[0] = 100.0 * (double)wrong / (double)count;
    hard_close(&tracer);
    rt_scene_clear(&scene);
}

static void tangents(void **state)
{
    (void)state;
    const hard_case aligned = {.row = 19,
                               .name = "tangents along an axis, 1 + k ulp",
                               .figures = {{"wrong of 17", {0, 0, 0, 0}}},
                               .naives = {&hard_naive_quadratic},
                               .measure = measure_tangent};
    hard_hold(&aligned);
    const hard_case skew = {.row = 19,
                            .name = "tangents any way, within 8 ulp or so",
                            .figures = {{"wrong, %", {TOLD, TOLD, 5, 0}}},
                            .naives = {&hard_naive_quadratic},
                            .measure = measure_skew};
    hard_hold(&skew);
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(far_spheres),
                                       cmocka_unit_test(floor_sphere), cmocka_unit_test(inside),
                                       cmocka_unit_test(tangents)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
