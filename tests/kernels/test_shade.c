/* Phong's formula against pixels computed by hand, and the three bugs of normals that renderers
 * have had: each check is shown to fail when the bug is put into the kernels. */
#include "support/mutants.h"
#include "support/support.h"

#include <math.h>
#include <string.h>

/* The colour of pixel (x, y) on the device; the scalar path's must be the same to the bit, unless a
 * mutant is under test or a library's power comes in. */
static void pixel(const char *text, int x, int y, bool exact, float rgb[3])
{
    rt_scene scene;
    rt_image image, expected;
    test_scene(&scene, text);
    test_draw(&scene, NULL, &image);
    test_draw_scalar(&scene, &expected);
    if (exact)
        assert_memory_equal(image.rgb, expected.rgb,
                            3 * sizeof(float) * (size_t)(image.width * image.height));
    memcpy(rgb, image.rgb + 3 * (y * image.width + x), 3 * sizeof *rgb);
    rt_image_clear(&image);
    rt_image_clear(&expected);
    rt_scene_clear(&scene);
}

static void assert_color(const char *text, float r, float g, float b)
{
    float rgb[3];
    pixel(text, 0, 0, true, rgb);
    assert_near(rgb[0], r, 1e-6);
    assert_near(rgb[1], g, 1e-6);
    assert_near(rgb[2], b, 1e-6);
}

/* One pixel that looks along -z at the plane z = -2, whose normal is +z. */
#define PLANE "image width 1 height 1\ntriangle a -9 -9 -2 b 9 -9 -2 c 0 9 -2 material m\n"

static void ambient_alone(void **state)
{
    (void)state;
    assert_color("material m ka 0.5 0.25 1 kd 1 1 1\nambient 0.5 1 0.25\n" PLANE, 0.25f, 0.25f,
                 0.25f);
}

static void background_where_nothing_is_hit(void **state)
{
    (void)state;
    assert_color("image width 1 height 1\nbackground 0.125 0.5 2\n", 0.125f, 0.5f, 2.0f);
}

/* L at 60 degrees to N: N.L = 0.5; R leaves on the other side, R.V = 0.5 too. */
static void diffuse_and_specular(void **state)
{
    (void)state;
    assert_color("light directional direction 0.866025403784 0 -0.5 color 1 0.5 2\n"
                 "material m kd 0.5 1 0.25 ks 1 0.5 0.125 shininess 2\n" PLANE,
                 0.5f * 0.5f + 0.25f, 0.5f * (0.5f + 0.5f * 0.25f),
                 2.0f * (0.125f + 0.125f * 0.25f));
}

static void a_point_light_shines_from_its_place(void **state)
{
    (void)state;
    /* From (0, 0, -2) the light is at (3, 0, 4): N.L = 4/5, R.V = 4/5. */
    assert_color("light point at 3 0 2 color 1 1 1\n"
                 "material m kd 1 0 0 ks 0 1 0 shininess 3\n" PLANE,
                 0.8f, 0.8f * 0.8f * 0.8f, 0.0f);
}

static void lights_add_up(void **state)
{
    (void)state;
    assert_color("light directional direction 0 0 -1 color 0.25 0 0\n"
                 "light directional direction 0 0 -1 color 0.5 0 0\n"
                 "light directional direction 0 0 -1 color 1 0 0\n"
                 "material m kd 1 1 1\n" PLANE,
                 1.75f, 0.0f, 0.0f);
}

static void no_light_from_behind(void **state)
{
    (void)state;
    assert_color(
        "light directional direction 0 0 1\nmaterial m kd 1 1 1 ks 1 1 1 shininess 8\n" PLANE, 0.0f,
        0.0f, 0.0f);
}

/* The sign of N.L does not gate the highlight: the light is 5 degrees below the horizon, the eye
 * looks along the surface the same way as the mirrored light travels. */
static void the_highlight_is_not_gated(void **state)
{
    (void)state;
    float rgb[3];
    const char *scene = "image width 1 height 1\n"
                        "camera from 0 0 0 at 0 -0.0874886635 -1 vfov 0.001\n"
                        "light directional direction 0 0.0874886635 -1\n"
                        "material m kd 1 1 1 ks 1 1 1 shininess 1\n"
                        "triangle a -90 -1 90 b 90 -1 90 c 0 -1 -90 material m\n";
    pixel(scene, 0, 0, true, rgb);
    /* N = +y, L = (0, -s, c), R = (0, -s, -c), V = (0, s, c) with s = sin 5 degrees: R.V = -1. */
    assert_near(rgb[0], 0.0, 1e-6);
    const char *facing = "image width 1 height 1\n"
                         "camera from 0 0 0 at 0 -0.0874886635 -1 vfov 0.001\n"
                         "light directional direction 0 0.0874886635 1\n"
                         "material m kd 1 1 1 ks 1 1 1 shininess 1\n"
                         "triangle a -90 -1 90 b 90 -1 90 c 0 -1 -90 material m\n";
    pixel(facing, 0, 0, true, rgb);
    /* L = (0, -s, -c), R = (0, -s, c): R.V = c c - s s = cos 10 degrees though N.L < 0. */
    assert_near(rgb[0], cos(10.0 * 3.14159265358979 / 180.0), 1e-6);
}

