/* Values at the ends of what a scene may say: every pixel is a finite number, and the same on the
 * device as by the scalar reference. */
#include "support/mutants.h"
#include "support/support.h"

#include <stdio.h>
#include <stdlib.h>

/* A picture with a pixel in its very middle, on the axis of what is around z = -1. */
#define HEAD                                                                                       \
    "image width 33 height 33\nambient 1 1 1\nbackground 0.25 0.5 0.75\n"                          \
    "light point at 3 4 5 shadow on\n"
#define PICTURE "texture \"globe.png\""

/* Pixels that are not finite or not the same; told of but for mutants. */
static size_t wrong_pixels(const char *text, bool is_mutant)
{
    rt_scene scene;
    rt_image image, expected;
    test_scene(&scene, text);
    /* One program for all of them. */
    rt_effects effects = rt_effects_of(&scene);
    effects.mode = RT_EFFECTS_ALL;
    const rt_render_options options = {.effects = &effects};
    test_draw(&scene, &options, &image);
    test_draw_scalar(&scene, &expected);
    const rt_image_difference d = rt_image_compare(&image, &expected);
    if (!is_mutant && d.first_x >= 0)
        print_message("%zu not finite, %zu hits and %zu pixels off, first at %d,%d, in\n%s",
                      d.non_finite, d.hits, d.pixels, d.first_x, d.first_y, text);
    rt_image_clear(&image);
    rt_image_clear(&expected);
    rt_scene_clear(&scene);
    return d.non_finite + d.hits + d.pixels;
}

static size_t wrong_on_sphere(const char *radius, const char *level, bool is_mutant)
{
    char text[800];
    snprintf(
        text, sizeof text,
        "accuracy %s\n" HEAD "material m ka 1 1 1 kd 1 1 1 checker 0.5 0.5 0.5 " PICTURE "\n"
        "sphere center 0 0 -1 radius %s material m\nsphere center 0 -3 0 radius 2 material m\n",
        level, radius);
    return wrong_pixels(text, is_mutant);
}

static void spheres_of_any_radius(void **state)
{
    (void)state;
    static const char *const radii[] = {"1e-38", "1e-30", "1e-8", "1", "1e8", "1e30", "1e38"};
    size_t wrong = 0;
    for (size_t i = 0; i < sizeof radii / sizeof *radii; ++i)
        wrong += wrong_on_sphere(radii[i], "standard", false) +
                 wrong_on_sphere(radii[i], "robust", false);
    assert_int_equal(wrong, 0);
    test_mutate_kernels(MUTANT_NORMAL_OF_CENTER);
    assert_true(wrong_on_sphere("1e-30", "robust", true) > 0);
    test_restore_kernels();
}

static size_t wrong_on_triangle(const char *material, const char *uvs, bool is_mutant)
{
    char text[800];
    snprintf(text, sizeof text,
             HEAD "material m ka 1 1 1 kd 1 1 1 %s\n"
                  "triangle a -9 -9 -1 b 9 -9 -1 c 0 9 -1 material m %s\n",
             material, uvs);
    return wrong_pixels(text, is_mutant);
}

static void texture_coordinates_of_any_size(void **state)
{
    (void)state;
    static const char *const uvs[] = {
        "ta 3.4e38 -3.4e38 tb -3.4e38 3.4e38 tc 3.4e38 3.4e38", "ta 3e9 -3e9 tb 5e9 3e9 tc 3e9 4e9",
        "ta 1e-45 -1e-45 tb -1e-45 1e-45 tc 0 -0",
        "ta 3.4028234e38 3.4028234e38 tb 3.4028234e38 3.4028234e38 tc 3.4028234e38 3.4028234e38"};
    size_t wrong = 0;
    for (size_t i = 0; i < sizeof uvs / sizeof *uvs; ++i)
        wrong += wrong_on_triangle(PICTURE, uvs[i], false) +
                 wrong_on_triangle(PICTURE " filter nearest wrap clamp", uvs[i], false);
    assert_int_equal(wrong, 0);
    test_mutate_kernels(MUTANT_COORDINATE_OF_NAN);
    assert_true(wrong_on_triangle(PICTURE, uvs[3], true) > 0);
    test_restore_kernels();
}

static void cells_of_any_size(void **state)
{
    (void)state;
    static const char *const cells[] = {"1e-45", "1e-38", "1e-30", "1e-7", "1e30", "3.4e38"};
    size_t wrong = 0;
    for (size_t i = 0; i < sizeof cells / sizeof *cells; ++i) {
        char text[100];
        snprintf(text, sizeof text, "checker 0.5 0 1 cell %s", cells[i]);
        wrong += wrong_on_triangle(text, "", false);
    }
    assert_int_equal(wrong, 0);
}

/* What is around the primitives: far away, or as good as nothing beside a huge one. */
static void surroundings_of_any_size(void **state)
{
    (void)state;
    static const char *const lines[] = {"light point at 3.4e38 3.4e38 3.4e38 shadow on",
                                        "light point at 0 5 0 radius 3.4e38 shadow on",
                                        "light point at 3.4e38 1 1 radius 3.4e38 shadow on",
                                        "occlusion samples 4 distance 1e-38",
                                        "occlusion samples 4 distance 3.4e38",
                                        "fog 1 0 0 density 1e-38",
                                        "fog 1 0 0 density 3.4e38"};
    size_t wrong = 0;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i)
        for (int is_huge = 0; is_huge < 2; ++is_huge) {
            char text[800];
            snprintf(text, sizeof text,
                     HEAD "%s\nmaterial m ka 1 1 1 kd 1 1 1 ks 1 1 1\n"
                          "sphere center 0 0 -3 radius 1 material m\n"
                          "sphere center 0 -%s 0 radius %s material m\n",
                     lines[i], is_huge ? "1.01e30" : "11", is_huge ? "1e30" : "10");
            wrong += wrong_pixels(text, false);
        }
    assert_int_equal(wrong, 0);
}

static int set_up(void **state)
{
    size_t length = 0;
    char *bytes = test_read_file("scenes/globe.png", &length);
    (void)state;
    assert_non_null(bytes);
    test_write_file(test_path("globe.png"), bytes, length);
    free(bytes);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_of_any_radius),
        cmocka_unit_test(texture_coordinates_of_any_size),
        cmocka_unit_test(cells_of_any_size),
        cmocka_unit_test(surroundings_of_any_size),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
