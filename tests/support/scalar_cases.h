/* The tests of test_tree.c and test_tree_double.c: the scalar reference's tree against its own
 * brute force, the same hits to the bit. */
#include "support/support.h"

#include <math.h>
#include <string.h>

#include "reference/real.h"

#define RAYS 20000
#define PRIMITIVES 300

static void vector(test_random *random, float size, float out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = test_random_float(random, -size, size);
}

/* Spheres and triangles of many sizes; some triangles are slivers, twins, or lie in z = 0. */
static void fill_scene(rt_scene *scene, uint64_t seed)
{
    test_random random = {seed};
    rt_status status = RT_STATUS_INIT;
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const rt_material material = rt_material_make(zero, zero, zero, 1.0f);
    rt_scene_init(scene);
    assert_good(rt_scene_add_material(scene, &material, &status), &status);
    for (int i = 0; i < PRIMITIVES; ++i) {
        float p[9];
        const float size = exp2f(test_random_float(&random, -8.0f, 0.0f));
        vector(&random, 1.0f, p);
        const rt_sphere sphere = {p[0], p[1], p[2], 0.3f * size};
        assert_good(rt_scene_add_sphere(scene, &sphere, 0, &status), &status);
        vector(&random, 1.0f, p);
        for (int k = 3; k < 9; ++k)
            p[k] = p[k % 3] + test_random_float(&random, -size, size);
        if (i % 5 == 1)
            p[2] = p[5] = p[8] = 0.0f;
        for (int k = 0; k < 3 && i % 5 == 2; ++k)
            p[6 + k] = p[k] + 0.7f * (p[3 + k] - p[k]) + 1e-6f;
        if (i % 5 == 3)
            memcpy(p, &scene->triangles[i / 2], sizeof p);
        rt_triangle triangle;
        memcpy(&triangle, p, sizeof triangle);
        assert_good(rt_scene_add_triangle(scene, &triangle, NULL, 0, &status), &status);
    }
}

/* Anywhere, toward edges, along an axis, or with an end. */
static ray some_ray(const rt_scene *scene, test_random *random, int i)
{
    float o[3], d[3], p[9];
    vector(random, 2.0f, o);
    vector(random, 1.0f, d);
    ray r = {vec_of(o[0], o[1], o[2]), vec_of(d[0], d[1], d[2]), 0, INFINITY};
    if (i % 4 == 1) {
        memcpy(p, &scene->triangles[i % PRIMITIVES], sizeof p);
        r.direction =
            vec_of((p[0] + p[3]) / 2 - o[0], (p[1] + p[4]) / 2 - o[1], (p[2] + p[5]) / 2 - o[2]);
    }
    if (i % 4 == 2)
        r.direction = (vec){0, i % 8 == 2 ? 0 : (real)-1, i % 8 == 2 ? 1 : 0};
    if (i % 4 == 3)
        r.tmax = (real)test_random_float(random, 0.0f, 2.0f);
    return r;
}

static bool are_same(hit a, hit b)
{
    return a.primitive == b.primitive && memcmp(&a.t, &b.t, sizeof a.t) == 0 &&
           memcmp(&a.u, &b.u, sizeof a.u) == 0 && memcmp(&a.v, &b.v, sizeof a.v) == 0;
}

static void the_tree_changes_nothing(void **state)
{
    (void)state;
    for (int level = RT_ACCURACY_STANDARD; level <= RT_ACCURACY_ROBUST; ++level) {
        rt_scene scene;
        fill_scene(&scene, 5);
        scene.accuracy = (enum rt_accuracy)level;
        scalar_world world = NAME(world)(&scene);
        scalar_world brute = world;
        brute.nodes = NULL;
        assert_non_null(world.nodes);
        test_random random = {6};
        int hits = 0;
        for (int i = 0; i < RAYS; ++i) {
            const ray r = some_ray(&scene, &random, i);
            const hit a = NAME(closest)(&world, &r), b = NAME(closest)(&brute, &r);
            if (!are_same(a, b))
                fail_msg("level %d, ray %d: %d at %a, by brute force %d at %a", level, i,
                         a.primitive, (double)a.t, b.primitive, (double)b.t);
            assert_int_equal(NAME(occluded)(&world, &r), b.primitive != RT_MISS);
            assert_int_equal(NAME(occluded)(&brute, &r), b.primitive != RT_MISS);
            hits += b.primitive != RT_MISS;
        }
        assert_in_range(hits, RAYS / 4, RAYS - RAYS / 20);
        NAME(world_clear)(&world);
        rt_scene_clear(&scene);
    }
}

static void an_empty_scene_is_missed(void **state)
{
    (void)state;
    rt_scene scene;
    rt_scene_init(&scene);
    scalar_world world = NAME(world)(&scene);
    const ray r = {{0, 0, 0}, {0, 0, 1}, 0, INFINITY};
    assert_int_equal(NAME(closest)(&world, &r).primitive, RT_MISS);
    assert_false(NAME(occluded)(&world, &r));
    NAME(world_clear)(&world);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tree_changes_nothing),
        cmocka_unit_test(an_empty_scene_is_missed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
