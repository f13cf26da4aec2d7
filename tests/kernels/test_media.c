/* Bodies within bodies: what a ray runs in, by Beer's law along ways that are known. Bodies are as
 * dense as the open, but for the first, so that no light is mirrored and all goes straight on. */
#include "support/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* By the kernels of all effects, which are one program for all of the scenes. */
static void draw(const rt_scene *scene, rt_image *image)
{
    rt_effects effects = rt_effects_of(scene);
    effects.mode = RT_EFFECTS_ALL;
    const rt_render_options options = {.effects = &effects};
    test_draw(scene, &options, image);
}

/* The only pixel of a picture, by the device and by the scalar path. */
static void assert_seen(const char *text, double r, double g, double b, double tolerance)
{
    rt_scene scene;
    rt_image image, scalar;
    char whole[8192];
    snprintf(whole, sizeof whole, "background 1 1 1\naccuracy robust\n%s", text);
    test_scene(&scene, whole);
    draw(&scene, &image);
    test_draw_scalar(&scene, &scalar);
    const double expected[3] = {r, g, b};
    for (int c = 0; c < 3; ++c) {
        assert_near(image.rgb[c], expected[c], tolerance);
        assert_near(scalar.rgb[c], expected[c], tolerance);
    }
    rt_image_clear(&image);
    rt_image_clear(&scalar);
    rt_scene_clear(&scene);
}

#define ONE_PIXEL "image width 1 height 1\n"
#define DYES                                                                                       \
    "material red   transmit 1 ior 1 absorb 1 0 0\n"                                               \
    "material green transmit 1 ior 1 absorb 0 1 0\n"                                               \
    "material blue  transmit 1 ior 1 absorb 0 0 1\n"

/* The way out is one radius; a part F is mirrored there, and again at each end of a diameter. */
static void the_eye_at_the_centre_of_a_ball(void **state)
{
    (void)state;
    const double F = 0.04, seen = (1 - F) * exp(-1.0) / (1 - F * exp(-2.0));
    assert_seen("image width 1 height 1 samples 4096\ncamera vfov 40\n"
                "material m transmit 1 ior 1.5 absorb 1 1 1\n"
                "sphere center 0 0 0 radius 1 material m\n",
                seen, seen, seen, 1e-4);
}

static void a_bubble_leads_back_into_its_ball(void **state)
{
    (void)state;
    assert_seen(ONE_PIXEL "camera from 0 0 5 at 0 0 0\n" DYES "material air transmit 1 ior 1\n"
                          "sphere center 0 0 0 radius 2 material red\n"
                          "sphere center 0 0 0 radius 1 material air\n",
                exp(-2.0), 1, 1, 1e-6);
}

static void three_bodies_one_within_the_other(void **state)
{
    (void)state;
    assert_seen(ONE_PIXEL "camera from 0 0 5 at 0 0 0\n" DYES
                          "sphere center 0 0 0 radius 3 material red\n"
                          "sphere center 0 0 0 radius 2 material green\n"
                          "sphere center 0 0 0 radius 1 material blue\n",
                exp(-2.0), exp(-2.0), exp(-2.0), 1e-6);
}

/* What was entered last is the medium, until it is left. */
static void bodies_that_overlap(void **state)
{
    (void)state;
    assert_seen(ONE_PIXEL "camera from 0 0 5 at 0 0 0\n" DYES
                          "sphere center 0 0 0 radius 1 material red\n"
                          "sphere center 0 0 -1 radius 1 material green\n",
                exp(-1.0), exp(-2.0), 1, 1e-6);
}

/* Of those that the eye is in, the one that it leaves first. */
static void the_eye_in_two_bodies(void **state)
{
    (void)state;
    assert_seen(ONE_PIXEL "camera from 0 0 -0.5 at 0 0 -5\n" DYES
                          "sphere center 0 0 -1 radius 1 material green\n"
                          "sphere center 0 0 0 radius 1 material red\n",
                exp(-0.5), exp(-1.0), 1, 1e-6);
}

