/* Shadows, occlusion, fog, backgrounds and patterns of the reference against closed formulas, in
 * double. */
#include "support/scalar_double.h"

#include <math.h>

static rt_material chalk(void)
{
    const float zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    return rt_material_make(zero, one, zero, 1.0f);
}

static void add_light(rt_scene *scene, const rt_light *light)
{
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_scene_add_light(scene, light, &status), &status);
}

/* The part of its unshadowed light that a point (x, 0, z) of a white floor gets. */
static double visible(const rt_scene *scene, double x, double z)
{
    rt_scene open = *scene;
    rt_light light = scene->lights[0];
    light.shadow = 0;
    open.lights = &light;
    const vec eye = {x, 0.25, z}, down = {0, -1, 0};
    return test_look(scene, eye, down).x / test_look(&open, eye, down).x;
}

/* ---- Shadows ---- */

/* A plate with an edge along x = 0 at the height h, a light above it at the height H: the shadow's
 * border, and for a ball of light the penumbra, lie where similar triangles put them. */
static const float plate_height = 2, light_height = 6;

static void begin_plate(rt_scene *scene, float x, float radius, int samples)
{
    const rt_material white = chalk(), black = test_glow(0, 0, 0);
    const rt_triangle plate = {0,    plate_height, -4e3f,        0, plate_height,
                               4e3f, -4e3f,        plate_height, 0};
    const rt_light light = {.x = x,
                            .y = light_height,
                            .w = 1,
                            .r = 1,
                            .g = 1,
                            .b = 1,
                            .radius = radius,
                            .shadow = 1,
                            .samples = samples};
    test_begin(scene);
    scene->ambient = (rt_vec3){0, 0, 0};
    test_add_floor(scene, &white, 0);
    test_add_triangle(scene, &black, &plate);
    add_light(scene, &light);
}

static void a_hard_shadow_ends_where_it_must(void **state)
{
    (void)state;
    for (int i = 0; i <= 10; ++i) {
        rt_scene scene;
        const float light_x = 0.5f * (float)i;
        begin_plate(&scene, light_x, 0, 1);
        /* The light's ray through (0, h). */
        const double border =
            -(double)light_x * (double)plate_height / (double)(light_height - plate_height);
        assert_near(visible(&scene, border + 1e-9, 0), 1, 0);
        assert_near(visible(&scene, border - 1e-9, 0), 0, 0);
        rt_scene_clear(&scene);
    }
}

static void a_directional_shadow_ends_where_it_must(void **state)
{
    (void)state;
    rt_scene scene;
    begin_plate(&scene, 0, 0, 1);
    scene.lights[0].w = 0;
    scene.lights[0].x = 0.6f;
    scene.lights[0].y = 0.8f;
    const double border = -(double)plate_height * (double)0.6f / (double)0.8f;
    assert_near(visible(&scene, border + 1e-9, 0), 1, 0);
    assert_near(visible(&scene, border - 1e-9, 0), 0, 0);
    rt_scene_clear(&scene);
}

/* What stands behind the light, however near, casts no shadow. */
static void only_what_is_between_casts_a_shadow(void **state)
{
    (void)state;
    static const float heights[] = {5.9f, 5.99999f, 6.00001f, 60};
    for (size_t i = 0; i < 4; ++i) {
        rt_scene scene;
        const rt_material black = test_glow(0, 0, 0);
        begin_plate(&scene, 3, 0, 1);
        const rt_triangle cover = {-9, heights[i], -9, 9, heights[i], -9, 0, heights[i], 9};
        test_add_triangle(&scene, &black, &cover);
        assert_near(visible(&scene, 2.5, 0), i < 2 ? 0 : 1, 0);
        rt_scene_clear(&scene);
    }
}

/* The angle at the floor from the disk's middle to the plate's edge, and the disk's half angle. */
static double edge_in_radii(double x, double radius)
{
    const double plate = (double)plate_height, height = (double)light_height;
    const double to_edge = atan(-x / plate) - atan(-x / height);
    return tan(to_edge) * hypot(x, height) / radius;
}

/* The light's disk, seen from the floor, is cut by the plate's edge: the part in sight is that of a
 * circle beside a chord. */
static double part_beside_chord(double distance)
{
    if (distance >= 1)
        return 0;
    if (distance <= -1)
        return 1;
    return (acos(distance) - distance * sqrt(1 - distance * distance)) / PI;
}

