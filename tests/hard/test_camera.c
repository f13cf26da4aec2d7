/* The camera inside of things, along `up`, at the ends of its angle: rows 36 to 38 of the hard
 * cases. */
#define _GNU_SOURCE
#include "hard/exact.h"
#include "hard/mesh.h"
#include "hard/naive.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/camera.h"
#include "scene_file/read.h"

#define TOLD HARD_REPORT

static rt_ray rays[HARD_CHUNK];
static rt_hit hits[HARD_CHUNK];

/* ---- Inside ---- */

/* The index of what is hit by the truth: the nearest of all; -2 where another is within 1e-6 of it,
 * or where a sphere is only just touched, so that any answer is lawful. */
static int true_index(const rt_scene *scene, const rt_ray *ray)
{
    double best = (double)INFINITY, second = best;
    int index = RT_MISS;
    const int spheres = (int)scene->sphere_count;
    for (int i = 0; i < spheres + (int)scene->triangle_count; ++i) {
        const hard_truth t = i < spheres ? hard_true_sphere(ray, &scene->spheres[i])
                                         : hard_true_triangle(ray, &scene->triangles[i - spheres]);
        if (i < spheres && t.margin < 64.0)
            return -2;
        if (t.t < best) {
            second = best;
            best = t.t;
            index = i;
        } else if (t.t < second) {
            second = t.t;
        }
    }
    return second - best < 1e-6 * best ? -2 : index;
}

/* From inside of a sphere, of a small sphere in it, and of a mesh around both. */
static void measure_inside(const hard_way *way, const void *of, double figures[])
{
    static const float origins[3][3] = {{0.1f, 0.2f, 0.3f}, {0.5f, 0.5f, 0.5f}, {2.9f, 0, 0}};
    const size_t count = 6144;
    test_random random = {41};
    rt_scene scene;
    hard_mesh mesh;
    hard_tracer tracer;
    (void)of;
    hard_scene(&scene);
    hard_add_sphere(&scene, 0.0f, 0.0f, 0.0f, 2.0f);
    hard_add_sphere(&scene, 0.5f, 0.5f, 0.5f, 0.25f);
    hard_mesh_ball(&mesh, 3, (const double[3]){0, 0, 0}, 4.0);
    hard_mesh_fill(&scene, &mesh, -1, 0);
    for (size_t i = 0; i < count; ++i) {
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        memcpy(rays[i].origin, origins[i % 3], sizeof origins[0]);
        for (int k = 0; k < 3; ++k)
            rays[i].direction[k] = test_random_float(&random, -1.0f, 1.0f);
    }
    hard_open(&tracer, way, &scene);
    hard_trace(&tracer, rays, count, hits);
    figures[0] = 0.0;
    size_t judged = 0;
    for (size_t i = 0; i < count; ++i) {
        const int truth = true_index(&scene, &rays[i]);
        judged += truth != -2;
        figures[0] += truth != -2 && hits[i].primitive != truth;
    }
    assert_true(judged > count * 9 / 10);
    hard_close(&tracer);
    hard_mesh_clear(&mesh);
    rt_scene_clear(&scene);
}

static void inside(void **state)
{
    (void)state;
    /* Only what comes in from outside, as if one were never inside. */
    const hard_case c = {.row = 36,
                         .name = "the eye inside of spheres and a mesh",
                         .figures = {{"wrong index of 6144", {TOLD, TOLD, 0, 0}}},
                         .naives = {&hard_naive_entering},
                         .measure = measure_inside};
    hard_hold(&c);
    hard_finish();
}

/* ---- Along up ---- */

/* How far three axes are from unit and from square, in ulp of 1. */
static double skew(double axes[3][3])
{
    double worst = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) {
            double dot = i == j ? -1.0 : 0.0;
            for (int k = 0; k < 3; ++k)
                dot += axes[i][k] * axes[j][k];
            const double off = fabs(dot) * 0x1p23;
            worst = !(off <= worst) ? off : worst;
        }
    return worst;
}

/* Half a pixel times the length of an axis: what makes it unit again. */
static double half_pixel(const rt_scene *scene)
{
    return tan((double)scene->camera.vfov * 3.14159265358979323846 / 360.0) / scene->height;
}

static void frame_axes(const rt_scene *scene, double axes[3][3])
{
    const rt_frame f = rt_scene_frame(scene);
    const double h = half_pixel(scene);
    const double all[3][3] = {{(double)f.right_x / h, (double)f.right_y / h, (double)f.right_z / h},
                              {(double)f.up_x / h, (double)f.up_y / h, (double)f.up_z / h},
                              {(double)f.forward_x, (double)f.forward_y, (double)f.forward_z}};
    memcpy(axes, all, sizeof all);
}

/* right = forward x up, whatever that is. */
static void naive_axes(const rt_scene *scene, double axes[3][3])
{
    const rt_camera *c = &scene->camera;
    const float f[3] = {c->at.x - c->from.x, c->at.y - c->from.y, c->at.z - c->from.z};
    const float u[3] = {c->up.x, c->up.y, c->up.z};
    for (int i = 0; i < 3; ++i) {
        float length = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const float v[3] = {f[(k + 1) % 3] * u[(k + 2) % 3] - f[(k + 2) % 3] * u[(k + 1) % 3],
                                u[k], f[k]};
            axes[i][k] = (double)v[i];
            length += v[i] * v[i];
        }
        for (int k = 0; k < 3; ++k)
            axes[i][k] /= (double)sqrtf(length);
    }
}

