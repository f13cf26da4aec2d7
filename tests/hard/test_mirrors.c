/* Light that goes on and on: mirrors and glass, rows 32 to 35 of the hard cases, by pictures that
 * tell how far light has gone and how much of it is left. */
#include "hard/naive.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/camera.h"

#define TOLD HARD_REPORT

/* ---- How far has light gone? ---- */

/* In white fog between black mirrors, what reaches the eye along a way of length L is
 * 1 - exp(-density L): the picture tells L. */
static double way_of(float rgb, double density)
{
    return -log1p(-(double)rgb) / density;
}

/* Inside a mirror sphere all chords of a path are equally long: 2 r times the cosine at which it
 * first meets the sphere. */
static void measure_mirror_sphere(const hard_way *way, const void *of, double figures[])
{
    const int bounces = *(const int *)of;
    const double density = 0.5 / bounces;
    const int side = 32;
    rt_scene scene;
    rt_image image;
    hard_read(&scene,
              "image width %d height %d\ncamera from 0.25 0.125 0.5 at 1 0 0 vfov 90\ndepth %d\n"
              "fog 1 1 1 density %.9g\nmaterial m reflect 1\n"
              "sphere center 0 0 0 radius 1 material m\n",
              side, side, bounces, density);
    hard_draw(way, &scene, &image);
    const rt_view view = rt_scene_view(&scene);
    figures[0] = 0.0;
    for (int i = 0; i < side * side; ++i) {
        double d[3], length = 0.0, b = 0.0, ff = 0.0;
        for (int k = 0; k < 3; ++k) {
            d[k] = view.right[k] * (2 * (i % side) + 1 - side) +
                   view.up[k] * (side - 1 - 2 * (i / side)) + view.forward[k];
            length += d[k] * d[k];
        }
        for (int k = 0; k < 3; ++k) {
            b -= view.origin[k] * d[k] / sqrt(length);
            ff += view.origin[k] * view.origin[k];
        }
        const double half_chord = sqrt(1.0 - (ff - b * b));
        const double truth = b + half_chord + 2.0 * half_chord * bounces;
        const double error = fabs(way_of(image.rgb[3 * i], density) / truth - 1.0);
        figures[0] = !(error <= figures[0]) ? error : figures[0];
    }
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

/* Two mirrors askew to all axes, whose corners are whole numbers: n = (2, 3, 6) is at right angles
 * to (3, -6, 2) and (6, 2, -3), all of length 7. Every crossing is 7 / cos long. */
static void add_skew_plate(rt_scene *scene, float away, float reach)
{
    static const float u[3] = {3, -6, 2}, v[3] = {6, 2, -3}, n[3] = {2, 3, 6};
    static const float signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    float p[4][3];
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k)
            p[i][k] = away * n[k] + reach * (signs[i][0] * u[k] + signs[i][1] * v[k]);
    for (int half = 0; half < 2; ++half) {
        float corners[9];
        memcpy(corners, p[0], sizeof p[0]);
        memcpy(corners + 3, p[1 + half], sizeof p[0]);
        memcpy(corners + 6, p[2 + half], sizeof p[0]);
        hard_add_triangle(scene, corners);
    }
}

/* Half a side of the mirrors in distances between them, and the angle of view. */
typedef struct corridor {
    float half;
    double vfov;
} corridor;

