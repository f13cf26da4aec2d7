/* Checkers on planes that are borders of their cells, and on spheres that touch one: all of such a
 * surface is in the cells on one side, and every pixel has the colour that a closed formula gives
 * it. */
#include "support/mutants.h"
#include "support/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define SIDE 96
#define PI 3.14159265358979323846

/* A plane at right angles to an axis, seen from one side, or a sphere that touches it from the
 * other; `height` is half a cell beyond a whole multiple of `cell`, in decimals. */
typedef struct plane {
    int axis;
    double height, cell;
    double above;  /* of the eye, in cells; below 0: seen from the other side */
    double turn;   /* of the plane's corners about the axis, in degrees */
    double radius; /* of the sphere, in cells; 0: a plane */
} plane;

/* In cells: where the eye is along the two other axes, and where it looks. */
static const double eye_u = 0.3, eye_v = -0.2, look_u = 1.0, look_v = 0.4;

static void say_point(char **at, const char *name, const plane *p, double a, double u, double v)
{
    double point[3];
    point[p->axis] = a;
    point[(p->axis + 1) % 3] = u;
    point[(p->axis + 2) % 3] = v;
    *at += sprintf(*at, " %s %.9g %.9g %.9g", name, point[0], point[1], point[2]);
}

static void say_corner(char **at, const char *name, const plane *p, double u, double v)
{
    const double c = cos(p->turn * PI / 180), s = sin(p->turn * PI / 180), size = 40 * p->cell;
    say_point(at, name, p, p->height, size * (c * u - s * v), size * (s * u + c * v));
}

/* The two halves of the plane are wound in opposite ways. */
static void say_halves(char **at, const plane *p)
{
    for (int half = 0; half < 2; ++half) {
        *at += sprintf(*at, "triangle material m");
        say_corner(at, "a", p, -1, -1);
        say_corner(at, half ? "c" : "b", p, half ? -1 : 1, half ? 1 : -1);
        say_corner(at, half ? "b" : "c", p, 1, 1);
        *at += sprintf(*at, "\n");
    }
}

static void say_sphere(char **at, const plane *p)
{
    *at += sprintf(*at, "sphere material m radius %.9g", p->radius * p->cell);
    say_point(at, "center", p, p->height - copysign(p->radius * p->cell, p->above), 0, 0);
}

static void read_plane(const plane *p, enum rt_accuracy level, rt_scene *scene)
{
    char text[2000], *at = text;
    const double c = p->cell, eye = p->height + c * p->above;
    at += sprintf(at, "image width %d height %d\ncamera", SIDE, SIDE);
    say_point(&at, "from", p, eye, eye_u * c, eye_v * c);
    say_point(&at, "at", p, eye - c * copysign(1, p->above), (eye_u + look_u) * c,
              (eye_v + look_v) * c);
    say_point(&at, "up", p, 1, 0, 0);
    at += sprintf(at, " vfov 90\nambient 1 1 1\nmaterial m ka 1 1 1 checker 0 0 0 cell %.9g\n", c);
    p->radius > 0 ? say_sphere(&at, p) : say_halves(&at, p);
    test_scene(scene, text);
    scene->accuracy = level;
}

/* The direction of a pixel's ray by the camera's formula (scenes/README.md), as (axis, u, v). */
static void direction_of(const plane *p, int x, int y, double d[3])
{
    const double length = sqrt(1 + look_u * look_u + look_v * look_v);
    const double v0[3] = {-copysign(1, p->above) / length, look_u / length, look_v / length};
    /* Right is v0 x (1, 0, 0), up is right x v0; the axes follow each other as x, y, z do. */
    const double across = hypot(v0[1], v0[2]);
    const double v1[3] = {0, v0[2] / across, -v0[1] / across};
    const double v2[3] = {v1[1] * v0[2] - v1[2] * v0[1], v1[2] * v0[0], -v1[1] * v0[0]};
    const double right = (2.0 * x + 1 - SIDE) / SIDE, up = (SIDE - 1 - 2.0 * y) / SIDE;
    for (int i = 0; i < 3; ++i)
        d[i] = v0[i] + right * v1[i] + up * v2[i];
}

/* Where the ray meets the plane or the sphere, in cells, from where that touches the plane. */
static void exact_place(const plane *p, const double d[3], double place[3])
{
    const double o[3] = {p->above, eye_u, eye_v};
    double t = -o[0] / d[0];
    if (p->radius > 0) {
        const long double r = (long double)copysign(p->radius, p->above);
        const long double a = (long double)d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        const long double b = d[0] * (o[0] + r) + d[1] * o[1] + d[2] * o[2];
        const long double c = o[0] * (o[0] + 2 * r) + o[1] * o[1] + o[2] * o[2];
        t = (double)(c / (sqrtl(b * b - a * c) - b));
    }
    for (int i = 0; i < 3; ++i)
        place[i] = o[i] + t * d[i];
    if (!(p->radius > 0))
        place[0] = 0;
}

static bool is_near_line(double place)
{
    return fabs(place - floor(place) - 0.5) < 0.004;
}

/* Pixels that have the other cells' colour; those at lines between cells are left out, and counted,
 * but not those at the border that the surface lies on. */
