/* Light at its limits: rows 24, 25, 28, 30, 31 and 41 of the hard cases. */
#define _GNU_SOURCE
#include "hard/exact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/camera.h"

#define TOLD HARD_REPORT

static void draw_text(const hard_way *way, rt_image *image, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static void draw_text(const hard_way *way, rt_image *image, const char *format, ...)
{
    char *text = NULL;
    rt_scene scene;
    va_list arguments;
    va_start(arguments, format);
    assert_true(vasprintf(&text, format, arguments) > 0);
    va_end(arguments);
    test_scene(&scene, text);
    free(text);
    hard_draw(way, &scene, image);
    rt_scene_clear(&scene);
}

/* ---- A light on the horizon ---- */

#define QUAD                                                                                       \
    "triangle a -9 0 -9 b 9 0 -9 c 9 0 9 material m\n"                                             \
    "triangle a -9 0 -9 b 9 0 9 c -9 0 9 material m\n"

/* A floor under a light that rises from below the horizon to above it in steps of an ulp. Its light
 * must not flicker: none up to the horizon, then more and more. */
static void measure_horizon(const hard_way *way, const void *of, double figures[])
{
    float before = 0.0f;
    (void)of;
    figures[0] = figures[1] = 0.0;
    for (int k = -8; k <= 8; ++k) {
        rt_image image;
        draw_text(way, &image,
                  "image width 8 height 8\ncamera from 0 1 0 at 0.1 0 0 vfov 20\nshadows on\n"
                  "light directional direction -1 %.9g 0 color 1e6 1e6 1e6\n"
                  "material m kd 1 1 1\n" QUAD,
                  -k * 0x1p-23);
        const float light = image.rgb[0];
        figures[0] += k <= 0 && !(light == 0.0f);
        figures[1] += k > 0 && !(light > before);
        before = light;
        rt_image_clear(&image);
    }
}

static void horizon(void **state)
{
    (void)state;
    static const hard_naive no_sign = {.mutant = MUTANT_LIT_FROM_BEHIND};
    const hard_case c = {.row = 24,
                         .name = "a light k ulp above the horizon, k = -8 .. 8",
                         .figures = {{"lit from below", {TOLD, TOLD, 0, 0}},
                                     {"steps without more light", {TOLD, TOLD, 0, 0}}},
                         .naives = {&no_sign},
                         .measure = measure_horizon};
    hard_hold(&c);
    hard_finish();
}

/* ---- A light on the surface ---- */

static void measure_touching(const hard_way *way, const void *of, double figures[])
{
    rt_image image;
    (void)of;
    draw_text(way, &image,
              "image width 1 height 1\ncamera from 0 1 0 at 0 0 0 up 0 0 1\n"
              "ambient 0.25 0.25 0.25\nlight point at 0 0 0\n"
              "material m ka 1 1 1 kd 1 1 1 ks 1 1 1 shininess 0\n" QUAD);
    /* Shininess 0 is 1 whatever the cosine, unless the light counts as none. */
    figures[0] = fabs((double)image.rgb[0] - 0.25);
    rt_image_clear(&image);
}

static void touching(void **state)
{
    (void)state;
    static const hard_naive no_guard = {.mutant = MUTANT_LIGHT_AT_THE_POINT};
    const hard_case c = {.row = 25,
                         .name = "a light at the point itself",
                         .figures = {{"off the ambient light by", {0, 0, 0, 0}}},
                         .naives = {&no_guard},
                         .measure = measure_touching};
    hard_hold(&c);
    hard_finish();
}

/* ---- Shading normals ---- */

static void draw_normals(const hard_way *way, const char *normals, rt_image *image)
{
    draw_text(way, image,
              "image width 64 height 64\ncamera from 0 1 0 at 0.3 0 0.2 vfov 60\n"
              "light point at 1 2 1\nmaterial m kd 1 1 1 ks 1 1 1 shininess 8\n"
              "triangle a -9 0 -9 b 9 0 -9 c 9 0 9 material m %s\n"
              "triangle a -9 0 -9 b 9 0 9 c -9 0 9 material m %s\n",
              normals, normals);
}

static void measure_normals(const hard_way *way, const void *of, double figures[])
{
    static const char *const normals[] = {"na 0 1 0 nb 0 1 0 nc 0 1 0",
                                          "na 0 -1 0 nb 0 -1 0 nc 0 -1 0",
                                          "na 0 0 0 nb 0 0 0 nc 0 0 0"};
    rt_image flat;
    (void)of;
    draw_normals(way, "", &flat);
    for (int i = 0; i < 3; ++i) {
        rt_image image;
        draw_normals(way, normals[i], &image);
        const rt_image_difference d = rt_image_compare(&flat, &image);
        figures[i] = d.non_finite ? 255.0 : (double)d.max_step;
        rt_image_clear(&image);
    }
    rt_image_clear(&flat);
}

static void normals(void **state)
{
    (void)state;
    static const hard_naive no_side = {.mutant = MUTANT_SMOOTH_NOT_TURNED};
    static const hard_naive no_guard = {.mutant = MUTANT_SMOOTH_OF_ZERO};
    /* At fast the flat picture's program and the smooth one's may round a quotient differently, by
     * the processor's own estimate of a reciprocal, and an ulp can be a step. */
    const hard_case c = {.row = 30,
                         .name = "vertex normals n, -n, 0",
                         .figures = {{"n is off the geometric normal by steps", {1, 0, 0, 0}},
                                     {"-n is off it by steps", {1, 0, 0, 0}},
                                     {"0 is off it by steps", {1, 0, 0, 0}}},
                         .naives = {&no_side, &no_guard},
                         .measure = measure_normals};
    hard_hold(&c);
    hard_finish();
}

/* ---- Phong's exponent ---- */

typedef struct exponent {
    const char *text;
    double vfov; /* so that the highlight fills the picture */
} exponent;

/* A wall square to the axis and a light straight behind the eye: the cosine of the highlight is the
 * part of the view's direction along the axis. What the kernel makes of that number is held against
 * pow in double. The number itself is the level's: the direction's third component, unit by the
 * kernel's formula. */
static double cosine_in_float(const rt_frame *f, int x, int y)
{
    const float across = (float)(2 * x + 1 - f->width), upward = (float)(f->height - 1 - 2 * y);
    float d[3] = {fmaf(f->right_x, across, fmaf(f->up_x, upward, f->forward_x)),
                  fmaf(f->right_y, across, fmaf(f->up_y, upward, f->forward_y)),
                  fmaf(f->right_z, across, fmaf(f->up_z, upward, f->forward_z))};
    const float length = sqrtf(fmaf(d[0], d[0], fmaf(d[1], d[1], d[2] * d[2])));
    const float inverse = 1.0f / length;
    return (double)-(d[2] * inverse);
}

static double cosine_in_double(const rt_view *v, int width, int height, int x, int y)
{
    double d[3], length = 0.0;
    for (int k = 0; k < 3; ++k) {
        d[k] = v->right[k] * (2 * x + 1 - width) + v->up[k] * (height - 1 - 2 * y) + v->forward[k];
        length += d[k] * d[k];
    }
    return -d[2] / sqrt(length);
}

#define SIDE 64

static void measure_exponent(const hard_way *way, const void *of, double figures[])
{
    const exponent *e = of;
    char *text = NULL;
    rt_scene scene;
    rt_image image;
    assert_true(asprintf(&text,
                         "image width %d height %d\ncamera from 0 0 0 at 0 0 -1 vfov %.9g\n"
                         "light directional direction 0 0 -1\nmaterial m ks 1 1 1 shininess %s\n"
                         "triangle a -9 -9 -1 b 9 -9 -1 c 0 9 -1 material m\n",
                         SIDE, SIDE, e->vfov, e->text) > 0);
    test_scene(&scene, text);
    free(text);
    hard_draw(way, &scene, &image);
    const rt_view view = rt_scene_view(&scene);
    const rt_frame frame = rt_scene_frame(&scene);
    const double n = atof(e->text);
    figures[0] = figures[1] = 0.0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const int x = i % SIDE, y = i / SIDE;
        const double cosine = way->level == RT_ACCURACY_DOUBLE
                                  ? cosine_in_double(&view, SIDE, SIDE, x, y)
                                  : cosine_in_float(&frame, x, y);
        const double truth = pow(cosine, n);
        const int steps = abs(rt_image_step(image.rgb[3 * i]) - rt_image_step((float)truth));
        figures[0] = isnan(image.rgb[3 * i]) ? NAN : fmax(figures[0], steps);
        figures[1] = fmax(figures[1], fabs((double)image.rgb[3 * i] - truth));
    }
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

/* The light on the horizon of the wall: the cosine is 0 or negative, which counts as 0. */
static void measure_power_of_zero(const hard_way *way, const void *of, double figures[])
{
    static const char *const exponents[] = {"0", "1", "1e4", "0.5"};
    (void)of;
    figures[0] = 0.0;
    for (int i = 0; i < (way->naive ? 1 : 4); ++i) {
        rt_image image;
        draw_text(way, &image,
                  "image width 1 height 1\ncamera from 0 0 0 at 0 0 -1\n"
                  "light directional direction 0 -1 0\nmaterial m ks 1 1 1 shininess %s\n"
                  "triangle a -9 -9 -1 b 9 -9 -1 c 0 9 -1 material m\n",
                  exponents[i]);
        figures[0] += fabs((double)image.rgb[0] - (i == 0 ? 1.0 : 0.0));
        rt_image_clear(&image);
    }
}

static void exponents(void **state)
{
    (void)state;
    static const exponent subjects[] = {{"0", 40.0},    {"1", 40.0},  {"0.5", 40.0},
                                        {"10000", 1.0}, {"1e6", 0.1}, {"12345.5", 1.0}};
    static const hard_naive half = {.mutant = MUTANT_EXPONENT_OF_7_BITS};
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; ++i) {
        char name[64];
        /* At fast the view's direction is not rounded correctly, and at 1e6 an ulp of the cosine is
         * 6 % of the highlight: 2 steps cannot be. */
        const double fast = i == 4 ? TOLD : 2;
        snprintf(name, sizeof name, "shininess %s", subjects[i].text);
        const hard_case c = {.row = 31,
                             .name = name,
                             .figures = {{"off pow in double by steps", {fast, 1, 1, 1}},
                                         {"off it by", {TOLD, TOLD, TOLD, TOLD}}},
                             .naives = {i == 3 || i == 4 ? &half : NULL},
                             .measure = measure_exponent,
                             .of = &subjects[i]};
        hard_hold(&c);
    }
    static const hard_naive from_zero = {.mutant = MUTANT_POWER_OF_ZERO};
    const hard_case zero = {.row = 31,
                            .name = "0 to the power of 0, 1, 1e4, 0.5",
                            .figures = {{"off 1, 0, 0, 0 by", {0, 0, 0, 0}}},
                            .naives = {&from_zero},
                            .measure = measure_power_of_zero};
    hard_hold(&zero);
    hard_finish();
}

