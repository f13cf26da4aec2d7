/* What is refused, dropped or kept as it is, at every level alike: rows 11, 20, 28 and 29 of the
 * hard cases. */
#define _GNU_SOURCE
#include "hard/exact.h"
#include "hard/naive.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_file/read.h"

#define TOLD HARD_REPORT

static rt_ray rays[HARD_CHUNK];
static rt_hit hits[HARD_CHUNK];

/* ---- Refused ---- */

typedef struct text_list {
    const char *const *texts;
    size_t count;
} text_list;

/* Whether a text's third line is refused, by its number. */
static bool is_refused(const char *text)
{
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    char *whole = NULL;
    const char *path = test_path("refused.txt");
    assert_true(asprintf(&whole, "rt 1\nmaterial m\n%s\n", text) > 0);
    test_write_text(path, whole);
    free(whole);
    rt_scene_init(&scene);
    const bool refused = !rt_scene_read(&scene, path, &status) && status.text &&
                         strstr(status.text, "refused.txt:3:");
    rt_status_clear(&status);
    rt_scene_clear(&scene);
    return refused;
}

/* The reader refuses alike at every level. */
static void measure_refused(const hard_way *way, const void *of, double figures[])
{
    const text_list *list = of;
    figures[0] = 0.0;
    for (size_t i = 0; i < list->count; ++i)
        if (!is_refused(list->texts[i])) {
            figures[0] += 1.0;
            print_error("%s: taken, or refused without its line: %s\n", way->name, list->texts[i]);
        }
}

static void hold_refused(int row, const char *name, const text_list *list)
{
    const hard_case c = {.row = row,
                         .name = name,
                         .figures = {{"not refused with their line", {0, 0, 0, 0}}},
                         .naives = {NULL},
                         .measure = measure_refused,
                         .of = list};
    hard_hold(&c);
    hard_finish();
    assert_false(is_refused("sphere center 0 0 0 radius 1 material m"));
}

static void radii(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "sphere center 0 0 0 radius 0 material m",    "sphere center 0 0 0 radius -0 material m",
        "sphere center 0 0 0 radius -1 material m",   "sphere center 0 0 0 radius nan material m",
        "sphere center 0 0 0 radius inf material m",  "sphere center 0 0 0 radius 1e39 material m",
        "sphere center 0 0 0 radius 1e-46 material m"};
    hold_refused(20, "radii of 0, below, infinite, no number",
                 &(text_list){texts, sizeof texts / sizeof *texts});
}

static void not_finite(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "triangle a nan 0 0 b 1 0 0 c 0 1 0 material m",
        "triangle a 0 0 0 b inf 0 0 c 0 1 0 material m",
        "triangle a 0 0 0 b 1 0 0 c 0 1e39 0 material m",
        "triangle a 0 0 0 b 1 0 0 c 0 1 0 na nan 0 0 nb 0 0 1 nc 0 0 1 material m",
        "sphere center 0 -inf 0 radius 1 material m",
        "light point at nan 0 0",
        "light point at 0 0 0 color inf 0 0",
        "light directional direction 0 0 nan",
        "camera from 0 nan 0",
        "camera at 0 0 inf",
        "ambient nan 0 0",
        "mesh \"m.obj\" material m scale inf",
        "mesh \"m.obj\" material m translate 0 nan 0",
        "mesh \"m.obj\" material m rotate 0 0 nan"};
    hold_refused(29, "coordinates and colours not finite",
                 &(text_list){texts, sizeof texts / sizeof *texts});
}

/* A mesh's own numbers, and those that its matrix makes infinite. */
static void not_finite_in_meshes(void **state)
{
    (void)state;
    static const char *const vertices[] = {"v nan 0 0", "v 0 inf 0", "v 0 0 1e39"};
    for (int i = 0; i < 4; ++i) {
        char text[200];
        rt_scene scene;
        rt_status status = RT_STATUS_INIT;
        snprintf(text, sizeof text, "v 1e30 0 0\nv 0 1 0\n%s\nf 1 2 3\n",
                 i < 3 ? vertices[i] : "v 0 0 1");
        test_write_text(test_path("m.obj"), text);
        snprintf(text, sizeof text, "rt 1\nmaterial m\nmesh \"m.obj\" material m scale %s\n",
                 i < 3 ? "1" : "1e30");
        const char *path = test_path("refused.txt");
        test_write_text(path, text);
        rt_scene_init(&scene);
        assert_false(rt_scene_read(&scene, path, &status));
        assert_non_null(strstr(status.text, i < 3 ? "m.obj:3:" : "refused.txt:3:"));
        rt_status_clear(&status);
        rt_scene_clear(&scene);
    }
}

/* ---- Dropped ---- */

