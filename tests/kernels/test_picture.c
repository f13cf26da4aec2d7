/* Pictures on surfaces at their borders, by closed forms: a globe's ends at its poles and goes
 * round, a triangle's is repeated or its border goes on. */
#include "support/mutants.h"
#include "support/support.h"

#include <math.h>
#include <stdio.h>

#define SIDE 33

/* Two columns and two rows: red and green above, black and blue below. */
static void write_picture(void)
{
    unsigned char bytes[54 + 2 * 8] = {
        'B', 'M', sizeof bytes, [10] = 54, [14] = 40, [18] = 2, [22] = 2, [26] = 1, [28] = 24};
    bytes[54 + 3] = 255;     /* blue, at the right of the lower row, which comes first */
    bytes[62 + 2] = 255;     /* red */
    bytes[62 + 3 + 1] = 255; /* green */
    test_write_file(test_path("four.bmp"), bytes, sizeof bytes);
}

typedef bool pixel_fn(int x, int y, const float rgb[3]);

/* Pixels of a scene that are not as they must be; on the device and, but for mutants, by the
 * reference. */
static int count_wrong(const char *text, pixel_fn *is_right, bool is_mutant)
{
    rt_scene scene;
    int wrong = 0;
    test_scene(&scene, text);
    for (int reference = 0; reference < (is_mutant ? 1 : 2); ++reference) {
        rt_image image;
        if (reference)
            test_draw_scalar(&scene, &image);
        else
            test_draw(&scene, NULL, &image);
        for (int i = 0; i < image.width * image.height; ++i)
            wrong += !is_right(i % image.width, i / image.width, image.rgb + 3 * i);
        rt_image_clear(&image);
    }
    rt_scene_clear(&scene);
    return wrong;
}

static bool is_near(const float rgb[3], double r, double g, double b)
{
    return fabs((double)rgb[0] - r) < 1e-4 && fabs((double)rgb[1] - g) < 1e-4 &&
           fabs((double)rgb[2] - b) < 1e-4;
}

/* ---- Globes ---- */

/* Above a latitude of 45 degrees the upper row is alone, below -45 the lower one. */
static bool is_of_upper_row(int x, int y, const float rgb[3])
{
    (void)x, (void)y;
    return fabs((double)(rgb[0] + rgb[1]) - 1.0) < 1e-5 && rgb[2] == 0.0f;
}

static bool is_of_lower_row(int x, int y, const float rgb[3])
{
    (void)x, (void)y;
    return rgb[0] == 0.0f && rgb[1] == 0.0f;
}

static int wrong_at_poles(bool is_mutant)
{
    int wrong = 0;
    for (int k = 0; k < 4; ++k) {
        char text[600];
        snprintf(text, sizeof text,
                 "image width %d height %d\ncamera from 0 %d 0 at 0 0 0 up 0 0 1 vfov 20\n"
                 "ambient 1 1 1\nmaterial m ka 1 1 1 texture \"four.bmp\" filter %s wrap %s\n"
                 "sphere center 0 0 0 radius 1 material m\n",
                 SIDE, SIDE, k % 2 ? -3 : 3, k / 2 ? "nearest" : "bilinear",
                 is_mutant || k != 1 ? "repeat" : "clamp");
        wrong += count_wrong(text, k % 2 ? is_of_lower_row : is_of_upper_row, is_mutant);
    }
    return wrong;
}

static void a_globe_s_picture_ends_at_its_poles(void **state)
{
    (void)state;
    assert_int_equal(wrong_at_poles(false), 0);
    test_mutate_kernels(MUTANT_POLES_TOGETHER);
    assert_true(wrong_at_poles(true) > 0);
    test_restore_kernels();
}

/* From behind, where u is 0 and 1: half of either column, whatever `wrap` says. */
static bool is_half_of_each(int x, int y, const float rgb[3])
{
    const bool is_seam = x == SIDE / 2 && y == 0;
    return !is_seam || is_near(rgb, 0.5, 0.5, 0);
}

