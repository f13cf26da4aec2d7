/* The reference in double, for tests of single rays: scenes built by hand, and a look along a ray.
 */
#ifndef RT_TESTS_SUPPORT_SCALAR_DOUBLE_H
#define RT_TESTS_SUPPORT_SCALAR_DOUBLE_H

#include "support/support.h"

#define RT_SCALAR_DOUBLE
#include "reference/effects.h"
#include "reference/scalar.h"

#define PI 3.14159265358979323846

/* Sends the colour `ka` under the white ambient light of test_begin, and nothing else. */
static inline rt_material test_glow(float r, float g, float b)
{
    const float zero[3] = {0, 0, 0}, ka[3] = {r, g, b};
    return rt_material_make(ka, zero, zero, 1.0f);
}

static inline void test_begin(rt_scene *scene)
{
    rt_scene_init(scene);
    scene->width = scene->height = 1;
    scene->ambient = (rt_vec3){1, 1, 1};
}

static inline void test_add_sphere(rt_scene *scene, const rt_material *m, float x, float y, float z,
                                   float radius)
{
    rt_status status = RT_STATUS_INIT;
    const rt_sphere sphere = {x, y, z, radius};
    assert_good(rt_scene_add_material(scene, m, &status), &status);
    assert_good(rt_scene_add_sphere(scene, &sphere, (int32_t)scene->material_count - 1, &status),
                &status);
}

static inline void test_add_triangle(rt_scene *scene, const rt_material *m, const rt_triangle *t)
{
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_scene_add_material(scene, m, &status), &status);
    assert_good(rt_scene_add_triangle(scene, t, NULL, (int32_t)scene->material_count - 1, &status),
                &status);
}

/* A floor at that height, as large as anything needs; its outside is above. */
static inline void test_add_floor(rt_scene *scene, const rt_material *m, float height)
{
    const rt_triangle floor = {-4e4f, height, 3e4f, 4e4f, height, 3e4f, 0, height, -5e4f};
    test_add_triangle(scene, m, &floor);
}

/* What an eye at the origin of a ray sees along it, as the mean of so many samples: what is
 * followed by chance wants many. */
static inline vec test_look_long(const rt_scene *scene, vec origin, vec direction, uint32_t count)
{
    rt_scene there = *scene;
    there.camera.from = (rt_vec3){(float)origin.x, (float)origin.y, (float)origin.z};
    there.camera.at = (rt_vec3){(float)(origin.x + direction.x), (float)(origin.y + direction.y),
                                (float)(origin.z + direction.z)};
    const ray r = {origin, unit(direction), 0, INFINITY};
    scalar_world world = rt_scalar_double_world(&there);
    const hit h = rt_scalar_double_closest(&world, &r);
    vec sum = {0, 0, 0};
    for (uint32_t i = 0; i < count; ++i) {
        const stream samples = {.sample = i};
        sum = plus(sum, rt_scalar_double_radiance(&world, &r, &h, &samples));
    }
    rt_scalar_double_world_clear(&world);
    return times(sum, 1.0 / count);
}

static inline vec test_look(const rt_scene *scene, vec origin, vec direction)
{
    return test_look_long(scene, origin, direction, 1);
}

/* The surface that the ray meets. */
static inline surface test_meet(const rt_scene *scene, const ray *r)
{
    scalar_world world = rt_scalar_double_world(scene);
    const hit h = rt_scalar_double_closest(&world, r);
    rt_scalar_double_world_clear(&world);
    return rt_scalar_double_surface_at(scene, r, &h);
}

#define assert_color(actual, r, g, b, tolerance)                                                   \
    do {                                                                                           \
        const vec color_ = (actual);                                                               \
        assert_near(color_.x, r, tolerance);                                                       \
        assert_near(color_.y, g, tolerance);                                                       \
        assert_near(color_.z, b, tolerance);                                                       \
    } while (0)

#endif
