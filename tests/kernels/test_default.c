/* What a scene gets that says nothing of accuracy: walls without holes. */
#include "support/support.h"

#include <stdio.h>

/* Pixels of the device's picture, and of the reference's, that hit nothing. */
static size_t holes_in(rt_scene *scene)
{
    size_t holes = 0;
    for (int reference = 0; reference < 2; ++reference) {
        rt_image image;
        if (reference)
            test_draw_scalar(scene, &image);
        else
            test_draw(scene, NULL, &image);
        for (size_t i = 0; i < (size_t)image.width * (size_t)image.height; ++i)
            holes += image.hits[i].primitive == RT_MISS;
        rt_image_clear(&image);
    }
    return holes;
}

/* Two triangles before the eye, with their seam from corner to corner of the picture. */
static void a_wall_seen_head_on_has_no_holes(void **state)
{
    (void)state;
    rt_scene scene;
    test_scene(&scene, "ambient 1 1 1\nmaterial m ka 1 1 1\n"
                       "triangle a -9 -9 -3 b 9 -9 -3 c 9 9 -3 material m\n"
                       "triangle a -9 -9 -3 b 9 9 -3 c -9 9 -3 material m\n");
    assert_int_equal(scene.accuracy, RT_ACCURACY_ROBUST);
    assert_int_equal(holes_in(&scene), 0);
    /* At standard rays slip through the seam. */
    scene.accuracy = RT_ACCURACY_STANDARD;
    assert_true(holes_in(&scene) > 100);
    rt_scene_clear(&scene);
}

/* From inside, along its axes and toward its edges and corners. */
static void a_closed_cube_has_no_holes(void **state)
{
    (void)state;
    static const char *const views[] = {"0 0 -1", "1 0 0",  "0 1 0",
                                        "1 1 1",  "-1 1 0", "0.3 -0.7 -1"};
    /* Its sides, by the corners of bits x, y, z. */
    static const int sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (size_t v = 0; v < sizeof views / sizeof *views; ++v) {
        char text[3000];
        int used =
            snprintf(text, sizeof text,
                     "camera at %s vfov 100\nambient 1 1 1\nmaterial m ka 1 1 1\n", views[v]);
        for (int i = 0; i < 12; ++i) {
            const int *s = sides[i / 2], corners[3] = {s[0], s[i % 2 + 1], s[i % 2 + 2]};
            used += snprintf(text + used, sizeof text - (size_t)used, "triangle material m");
            for (int k = 0; k < 3; ++k)
                used += snprintf(text + used, sizeof text - (size_t)used, " %c %d %d %d", "abc"[k],
                                 corners[k] & 1 ? 3 : -3, corners[k] & 2 ? 3 : -3,
                                 corners[k] & 4 ? 3 : -3);
            used += snprintf(text + used, sizeof text - (size_t)used, "\n");
        }
        rt_scene scene;
        test_scene(&scene, text);
        assert_int_equal(holes_in(&scene), 0);
        rt_scene_clear(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wall_seen_head_on_has_no_holes),
        cmocka_unit_test(a_closed_cube_has_no_holes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
