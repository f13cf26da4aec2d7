/* The pictures of scenes/hard, made small: at every level without a pixel that is not finite, and
 * on the device what the scalar path makes of them. */
#include "support/mutants.h"
#include "support/support.h"

#include <glob.h>
#include <stdio.h>
#include <string.h>

#include "common/accuracy.h"
#include "reference/scalar.h"

#define SIDE 64
#define SCENES_LEAST 10

static bool is_there(enum rt_accuracy level)
{
    return level != RT_ACCURACY_DOUBLE || test_device()->has_fp64;
}

static void read_small(rt_scene *scene, const char *path, int level)
{
    test_scene_file(scene, path);
    scene->width = scene->height = SIDE;
    scene->accuracy = (enum rt_accuracy)level;
}

/* The scalar path in the arithmetic of the scene's level. */
static void draw_scalar(const rt_scene *scene, rt_image *image)
{
    rt_status status = RT_STATUS_INIT;
    test_draw_scalar(scene, image);
    if (scene->accuracy == RT_ACCURACY_DOUBLE)
        assert_good(rt_scalar_double_render(scene, image, NULL, &status), &status);
}

/* Where the device may differ from the scalar path: at fast, whose bits are nobody's promise. */
static size_t hold(const char *path, int level)
{
    rt_scene scene;
    rt_image actual, expected;
    read_small(&scene, path, level);
    test_draw(&scene, NULL, &actual);
    draw_scalar(&scene, &expected);
    const rt_image_difference d = rt_image_compare(&actual, &expected);
    const bool is_held = level != RT_ACCURACY_FAST;
    const size_t wrong = d.non_finite + (is_held ? d.hits + d.pixels : 0);
    print_message("%-28s %-8s non-finite %zu, hits %zu, pixels %zu%s\n", path,
                  rt_accuracy_name(scene.accuracy), d.non_finite, d.hits, d.pixels,
                  wrong ? "  <--" : "");
    rt_image_clear(&actual);
    rt_image_clear(&expected);
    rt_scene_clear(&scene);
    return wrong;
}

static void pictures(void **state)
{
    (void)state;
    glob_t found;
    size_t wrong = 0;
    assert_int_equal(glob("scenes/hard/*.txt", 0, NULL, &found), 0);
    assert_true(found.gl_pathc >= SCENES_LEAST);
    for (size_t i = 0; i < found.gl_pathc; ++i)
        for (int level = 0; level < RT_ACCURACY_COUNT; ++level)
            if (is_there((enum rt_accuracy)level))
                wrong += hold(found.gl_pathv[i], level);
    globfree(&found);
    assert_int_equal(wrong, 0);
}

/* Whether two files give the same picture, to the bit, and one with something in it. */
static bool is_same(const char *const paths[2], int level)
{
    rt_image images[2];
    for (int i = 0; i < 2; ++i) {
        rt_scene scene;
        read_small(&scene, paths[i], level);
        test_draw(&scene, NULL, &images[i]);
        rt_scene_clear(&scene);
    }
    size_t hits = 0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE; ++i)
        hits += images[0].hits[i].primitive != RT_MISS;
    assert_true(hits > SIDE * SIDE / 4);
    const bool same =
        memcmp(images[0].rgb, images[1].rgb, 3 * sizeof(float) * (size_t)SIDE * SIDE) == 0;
    rt_image_clear(&images[0]);
    rt_image_clear(&images[1]);
    return same;
}

static void size_changes_nothing(void **state)
{
    (void)state;
    static const char *const twins[] = {"scenes/hard/tiny.txt", "scenes/hard/huge.txt"};
    for (int level = RT_ACCURACY_STANDARD; level < RT_ACCURACY_COUNT; ++level)
        if (is_there((enum rt_accuracy)level))
            assert_true(is_same(twins, level));
}

/* Two pictures that are not the same are told apart, and kernels that are almost right. */
static void a_wrong_kernel_is_noticed(void **state)
{
    (void)state;
    static const char *const others[] = {"scenes/hard/tiny.txt", "scenes/hard/facing.txt"};
    assert_false(is_same(others, RT_ACCURACY_ROBUST));
    test_mutate_kernels(MUTANT_RESIDUAL_NOT_FUSED);
    const size_t wrong = hold("scenes/hard/hub.txt", RT_ACCURACY_ROBUST);
    test_restore_kernels();
    assert_true(wrong > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures),
                                       cmocka_unit_test(size_changes_nothing),
                                       cmocka_unit_test(a_wrong_kernel_is_noticed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
