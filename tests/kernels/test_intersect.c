/* One primitive and one ray at a time, against values computed by hand; every case goes through the
 * trace kernel, in its long form at every lane width, and through both scalar paths. */
#include "support/support.h"

#include <math.h>
#include <string.h>

#include "reference/scalar.h"

typedef struct expectation {
    rt_ray ray;
    int primitive;
    float t, u, v;
    float tolerance;
} expectation;

#define RAY(ox, oy, oz, dx, dy, dz)                                                                \
    {                                                                                              \
        {ox, oy, oz}, {dx, dy, dz}, 0.0f, INFINITY                                                 \
    }

static void check(const char *path, const expectation *e, const rt_hit *hit)
{
    if (hit->primitive != e->primitive)
        fail_msg("%s: primitive %d, not %d, for the ray from %g %g %g", path, hit->primitive,
                 e->primitive, (double)e->ray.origin[0], (double)e->ray.origin[1],
                 (double)e->ray.origin[2]);
    if (e->primitive == RT_MISS) {
        assert_true(isinf(hit->t) && hit->t > 0.0f);
        return;
    }
    assert_near(hit->t, e->t, e->tolerance);
    assert_near(hit->u, e->u, e->tolerance);
    assert_near(hit->v, e->v, e->tolerance);
}

static void check_level(rt_scene *scene, enum rt_accuracy level, int lanes,
                        const expectation *cases, size_t count)
{
    rt_status status = RT_STATUS_INIT;
    const rt_render_options options = {.lanes = lanes, .tile = 8};
    scene->accuracy = level;
    rt_renderer *renderer = test_renderer(scene, &options);
    for (size_t i = 0; i < count; ++i) {
        rt_hit hit;
        assert_good(rt_renderer_trace(renderer, &cases[i].ray, 1, &hit, &status), &status);
        check(rt_accuracy_name(level), &cases[i], &hit);
    }
    rt_renderer_free(renderer);
}

static void check_standard(const char *text, const expectation *cases, size_t count)
{
    rt_scene scene;
    test_scene(&scene, text);
    for (int lanes = 1; lanes <= 16; lanes *= !test_is_long() ? 16 : lanes == 1 ? 4 : 2)
        check_level(&scene, RT_ACCURACY_STANDARD, lanes, cases, count);
    for (size_t i = 0; i < count; ++i) {
        rt_hit hit;
        rt_scalar_float_trace(&scene, &cases[i].ray, 1, &hit);
        check("scalar", &cases[i], &hit);
    }
    rt_scene_clear(&scene);
}

static void check_all(const char *text, const expectation *cases, size_t count)
{
    rt_scene scene;
    check_standard(text, cases, count);
    test_scene(&scene, text);
    if (test_is_long())
        check_level(&scene, RT_ACCURACY_ROBUST, 1, cases, count);
    check_level(&scene, RT_ACCURACY_ROBUST, 16, cases, count);
    if (test_device()->has_fp64) {
        if (test_is_long())
            check_level(&scene, RT_ACCURACY_DOUBLE, 1, cases, count);
        check_level(&scene, RT_ACCURACY_DOUBLE, 8, cases, count);
    }
    for (size_t i = 0; i < count; ++i) {
        rt_hit hit;
        scene.accuracy = RT_ACCURACY_ROBUST;
        rt_scalar_float_trace(&scene, &cases[i].ray, 1, &hit);
        check("scalar, robust", &cases[i], &hit);
        rt_scalar_double_trace(&scene, &cases[i].ray, 1, &hit);
        check("scalar-double", &cases[i], &hit);
    }
    rt_scene_clear(&scene);
}

#define CHECK_ALL(text, cases) check_all(text, cases, sizeof(cases) / sizeof *(cases))

