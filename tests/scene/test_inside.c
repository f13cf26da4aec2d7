/* How often a point is inside of what: whole numbers in and out of closed meshes, closed forms for
 * open ones. */
#include "support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "scene/inside.h"

#define EVERY_WINDING 1e-12

static void assert_winding(const rt_scene *s, int material, double x, double y, double z,
                           double expected, double tolerance)
{
    rt_status status = RT_STATUS_INIT;
    const vec3 point = {x, y, z};
    double *windings = rt_scene_windings(s, point, &status);
    assert_good(windings != NULL, &status);
    assert_near(windings[material], expected, tolerance);
    free(windings);
}

static void spheres_are_counted_by_material(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "material a kd 1 1 1\nmaterial b kd 1 1 1\n"
                   "sphere center 0 0 0 radius 2 material a\n"
                   "sphere center 0.5 0 0 radius 1 material a\n"
                   "sphere center 0 0 0 radius 3 material b\n");
    assert_winding(&s, 0, 0, 0, 0, 2.0, 0.0);
    assert_winding(&s, 0, -1.5, 0, 0, 1.0, 0.0);
    assert_winding(&s, 1, -1.5, 0, 0, 1.0, 0.0);
    assert_winding(&s, 0, 2.5, 0, 0, 0.0, 0.0);
    assert_winding(&s, 1, 2.5, 0, 0, 1.0, 0.0);
    assert_winding(&s, 1, 0, 3.0, 0, 0.0, 0.0);
    /* In double: the last float below the radius is inside, the radius is not. */
    assert_winding(&s, 1, 0, (double)nextafterf(3.0f, 0.0f), 0, 1.0, 0.0);
    rt_scene_clear(&s);
}

/* An octahedron, counter-clockwise as seen from outside. */
static void add_octahedron(rt_scene *s, float radius, float x, bool turned, int32_t material)
{
    rt_status status = RT_STATUS_INIT;
    for (int i = 0; i < 8; ++i) {
        const float sx = i & 1 ? -radius : radius, sy = i & 2 ? -radius : radius,
                    sz = i & 4 ? -radius : radius;
        rt_triangle t = {x + sx, 0, 0, x, sy, 0, x, 0, sz};
        const bool mirrored = ((i & 1) + (i >> 1 & 1) + (i >> 2 & 1)) % 2 == 1;
        if (mirrored != turned)
            t = (rt_triangle){x + sx, 0, 0, x, 0, sz, x, sy, 0};
        assert_good(rt_scene_add_triangle(s, &t, NULL, material, &status), &status);
    }
}

static void closed_meshes_give_whole_numbers(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "material a kd 1 1 1\nmaterial b kd 1 1 1\n");
    add_octahedron(&s, 2.0f, 0.0f, false, 0);
    add_octahedron(&s, 1.0f, 0.5f, false, 0);
    add_octahedron(&s, 3.0f, 0.0f, true, 1);
    test_random random = {77};
    for (int i = 0; i < 2000; ++i) {
        const double x = (double)test_random_float(&random, -3.5f, 3.5f);
        const double y = (double)test_random_float(&random, -3.5f, 3.5f);
        const double z = (double)test_random_float(&random, -3.5f, 3.5f);
        const double from_middle = fabs(x) + fabs(y) + fabs(z);
        const double from_second = fabs(x - 0.5) + fabs(y) + fabs(z);
        assert_winding(&s, 0, x, y, z, (from_middle < 2.0) + (from_second < 1.0), EVERY_WINDING);
        assert_winding(&s, 1, x, y, z, -(double)(from_middle < 3.0), EVERY_WINDING);
    }
    rt_scene_clear(&s);
}

/* Corners and edges straight above and below the point, where products vanish. */
static void middles_and_small_sizes_are_no_exception(void **state)
{
    (void)state;
    static const float sizes[] = {1.0f, 0x1p-10f, 0x1p37f, 1e-30f, 1e30f};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        rt_scene s;
        test_scene(&s, "material a kd 1 1 1\n");
        add_octahedron(&s, sizes[i], 0.0f, false, 0);
        assert_winding(&s, 0, 0, 0, 0, 1.0, EVERY_WINDING);
        assert_winding(&s, 0, 0.999 * (double)sizes[i], 0, 0, 1.0, EVERY_WINDING);
        assert_winding(&s, 0, 1.001 * (double)sizes[i], 0, 0, 0.0, EVERY_WINDING);
        rt_scene_clear(&s);
    }
}

/* A face of a cube covers a sixth of all directions as seen from the middle, and a square of side s
 * from h above its middle 4 asin(s^2 / (s^2 + 4 h^2)). */
static void open_surfaces_cover_a_part(void **state)
{
    (void)state;
    rt_scene s;
    /* A third triangle, far below and seen edge on, makes the box one that holds the points. */
    test_scene(&s, "material a kd 1 1 1\n"
                   "triangle a -1 -1 1 b 1 -1 1 c 1 1 1 material a\n"
                   "triangle a -1 -1 1 b 1 1 1 c -1 1 1 material a\n"
                   "triangle a 0 0 -9 b 0 0 -8 c 0 0 -9 material a\n");
    const double pi = acos(-1.0);
    assert_winding(&s, 0, 0, 0, 0, 1.0 / 6.0, EVERY_WINDING);
    for (double h = 0.125; h < 5.0; h *= 2.0)
        assert_winding(&s, 0, 0, 0, 1.0 - h, asin(4.0 / (4.0 + 4.0 * h * h)) / pi, EVERY_WINDING);
    /* Outside of the box there is nothing to be inside of. */
    assert_winding(&s, 0, 0, 0, 1.5, 0.0, 0.0);
    rt_scene_clear(&s);
}

static void nothing_has_no_inside(void **state)
{
    (void)state;
    rt_scene s;
    rt_status status = RT_STATUS_INIT;
    const vec3 point = {0, 0, 0};
    test_scene(&s, "");
    double *windings = rt_scene_windings(&s, point, &status);
    assert_good(windings != NULL, &status);
    free(windings);
    rt_scene_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_are_counted_by_material),
        cmocka_unit_test(closed_meshes_give_whole_numbers),
        cmocka_unit_test(middles_and_small_sizes_are_no_exception),
        cmocka_unit_test(open_surfaces_cover_a_part),
        cmocka_unit_test(nothing_has_no_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
