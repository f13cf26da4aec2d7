/* The reference in float: what rounding may and may not do to it. */
#include "support/support.h"

#include <math.h>

#include "reference/effects.h"

static vec random_direction(test_random *random)
{
    vec d;
    do {
        d = (vec){test_random_float(random, -1, 1), test_random_float(random, -1, 1),
                  test_random_float(random, -1, 1)};
    } while (!(dot(d, d) < 1.0f && dot(d, d) > 0.01f));
    return unit(d);
}

static void sine_and_cosine_are_near_the_library_s(void **state)
{
    (void)state;
    for (int i = -100000; i <= 100000; ++i) {
        const float phi = 0.785398f * (float)i / 100000.0f;
        float sine, cosine;
        rt_scalar_float_sine_cosine(phi, &sine, &cosine);
        assert_near(sine, sin((double)phi), 1e-7);
        assert_near(cosine, cos((double)phi), 1e-7);
    }
}

static void axes_are_at_right_angles(void **state)
{
    (void)state;
    test_random random = {3};
    const double few_ulp = 8 * 0x1p-24;
    for (int i = 0; i < 100000; ++i) {
        const vec n = random_direction(&random);
        vec t1, t2;
        rt_scalar_float_axes_about(n, &t1, &t2);
        assert_near(dot(t1, t1), 1.0, few_ulp);
        assert_near(dot(t2, t2), 1.0, few_ulp);
        assert_near(dot(t1, t2), 0.0, few_ulp);
        assert_near(dot(t1, n), 0.0, few_ulp);
        assert_near(dot(t2, n), 0.0, few_ulp);
    }
}

static void sample_points_stay_in_the_square(void **state)
{
    (void)state;
    for (uint32_t x = 0; x < 1000; ++x) {
        const stream s = {x, 0, 0, 0, 0};
        for (uint32_t i = 0; i < 64; ++i) {
            const pair p = rt_scalar_float_sample_point(&s, FOR_LENS, i);
            const pair d = rt_scalar_float_disk(p);
            assert_true(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
            assert_true(hypot((double)d.x, (double)d.y) <= 1.0 + 2e-7);
        }
    }
}

/* A scene of one primitive, and rays that leave it where other rays have met it. */
typedef struct leaving {
    rt_scene scene;
    scalar_world world;
    surface s;
} leaving;

static bool meet(leaving *l, vec from, vec aim)
{
    const ray r = {from, unit(minus(aim, from)), 0, INFINITY};
    const hit h = rt_scalar_float_closest(&l->world, &r);
    if (h.primitive == RT_MISS)
        return false;
    l->s = rt_scalar_float_surface_at(&l->scene, &r, &h);
    return true;
}

static hit leave(const leaving *l, vec direction, vec side)
{
    const ray r = {rt_scalar_float_start(&l->s, side), direction, 0, INFINITY};
    return rt_scalar_float_closest(&l->world, &r);
}

/* A direction less than `steepness` above the surface's plane. */
static vec grazing(test_random *random, vec facing, float steepness)
{
    vec t1, t2;
    rt_scalar_float_axes_about(facing, &t1, &t2);
    const float phi = test_random_float(random, 0, 6.2831853f);
    const vec along = add_scaled(t2, sinf(phi), times(t1, cosf(phi)));
    return unit(add_scaled(facing, steepness * test_random_float(random, 0.01f, 1), along));
}

static void begin(leaving *l, const rt_sphere *sphere, const rt_triangle *triangle)
{
    rt_status status = RT_STATUS_INIT;
    const float zero[3] = {0, 0, 0};
    const rt_material m = rt_material_make(zero, zero, zero, 1);
    rt_scene_init(&l->scene);
    assert_good(rt_scene_add_material(&l->scene, &m, &status), &status);
    assert_good(sphere ? rt_scene_add_sphere(&l->scene, sphere, 0, &status)
                       : rt_scene_add_triangle(&l->scene, triangle, NULL, 0, &status),
                &status);
    l->world = rt_scalar_float_world(&l->scene);
}

static void end(leaving *l)
{
    rt_scalar_float_world_clear(&l->world);
    rt_scene_clear(&l->scene);
}

/* From the outside of a ball no ray comes back to it; from just inside each crosses it to the far
 * root, however small or far away the ball is. */
static void rays_leave_a_sphere(void **state)
{
    (void)state;
    test_random random = {4};
    for (int i = 0; i < 2000; ++i) {
        leaving l;
        const float radius = exp2f(test_random_float(&random, -10, 20));
        const float away = radius * exp2f(test_random_float(&random, -2, 8));
        const vec c = times(random_direction(&random), away);
        const rt_sphere sphere = {c.x, c.y, c.z, radius};
        begin(&l, &sphere, NULL);
        for (int k = 0; k < 50; ++k) {
            const vec from = add_scaled(random_direction(&random), 5 * radius, c);
            const vec aim = add_scaled(random_direction(&random),
                                       radius * sqrtf(test_random_float(&random, 0, 0.99f)), c);
            if (!meet(&l, from, aim))
                continue;
            const vec out =
                k % 2 ? grazing(&random, l.s.facing, 1e-3f) : grazing(&random, l.s.facing, 10);
            assert_int_equal(leave(&l, out, l.s.facing).primitive, RT_MISS);
            const vec in = times(grazing(&random, l.s.facing, 10), -1);
            const float steep = -dot(in, l.s.facing);
            if (steep < 0.1f)
                continue;
            const hit far = leave(&l, in, times(l.s.facing, -1));
            assert_int_equal(far.primitive, 0);
            const float error = 64 * 0x1p-24f * (away + radius) / radius;
            assert_near(far.t / (2 * radius * steep), 1.0, (double)error * 100);
        }
        end(&l);
    }
}

/* From either side of a triangle, met anywhere up to its edges, none comes back. */
static void rays_leave_a_triangle(void **state)
{
    (void)state;
    test_random random = {5};
    for (int i = 0; i < 2000; ++i) {
        leaving l;
        const float size = exp2f(test_random_float(&random, -16, 16));
        const vec middle =
            times(random_direction(&random), size * exp2f(test_random_float(&random, -2, 10)));
        const vec a = add_scaled(random_direction(&random), size, middle);
        const vec b = add_scaled(random_direction(&random), size, middle);
        const vec c = add_scaled(random_direction(&random), size, middle);
        const rt_triangle triangle = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
        begin(&l, NULL, &triangle);
        for (int k = 0; k < 50; ++k) {
            const float u = k % 3 ? test_random_float(&random, 0, 1) : 0.0f;
            const float v = k % 5 ? test_random_float(&random, 0, 1 - u) : 0.0f;
            const vec aim = add_scaled(c, v, add_scaled(b, u, times(a, 1 - u - v)));
            if (!meet(&l, add_scaled(random_direction(&random), 5 * size, aim), aim))
                continue;
            const vec out =
                k % 2 ? grazing(&random, l.s.facing, 1e-3f) : grazing(&random, l.s.facing, 10);
            assert_int_equal(leave(&l, out, l.s.facing).primitive, RT_MISS);
            const vec under = times(l.s.facing, -1);
            assert_int_equal(leave(&l, times(out, -1), under).primitive, RT_MISS);
        }
        end(&l);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sine_and_cosine_are_near_the_library_s),
        cmocka_unit_test(axes_are_at_right_angles),
        cmocka_unit_test(sample_points_stay_in_the_square),
        cmocka_unit_test(rays_leave_a_sphere),
        cmocka_unit_test(rays_leave_a_triangle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