static void sphere(void **state)
{
    (void)state;
    const float root = sqrtf(3.0f) / 2.0f;
    const expectation cases[] = {
        {RAY(0, 0, 5, 0, 0, -1), 0, 4.0f, 0, 0, 0.0f},
        {RAY(0, 0, 5, 0, 0, 1), RT_MISS, 0, 0, 0, 0},     /* behind */
        {RAY(0, 0, 0, 0, 0, -1), 0, 1.0f, 0, 0, 0.0f},    /* from the centre */
        {RAY(0, 0, 0.5f, 0, 0, 1), 0, 0.5f, 0, 0, 1e-7f}, /* from inside: the far root */
        {RAY(0, 0, 0.5f, 0, 0, -1), 0, 1.5f, 0, 0, 1e-7f},
        {RAY(0.5f, 0, 5, 0, 0, -1), 0, 5.0f - root, 0, 0, 1e-6f},
        {RAY(0, 0, 5, 0, 0, -2), 0, 2.0f, 0, 0, 0.0f},    /* t is in units of the direction */
        {RAY(0, 0.5f, 0, 0, 0, 1), 0, root, 0, 0, 1e-7f}, /* at right angles to the centre */
        {RAY(0, 0.5f, 0, -0.0f, -0.0f, -1), 0, root, 0, 0, 1e-7f},
        {RAY(1.5f, 0, 5, 0, 0, -1), RT_MISS, 0, 0, 0, 0},
        {RAY(1, 0, 5, 0, 0, -1), 0, 5.0f, 0, 0, 0.0f},                   /* tangent */
        {{{0, 0, 5}, {0, 0, -1}, 4.5f, INFINITY}, 0, 6.0f, 0, 0, 1e-6f}, /* near root before tmin */
        {{{0, 0, 5}, {0, 0, -1}, 0.0f, 4.0f}, RT_MISS, 0, 0, 0, 0},      /* tmax is exclusive */
        {{{0, 0, 5}, {0, 0, -1}, 0.0f, -1.0f}, RT_MISS, 0, 0, 0, 0},     /* a dead ray */
    };
    CHECK_ALL("material m\nsphere center 0 0 0 radius 1 material m\n", cases);
}

static void triangle(void **state)
{
    (void)state;
    const expectation cases[] = {
        {RAY(0.25f, 0.25f, 1, 0, 0, -1), 0, 1.0f, 0.25f, 0.25f, 0.0f},
        {RAY(0.25f, 0.25f, -1, 0, 0, 1), 0, 1.0f, 0.25f, 0.25f, 0.0f}, /* its back */
        {RAY(0.5f, 0.125f, 2, 0, 0, -4), 0, 0.5f, 0.5f, 0.125f, 0.0f},
        {RAY(0.6f, 0.6f, 1, 0, 0, -1), RT_MISS, 0, 0, 0, 0},
        {RAY(-0.01f, 0.5f, 1, 0, 0, -1), RT_MISS, 0, 0, 0, 0},
        {RAY(0.5f, -0.01f, 1, 0, 0, -1), RT_MISS, 0, 0, 0, 0},
        {RAY(0.25f, 0.25f, 1, 0, 0, 1), RT_MISS, 0, 0, 0, 0}, /* behind */
        {RAY(-1, 0.25f, 0, 1, 0, 0), RT_MISS, 0, 0, 0, 0},    /* in its plane */
        {RAY(1.25f, 0.25f, 1, -1, 0, -1), 0, 1.0f, 0.25f, 0.25f, 0.0f},
    };
    CHECK_ALL("material m\ntriangle a 0 0 0 b 1 0 0 c 0 1 0 material m\n", cases);
}

/* At standard the border belongs to the triangle; at robust a ray through it is in one of the
 * triangles around alone, of which there may be just this one (tests/kernels/test_watertight.c). */
static void a_border_belongs_to_the_triangle(void **state)
{
    (void)state;
    const expectation cases[] = {
        {RAY(0, 0, 1, 0, 0, -1), 0, 1.0f, 0, 0, 0.0f},             /* corner a */
        {RAY(1, 0, 1, 0, 0, -1), 0, 1.0f, 1, 0, 0.0f},             /* corner b */
        {RAY(0, 1, 1, 0, 0, -1), 0, 1.0f, 0, 1, 0.0f},             /* corner c */
        {RAY(0.5f, 0.5f, 1, 0, 0, -1), 0, 1.0f, 0.5f, 0.5f, 0.0f}, /* the long edge */
    };
    check_standard("material m\ntriangle a 0 0 0 b 1 0 0 c 0 1 0 material m\n", cases,
                   sizeof cases / sizeof *cases);
}

/* The side is told by the determinant's sign alone: at a scale where its size is far below any
 * epsilon, culling is the same. */
static void culling_at_any_scale(void **state)
{
    (void)state;
    static const char *const settings[] = {"cull back", "cull front", "cull back winding cw",
                                           "cull front winding cw"};
    static const char *const sizes[] = {"1", "1e-6", "1e6"};
    static const float scales[] = {1.0f, 1e-6f, 1e6f};
    for (int s = 0; s < 4; ++s)
        for (int k = 0; k < 3; ++k) {
            char text[200];
            const float size = scales[k];
            snprintf(text, sizeof text,
                     "%s\nmaterial m\ntriangle a 0 0 0 b %s 0 0 c 0 %s 0 material m\n", settings[s],
                     sizes[k], sizes[k]);
            /* Seen from +z the corners run counter-clockwise. */
            const bool sees_front_from_above = s == 0 || s == 3;
            const int above = sees_front_from_above ? 0 : RT_MISS;
            const int below = sees_front_from_above ? RT_MISS : 0;
            const float at = size / 4;
            const expectation cases[] = {
                {RAY(at, at, size, 0, 0, -1), above, size, 0.25f, 0.25f, size * 1e-6f + 1e-7f},
                {RAY(at, at, -size, 0, 0, 1), below, size, 0.25f, 0.25f, size * 1e-6f + 1e-7f},
            };
            if (test_is_long())
                CHECK_ALL(text, cases);
            else
                check_standard(text, cases, 2);
        }
}

