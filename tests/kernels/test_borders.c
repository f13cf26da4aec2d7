/* Borders that scenes drawn at random never meet: pixels that are exactly on one, by closed forms.
 * Each was found as a change of a kernel that no other test noticed (make mutants). */
#include "support/support.h"

#include <stdio.h>
#include <string.h>

/* The colour of a picture of one pixel, which is (r, g, b) to within rounding. */
static void assert_color(const char *text, double r, double g, double b)
{
    rt_scene scene;
    rt_image image;
    test_scene(&scene, text);
    test_draw(&scene, NULL, &image);
    assert_near(image.rgb[0], r, 1e-6);
    assert_near(image.rgb[1], g, 1e-6);
    assert_near(image.rgb[2], b, 1e-6);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

#define PIXEL "image width 1 height 1\n"
/* The plane z = at: a triangle about the z axis. */
#define PLANE(at) "triangle a -9 -9 " at " b 9 -9 " at " c 0 9 " at " material m\n"

/* Each hit between two mirrors is worth half of the one before: the tenth, 2^-9, is the last that
 * is followed here: beyond it is chance that goes on. The sum is 2 - 2^-9. */
static void a_mirror_ray_of_the_least_weight(void **state)
{
    (void)state;
    assert_color(PIXEL "depth 9\nambient 1 1 1\nmaterial m ka 1 0.5 0.25 reflect 0.5\n" PLANE("-1")
                     PLANE("1"),
                 2 - 0x1p-9, 1 - 0x1p-10, 0.5 - 0x1p-11);
}

/* The same through twelve panes of what does not bend light and lets half of it through. */
static void a_refracted_ray_of_the_least_weight(void **state)
{
    (void)state;
    char text[2000] = PIXEL "depth 9\nambient 1 1 1\n"
                            "material m ka 1 0.5 0.25 transmit 0.5 ior 1\n";
    for (int i = 1; i <= 12; ++i) {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used,
                 "triangle a -99 -99 -%d b 99 -99 -%d c 0 99 -%d material m\n", i, i, i);
    }
    assert_color(text, 2 - 0x1p-9, 1 - 0x1p-10, 0.5 - 0x1p-11);
}

/* Behind a single pane the way in glass has no end: where nothing is absorbed nothing is lost. */
static void glass_without_end(void **state)
{
    (void)state;
    assert_color(PIXEL "background 0.25 0.5 1\n"
                       "material m transmit 1 ior 1 absorb 0 0.001 0\n" PLANE("-1"),
                 0.25, 0, 1);
}

/* A ray that only just touches a sphere comes from outside: the light above shines on what it
 * meets. */
static void the_horizon_of_a_sphere(void **state)
{
    (void)state;
    static const char *const levels[] = {"standard", "robust"};
    for (int i = 0; i < 2; ++i) {
        char text[500];
        snprintf(text, sizeof text,
                 PIXEL "accuracy %s\ncamera from 0 1 5 at 0 1 0\n"
                       "light directional direction 0 -1 0\nmaterial m kd 0.5 0.25 1\n"
                       "sphere center 0 0 0 radius 1 material m\n",
                 levels[i]);
        assert_color(text, 0.5, 0.25, 1);
    }
}

/* 0 to the power of 0 where another material's exponent is not whole. */
static void exponent_zero_among_others(void **state)
{
    (void)state;
    assert_color(PIXEL "light directional direction 0 -1 0\nmaterial m ks 1 0.5 0.25 shininess 0\n"
                       "material other ks 1 1 1 shininess 0.5\n" PLANE(
                           "-1") "sphere center 0 0 9 radius 1 material other\n",
                 1, 0.5, 0.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mirror_ray_of_the_least_weight),
        cmocka_unit_test(a_refracted_ray_of_the_least_weight),
        cmocka_unit_test(glass_without_end),
        cmocka_unit_test(the_horizon_of_a_sphere),
        cmocka_unit_test(exponent_zero_among_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
