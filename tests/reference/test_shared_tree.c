/* A tree that several pictures and rays share changes no bit of them. */
#include "support/scalar_double.h"

#include <stdlib.h>
#include <string.h>

#define SIDE 24

static void draw(const rt_scalar_tree *tree, const rt_scene *scene, rt_image *image)
{
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_image_init(image, scene->width, scene->height, true, &status), &status);
    assert_good(rt_scalar_double_render_by(tree, scene, image, NULL, &status), &status);
}

static void pictures_of_any_size(void **state)
{
    (void)state;
    rt_scene scene;
    test_scene_file(&scene, "scenes/icecream.txt");
    rt_scalar_tree *tree = rt_scalar_double_tree(&scene);
    assert_non_null(tree);
    for (int samples = 1; samples <= 4; samples *= 4) {
        rt_scene small = scene; /* the arrays stay the scene's */
        rt_image shared, own;
        small.width = small.height = SIDE * samples / 2;
        small.samples = samples;
        draw(tree, &small, &shared);
        draw(NULL, &small, &own);
        const size_t pixels = (size_t)small.width * (size_t)small.height;
        assert_memory_equal(shared.rgb, own.rgb, 3 * pixels * sizeof *own.rgb);
        assert_memory_equal(shared.hits, own.hits, pixels * sizeof *own.hits);
        rt_image_clear(&shared);
        rt_image_clear(&own);
    }
    rt_scalar_double_tree_free(tree);
    rt_scene_clear(&scene);
}

static void rays(void **state)
{
    (void)state;
    rt_scene scene;
    rt_ray one[SIDE];
    rt_hit shared[SIDE], own[SIDE];
    test_scene_file(&scene, "scenes/icecream.txt");
    rt_scalar_tree *tree = rt_scalar_double_tree(&scene);
    for (int i = 0; i < SIDE; ++i)
        one[i] = (rt_ray){.direction = {0.02f * (float)(i - SIDE / 2), 0.01f * (float)i, -1.0f},
                          .tmax = INFINITY};
    rt_scalar_double_trace_by(tree, &scene, one, SIDE, shared);
    rt_scalar_double_trace(&scene, one, SIDE, own);
    assert_memory_equal(shared, own, sizeof own);
    rt_scalar_double_tree_free(tree);
    rt_scalar_double_tree_free(NULL);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_of_any_size),
        cmocka_unit_test(rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