/* ---- A shadow on a floor that reaches to the horizon ---- */

#define SLOPES 4
#define BALL 0.6

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; ++k)
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void make_unit(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; ++k)
        v[k] /= length;
}

/* A ball above a huge triangle: `foot` is below it on the plane, `along` and `normal` are unit, and
 * light comes down by `sun`. */
typedef struct floor_scene {
    float corners[9];
    double foot[3], along[3], normal[3], ball[3], sun[3];
} floor_scene;

static void make_floor(floor_scene *f, test_random *random, float size)
{
    double e1[3], e2[3];
    for (int k = 0; k < 6; ++k)
        f->corners[k] = test_random_float(random, -size, size);
    for (int k = 0; k < 3; ++k) {
        f->corners[6 + k] = -f->corners[k] - f->corners[3 + k];
        e1[k] = (double)f->corners[3 + k] - (double)f->corners[k];
        e2[k] = (double)f->corners[6 + k] - (double)f->corners[k];
        f->along[k] = e1[k];
    }
    cross(e1, e2, f->normal);
    make_unit(f->normal);
    make_unit(f->along);
    double height = 0.0;
    for (int k = 0; k < 3; ++k)
        height += f->normal[k] * (double)f->corners[k];
    for (int k = 0; k < 3; ++k) {
        f->foot[k] = height * f->normal[k];
        f->ball[k] = (double)(float)(f->foot[k] + 0.7 * f->normal[k]);
        f->sun[k] = (double)(float)(0.5 * f->along[k] - f->normal[k]);
    }
}