static void a_penumbra_is_as_wide_as_it_must_be(void **state)
{
    (void)state;
    rt_scene scene;
    const double radius = 0.25;
    begin_plate(&scene, 0, 0.25f, 4096);
    double first = 1, last = -1;
    for (int i = -400; i <= 400; ++i) {
        const double x = 0.001 * i;
        const double part = visible(&scene, x, 0);
        assert_near(part, part_beside_chord(edge_in_radii(x, radius)), 0.004);
        if (part > 0 && x < first)
            first = x;
        if (part < 1 && x > last)
            last = x;
    }
    /* 2 R h / (H - h), the textbook's width, and its place about the hard shadow's border at 0. */
    const double width = 2 * radius * (double)plate_height / (double)(light_height - plate_height);
    assert_near(last - first, width, 0.015 * width);
    assert_near(last + first, 0, 0.015 * width);
    rt_scene_clear(&scene);
}

/* ---- Occlusion ---- */

/* A wall that rises from the point hides half of the sky, whichever way it faces. */
static void a_half_space_hides_half(void **state)
{
    (void)state;
    for (int i = 0; i < 8; ++i) {
        rt_scene scene;
        const rt_material white = test_glow(1, 1, 1), black = test_glow(0, 0, 0);
        const double phi = 2 * PI * (i + 0.3) / 8;
        const float c = (float)cos(phi), s = (float)sin(phi);
        test_begin(&scene);
        scene.occlusion_samples = 4096;
        scene.occlusion_distance = 1e9f;
        test_add_floor(&scene, &white, 0);
        const float d = 1e-4f, far = 1e5f;
        const rt_triangle wall = {c * d - s * far, -far, s * d + c * far,
                                  c * d + s * far, -far, s * d - c * far,
                                  c * d,           far,  s * d};
        test_add_triangle(&scene, &black, &wall);
        const vec seen = test_look(&scene, (vec){0, 1e-5, 0}, (vec){0, -1, 0});
        assert_near(seen.x, 0.5, 0.003);
        rt_scene_clear(&scene);
    }
}

/* A disk above the point at the height h: the cosine-weighted part of the sky behind it is
 * r^2 / (r^2 + h^2); further away than `distance` nothing counts. */
static void a_ball_hides_its_form_factor(void **state)
{
    (void)state;
    rt_scene scene;
    const rt_material white = test_glow(1, 1, 1), black = test_glow(0, 0, 0);
    test_begin(&scene);
    scene.occlusion_samples = 4096;
    scene.occlusion_distance = 100;
    test_add_floor(&scene, &white, 0);
    test_add_sphere(&scene, &black, 0, 5, 0, 3);
    /* A ball covers the directions within asin(r / d) of the axis: (r / d)^2 of the cosine. */
    assert_near(test_look(&scene, (vec){0, 1, 0}, (vec){0, -1, 0}).x, 1 - 9.0 / 25.0, 0.002);
    scene.occlusion_distance = 1.999f;
    assert_near(test_look(&scene, (vec){0, 1, 0}, (vec){0, -1, 0}).x, 1, 0);
    rt_scene_clear(&scene);
}

/* ---- Fog and background ---- */

static void fog_thickens_with_distance(void **state)
{
    (void)state;
    rt_scene scene;
    const rt_material red = test_glow(1, 0, 0);
    test_begin(&scene);
    scene.fog = (rt_vec3){0, 0.5f, 1};
    scene.fog_density = 0.25f;
    scene.background = (rt_vec3){1, 1, 1};
    test_add_sphere(&scene, &red, 0, 0, -5, 1);
    const double left = exp(-0.25 * 4);
    assert_color(test_look(&scene, (vec){0, 0, 0}, (vec){0, 0, -1}), left, 0.5 * (1 - left),
                 1 - left, 1e-12);
    assert_color(test_look(&scene, (vec){0, 0, 0}, (vec){0, 1, 0}), 0, 0.5, 1, 1e-12);
    rt_scene_clear(&scene);
}

/* Both ways of a mirrored ray lie in the fog; inside of glass there is none. */
static void fog_lies_on_every_way_outside(void **state)
{
    (void)state;
    rt_scene scene;
    rt_material m = test_glow(0, 0, 0);
    const rt_material red = test_glow(1, 0, 0);
    m.reflect = 1;
    test_begin(&scene);
    scene.fog_density = 0.25f;
    test_add_floor(&scene, &m, 0);
    test_add_sphere(&scene, &red, 0, 7, 0, 1);
    assert_near(test_look(&scene, (vec){0, 2, 0}, (vec){0, -1, 0}).x, exp(-0.25 * 8), 1e-12);
    scene.materials[0].reflect = 0;
    scene.materials[0].transmit = 1;
    scene.materials[0].ior = 1;
    scene.spheres[0].cy = -9;
    assert_near(test_look(&scene, (vec){0, 2, 0}, (vec){0, -1, 0}).x, exp(-0.25 * 2), 1e-12);
    rt_scene_clear(&scene);
}