static void measure_up(const hard_way *way, const void *of, double figures[])
{
    test_random random = {42};
    (void)of;
    figures[0] = 0.0;
    for (int i = 0; i < 3000; ++i) {
        rt_scene scene;
        double axes[3][3];
        rt_scene_init(&scene);
        float d[3];
        for (int k = 0; k < 3; ++k)
            d[k] = test_random_float(&random, -1.0f, 1.0f);
        if (i < 3)
            for (int k = 0; k < 3; ++k)
                d[k] = k == i ? -1.0f : 0.0f;
        scene.camera.at = (rt_vec3){d[0], d[1], d[2]};
        /* Along the view to the bit, about along it, or anywhere. */
        const float off = i % 3 == 2 ? 0.5f : i % 3 == 1 ? 1e-7f : 0.0f;
        scene.camera.up = (rt_vec3){2.0f * d[0], 2.0f * d[1] + off, 2.0f * d[2]};
        if (way->naive)
            naive_axes(&scene, axes);
        else
            frame_axes(&scene, axes);
        const double s = skew(axes);
        figures[0] = !(s <= figures[0]) ? s : figures[0];
    }
}

static void along_up(void **state)
{
    (void)state;
    static const hard_naive no_fallback = {.name = "forward x up"};
    const hard_case c = {.row = 37,
                         .name = "3000 views, two thirds along up",
                         .figures = {{"axes off square and unit, ulp", {4, 4, 4, 4}}},
                         .naives = {&no_fallback},
                         .measure = measure_up};
    hard_hold(&c);
    hard_finish();
}

/* ---- The angle of view ---- */

#define ROWS 16384

/* One column of pixels over an angle of view of 1e-3 degrees onto a triangle as large as what is
 * seen: where (u, v) of neighbours are equal, their rays have become one. */
static void measure_narrow(const hard_way *way, const void *of, double figures[])
{
    rt_scene scene;
    rt_image image;
    (void)of;
    test_scene(&scene, "image width 1 height 16384\ncamera from 0 0 0 at 1 2 -3 vfov 0.001\n"
                       "material m\ntriangle a 0.99997 1.99997 -3 b 1.00003 2 -3.00001 "
                       "c 1 2.00004 -2.99996 material m\n");
    hard_draw(way, &scene, &image);
    size_t equal = 0, hit = 0, not_finite = 0;
    for (int y = 0; y < ROWS; ++y) {
        const rt_hit *h = &image.hits[y];
        hit += h->primitive == 0;
        not_finite += h->primitive == 0 && !(isfinite(h->t) && isfinite(h->u) && isfinite(h->v));
        equal += y > 0 && h[-1].primitive == 0 && h->primitive == 0 && h->u == h[-1].u &&
                 h->v == h[-1].v;
    }
    figures[0] = hit > 1000 ? 100.0 * (double)equal / (double)hit : (double)NAN;
    figures[1] = (double)not_finite;
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

/* Nearly half a turn: the rays at the rim are nearly square to the axis. Along a row the place that
 * is hit must go one way. */
static void measure_wide(const hard_way *way, const void *of, double figures[])
{
    rt_scene scene;
    rt_image image;
    (void)of;
    test_scene(&scene, "image width 512 height 512\ncamera from 0 0 0 at 0 0 -1 vfov 179.99\n"
                       "background 1 1 1\nmaterial m kd 1 1 1\n"
                       "triangle a -9e4 -9e4 -1 b 9e4 -9e4 -1 c 0 9e4 -1 material m\n"
                       "light point at 0 0 0\n");
    hard_draw(way, &scene, &image);
    size_t backward = 0, hit = 0;
    for (int i = 1; i < 512 * 512; ++i) {
        const rt_hit *h = &image.hits[i];
        hit += h->primitive == 0;
        /* x is what b weighs against a, and half of c. */
        backward += i % 512 > 0 && h->primitive == 0 && h[-1].primitive == 0 &&
                    !(h->u + 0.5f * h->v >= h[-1].u + 0.5f * h[-1].v);
    }
    assert_true(hit > 1000);
    figures[0] = (double)backward;
    figures[1] = (double)rt_image_compare(&image, &image).non_finite;
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

static void angles(void **state)
{
    (void)state;
    /* Neighbours are 1e-9 apart, and a float's direction has steps of 6e-8. */
    const hard_case narrow = {
        .row = 38,
        .name = "16384 pixels in 1e-3 degrees",
        .figures = {{"rays equal to their neighbours, %", {TOLD, TOLD, TOLD, 0}},
                    {"hits not finite", {0, 0, 0, 0}}},
        .measure = measure_narrow};
    hard_hold(&narrow);
    const hard_case wide = {
        .row = 38,
        .name = "179.99 degrees",
        .figures = {{"places that go backward", {0, 0, 0, 0}}, {"pixels not finite", {0, 0, 0, 0}}},
        .measure = measure_wide};
    hard_hold(&wide);
    hard_finish();
}

static void angles_that_are_none(void **state)
{
    (void)state;
    static const char *const texts[] = {"rt 1\ncamera vfov 0\n", "rt 1\ncamera vfov 180\n",
                                        "rt 1\ncamera vfov -1\n", "rt 1\ncamera vfov 1e-50\n"};
    for (int i = 0; i < 4; ++i) {
        rt_scene scene;
        rt_status status = RT_STATUS_INIT;
        const char *path = test_path("angle.txt");
        rt_scene_init(&scene);
        test_write_text(path, texts[i]);
        assert_false(rt_scene_read(&scene, path, &status));
        assert_non_null(strstr(status.text, "angle.txt:2:"));
        rt_status_clear(&status);
        rt_scene_clear(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inside),
        cmocka_unit_test(along_up),
        cmocka_unit_test(angles),
        cmocka_unit_test(angles_that_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