/* How far a line through `from` passes the ball's centre. */
static double passes_at(const floor_scene *f, const double from[3], const double along[3])
{
    double unit[3] = {along[0], along[1], along[2]}, way[3], off[3];
    make_unit(unit);
    for (int k = 0; k < 3; ++k)
        way[k] = f->ball[k] - from[k];
    cross(way, unit, off);
    return sqrt(dot(off, off));
}

enum floor_pixel { NOT_SURE, LIT, IN_SHADOW };

/* What the pixel of that direction shows, where that is the floor, and not so near the rim of the
 * ball or of its shadow that rounding could tell. */
static enum floor_pixel floor_pixel(const floor_scene *f, const double eye[3], const double d[3])
{
    double down[3], point[3];
    for (int k = 0; k < 3; ++k)
        down[k] = f->foot[k] - eye[k];
    const double t = dot(down, f->normal) / dot(d, f->normal);
    for (int k = 0; k < 3; ++k)
        point[k] = eye[k] + t * d[k];
    if (!(t > 0.0) || dot(point, point) > 1e4 || passes_at(f, eye, d) < BALL + 0.02)
        return NOT_SURE;
    const double off = passes_at(f, point, f->sun) - BALL;
    return fabs(off) < 0.02 ? NOT_SURE : off < 0.0 ? IN_SHADOW : LIT;
}