/* Triangles without area among others: told of by number, never hit, in nobody's way. */
static void measure_no_area(const hard_way *way, const void *of, double figures[])
{
    static const char text[] = "rt 1\nmaterial m\n"
                               "triangle a 0 0 0 b 0 0 0 c 1 1 0 material m\n"
                               "triangle a 1 2 3 b 1 2 3 c 1 2 3 material m\n"
                               "triangle a -90 -90 -1 b 90 -90 -1 c 0 90 -1 material m\n"
                               "triangle a -1 -1 0 b 0 0 0 c 2 2 0 material m\n"
                               "triangle a 0 0 0 b 1e-30 0 0 c 3e-30 0 0 material m\n";
    const char *path = test_path("area.txt");
    test_random random = {51};
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    hard_tracer tracer;
    (void)of;
    test_write_text(path, text);
    rt_scene_init(&scene);
    assert_good(rt_scene_read(&scene, path, &status), &status);
    figures[0] = !(status.text && strstr(status.text, "(4 such)"));
    rt_status_clear(&status);
    if (way->naive)
        scene.triangles[3] = (rt_triangle){-1, -1, 0, 0, 0, 0, 2, 2, 0};
    for (size_t i = 0; i < HARD_CHUNK; ++i) {
        const float f = test_random_float(&random, -1.0f, 2.0f);
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        for (int k = 0; k < 3; ++k) {
            rays[i].origin[k] = k == 2 ? 2.0f : test_random_float(&random, -0.3f, 0.3f);
            rays[i].direction[k] = (k == 2 ? 0.0f : f) - rays[i].origin[k];
        }
    }
    hard_open(&tracer, way, &scene);
    hard_trace(&tracer, rays, HARD_CHUNK, hits);
    figures[1] = 0.0;
    for (size_t i = 0; i < HARD_CHUNK; ++i)
        figures[1] += hits[i].primitive != 2;
    hard_close(&tracer);
    rt_scene_clear(&scene);
}

static void no_area(void **state)
{
    (void)state;
    const hard_case c = {.row = 11,
                         .name = "equal corners, corners on a line",
                         .figures = {{"not told of", {0, 0, 0, 0}},
                                     {"rays that miss what is behind them", {0, 0, 0, 0}}},
                         .naives = {&hard_naive_woop},
                         .measure = measure_no_area};
    hard_hold(&c);
    hard_finish();
}

/* ---- Denormals ---- */

/* A square of the size of the smallest normal number's thousandth, met at right angles, and one of
 * size 1 met by rays whose direction has a denormal component. */
static void measure_denormals(const hard_way *way, const void *of, double figures[])
{
    const bool is_tiny = *(const bool *)of;
    const size_t count = 4096;
    const float s = is_tiny ? 1e-40f : 1.0f;
    test_random random = {52};
    rt_scene scene;
    hard_tracer tracer;
    hard_scene(&scene);
    hard_add_triangle(&scene, (const float[9]){-s, -s, 0, s, -s, 0, s, s, 0});
    hard_add_triangle(&scene, (const float[9]){-s, -s, 0, s, s, 0, -s, s, 0});
    for (size_t i = 0; i < count; ++i) {
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        rays[i].origin[0] = s * test_random_float(&random, -1.5f, 1.5f);
        rays[i].origin[1] = s * test_random_float(&random, -1.5f, 1.5f);
        rays[i].origin[2] = 2.0f * s;
        rays[i].direction[0] = is_tiny ? 0.0f : 1e-40f * test_random_float(&random, -1.0f, 1.0f);
        rays[i].direction[2] = -1.0f;
    }
    hard_open(&tracer, way, &scene);
    hard_trace(&tracer, rays, count, hits);
    figures[0] = figures[1] = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const bool truth = hard_true_triangle(&rays[i], &scene.triangles[0]).is_hit ||
                           hard_true_triangle(&rays[i], &scene.triangles[1]).is_hit;
        const bool is_hit = hits[i].primitive != RT_MISS;
        figures[0] += is_hit && !(isfinite(hits[i].t) && isfinite(hits[i].u));
        figures[1] += is_hit != truth;
    }
    figures[1] *= 100.0 / (double)count;
    hard_close(&tracer);
    rt_scene_clear(&scene);
}

static void denormals(void **state)
{
    (void)state;
    static const bool tiny[] = {true, false};
    static const char *const names[] = {"a square of size 1e-40",
                                        "directions with a component of 1e-40"};
    for (int i = 0; i < 2; ++i) {
        const hard_case c = {.row = 28,
                             .name = names[i],
                             .figures = {{"hits not finite", {0, 0, 0, 0}},
                                         {"wrong hits, %", {TOLD, TOLD, i ? 0 : TOLD, 0}}},
                             .naives = {NULL},
                             .measure = measure_denormals,
                             .of = &tiny[i]};
        hard_hold(&c);
    }
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(radii), cmocka_unit_test(not_finite),
                                       cmocka_unit_test(not_finite_in_meshes),
                                       cmocka_unit_test(no_area), cmocka_unit_test(denormals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
