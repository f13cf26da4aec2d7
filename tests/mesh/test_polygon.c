/* Corners are small whole numbers, so that areas are exact and a split is right if no triangle is
 * turned around and the areas sum up to the polygon's. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "mesh/polygon.h"

#define CORNERS_MAX 64

/* Twice the area of a triangle in the plane of axes u and v. */
static double twice_area(const float *a, const float *b, const float *c, int u, int v)
{
    return ((double)b[u] - (double)a[u]) * ((double)c[v] - (double)a[v]) -
           ((double)b[v] - (double)a[v]) * ((double)c[u] - (double)a[u]);
}

/* Splits the polygon (x, y) in each of the three axis planes, both ways around, from every first
 * corner. Exactly `flat` of the triangles may have no area, or any number for -1. */
static void check_split(const float *xy, size_t count, int flat)
{
    rt_polygon polygon = RT_POLYGON_INIT;
    for (int variant = 0; variant < 6; ++variant) {
        const int u = variant % 3, v = (u + (variant < 3 ? 1 : 2)) % 3, w = 3 - u - v;
        for (size_t first = 0; first < count; ++first) {
            float points[3 * CORNERS_MAX];
            for (size_t i = 0; i < count; ++i) {
                const float *from = xy + 2 * ((first + i) % count);
                points[3 * i + (size_t)u] = from[0];
                points[3 * i + (size_t)v] = from[1];
                points[3 * i + (size_t)w] = 7.0f;
            }
            assert_true(rt_polygon_split(&polygon, points, count));
            double whole = 0.0, sum = 0.0;
            for (size_t i = 2; i < count; ++i)
                whole += twice_area(points, points + 3 * (i - 1), points + 3 * i, u, v);
            int flat_found = 0;
            for (size_t i = 0; i < count - 2; ++i) {
                const int32_t *t = polygon.triangles + 3 * i;
                const double area =
                    twice_area(points + 3 * t[0], points + 3 * t[1], points + 3 * t[2], u, v);
                assert_true(area * whole >= 0.0);
                sum += area;
                flat_found += area == 0.0;
            }
            assert_true(sum == whole);
            assert_true(flat < 0 || flat_found == flat);
        }
    }
    rt_polygon_clear(&polygon);
}

#define CHECK(flat, ...)                                                                           \
    do {                                                                                           \
        static const float xy[] = {__VA_ARGS__};                                                   \
        check_split(xy, sizeof xy / sizeof *xy / 2, flat);                                         \
    } while (0)

static void simple_polygons(void **state)
{
    (void)state;
    CHECK(0, 0, 0, 4, 0, 0, 4);                               /* triangle */
    CHECK(0, 0, 0, 4, 0, 4, 4, 0, 4);                         /* square */
    CHECK(0, 0, 0, 4, 0, 1, 1, 0, 4);                         /* arrowhead */
    CHECK(0, 0, 0, 9, 0, 9, 9, 6, 9, 6, 3, 3, 3, 3, 9, 0, 9); /* U */
    CHECK(0, 0, 0, 8, 0, 8, 8, 0, 8, 0, 2, 6, 2, 6, 6, 2, 6, 2, 4, 4, 4, 4, 5, 3, 5, 3, 5.5, 5, 5.5,
          5, 3, 1, 3, 1, 7, 7, 7, 7, 1, 0, 1);                                         /* spiral */
    CHECK(0, 0, 0, 1, 3, 2, 0, 3, 3, 4, 0, 5, 3, 6, 0, 6, -1, 0, -1);                  /* saw */
    CHECK(0, 0, 5, 3, 1, 4, 0, 9, -1, 4, -7, 5, -2, 1, -9, -3, -2, -1, -3, -8, 1, -2); /* star */
}

/* Corners on the line between their neighbours are used for triangles that have an area. */
static void corners_on_a_line(void **state)
{
    (void)state;
    CHECK(0, 0, 0, 2, 0, 4, 0, 0, 4);
    CHECK(0, 0, 0, 1, 0, 2, 0, 3, 0, 4, 0, 4, 4, 3, 4, 2, 4, 0, 4, 0, 1);
    CHECK(0, 0, 0, 1, 0, 2, 0, 2, 1, 2, 2, 1, 2, 1, 1, 0, 1);
    CHECK(3, 0, 0, 1, 0, 2, 0, 3, 0, 4, 0); /* all of them: no area at all */
}

static void corners_that_repeat(void **state)
{
    (void)state;
    CHECK(1, 0, 0, 4, 0, 4, 0, 4, 4, 0, 4);
    CHECK(2, 0, 0, 4, 0, 4, 0, 4, 0, 1, 1, 0, 4);
    CHECK(-1, 0, 0, 4, 0, 8, 0, 4, 0, 4, 4, 0, 4); /* a spike */
    CHECK(4, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1);
}

/* Holes joined to the outline by cuts, which run there and back. */
static void holes(void **state)
{
    (void)state;
    CHECK(0, 0, 0, 10, 0, 10, 10, 0, 10, 0, 0, 3, 3, 3, 7, 7, 7, 7, 3, 3, 3);
    CHECK(-1, 0, 0, 20, 0, 20, 10, 0, 10, 0, 0, 3, 3, 3, 7, 7, 7, 7, 3, 3, 3, 0, 0, 12, 2, 12, 4,
          14, 4, 14, 2, 12, 2);
}

static void convex_polygon_is_a_fan(void **state)
{
    (void)state;
    const float points[] = {0, 0, 0, 2, -1, 0, 4, 0, 0, 4, 4, 0, 2, 5, 0, 0, 4, 0};
    rt_polygon polygon = RT_POLYGON_INIT;
    assert_true(rt_polygon_split(&polygon, points, 6));
    for (int32_t i = 0; i < 4; ++i) {
        assert_int_equal(polygon.triangles[3 * i], 0);
        assert_int_equal(polygon.triangles[3 * i + 1], i + 1);
        assert_int_equal(polygon.triangles[3 * i + 2], i + 2);
    }
    rt_polygon_clear(&polygon);
}

/* No right answer: every corner index is valid, and it ends. */
static void crossing_edges(void **state)
{
    (void)state;
    rt_polygon polygon = RT_POLYGON_INIT;
    uint32_t random = 1;
    for (int round = 0; round < 2000; ++round) {
        float points[3 * CORNERS_MAX];
        const size_t count = 3 + (size_t)round % (CORNERS_MAX - 2);
        for (size_t i = 0; i < 3 * count; ++i) {
            random = random * 1664525u + 1013904223u;
            points[i] = (float)(random >> 29) * (round % 7 ? 1.0f : 3e37f);
        }
        assert_true(rt_polygon_split(&polygon, points, count));
        for (size_t i = 0; i < 3 * (count - 2); ++i)
            assert_in_range(polygon.triangles[i], 0, count - 1);
    }
    rt_polygon_clear(&polygon);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simple_polygons),         cmocka_unit_test(corners_on_a_line),
        cmocka_unit_test(corners_that_repeat),     cmocka_unit_test(holes),
        cmocka_unit_test(convex_polygon_is_a_fan), cmocka_unit_test(crossing_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