static void measure_shadow(const hard_way *way, const void *of, double figures[])
{
    test_random random = {41};
    figures[0] = figures[1] = 0.0;
    for (int slope = 0; slope < SLOPES; ++slope) {
        floor_scene f;
        rt_scene scene;
        rt_image image;
        make_floor(&f, &random, *(const float *)of);
        const double *o = f.foot, *a = f.along, *n = f.normal;
        hard_read(&scene,
                  "image width %d height %d\nshadows on\nmaterial m kd 1 1 1\n"
                  "camera from %.9g %.9g %.9g at %.9g %.9g %.9g up %.9g %.9g %.9g vfov 50\n"
                  "light directional direction %.9g %.9g %.9g\n"
                  "sphere center %.9g %.9g %.9g radius %.9g material m\n",
                  SIDE, SIDE, o[0] + 6 * a[0] + 1.5 * n[0], o[1] + 6 * a[1] + 1.5 * n[1],
                  o[2] + 6 * a[2] + 1.5 * n[2], o[0], o[1], o[2], n[0], n[1], n[2], f.sun[0],
                  f.sun[1], f.sun[2], f.ball[0], f.ball[1], f.ball[2], BALL);
        hard_add_triangle(&scene, f.corners);
        hard_draw(way, &scene, &image);
        const rt_view v = rt_scene_view(&scene);
        int shadowed = 0;
        for (int i = 0; i < SIDE * SIDE; ++i) {
            double d[3];
            for (int k = 0; k < 3; ++k)
                d[k] = v.right[k] * (2 * (i % SIDE) + 1 - SIDE) +
                       v.up[k] * (SIDE - 1 - 2 * (i / SIDE)) + v.forward[k];
            const enum floor_pixel truth = floor_pixel(&f, v.origin, d);
            shadowed += truth == IN_SHADOW;
            figures[0] += truth == IN_SHADOW && !(image.rgb[3 * i] == 0.0f);
            figures[1] += truth == LIT && !(image.rgb[3 * i] > 0.0f);
        }
        assert_true(shadowed > 16);
        rt_image_clear(&image);
        rt_scene_clear(&scene);
    }
}

static void shadow(void **state)
{
    (void)state;
    static const hard_naive by_corners = {.mutant = MUTANT_START_BY_FAR_CORNERS, .at_robust = true};
    static const float sizes[] = {1e4f, 1e6f, 1e8f};
    static const char *const names[] = {"a ball of 0.6 on a plane of 1e4",
                                        "a ball of 0.6 on a plane of 1e6",
                                        "a ball of 0.6 on a plane of 1e8"};
    for (int i = 0; i < 3; ++i) {
        const hard_case c = {.row = 41,
                             .name = names[i],
                             .figures = {{"pixels of its shadow lit", {TOLD, TOLD, 0, 0}},
                                         {"pixels of the floor unlit", {TOLD, TOLD, 0, 0}}},
                             .naives = {i > 0 ? &by_corners : NULL},
                             .measure = measure_shadow,
                             .of = &sizes[i]};
        hard_hold(&c);
    }
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(horizon), cmocka_unit_test(touching),
                                       cmocka_unit_test(normals), cmocka_unit_test(exponents),
                                       cmocka_unit_test(shadow)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
