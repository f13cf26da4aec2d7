/* --seconds and --error: as many samples as it takes, and what is said of the error. */
#include "support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/refine.h"

/* Two parts whose means differ by d: the error of both together is d sqrt(ab) / (a + b). */
static void the_estimate_is_that_of_independent_parts(void **state)
{
    (void)state;
    const float first[] = {4 * 0.5f, 4 * 0.25f}, all[] = {4 * 0.5f + 4 * 0.75f, 4 * 0.25f + 4 * 0};
    assert_near(rt_refine_error(first, 4, all, 4, 2), 255 * 0.25 / 2, 1e-9);
    const float more[] = {4 * 0.5f + 2 * 0.75f, 4 * 0.25f + 2 * 0.5f};
    assert_near(rt_refine_error(first, 4, more, 2, 2), 255 * 0.25 * sqrt(8) / 6, 1e-9);
    /* Brighter than white is white. */
    const float bright[] = {4 * 2.0f}, brighter[] = {4 * 2.0f + 4 * 3.0f};
    assert_near(rt_refine_error(bright, 4, brighter, 4, 1), 0, 0);
}

static void add(rt_renderer *renderer, rt_image *image, int first, int count)
{
    rt_status status = RT_STATUS_INIT;
    rt_tiles tiles;
    const rt_sample_range range = {first, count, true};
    rt_tiles_init(&tiles, image->width, image->height, RT_TILE_DEFAULT, 1);
    assert_good(rt_renderer_draw_tiles(renderer, &tiles, &range, image, NULL, &status), &status);
}

/* Against many samples: what is said is not less than what is so, and not far more. */
static void the_estimate_holds_against_the_truth(void **state)
{
    (void)state;
    static const char *const files[] = {"scenes/soft.txt", "scenes/focus.txt"};
    static const int parts[][2] = {{4, 4}, {8, 4}, {32, 32}};
    for (size_t i = 0; i < 2; ++i) {
        rt_scene scene;
        rt_image image;
        rt_status status = RT_STATUS_INIT;
        test_scene_file(&scene, files[i]);
        scene.width = 64;
        scene.height = 36;
        scene.samples = 1024;
        rt_renderer *renderer = test_renderer(&scene, &(rt_render_options){0});
        assert_good(rt_image_init(&image, scene.width, scene.height, false, &status), &status);
        const size_t count = 3 * (size_t)image.width * (size_t)image.height;
        float *truth = malloc(count * sizeof *truth), *first = malloc(count * sizeof *first);
        assert_non_null(truth);
        assert_non_null(first);
        add(renderer, &image, 0, 1024);
        memcpy(truth, image.rgb, count * sizeof *truth);
        for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k) {
            const int a = parts[k][0], b = parts[k][1];
            add(renderer, &image, 0, a);
            memcpy(first, image.rgb, count * sizeof *first);
            add(renderer, &image, a, b);
            const double said = rt_refine_error(first, a, image.rgb, b, count);
            double squares = 0;
            for (size_t c = 0; c < count; ++c) {
                const double seen = fmin((double)image.rgb[c] / (a + b), 1.0);
                const double right = fmin((double)truth[c] / 1024, 1.0);
                squares += (seen - right) * (seen - right);
            }
            const double error = 255 * sqrt(squares / (double)count);
            print_message("%s, %d samples: said %.2f, is %.2f\n", files[i], a + b, said, error);
            assert_true(error < 1.15 * said && said < 4 * error);
        }
        free(truth);
        free(first);
        rt_image_clear(&image);
        rt_renderer_free(renderer);
        rt_scene_clear(&scene);
    }
}

/* The same bytes as the scene gives with that many samples, and what was reached is told. */
static void the_picture_is_that_of_so_many_samples(void **state)
{
    (void)state;
    char errors[4096];
    assert_int_equal(
        test_run("$RT --size 64x36 --error 4 --stats $T/s.json scenes/focus.txt $T/a.exr && "
                 "n=$(sed -n 's/.*\"samples\": \\([0-9]*\\).*/\\1/p' $T/s.json) && "
                 "sed \"s/^\\(image.*samples\\) *[0-9]*/\\1 $n/\" scenes/focus.txt >$T/n.txt && "
                 "$RT -q --size 64x36 $T/n.txt $T/b.exr && cmp $T/a.exr $T/b.exr",
                 errors, sizeof errors),
        0);
    assert_non_null(strstr(errors, "samples a pixel after"));
    assert_non_null(strstr(errors, "the error is about"));
}

static void there_is_a_picture_in_no_time(void **state)
{
    (void)state;
    char errors[4096];
    assert_int_equal(test_run("$RT --size 64x36 --seconds 0.001 scenes/focus.txt $T/c.png", errors,
                              sizeof errors),
                     0);
    assert_non_null(strstr(errors, "rt: 4 samples a pixel after"));
    assert_int_equal(test_run("$RT --seconds 0 scenes/focus.txt $T/c.png", errors, sizeof errors),
                     2);
    assert_int_equal(
        test_run("$RT --error 1 --device scalar scenes/focus.txt $T/c.png", errors, sizeof errors),
        2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_estimate_is_that_of_independent_parts),
        cmocka_unit_test(the_estimate_holds_against_the_truth),
        cmocka_unit_test(the_picture_is_that_of_so_many_samples),
        cmocka_unit_test(there_is_a_picture_in_no_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