static void shininess_zero_and_large(void **state)
{
    (void)state;
    /* 0 to the power of 0 is 1: the highlight is everywhere, even with the light behind. */
    assert_color("light directional direction 0 0 1\nmaterial m ks 1 1 1 shininess 0\n" PLANE, 1.0f,
                 1.0f, 1.0f);
    assert_color(
        "light directional direction 0 0 -1\nmaterial m ks 1 1 1 shininess 1000000\n" PLANE, 1.0f,
        1.0f, 1.0f);
    assert_color(
        "light directional direction 0.6 0 -0.8\nmaterial m ks 1 1 1 shininess 300\n" PLANE,
        powf(0.8f, 300.0f), powf(0.8f, 300.0f), powf(0.8f, 300.0f));
}

static void a_fractional_shininess(void **state)
{
    (void)state;
    float rgb[3];
    pixel("light directional direction 0.6 0 -0.8\nmaterial m ks 1 1 1 shininess 2.5\n" PLANE, 0, 0,
          false, rgb);
    assert_near(rgb[0], pow(0.8, 2.5), 1e-5);
    pixel("light directional direction 0 0 1\nmaterial m ks 1 1 1 shininess 2.5\n" PLANE, 0, 0,
          false, rgb);
    assert_near(rgb[0], 0.0, 0.0);
}

static void a_light_at_the_point_gives_nothing(void **state)
{
    (void)state;
    assert_color("ambient 1 1 1\nlight point at 0 0 -2\n"
                 "material m ka 0.5 0.5 0.5 kd 1 1 1 ks 1 1 1 shininess 0\n" PLANE,
                 0.5f, 0.5f, 0.5f);
}

static void a_sphere_is_lit_from_inside_too(void **state)
{
    (void)state;
    /* From its centre: the normal is turned toward the eye. */
    assert_color("image width 1 height 1\nlight point at 0 0 0\nmaterial m kd 1 0.5 0\n"
                 "sphere center 0 0 0 radius 2 material m\n",
                 1.0f, 0.5f, 0.0f);
}

static void smooth_normals(void **state)
{
    (void)state;
    /* In the middle of b and c the normals (0.6, 0, 0.8) and (-0.6, 0, 0.8), of any length, add up
     * to +z; at corner a the light comes along its normal. */
    const char *triangle = "image width 1 height 1\ncamera from 0 0 0 at %s\n"
                           "light directional direction 0 0 -1\nmaterial m kd 1 1 1\n"
                           "triangle a 0 3 -2 b -1 -1 -2 c 1 -1 -2 material m "
                           "na 1 0 0 nb 1.2 0 1.6 nc -1.2 0 1.6\n";
    char text[400];
    snprintf(text, sizeof text, triangle, "0 -1 -2");
    float rgb[3];
    pixel(text, 0, 0, true, rgb);
    assert_near(rgb[0], 1.0, 1e-6);
    snprintf(text, sizeof text, triangle, "-1 -1 -2");
    pixel(text, 0, 0, true, rgb);
    assert_near(rgb[0], 0.8, 1e-6);
    snprintf(text, sizeof text, triangle, "0 2.9999995 -2");
    pixel(text, 0, 0, true, rgb);
    assert_near(rgb[0], 0.0, 1e-5);
}

/* Vertex normals that point behind are turned with the geometric one; zero ones give way to it. */
static void strange_vertex_normals(void **state)
{
    (void)state;
    const char *head = "image width 1 height 1\nlight directional direction 0 0 -1\n"
                       "material m kd 1 1 1\ntriangle a -9 -9 -2 b 9 -9 -2 c 0 9 -2 material m ";
    char text[400];
    snprintf(text, sizeof text, "%sna 0 0 -1 nb 0 0 -1 nc 0 0 -1\n", head);
    assert_color(text, 1.0f, 1.0f, 1.0f);
    snprintf(text, sizeof text, "%sna 0 0 0 nb 0 0 0 nc 0 0 0\n", head);
    assert_color(text, 1.0f, 1.0f, 1.0f);
}

/* Normals and the way to a light come out unit though squares of their components overflow or
 * vanish. */
static void far_from_unit_scale(void **state)
{
    (void)state;
    static const char *const sizes[] = {"1e-10", "1e10", "1e12"};
    for (int i = 0; i < 3; ++i) {
        char text[400];
        const char *s = sizes[i];
        snprintf(text, sizeof text,
                 "image width 1 height 1\nlight directional direction 0 0 -1\n"
                 "material m kd 1 0.5 0.25\ntriangle a -%s -%s -%s b %s -%s -%s c 0 %s -%s "
                 "material m\n",
                 s, s, s, s, s, s, s, s);
        assert_color(text, 1.0f, 0.5f, 0.25f);
        snprintf(
            text, sizeof text,
            "light directional direction 0 0 -1\nmaterial m kd 1 0 0\nimage width 1 height 1\n"
            "triangle a -9 -9 -2 b 9 -9 -2 c 0 9 -2 material m na 0 0 %s nb 0 0 %s nc 0 0 %s\n",
            i ? "1e30" : "1e-30", i ? "1e30" : "1e-30", i ? "1e30" : "1e-30");
        assert_color(text, 1.0f, 0.0f, 0.0f);
    }
    assert_color("light point at 0 0 1e30\nmaterial m kd 1 1 1\n" PLANE, 1.0f, 1.0f, 1.0f);
}