/* Grazing rays have a small determinant at any scale; they are hits nevertheless. */
static void a_grazing_ray_is_not_culled(void **state)
{
    (void)state;
    /* It comes down through z = 0 at x = 1, from 1e-3 above at a slope of 1e-4. */
    const expectation cases[] = {
        {RAY(-9, 2, 1e-3f, 1, 0, -1e-4f), 0, 10.0f, 0.125f, 0.25f, 1e-4f},
    };
    CHECK_ALL("cull back\nmaterial m\ntriangle a 0 0 0 b 8 0 0 c 0 8 0 material m\n", cases);
}

static void nearest_then_lowest_index(void **state)
{
    (void)state;
    const expectation cases[] = {
        {RAY(0.25f, 0.25f, 5, 0, 0, -1), 2, 3.0f, 0.25f, 0.25f, 0.0f}, /* the nearest plane */
        {RAY(0.25f, 0.25f, -5, 0, 0, 1), 3, 5.0f, 0.25f, 0.25f, 0.0f}, /* twins: the lower index */
        {RAY(9, 0, 5, 0, 0, -1), 0, 4.0f, 0, 0, 0.0f},                 /* twin spheres */
    };
    CHECK_ALL("material m\n"
              "triangle a 0 0 2 b 1 0 2 c 0 1 2 material m\n"
              "sphere center 9 0 0 radius 1 material m\n"
              "triangle a 0 0 0 b 1 0 0 c 0 1 0 material m\n"
              "sphere center 9 0 0 radius 1 material m\n"
              "triangle a 0 0 0 b 1 0 0 c 0 1 0 material m\n",
              cases);
}

static void nothing_is_hit_where_there_is_nothing(void **state)
{
    (void)state;
    const expectation cases[] = {{RAY(0, 0, 0, 0, 0, -1), RT_MISS, 0, 0, 0, 0}};
    CHECK_ALL("background 0 0 0\n", cases);
}

/* Rays and triangles that make the arithmetic overflow, divide by zero or give NaN are misses. */
static void nonsense_is_a_miss(void **state)
{
    (void)state;
    const expectation cases[] = {
        {RAY(0, 0, 5, 0, 0, 0), RT_MISS, 0, 0, 0, 0},
        {RAY(NAN, 0, 5, 0, 0, -1), RT_MISS, 0, 0, 0, 0},
        {RAY(0, 0, 5, 0, NAN, -1), RT_MISS, 0, 0, 0, 0},
        {RAY(INFINITY, 0, 5, 0, 0, -1), RT_MISS, 0, 0, 0, 0},
        {RAY(0, 0, 5, 0, 0, -INFINITY), RT_MISS, 0, 0, 0, 0},
        {{{0, 0, 5}, {0, 0, -1}, NAN, INFINITY}, RT_MISS, 0, 0, 0, 0},
        {{{0, 0, 5}, {0, 0, -1}, 0.0f, NAN}, RT_MISS, 0, 0, 0, 0},
    };
    static const char text[] = "material m\nsphere center 0 0 0 radius 1 material m\n"
                               "triangle a -9 -9 -2 b 9 -9 -2 c 0 9 -2 material m\n"
                               "triangle a 0 0 1 b 0 0 1 c 0 0 1 material m\n"
                               "triangle a -1 -1 1 b 0 0 1 c 1 1 1 material m\n";
    CHECK_ALL(text, cases);
    /* Those whose origin or direction is not finite at fast too, where the compiler takes for
     * granted that there are none. */
    rt_scene scene;
    test_scene(&scene, text);
    check_level(&scene, RT_ACCURACY_FAST, 0, cases + 1, 4);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere),
        cmocka_unit_test(triangle),
        cmocka_unit_test(a_border_belongs_to_the_triangle),
        cmocka_unit_test(culling_at_any_scale),
        cmocka_unit_test(a_grazing_ray_is_not_culled),
        cmocka_unit_test(nearest_then_lowest_index),
        cmocka_unit_test(nothing_is_hit_where_there_is_nothing),
        cmocka_unit_test(nonsense_is_a_miss),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