static void measure_parallel(const hard_way *way, const void *of, double figures[])
{
    const corridor *c = of;
    const int bounces = 64;
    const double density = 0.05 / bounces;
    const int side = 32;
    rt_scene scene;
    rt_image image;
    hard_read(&scene,
              "image width %d height %d\ncamera from 0.5 0.75 1.5 at 2.5 3.75 7.5 vfov %.9g\n"
              "depth %d\nfog 1 1 1 density %.9g\nmaterial m reflect 1\n",
              side, side, c->vfov, bounces, density);
    add_skew_plate(&scene, 0.0f, c->half);
    add_skew_plate(&scene, 1.0f, c->half);
    hard_draw(way, &scene, &image);
    const rt_view view = rt_scene_view(&scene);
    figures[0] = 0.0;
    for (int i = 0; i < side * side; ++i) {
        double length = 0.0, d_n = 0.0;
        static const double n[3] = {2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0};
        for (int k = 0; k < 3; ++k) {
            const double d = view.right[k] * (2 * (i % side) + 1 - side) +
                             view.up[k] * (side - 1 - 2 * (i / side)) + view.forward[k];
            length += d * d;
            d_n += d * n[k];
        }
        const double start = (0.5 * 2.0 + 0.75 * 3.0 + 1.5 * 6.0) / 7.0;
        const double truth = (7.0 - start + 7.0 * bounces) * sqrt(length) / fabs(d_n);
        const double error = fabs(way_of(image.rgb[3 * i], density) / truth - 1.0);
        figures[0] = !(error <= figures[0]) ? error : figures[0];
    }
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

static void mirrors(void **state)
{
    (void)state;
    static const int bounces[] = {64, 256, 1024};
    /* What is measured is a colour, and colours are float at every level: each bounce rounds the
     * part that fog has let through, and the logarithm doubles what is left of it. 1e-9 could not
     * be read off. */
    static const double lawful[] = {1e-3, 1e-2, 1e-1}, in_double[] = {1e-5, 1e-4, 1e-3};
    for (int i = 0; i < 3; ++i) {
        char name[64];
        snprintf(name, sizeof name, "inside a mirror sphere, %d bounces", bounces[i]);
        const double gate = i ? TOLD : lawful[i];
        const hard_case c = {.row = 32,
                             .name = name,
                             .figures = {{"length of the way, relative error",
                                          {gate, gate, i ? TOLD : 1e-3, in_double[i]}}},
                             .naives = {i ? NULL : &hard_naive_no_offset},
                             .measure = measure_mirror_sphere,
                             .of = &bounces[i]};
        hard_hold(&c);
    }
    /* A ray starts a bound of the rounding away from its mirror, and that is relative to the
     * mirror's corners: 1e-4 hold where mirrors are up to some ten times as large as their
     * distance. */
    static const corridor corridors[] = {{16.0f, 5.0}, {512.0f, 40.0}};
    static const char *const names[] = {"64 bounces between mirrors 32 distances wide",
                                        "64 bounces between mirrors 1024 distances wide"};
    for (int i = 0; i < 2; ++i) {
        const hard_case c = {
            .row = 33,
            .name = names[i],
            .figures = {{"length of the way, relative error", {TOLD, TOLD, i ? 1e-3 : 1e-4, 1e-5}}},
            .naives = {&hard_naive_no_offset},
            .measure = measure_parallel,
            .of = &corridors[i]};
        hard_hold(&c);
    }
    hard_finish();
}

static size_t non_finite(const rt_image *image)
{
    return rt_image_compare(image, image).non_finite;
}

static void measure_chaos(const hard_way *way, const void *of, double figures[])
{
    (void)of;
    rt_scene scene;
    rt_image image;
    hard_read(&scene,
              "image width 128 height 128\ncamera from 0 0.3 4 at 0 0 0 vfov 50\ndepth 1024\n"
              "background 0.5 0.5 0.5\nlight directional direction -1 -1 -1 shadow on\n"
              "material m kd 0.1 0.1 0.1 reflect 0.99\n"
              "sphere center -1.0001 0 0 radius 1 material m\n"
              "sphere center 1.0001 0 0 radius 1 material m\n");
    hard_draw(way, &scene, &image);
    figures[0] = (double)non_finite(&image);
    size_t black = 0;
    for (size_t i = 0; i < 128 * 128; ++i)
        black += !(image.rgb[3 * i] > 0.0f);
    figures[1] = (double)black;
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

static void chaos(void **state)
{
    (void)state;
    const hard_case c = {.row = 34,
                         .name = "two convex mirrors, up to 1024 bounces",
                         .figures = {{"pixels not finite", {0, 0, 0, 0}},
                                     {"pixels that bring nothing", {TOLD, TOLD, 0, 0}}},
                         .measure = measure_chaos};
    hard_hold(&c);
    hard_finish();
}

/* ---- Glass at the critical angle ---- */

/* The eye is on the dense side of a plane of glass and looks at it at the critical angle, a few ulp
 * of sine a pixel. All around is white: whatever is reflected and whatever is let through must add
 * up to white. */
static void measure_total_reflection(const hard_way *way, const void *of, double figures[])
{
    (void)of;
    rt_scene scene;
    rt_image image;
    hard_read(&scene,
              "image width 64 height 1024\ncamera from 0 0 -1 at %.9g 0 0 up 0 0 1 vfov 0.01\n"
              "background 1 1 1\ndepth 4\nmaterial m transmit 1 ior 1.5\n",
              1.0 / sqrt(1.25)); /* the tangent where the sine is 1 / 1.5 */
    const float s = 1000.0f;
    hard_add_triangle(&scene, (const float[9]){-s, -s, 0, s, -s, 0, s, s, 0});
    hard_add_triangle(&scene, (const float[9]){-s, -s, 0, s, s, 0, -s, s, 0});
    hard_draw(way, &scene, &image);
    figures[0] = 0.0;
    figures[1] = (double)non_finite(&image);
    for (size_t i = 0; i < 3 * 64 * 1024; ++i) {
        const double error = fabs((double)image.rgb[i] - 1.0);
        figures[0] = !(error <= figures[0]) ? error : figures[0];
    }
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

static void total_reflection(void **state)
{
    (void)state;
    static const hard_naive no_guard = {.mutant = MUTANT_ROOT_OF_NEGATIVE};
    /* Colours are float at every level. */
    const hard_case c = {.row = 35,
                         .name = "glass at the critical angle, within 2^-13 of it",
                         .figures = {{"R + T is off 1 by", {TOLD, TOLD, 1e-6, 1e-6}},
                                     {"pixels not finite", {0, 0, 0, 0}}},
                         .naives = {&no_guard},
                         .measure = measure_total_reflection};
    hard_hold(&c);
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(mirrors), cmocka_unit_test(chaos),
                                       cmocka_unit_test(total_reflection)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
