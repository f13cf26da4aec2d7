/* Whole pictures: every lane width, tiling, rounding and odd size gives the scalar path's hits to
 * the bit, and its colours within a step. */
#define _GNU_SOURCE
#include "support/mutants.h"
#include "support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Draws with the options and asserts that nothing is off. */
static void assert_equal_to_scalar(const rt_scene *scene, const rt_render_options *options)
{
    rt_image image, expected;
    test_draw(scene, options, &image);
    test_draw_scalar(scene, &expected);
    const rt_image_difference d = rt_image_compare(&image, &expected);
    if (d.hits || d.pixels || d.non_finite)
        fail_msg("%dx%d, lanes %d, tile %d: %zu hits and %zu pixels are off, first at %d,%d",
                 scene->width, scene->height, options->lanes, options->tile, d.hits, d.pixels,
                 d.first_x, d.first_y);
    rt_image_clear(&image);
    rt_image_clear(&expected);
}

static const char *const scenes[] = {"scenes/sphere.txt", "scenes/triangle.txt",
                                     "scenes/triangle-spheres.txt", "scenes/icecream.txt"};

static void shipped_scenes(void **state)
{
    (void)state;
    const rt_render_options options = {0};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i) {
        rt_scene scene;
        test_scene_file(&scene, scenes[i]);
        assert_equal_to_scalar(&scene, &options);
        rt_scene_clear(&scene);
    }
}

static void odd_sizes_at_every_width(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {7, 93}, {144, 5}, {8, 8}, {257, 3}};
    static const int widths[] = {1, 4, 8, 16};
    rt_scene scene;
    test_scene_file(&scene, "scenes/icecream.txt");
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s)
        for (size_t w = 0; w < 4; ++w) {
            const rt_render_options options = {.lanes = widths[w]};
            scene.width = sizes[s][0];
            scene.height = sizes[s][1];
            assert_equal_to_scalar(&scene, &options);
        }
    rt_scene_clear(&scene);
}

/* Tiles of any size make the same picture as one. */
static void tiling_does_not_show(void **state)
{
    (void)state;
    static const int tiles[] = {1, 7, 8, 33, 64, 512};
    rt_scene scene;
    test_scene_file(&scene, "scenes/icecream.txt");
    scene.width = 99;
    scene.height = 61;
    rt_image whole;
    const rt_render_options one_tile = {.tile = 128};
    test_draw(&scene, &one_tile, &whole);
    for (size_t i = 0; i < sizeof tiles / sizeof *tiles; ++i) {
        rt_image image;
        const rt_render_options options = {.tile = tiles[i]};
        test_draw(&scene, &options, &image);
        assert_memory_equal(image.rgb, whole.rgb, 99 * 61 * 3 * sizeof(float));
        assert_memory_equal(image.hits, whole.hits, 99 * 61 * sizeof(rt_hit));
        rt_image_clear(&image);
    }
    rt_image_clear(&whole);
    rt_scene_clear(&scene);
}

/* A scene of everything: all kinds of light and material, smooth and flat, in a tilted view. */
static void a_mixed_scene(const char *cull, rt_scene *scene)
{
    test_random random = {42};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(out,
            "image width 200 height 150\ncamera from 1 2 6 at 0 0 0 up 0.2 1 0 vfov 50\n%s\n"
            "background 0.1 0.2 0.3\nambient 0.1 0.1 0.1\n"
            "light point at 5 9 3 color 0.5 0.4 0.3\nlight point at 0 0 0 color 0.2 0.2 0.9\n"
            "light directional direction 1 -2 -1 color 0.3 0.3 0.3\n",
            cull);
    static const char *const exponents[] = {"0", "1", "2.5", "31", "32", "200.7", "255", "4000"};
    for (int m = 0; m < 8; ++m)
        fprintf(out, "material m%d ka 0.%d 0.5 0.2 kd 0.5 0.%d 0.9 ks 0.5 0.5 0.%d shininess %s\n",
                m, m, m, m, exponents[m]);
    for (int i = 0; i < 120; ++i) {
        float p[9], n[9];
        for (int k = 0; k < 9; ++k) {
            p[k] = test_random_float(&random, -2, 2);
            n[k] = test_random_float(&random, -1, 1);
        }
        if (i % 3 == 0)
            fprintf(out, "sphere center %g %g %g radius %g material m%d\n", (double)p[0],
                    (double)p[1], (double)p[2], 0.05 + 0.2 * (double)(p[3] + 2), i % 8);
        else
            fprintf(out, "triangle a %g %g %g b %g %g %g c %g %g %g material m%d", (double)p[0],
                    (double)p[1], (double)p[2], (double)p[3], (double)p[4], (double)p[5],
                    (double)p[6], (double)p[7], (double)p[8], i % 8);
        if (i % 3 == 1)
            fprintf(out, " na %g %g %g nb %g %g %g nc %g %g %g", (double)n[0], (double)n[1],
                    (double)n[2], (double)n[3], (double)n[4], (double)n[5], (double)n[6],
                    (double)n[7], (double)n[8]);
        fputc('\n', out);
    }
    assert_int_equal(fclose(out), 0);
    test_scene(scene, text);
    free(text);
}