/* ---- The three bugs ---- */

/* The part of the picture that triangle.txt's triangle covers is what its projection says. */
static bool covers_its_projection(void)
{
    rt_scene scene;
    rt_image image;
    test_scene_file(&scene, "scenes/triangle.txt");
    scene.accuracy = RT_ACCURACY_STANDARD; /* of whose test the mutant is */
    test_draw(&scene, NULL, &image);
    int covered = 0;
    for (int i = 0; i < image.width * image.height; ++i)
        covered += image.hits[i].primitive == 0;
    /* Corners projected to the plane at distance 1, which is 256 pixels a unit. */
    const double a[2] = {-1 / 3.5, -1 / 3.5}, b[2] = {1 / 3.0, 1 / 3.0}, c[2] = {0.75 / 2.5, -0.4};
    const double area =
        0.5 * fabs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) * 256.0 * 256.0;
    rt_image_clear(&image);
    rt_scene_clear(&scene);
    return fabs(covered - area) < 0.01 * area;
}

/* A large triangle whose normal is long: the highlight has the colour that a unit normal gives. */
static bool highlight_is_of_its_size(void)
{
    float rgb[3];
    pixel("light directional direction 0.6 0 -0.8\nmaterial m ks 1 0.5 0.25 shininess 4\n" PLANE, 0,
          0, false, rgb);
    return fabs((double)rgb[0] - 0.4096) < 1e-5 && fabs((double)rgb[2] - 0.1024) < 1e-5;
}

/* A triangle that faces the eye and the light is lit, whichever way its corners run. */
static bool lit_from_the_front(void)
{
    float ccw[3], cw[3];
    const char *head = "image width 1 height 1\nlight directional direction 0 0 -1\n"
                       "material m kd 1 1 1\n";
    char text[300];
    snprintf(text, sizeof text, "%striangle a -9 -9 -2 b 9 -9 -2 c 0 9 -2 material m\n", head);
    pixel(text, 0, 0, false, ccw);
    snprintf(text, sizeof text, "%striangle a -9 -9 -2 b 0 9 -2 c 9 -9 -2 material m\n", head);
    pixel(text, 0, 0, false, cw);
    return fabs((double)ccw[0] - 1.0) < 1e-6 && fabs((double)cw[0] - 1.0) < 1e-6;
}

static bool holds_with(bool (*check)(void), test_mutant mutant)
{
    test_mutate_kernels(mutant);
    const bool holds = check();
    test_restore_kernels();
    return holds;
}

static void a_unit_normal_too_early_would_shrink_the_triangle(void **state)
{
    (void)state;
    assert_true(covers_its_projection());
    assert_false(holds_with(covers_its_projection, MUTANT_EDGE_UNIT_TOO_EARLY));
}

static void a_long_normal_would_turn_highlights_white(void **state)
{
    (void)state;
    assert_true(highlight_is_of_its_size());
    assert_false(holds_with(highlight_is_of_its_size, MUTANT_NORMAL_LONG));
}

static void swapped_edges_would_turn_the_normal_away(void **state)
{
    (void)state;
    assert_true(lit_from_the_front());
    /* Turning normals toward the ray is what makes the order of the edges harmless ... */
    assert_true(holds_with(lit_from_the_front, MUTANT_NORMAL_OF_SWAPPED_EDGES));
    /* ... and without it either order is wrong for one of the two windings. */
    assert_false(holds_with(lit_from_the_front, MUTANT_NORMAL_NOT_TURNED));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ambient_alone),
        cmocka_unit_test(background_where_nothing_is_hit),
        cmocka_unit_test(diffuse_and_specular),
        cmocka_unit_test(a_point_light_shines_from_its_place),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(no_light_from_behind),
        cmocka_unit_test(the_highlight_is_not_gated),
        cmocka_unit_test(shininess_zero_and_large),
        cmocka_unit_test(a_fractional_shininess),
        cmocka_unit_test(a_light_at_the_point_gives_nothing),
        cmocka_unit_test(a_sphere_is_lit_from_inside_too),
        cmocka_unit_test(smooth_normals),
        cmocka_unit_test(strange_vertex_normals),
        cmocka_unit_test(far_from_unit_scale),
        cmocka_unit_test(a_unit_normal_too_early_would_shrink_the_triangle),
        cmocka_unit_test(a_long_normal_would_turn_highlights_white),
        cmocka_unit_test(swapped_edges_would_turn_the_normal_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
