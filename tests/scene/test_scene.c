/* The camera's vectors, culling's sign and what counts as a triangle without area. */
#include "support/support.h"

#include <math.h>

#include "scene/camera.h"

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void assert_vector(const double v[3], double x, double y, double z)
{
    assert_near(v[0], x, 1e-15);
    assert_near(v[1], y, 1e-15);
    assert_near(v[2], z, 1e-15);
}

static void the_default_view(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "image width 512 height 256\n");
    const rt_view v = rt_scene_view(&s);
    assert_vector(v.origin, 0, 0, 0);
    assert_vector(v.forward, 0, 0, -1);
    /* vfov 90: the plane at distance 1 reaches from -1 to 1, 256 pixels high. */
    assert_vector(v.up, 0, 1.0 / 256, 0);
    assert_vector(v.right, 1.0 / 256, 0, 0);
    rt_scene_clear(&s);
}

static void a_view_from_anywhere_is_orthogonal(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s,
               "camera from 3 -2 7 at -4 0.5 1 up 0.1 0.9 -0.3 vfov 37\nimage width 3 height 7\n");
    const rt_view v = rt_scene_view(&s);
    assert_near(dot(v.forward, v.forward), 1.0, 1e-15);
    assert_near(dot(v.forward, v.up), 0.0, 1e-15);
    assert_near(dot(v.forward, v.right), 0.0, 1e-15);
    assert_near(dot(v.right, v.up), 0.0, 1e-15);
    assert_near(dot(v.right, v.right), dot(v.up, v.up), 1e-15);
    rt_scene_clear(&s);
}

static void a_view_parallel_to_up_has_a_fallback(void **state)
{
    (void)state;
    static const char *const cameras[] = {"camera at 0 5 0", "camera at 0 -5 0",
                                          "camera at 3 3 3 up 1 1 1", "camera at 0 0 -1 up 0 0 2",
                                          "camera at 1 0 0 up -3 0 0"};
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; ++i) {
        rt_scene s;
        test_scene(&s, cameras[i]);
        const rt_view v = rt_scene_view(&s);
        const double pixel = 1.0 / 512;
        assert_near(sqrt(dot(v.right, v.right)), pixel, 4e-16);
        assert_near(sqrt(dot(v.up, v.up)), pixel, 4e-16);
        assert_near(dot(v.right, v.forward), 0.0, 1e-18);
        assert_near(dot(v.right, v.up), 0.0, 1e-18);
        rt_scene_clear(&s);
    }
}

static void narrow_and_wide_views(void **state)
{
    (void)state;
    static const char *const cameras[] = {"camera vfov 0.001", "camera vfov 179.99"};
    for (size_t i = 0; i < 2; ++i) {
        rt_scene s;
        test_scene(&s, cameras[i]);
        const rt_frame f = rt_scene_frame(&s);
        assert_true(isfinite(f.up_y) && f.up_y > 0.0f && isfinite(f.right_x) && f.right_x > 0.0f);
        rt_scene_clear(&s);
    }
}

static void culling_keeps_one_sign(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int sign;
    } cases[] = {{"", 0},
                 {"cull back", 1},
                 {"cull back winding ccw", 1},
                 {"cull back winding cw", -1},
                 {"cull front", -1},
                 {"cull front winding cw", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rt_scene s;
        test_scene(&s, cases[i].text);
        assert_int_equal(rt_scene_cull_sign(&s), cases[i].sign);
        rt_scene_clear(&s);
    }
}

static void triangles_without_area(void **state)
{
    (void)state;
    const rt_triangle flat[] = {{0, 0, 0, 0, 0, 0, 0, 0, 0},
                                {1, 2, 3, 1, 2, 3, 4, 5, 6},
                                {1, 1, 1, 2, 2, 2, 3, 3, 3},
                                {0.1f, 0, 0, 0.2f, 0, 0, 0.3f, 0, 0},
                                {0, 0, 0, 1e-20f, 0, 0, 1e20f, 0, 0}};
    const rt_triangle good[] = {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                {0, 0, 0, 1e-30f, 0, 0, 0, 1e-30f, 0},
                                {1, 1, 1, 2, 2, 2, 3, 3, nextafterf(3, 4)}};
    for (size_t i = 0; i < sizeof flat / sizeof *flat; ++i)
        assert_true(rt_triangle_is_degenerate(&flat[i]));
    for (size_t i = 0; i < sizeof good / sizeof *good; ++i)
        assert_false(rt_triangle_is_degenerate(&good[i]));
}

static void arrays_grow(void **state)
{
    (void)state;
    rt_scene s;
    rt_status status = RT_STATUS_INIT;
    rt_scene_init(&s);
    for (int i = 0; i < 1000; ++i) {
        const rt_sphere sphere = {(float)i, 0, 0, 1};
        const rt_triangle triangle = {(float)i, 0, 0, 1, 1, 1, 2, 2, 2};
        const float normals[9] = {(float)i, 0, 0, 0, 0, 0, 0, 0, (float)-i};
        assert_true(rt_scene_add_sphere(&s, &sphere, i, &status));
        const float uvs[RT_UV_COMPONENTS] = {(float)i, 0, 1, 0, 0, 1};
        assert_true(rt_scene_add_triangle(&s, &triangle, i % 2 ? normals : NULL, 2 * i, &status));
        assert_true(i % 4 || rt_scene_set_uvs(&s, uvs, &status));
    }
    assert_int_equal(s.sphere_count, 1000);
    assert_int_equal(s.normal_count, 500);
    assert_int_equal(s.uv_count, 250);
    for (int i = 0; i < 1000; ++i) {
        assert_true(s.spheres[i].cx == (float)i && s.sphere_materials[i] == i);
        assert_true(s.triangles[i].ax == (float)i && s.triangle_materials[i] == 2 * i);
        assert_int_equal(s.triangle_normals[i], i % 2 ? i / 2 : -1);
        assert_int_equal(s.triangle_uvs[i], i % 4 ? -1 : i / 4);
        assert_true(i % 4 || s.uvs[RT_UV_COMPONENTS * (i / 4)] == (float)i);
        if (i % 2)
            assert_true(s.normals[9 * (i / 2)] == (float)i &&
                        s.normals[9 * (i / 2) + 8] == (float)-i);
    }
    rt_scene_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_default_view),
        cmocka_unit_test(a_view_from_anywhere_is_orthogonal),
        cmocka_unit_test(a_view_parallel_to_up_has_a_fallback),
        cmocka_unit_test(narrow_and_wide_views),
        cmocka_unit_test(culling_keeps_one_sign),
        cmocka_unit_test(triangles_without_area),
        cmocka_unit_test(arrays_grow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
