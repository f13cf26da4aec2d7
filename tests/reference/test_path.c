/* Mirrors and glass of the reference against closed formulas, in double. */
#include "support/scalar_double.h"

#include <math.h>

static rt_material mirror(float reflect)
{
    rt_material m = test_glow(0, 0, 0);
    m.reflect = reflect;
    return m;
}

static rt_material glass(float transmit, float ior)
{
    rt_material m = test_glow(0, 0, 0);
    m.transmit = transmit;
    m.ior = ior;
    return m;
}

/* The mirror image of a ball is as far behind the mirror as the ball is before it: rays aimed
 * within the image's outline see the ball, rays just outside do not. */
static void a_mirror_shows_a_known_point(void **state)
{
    (void)state;
    rt_scene scene;
    const rt_material half = mirror(0.5f), red = test_glow(1, 0.25f, 0);
    test_begin(&scene);
    scene.background = (rt_vec3){0, 0, 1};
    test_add_floor(&scene, &half, -1);
    test_add_sphere(&scene, &red, 3, 2, -4, 0.125f);
    const vec eye = {0.5, 1, 0.25}, image = {3, -4, -4};
    const vec way = minus(image, eye);
    const double distance = sqrt(dot(way, way));
    vec t1, t2;
    rt_scalar_double_axes_about(unit(way), &t1, &t2);
    for (int i = 0; i < 16; ++i) {
        const double phi = 2 * PI * i / 16;
        const vec across = add_scaled(t2, sin(phi), times(t1, cos(phi)));
        /* The outline: as seen from the eye the ball's radius has the sine radius / distance. */
        const double tangent = tan(asin(0.125 / distance)) * distance;
        const vec inside = add_scaled(across, tangent * (1 - 1e-6), way);
        const vec outside = add_scaled(across, tangent * (1 + 1e-6), way);
        assert_color(test_look(&scene, eye, inside), 0.5, 0.125, 0, 1e-12);
        assert_color(test_look(&scene, eye, outside), 0, 0, 0.5, 1e-12);
    }
    rt_scene_clear(&scene);
}

/* Two mirrors face each other, each with a light of its own: one term of a geometric series a ray.
 */
static void depth_counts_rays_in_a_row(void **state)
{
    (void)state;
    rt_scene scene;
    rt_material m = mirror(0.5f);
    m.ka_r = 1;
    const rt_triangle wall = {-9, -9, -1, 9, -9, -1, 0, 9, -1};
    const rt_triangle back = {-9, -9, 1, 9, -9, 1, 0, 9, 1};
    test_begin(&scene);
    test_add_triangle(&scene, &m, &wall);
    test_add_triangle(&scene, &m, &back);
    const vec eye = {0, 0, 0}, ahead = {0, 0, -1};
    static const int depths[] = {0, 1, 2, 5, 9, 10, 1000};
    for (size_t i = 0; i < sizeof depths / sizeof *depths; ++i) {
        scene.depth = depths[i];
        /* Beyond 2^-9 it is chance that goes on, and right on average. */
        if (depths[i] <= 9)
            assert_near(test_look(&scene, eye, ahead).x, 2 - exp2(-depths[i]), 1e-15);
        assert_near(test_look_long(&scene, eye, ahead, 4096).x, 2 - exp2(-depths[i]), 2e-4);
    }
    rt_scene_clear(&scene);
}

/* A smooth normal that would send the mirror ray into the floor gives way to the floor's own. */
static void no_mirror_ray_goes_into_the_surface(void **state)
{
    (void)state;
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    const rt_material m = mirror(1);
    const rt_triangle floor = {-9, 0, 9, 9, 0, 9, 0, 0, -9};
    const float leaning[9] = {0, 0.5f, 1, 0, 0.5f, 1, 0, 0.5f, 1};
    test_begin(&scene);
    scene.background = (rt_vec3){0, 0, 1};
    scene.has_gradient = true;
    scene.background_top = (rt_vec3){1, 0, 0};
    assert_good(rt_scene_add_material(&scene, &m, &status), &status);
    assert_good(rt_scene_add_triangle(&scene, &floor, leaning, 0, &status), &status);
    /* Steeply down: mirrored about the normal, which leans away, it would run below the floor. */
    const double slope = 0.1;
    const vec seen = test_look(&scene, (vec){0, 0.5, -1}, (vec){0, -slope, 1});
    const double up = slope / hypot(1, slope);
    assert_color(seen, 0.5 * (1 + up), 0, 0.5 * (1 - up), 1e-6);
    rt_scene_clear(&scene);
}