static size_t wrong_pixels(const plane *p, const rt_image *image, size_t *lines)
{
    /* A border belongs to the cell above it. */
    const double layer = floor(p->height / p->cell + 0.5 + 1e-6);
    size_t wrong = 0, hits = 0;
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x) {
            const size_t i = (size_t)(y * SIDE + x);
            double d[3], place[3];
            if (image->hits[i].primitive == RT_MISS)
                continue;
            direction_of(p, x, y, d);
            exact_place(p, d, place);
            ++hits;
            if (is_near_line(place[1]) || is_near_line(place[2]) ||
                (fabs(place[0]) > 0.5 && is_near_line(place[0] + 0.5))) {
                ++*lines;
                continue;
            }
            const double sum =
                layer + floor(place[0]) + floor(place[1] + 0.5) + floor(place[2] + 0.5);
            const float expected = fmod(fabs(sum), 2) < 0.5 ? 1.0f : 0.0f;
            wrong += image->rgb[3 * i] != expected;
        }
    assert_true(hits > SIDE * SIDE / 64);
    return wrong;
}

/* Heights and cells of which one is a half of a whole multiple of the other. */
static const double heights[][2] = {{0.5, 1},    {-1, 2},      {-0.5, 1},       {1000.5, 1},
                                    {0.65, 0.1}, {-0.65, 0.1}, {-4.5e-5, 1e-5}, {250000, 1e5}};
#define HEIGHTS (sizeof heights / sizeof *heights)
#define PLANES (3 * HEIGHTS)

/* The planes in turn: each height on each axis, turned or not, from above or from below. */
static plane plane_of(size_t i)
{
    const double *h = heights[i / 3 % HEIGHTS];
    return (plane){.axis = (int)(i % 3),
                   .height = h[0],
                   .cell = h[1],
                   .turn = (i / 2) % 2 ? 45 : 0,
                   .above = (i / 3) % 2 ? -1.75 : 2.5};
}

/* On the device and, but for mutants, by the scalar reference. */
static size_t wrong_in(const plane *p, enum rt_accuracy level, bool is_mutant, size_t *lines)
{
    rt_scene scene;
    rt_image image;
    read_plane(p, level, &scene);
    test_draw(&scene, NULL, &image);
    size_t wrong = wrong_pixels(p, &image, lines);
    rt_image_clear(&image);
    if (!is_mutant) {
        test_draw_scalar(&scene, &image);
        wrong += wrong_pixels(p, &image, lines);
        rt_image_clear(&image);
    }
    rt_scene_clear(&scene);
    if (wrong && !is_mutant)
        print_message("%s, axis %d at %g, cell %g, radius %g: %zu\n", rt_accuracy_name(level),
                      p->axis, p->height, p->cell, p->radius, wrong);
    return wrong;
}

static size_t wrong_on_planes(enum rt_accuracy level, bool is_mutant)
{
    size_t wrong = 0, lines = 0;
    for (size_t i = 0; i < PLANES; ++i) {
        const plane p = plane_of(i);
        wrong += wrong_in(&p, level, is_mutant, &lines);
    }
    assert_true(lines < PLANES * SIDE * SIDE / 16);
    return wrong;
}

static void a_plane_that_is_a_border_is_on_one_side_of_it(void **state)
{
    (void)state;
    for (int level = RT_ACCURACY_STANDARD; level <= RT_ACCURACY_ROBUST; ++level)
        assert_int_equal(wrong_on_planes((enum rt_accuracy)level, false), 0);
    test_mutate_kernels(MUTANT_CELLS_OF_THE_RAY);
    assert_true(wrong_on_planes(RT_ACCURACY_STANDARD, true) > 0);
    test_mutate_kernels(MUTANT_CELLS_WITHOUT_MARGIN);
    assert_true(wrong_on_planes(RT_ACCURACY_STANDARD, true) > 0);
    test_restore_kernels();
}

/* Also a floor as a sphere of 1e6 cells, where a float has room for its centre. */
static size_t wrong_on_spheres(enum rt_accuracy level, bool is_mutant)
{
    static const double radii[] = {1e6, 1.5, 5};
    size_t wrong = 0, lines = 0;
    for (size_t i = 0; i < PLANES; i += 2) {
        plane p = plane_of(i);
        p.radius = p.cell >= 1 && p.cell <= 2 ? radii[i % 3] : 1.5;
        if (fabs(p.height / p.cell) < 10)
            wrong += wrong_in(&p, level, is_mutant, &lines);
    }
    return wrong;
}

static void a_sphere_that_touches_a_border_is_on_one_side_of_it(void **state)
{
    (void)state;
    assert_int_equal(wrong_on_spheres(RT_ACCURACY_ROBUST, false), 0);
    test_mutate_kernels(MUTANT_CELLS_ABOVE_A_SPHERE);
    assert_true(wrong_on_spheres(RT_ACCURACY_ROBUST, true) > 0);
    test_restore_kernels();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_that_is_a_border_is_on_one_side_of_it),
        cmocka_unit_test(a_sphere_that_touches_a_border_is_on_one_side_of_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