static void the_gradient_goes_along_up(void **state)
{
    (void)state;
    rt_scene scene;
    test_begin(&scene);
    scene.camera.up = (rt_vec3){0, 3, 4};
    scene.background = (rt_vec3){1, 0, 0.5f};
    scene.background_top = (rt_vec3){0, 2, 0.5f};
    scene.has_gradient = true;
    assert_color(test_look(&scene, (vec){1, 2, 3}, (vec){0, 3, 4}), 0, 2, 0.5, 1e-12);
    assert_color(test_look(&scene, (vec){1, 2, 3}, (vec){0, -3, -4}), 1, 0, 0.5, 1e-12);
    assert_color(test_look(&scene, (vec){1, 2, 3}, (vec){0, 4, -3}), 0.5, 1, 0.5, 1e-12);
    assert_color(test_look(&scene, (vec){1, 2, 3}, (vec){0, 0, 1}), 0.1, 1.8, 0.5, 1e-12);
    rt_scene_clear(&scene);
}

/* ---- Patterns ---- */

static double checker_at(const rt_material *m, double x, double y, double z)
{
    const rt_scene scene = {0};
    const surface s = {.material = m, .within = {x, y, z}};
    return rt_scalar_double_pattern(&scene, &s).x;
}

/* A plane at a whole multiple of the cell's size is not on a border: what rounding does to its
 * height changes no colour. Along it cells are centred on whole multiples too. */
static void checkers_are_centred_on_whole_multiples(void **state)
{
    (void)state;
    rt_material m = test_glow(1, 1, 1);
    m.checker_r = 0.25f;
    static const float cells[] = {1, 0.5f, 3};
    for (size_t i = 0; i < 3; ++i) {
        m.cell = cells[i];
        const double c = (double)m.cell;
        for (int k = -5; k <= 5; ++k)
            for (int j = -20; j < 20; ++j) {
                const double inside = 0.5 * j + 0.25; /* two points a cell */
                const int along = (int)floor(inside + 0.5);
                const double expected = (along + k) % 2 ? 0.25 : 1;
                for (int wobble = -1; wobble <= 1; ++wobble) {
                    const double plane = c * (k + 1e-6 * wobble);
                    assert_near(checker_at(&m, c * inside, plane, 0), expected, 0);
                    assert_near(checker_at(&m, 0, c * inside, plane), expected, 0);
                    assert_near(checker_at(&m, plane, 0, c * inside), expected, 0);
                }
            }
    }
}

static vec picture_at(rt_material *m, bool nearest, double u, double v)
{
    /* Three columns, two rows, of which the first is the upper one. */
    uint32_t texels[] = {0x0000ff, 0x00ff00, 0xff0000, 0x000000, 0xffffff, 0x00ff33};
    rt_texture texture = {.width = 3, .height = 2};
    rt_scene scene = {.textures = &texture, .texels = texels};
    m->texture = 0;
    m->nearest = nearest;
    const surface s = {.material = m, .u = u, .v = v};
    return rt_scalar_double_pattern(&scene, &s);
}