static void mixed_scenes(void **state)
{
    (void)state;
    static const char *const culls[] = {"", "cull back", "cull front winding cw"};
    static const int widths[] = {1, 16, 4};
    for (int i = 0; i < 3; ++i) {
        rt_scene scene;
        a_mixed_scene(culls[i], &scene);
        const rt_render_options options = {.lanes = widths[i], .tile = 64};
        assert_equal_to_scalar(&scene, &options);
        rt_scene_clear(&scene);
    }
}

/* On a device that divides and takes roots correctly, the two ways around for others must agree
 * with it: by double, and by fma. */
static void every_way_of_rounding(void **state)
{
    (void)state;
    static const test_mutant ways[] = {MUTANT_ROUNDING_BY_DOUBLE, MUTANT_ROUNDING_BY_FMA};
    const rt_device *device = test_device();
    rt_scene scene;
    a_mixed_scene("", &scene);
    for (int way = 0; way < 2; ++way) {
        if (way == 0 && !device->has_fp64) {
            print_message("the device has no fp64: rounding by double is not tested\n");
            continue;
        }
        static const int widths[] = {1, 16};
        for (int w = 0; w < 2; ++w) {
            const rt_render_options options = {.lanes = widths[w]};
            test_mutate_kernels(ways[way]);
            assert_equal_to_scalar(&scene, &options);
            test_restore_kernels();
        }
    }
    rt_scene_clear(&scene);
}

static bool stop_at_once(void *context, double done)
{
    (void)done;
    ++*(int *)context;
    return false;
}

static void a_watch_stops_the_picture(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image image;
    rt_status status = RT_STATUS_INIT;
    int ticks = 0;
    const rt_watch watch = {stop_at_once, &ticks};
    const rt_render_options options = {.tile = 16};
    test_scene_file(&scene, "scenes/sphere.txt");
    assert_good(rt_image_init(&image, scene.width, scene.height, false, &status), &status);
    rt_renderer *renderer = test_renderer(&scene, &options);
    assert_false(rt_renderer_draw(renderer, &image, &watch, &status));
    assert_int_equal(status.code, RT_INTERRUPTED);
    assert_int_equal(ticks, 1);
    rt_renderer_free(renderer);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
    rt_status_clear(&status);
}

/* What was not asked for is not launched. */
static void only_the_stages_called_for(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image image;
    rt_status status = RT_STATUS_INIT;
    const rt_render_options options = {0};
    test_scene_file(&scene, "scenes/sphere.txt");
    assert_good(rt_image_init(&image, scene.width, scene.height, false, &status), &status);
    rt_renderer *renderer = test_renderer(&scene, &options);
    assert_good(rt_renderer_draw(renderer, &image, NULL, &status), &status);
    const rt_render_times *times = rt_renderer_times(renderer);
    assert_int_equal(times->launches[RT_STAGE_CAMERA], 4);
    assert_int_equal(times->launches[RT_STAGE_TRACE], 4);
    assert_int_equal(times->launches[RT_STAGE_SHADE], 4);
    assert_int_equal(times->launches[RT_STAGE_RESOLVE], 4);
    assert_int_equal(times->launches[RT_STAGE_HITS], 0);
    assert_int_equal(times->rays.primary, 512 * 512);
    rt_renderer_free(renderer);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shipped_scenes),
        cmocka_unit_test(odd_sizes_at_every_width),
        cmocka_unit_test(tiling_does_not_show),
        cmocka_unit_test(mixed_scenes),
        cmocka_unit_test(every_way_of_rounding),
        cmocka_unit_test(a_watch_stops_the_picture),
        cmocka_unit_test(only_the_stages_called_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