static void fresnel_s_known_values(void **state)
{
    (void)state;
    static const double iors[] = {1.1, 1.33, 1.5, 2.4};
    for (size_t i = 0; i < sizeof iors / sizeof *iors; ++i) {
        const double n = iors[i], normal = (n - 1) / (n + 1) * ((n - 1) / (n + 1));
        assert_near(rt_scalar_double_fresnel(1 / n, 1), normal, 1e-14);
        assert_near(rt_scalar_double_fresnel(n, 1), normal, 1e-14);
        /* At grazing all is mirrored, linearly in the cosine: 1 - 2 c (n^2 + 1) / sqrt(n^2 - 1). */
        assert_near(rt_scalar_double_fresnel(1 / n, 0), 1, 1e-14);
        const double slope = 2 * (n * n + 1) / sqrt(n * n - 1);
        assert_near((1 - rt_scalar_double_fresnel(1 / n, 1e-7)) / 1e-7, slope, 1e-4);
        /* Brewster's angle: no light in the plane of incidence; rs = (n^2 - 1) / (n^2 + 1). */
        const double rs = (n * n - 1) / (n * n + 1);
        assert_near(rt_scalar_double_fresnel(1 / n, 1 / hypot(1, n)), 0.5 * rs * rs, 1e-14);
        for (int k = 1; k < 100; ++k) {
            const double c1 = k / 100.0, s2 = sqrt(1 - c1 * c1) / n, c2 = sqrt(1 - s2 * s2);
            /* The same both ways; between 0 and 1; by the formula of sines and tangents. */
            const double part = rt_scalar_double_fresnel(1 / n, c1);
            assert_near(rt_scalar_double_fresnel(n, c2), part, 1e-12);
            const double a = acos(c1), b = acos(c2);
            const double s = sin(a - b) / sin(a + b), p = tan(a - b) / tan(a + b);
            assert_near(part, 0.5 * (s * s + p * p), 1e-10);
        }
    }
}

/* From the dense side everything is mirrored past the critical angle, and just before it not. */
static void total_reflection_begins_where_it_must(void **state)
{
    (void)state;
    const double n = 1.5, critical = sqrt(1 - 1 / (n * n));
    for (int k = 0; k <= 20; ++k)
        assert_near(rt_scalar_double_fresnel(n, critical * k / 20 * (1 - 1e-12)), 1, 0);
    assert_true(rt_scalar_double_fresnel(n, critical * (1 + 1e-12)) < 1);
    assert_near(rt_scalar_double_fresnel(n, critical * (1 + 1e-12)), 1, 1e-4);
}

/* The surface between glass below and air above, hit from below: what it mirrors and what it lets
 * through add up to what is there, at every angle. */
static void mirrored_and_transmitted_add_up(void **state)
{
    (void)state;
    rt_scene scene;
    const rt_material m = glass(1, 1.5f);
    test_begin(&scene);
    scene.background = (rt_vec3){0.25f, 0.5f, 1};
    test_add_floor(&scene, &m, 0);
    for (int i = -400; i <= 400; ++i) {
        /* Fine about the critical angle, whose sine is 1 / 1.5. */
        const double sine = i % 2 ? 1 / 1.5 + i * 1e-7 : (i + 400) / 801.0;
        const vec d = {sine, sqrt(1 - sine * sine), 0};
        const vec up = test_look(&scene, (vec){0, -1, 0}, d);
        assert_color(up, 0.25, 0.5, 1, 4.0 / 512);
        const double part = rt_scalar_double_fresnel(1.5, d.y);
        const bool is_whole = part >= 1.0 / 512 && (part == 1 || 1 - part >= 1.0 / 512);
        if (is_whole)
            assert_color(up, 0.25, 0.5, 1, 1e-14);
    }
    rt_scene_clear(&scene);
}

/* A tiny ball lies where Snell's law says that the ray goes on, from either side; the ray is aimed
 * through it and just past it. */
static void refraction_follows_snell(void **state)
{
    (void)state;
    const double radius = 1e-6;
    for (int from_glass = 0; from_glass < 2; ++from_glass)
        for (int i = 1; i < 18; ++i) {
            const double angle = PI / 36 * i, n = from_glass ? 1.5 : 1 / 1.5;
            const double sine = n * sin(angle);
            if (sine > 0.99)
                continue;
            rt_scene scene;
            const rt_material m = glass(1, 1.5f), white = test_glow(1, 1, 1);
            test_begin(&scene);
            test_add_floor(&scene, &m, 0);
            /* Downwards into the glass or upwards out of it, through the origin. */
            const double down = from_glass ? -1 : 1;
            const float x = (float)sine, y = (float)(-down * sqrt(1 - sine * sine));
            test_add_sphere(&scene, &white, x, y, 0, (float)radius);
            const vec d = {sin(angle), -down * cos(angle), 0}, eye = times(d, -1);
            const double through = 1 - rt_scalar_double_fresnel(n, cos(angle));
            assert_near(test_look(&scene, eye, d).x, through, 1e-10);
            const vec right = {eye.x + 3 * radius, eye.y, 0}, left = {eye.x - 3 * radius, eye.y, 0};
            if (fabs((double)y) > 0.5) {
                assert_near(test_look(&scene, right, d).x, 0, 0);
                assert_near(test_look(&scene, left, d).x, 0, 0);
            }
            rt_scene_clear(&scene);
        }
}