static void pictures_stand_upright_and_repeat(void **state)
{
    (void)state;
    rt_material m = test_glow(1, 1, 1);
    for (int nearest = 0; nearest < 2; ++nearest)
        for (int i = -2; i <= 2; ++i) {
            /* Texels at their centres: (0, 0) is the lower left. */
            const double left = i + 0.5 / 3, middle = i + 0.5, right = i + 2.5 / 3;
            assert_color(picture_at(&m, nearest, left, 0.25 - i), 0, 0, 0, 1e-12);
            assert_color(picture_at(&m, nearest, middle, 0.25), 1, 1, 1, 1e-12);
            assert_color(picture_at(&m, nearest, right, 0.25), 0.2, 1, 0, 1e-12);
            assert_color(picture_at(&m, nearest, left, 0.75 + i), 1, 0, 0, 1e-12);
            assert_color(picture_at(&m, nearest, middle, 0.75), 0, 1, 0, 1e-12);
            assert_color(picture_at(&m, nearest, right, 0.75), 0, 0, 1, 1e-12);
        }
    assert_color(picture_at(&m, true, 0, 0), 0, 0, 0, 0);
    assert_color(picture_at(&m, true, 0.01, 0.01), 0, 0, 0, 0);
    assert_color(picture_at(&m, true, 0.32, 0.49), 0, 0, 0, 0);
    assert_color(picture_at(&m, true, 0.34, 0.51), 0, 1, 0, 0);
    assert_color(picture_at(&m, true, 0.99, 0.99), 0, 0, 1, 0);
    /* Half way between columns, between rows, between all four, and across the seam. */
    assert_color(picture_at(&m, false, 1 / 3.0, 0.75), 0.5, 0.5, 0, 1e-12);
    assert_color(picture_at(&m, false, 0.5 / 3, 0.5), 0.5, 0, 0, 1e-12);
    assert_color(picture_at(&m, false, 1 / 3.0, 0.5), 0.5, 0.5, 0.25, 1e-12);
    assert_color(picture_at(&m, false, 0, 0.75), 0.5, 0, 0.5, 1e-12);
    assert_color(picture_at(&m, false, 0.5, 0), 0.5, 1, 0.5, 1e-12);
    /* Its border goes on. */
    m.clamp = 1;
    assert_color(picture_at(&m, false, 0, 0.75), 1, 0, 0, 1e-12);
    assert_color(picture_at(&m, false, 7, 1), 0, 0, 1, 1e-12);
    assert_color(picture_at(&m, false, 0.5, -7), 1, 1, 1, 1e-12);
    assert_color(picture_at(&m, true, -1, 2), 1, 0, 0, 0);
    assert_color(picture_at(&m, true, 1, 1), 0, 0, 1, 0);
}

/* On a sphere u runs with the longitude from -z by -x ... to z in the middle, v from pole to pole.
 */
static void a_sphere_s_coordinates_are_geographic(void **state)
{
    (void)state;
    rt_scene scene;
    const rt_material m = test_glow(1, 1, 1);
    test_begin(&scene);
    test_add_sphere(&scene, &m, 1, 2, 3, 2);
    static const double directions[][5] = {{0, 0, 1, 0.5, 0.5},   {1, 0, 0, 0.75, 0.5},
                                           {-1, 0, 0, 0.25, 0.5}, {0.8, 0.6, 0, 0.75, 0},
                                           {0, 1, 0, 0.5, 1},     {0, -1, 0, 0.5, 0}};
    for (size_t i = 0; i < 6; ++i) {
        const double *d = directions[i];
        const vec out = {d[0], d[1], d[2]}, center = {1, 2, 3};
        const ray r = {add_scaled(out, 5, center), times(out, -1), 0, INFINITY};
        const surface s = test_meet(&scene, &r);
        const double v = i == 3 ? asin(0.6) / PI + 0.5 : d[4];
        assert_near(s.v, v, 1e-7);
        if (fabs(d[1]) < 1)
            assert_near(s.u, d[3], 1e-12);
    }
    rt_scene_clear(&scene);
}

static void a_triangle_s_coordinates_are_interpolated(void **state)
{
    (void)state;
    rt_scene scene;
    const rt_material m = test_glow(1, 1, 1);
    const rt_triangle t = {0, 0, 0, 4, 0, 0, 0, 4, 0};
    float uvs[] = {0.5f, 0.25f, 2.5f, 0.25f, 0.5f, -3.75f};
    int32_t record = 0;
    test_begin(&scene);
    test_add_triangle(&scene, &m, &t);
    const ray r = {{1, 0.5, 3}, {0, 0, -1}, 0, INFINITY};
    surface s = test_meet(&scene, &r);
    assert_true(s.u == 0 && s.v == 0);
    rt_scene with = scene;
    with.uvs = uvs;
    with.triangle_uvs = &record;
    s = test_meet(&with, &r);
    assert_near(s.u, 0.5 + 2 * 0.25, 1e-14);
    assert_near(s.v, 0.25 - 4 * 0.125, 1e-14);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hard_shadow_ends_where_it_must),
        cmocka_unit_test(a_directional_shadow_ends_where_it_must),
        cmocka_unit_test(only_what_is_between_casts_a_shadow),
        cmocka_unit_test(a_penumbra_is_as_wide_as_it_must_be),
        cmocka_unit_test(a_half_space_hides_half),
        cmocka_unit_test(a_ball_hides_its_form_factor),
        cmocka_unit_test(fog_thickens_with_distance),
        cmocka_unit_test(fog_lies_on_every_way_outside),
        cmocka_unit_test(the_gradient_goes_along_up),
        cmocka_unit_test(checkers_are_centred_on_whole_multiples),
        cmocka_unit_test(pictures_stand_upright_and_repeat),
        cmocka_unit_test(a_sphere_s_coordinates_are_geographic),
        cmocka_unit_test(a_triangle_s_coordinates_are_interpolated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