static void a_globe_s_picture_goes_round(void **state)
{
    (void)state;
    for (int clamp = 0; clamp < 2; ++clamp) {
        char text[600];
        snprintf(
            text, sizeof text,
            "image width %d height 1\ncamera from 0 0 -3 at 0 2.1213203 -0.70710678 vfov 1e-4\n"
            "ambient 1 1 1\nmaterial m ka 1 1 1 texture \"four.bmp\" wrap %s\n"
            "sphere center 0 0 0 radius 3 material m\n",
            SIDE, clamp ? "clamp" : "repeat");
        assert_int_equal(count_wrong(text, is_half_of_each, false), 0);
    }
}

/* ---- Triangles ---- */

/* The picture's upper row over a wall: u goes from -1 to 2 across SIDE pixels. */
static double u_of(int x)
{
    return 3 * (x + 0.5) / SIDE - 1;
}

static double clamped(double x)
{
    return fmin(fmax(x, 0), 1);
}

/* In texels, whose centres are at 0.5 and 1.5: the part of the second one. */
static bool is_clamped(int x, int y, const float rgb[3])
{
    const double green = clamped(2 * u_of(x) - 0.5);
    (void)y;
    return is_near(rgb, 1 - green, green, 0);
}

static bool is_clamped_nearest(int x, int y, const float rgb[3])
{
    const double green = u_of(x) > 0.5 - 1e-9; /* the border belongs to the texel beyond it */
    (void)y;
    return is_near(rgb, 1 - green, green, 0);
}

static bool is_repeated(int x, int y, const float rgb[3])
{
    const double u = u_of(x), from_red = fabs(u - floor(u + 0.25) - 0.25);
    const double green = from_red < 0.5 ? 2 * from_red : 2 - 2 * from_red;
    (void)y;
    return is_near(rgb, 1 - green, green, 0);
}

static int wrong_on_wall(const char *how, pixel_fn *is_right, bool is_mutant)
{
    char text[800];
    /* The wall is twice as wide and high as the picture is: u and v by their slopes. */
    snprintf(
        text, sizeof text,
        "image width %d height 1\ncamera from 0 0 1 at 0 0 0 vfov %.9g\n"
        "ambient 1 1 1\nmaterial m ka 1 1 1 texture \"four.bmp\" %s\n"
        "triangle a -2 -2 0 b 2 -2 0 c 2 2 0 material m ta -5.5 -1.25 tb 6.5 -1.25 tc 6.5 2.75\n"
        "triangle a -2 -2 0 b 2 2 0 c -2 2 0 material m ta -5.5 -1.25 tb 6.5 2.75 tc -5.5 2.75\n",
        SIDE, 360 / 3.14159265358979 * atan(0.5 / SIDE), how);
    return count_wrong(text, is_right, is_mutant);
}

static void a_triangle_s_picture_is_repeated_or_its_border_goes_on(void **state)
{
    (void)state;
    assert_int_equal(wrong_on_wall("", is_repeated, false), 0);
    assert_int_equal(wrong_on_wall("wrap repeat", is_repeated, false), 0);
    assert_int_equal(wrong_on_wall("wrap clamp", is_clamped, false), 0);
    assert_int_equal(wrong_on_wall("wrap clamp filter nearest", is_clamped_nearest, false), 0);
    test_mutate_kernels(MUTANT_NEVER_CLAMPED);
    assert_true(wrong_on_wall("wrap clamp", is_clamped, true) > 0);
    test_restore_kernels();
}

static int set_up(void **state)
{
    (void)state;
    write_picture();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_globe_s_picture_ends_at_its_poles),
        cmocka_unit_test(a_globe_s_picture_goes_round),
        cmocka_unit_test(a_triangle_s_picture_is_repeated_or_its_border_goes_on),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