#define CUBE                                                                                       \
    "triangle a -1 -1 -1 b -1 1 -1 c 1 1 -1 material red\n"                                        \
    "triangle a -1 -1 -1 b 1 1 -1 c 1 -1 -1 material red\n"                                        \
    "triangle a -1 -1 1 b 1 -1 1 c 1 1 1 material red\n"                                           \
    "triangle a -1 -1 1 b 1 1 1 c -1 1 1 material red\n"                                           \
    "triangle a -1 -1 -1 b 1 -1 -1 c 1 -1 1 material red\n"                                        \
    "triangle a -1 -1 -1 b 1 -1 1 c -1 -1 1 material red\n"                                        \
    "triangle a 1 1 -1 b -1 1 -1 c -1 1 1 material red\n"                                          \
    "triangle a 1 1 -1 b -1 1 1 c 1 1 1 material red\n"                                            \
    "triangle a -1 -1 -1 b -1 -1 1 c -1 1 1 material red\n"                                        \
    "triangle a -1 -1 -1 b -1 1 1 c -1 1 -1 material red\n"                                        \
    "triangle a 1 -1 -1 b 1 1 -1 c 1 1 1 material red\n"                                           \
    "triangle a 1 -1 -1 b 1 1 1 c 1 -1 1 material red\n"

/* Through the edge that two triangles of its face share. */
static void the_eye_in_a_mesh(void **state)
{
    (void)state;
    assert_seen(ONE_PIXEL "camera from 0 0 0 at 0 0 -1\n" DYES CUBE, exp(-1.0), 1, 1, 1e-6);
    assert_seen(ONE_PIXEL "camera from 0.25 0.125 0 at 0.25 0.125 1\n" DYES CUBE, exp(-1.0), 1, 1,
                1e-6);
    assert_seen(ONE_PIXEL "camera from 0.25 0.125 3 at 0.25 0.125 1\n" DYES CUBE, exp(-2.0), 1, 1,
                1e-6);
}

/* A hundredth apart each; starts of rays are lifted clear of 140 surfaces. There is room for 64
 * bodies of a medium: of 70, the outer six are forgotten, and left for the open. */
static void many_shells_of_one_medium(void **state)
{
    (void)state;
    static const struct {
        int count;
        double way;
    } rows[] = {{40, 2.0}, {64, 2.0}, {70, 1.94}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        char text[8000];
        int length = snprintf(text, sizeof text,
                              ONE_PIXEL "depth 200\ncamera from 0 0 5 at 0 0 0\n"
                                        "material red transmit 1 ior 1 absorb 1 0 0\n");
        for (int k = 0; k < rows[i].count; ++k)
            length += snprintf(text + length, sizeof text - (size_t)length,
                               "sphere center 0 0 0 radius %.2f material red\n", 1 - 0.01 * k);
        assert_seen(text, exp(-rows[i].way), 1, 1, 1e-5);
    }
}

/* What is as dense as what is about it cannot be seen: a ball of glass in glass. Chance differs, in
 * what weighs a few quanta of 1/512. */
static void glass_in_glass(void **state)
{
    (void)state;
    static const char about[] = "image width 16 height 16\ncamera from 0 0 2.5 at 0 0 0\n"
                                "background 0 0 0 top 1 1 1\n"
                                "material m transmit 1 ior 1.5\n"
                                "sphere center 0 0 0 radius 3 material m\n";
    rt_scene with, without;
    rt_image seen, expected;
    char text[512];
    snprintf(text, sizeof text, "%ssphere center 0.25 0 0 radius 1 material m\n", about);
    test_scene(&with, text);
    test_scene(&without, about);
    draw(&with, &seen);
    draw(&without, &expected);
    for (int i = 0; i < 3 * 16 * 16; ++i)
        assert_near(seen.rgb[i], expected.rgb[i], 2.0 / 512);
    rt_image_clear(&seen);
    rt_image_clear(&expected);
    rt_scene_clear(&with);
    rt_scene_clear(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_eye_at_the_centre_of_a_ball),
        cmocka_unit_test(a_bubble_leads_back_into_its_ball),
        cmocka_unit_test(three_bodies_one_within_the_other),
        cmocka_unit_test(bodies_that_overlap),
        cmocka_unit_test(the_eye_in_two_bodies),
        cmocka_unit_test(the_eye_in_a_mesh),
        cmocka_unit_test(many_shells_of_one_medium),
        cmocka_unit_test(glass_in_glass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