/* A glass ball is a lens: a ray beside the axis crosses it where the ball's formula says. */
static void a_ball_bends_twice(void **state)
{
    (void)state;
    rt_scene scene;
    const rt_material m = glass(1, 1.5f), white = test_glow(1, 1, 1);
    const double beside = 0.25;
    /* It turns by the angle of incidence less that of refraction, on the way in and out alike. */
    const double a = asin(beside), b = asin(beside / 1.5), turn = 2 * (a - b);
    /* It enters at the polar angle pi - a and crosses a chord of the central angle pi - 2 b. */
    const double out = 2 * b - a;
    const double x = cos(out), y = sin(out), far = 3;
    test_begin(&scene);
    test_add_sphere(&scene, &m, 0, 0, 0, 1);
    test_add_sphere(&scene, &white, (float)(x + far * cos(turn)), (float)(y - far * sin(turn)), 0,
                    1e-5f);
    const double part = rt_scalar_double_fresnel(1 / 1.5, cos(a));
    const vec seen = test_look(&scene, (vec){-4, beside, 0}, (vec){1, 0, 0});
    assert_near(seen.x, (1 - part) * (1 - part), 1e-9);
    assert_near(test_look(&scene, (vec){-4, beside + 2e-5, 0}, (vec){1, 0, 0}).x, 0, 0);
    assert_near(test_look(&scene, (vec){-4, beside - 2e-5, 0}, (vec){1, 0, 0}).x, 0, 0);
    rt_scene_clear(&scene);
}

/* Beer's law along the axis of a ball: F from the front, and from inside one term a passage of the
 * part that is left after each way of two radii, without end. */
static void glass_absorbs_along_the_way(void **state)
{
    (void)state;
    rt_scene scene;
    rt_material m = glass(1, 1.5f);
    m.absorb_r = 0.5f;
    m.absorb_g = 2;
    test_begin(&scene);
    scene.background = (rt_vec3){1, 1, 1};
    test_add_sphere(&scene, &m, 0, 0, -5, 1.5f);
    const vec seen = test_look_long(&scene, (vec){0, 0, 0}, (vec){0, 0, -1}, 4096);
    const double F = 0.04;
    const double left[3] = {exp(-0.5 * 3), exp(-2.0 * 3), 1};
    double expected[3];
    for (int i = 0; i < 3; ++i)
        expected[i] = F + (1 - F) * (1 - F) * left[i] / (1 - F * left[i]);
    assert_color(seen, expected[0], expected[1], expected[2], 1e-6);
    rt_scene_clear(&scene);
}

/* An object that gives back all it gets cannot be told from a uniform background: a white furnace.
 * Nothing is missing, whatever is followed by chance. */
static void a_white_furnace_hides_what_is_in_it(void **state)
{
    (void)state;
    static const float reflects[] = {0, 0.25f, 0.5f, 1};
    for (size_t i = 0; i < sizeof reflects / sizeof *reflects; ++i) {
        rt_scene scene;
        rt_material m = glass(1 - reflects[i], 1.5f);
        m.reflect = reflects[i];
        test_begin(&scene);
        scene.depth = 1000;
        scene.background = (rt_vec3){1, 1, 1};
        test_add_sphere(&scene, &m, 0, 0, 0, 1);
        for (int k = 0; k <= 200; ++k) {
            const vec seen = test_look(&scene, (vec){0.005 * k, 0, 4}, (vec){0, 0, -1});
            assert_near(seen.x, 1, 1e-12);
        }
        rt_scene_clear(&scene);
    }
}

/* A ray carries the medium that it runs in: a mirror inside of glass reflects into glass. */
static void a_mirror_in_glass(void **state)
{
    (void)state;
    rt_scene scene;
    rt_material m = glass(1, 1.5f);
    const rt_material all = mirror(1);
    m.absorb_r = m.absorb_g = m.absorb_b = 0.25f;
    test_begin(&scene);
    scene.background = (rt_vec3){1, 1, 1};
    scene.depth = 3; /* in, back, out: the echoes inside the glass are cut off */
    test_add_sphere(&scene, &m, 0, 0, 0, 2);
    const rt_triangle wall = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    test_add_triangle(&scene, &all, &wall);
    const double F = 0.04;
    const double expected = F + (1 - F) * (1 - F) * exp(-0.25 * 4);
    assert_near(test_look(&scene, (vec){0, 0, 5}, (vec){0, 0, -1}).x, expected, 1e-12);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mirror_shows_a_known_point),
        cmocka_unit_test(depth_counts_rays_in_a_row),
        cmocka_unit_test(no_mirror_ray_goes_into_the_surface),
        cmocka_unit_test(fresnel_s_known_values),
        cmocka_unit_test(total_reflection_begins_where_it_must),
        cmocka_unit_test(mirrored_and_transmitted_add_up),
        cmocka_unit_test(refraction_follows_snell),
        cmocka_unit_test(a_ball_bends_twice),
        cmocka_unit_test(glass_absorbs_along_the_way),
        cmocka_unit_test(a_white_furnace_hides_what_is_in_it),
        cmocka_unit_test(a_mirror_in_glass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
