/* The margins that rounding is given (kernels/margins.h) against the reference's own: one that is
 * wrong in the kernels or in the tree is noticed. */
#include "support/mutants.h"
#include "support/support.h"

#include <math.h>
#include <string.h>

#include "bvh/box.h"
#include "bvh/bvh.h"
#include "reference/real.h"
#include "reference/scalar.h"

#define RAYS 4096
#define TRIANGLES 500

static void vector(test_random *random, float out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = test_random_float(random, -1.0f, 1.0f);
}

/* Slivers: the t of a hit on one is so far off that it is mostly the end of the ray's part in its
 * box. Every other triangle is small and flat along an axis, so that its box is all margin there.
 */
static void make_scene(rt_scene *scene, enum rt_accuracy level)
{
    const float grey[3] = {0.5f, 0.5f, 0.5f};
    const rt_material material = rt_material_make(grey, grey, grey, 1.0f);
    rt_status status = RT_STATUS_INIT;
    test_random random = {11};
    rt_scene_init(scene);
    scene->accuracy = level;
    assert_good(rt_scene_add_material(scene, &material, &status), &status);
    for (int i = 0; i < TRIANGLES; ++i) {
        float p[9];
        rt_triangle triangle;
        vector(&random, p);
        vector(&random, p + 3);
        for (int k = 0; k < 3; ++k)
            p[6 + k] = (p[k] + p[3 + k]) / 2 + 1e-6f * test_random_float(&random, -1.0f, 1.0f);
        for (int k = 0; i % 2 && k < 9; ++k)
            p[k] *= k % 3 == 2 ? 0.0f : 0.1f;
        if (i % 2)
            p[6] += 0.1f;
        memcpy(&triangle, p, sizeof triangle);
        assert_good(rt_scene_add_triangle(scene, &triangle, NULL, 0, &status), &status);
    }
    for (int i = 0; i < 100; ++i) {
        float c[3];
        vector(&random, c);
        const rt_sphere sphere = {c[0], c[1], c[2], test_random_float(&random, 0.001f, 0.1f)};
        assert_good(rt_scene_add_sphere(scene, &sphere, 0, &status), &status);
    }
}

/* Rays at the triangles, from farther off than those are large. */
static void make_rays(const rt_scene *scene, rt_ray *rays)
{
    test_random random = {12};
    for (int i = 0; i < RAYS; ++i) {
        float p[9];
        memcpy(p, &scene->triangles[i % TRIANGLES], sizeof p);
        rays[i] = (rt_ray){.tmax = INFINITY};
        vector(&random, rays[i].origin);
        rays[i].origin[2] += 3.0f;
        for (int k = 0; k < 3; ++k)
            rays[i].direction[k] =
                0.7f * p[k] + 0.2f * p[3 + k] + 0.1f * p[6 + k] - rays[i].origin[k];
    }
}

/* Whether the kernels' hits, with a tree or without, are not the reference's. */
static bool differs(const rt_scene *scene, bool with_tree)
{
    static rt_ray rays[RAYS];
    static rt_hit expected[RAYS], actual[RAYS];
    rt_status status = RT_STATUS_INIT;
    rt_bvh bvh;
    make_rays(scene, rays);
    rt_scalar_float_trace(scene, rays, RAYS, expected);
    assert_good(rt_bvh_build(&bvh, scene, 1, &status), &status);
    rt_renderer *renderer = rt_renderer_new(test_device(), scene, with_tree ? &bvh : NULL,
                                            &(rt_render_options){0}, &status);
    assert_good(renderer != NULL, &status);
    assert_good(rt_renderer_trace(renderer, rays, RAYS, actual, &status), &status);
    rt_renderer_free(renderer);
    rt_bvh_clear(&bvh);
    return memcmp(expected, actual, sizeof actual) != 0;
}

static void the_kernels_have_the_references(void **state)
{
    (void)state;
    for (int level = RT_ACCURACY_STANDARD; level <= RT_ACCURACY_ROBUST; ++level) {
        rt_scene scene;
        make_scene(&scene, (enum rt_accuracy)level);
        assert_false(differs(&scene, false));
        assert_false(differs(&scene, true));
        rt_scene_clear(&scene);
    }
}

static void a_wrong_margin_is_noticed(void **state)
{
    (void)state;
    static const struct {
        enum rt_accuracy level;
        test_mutant mutant;
    } mutants[] = {
        {RT_ACCURACY_STANDARD, MUTANT_BOX_MARGIN_WIDE},
        {RT_ACCURACY_STANDARD, MUTANT_BOX_MARGIN_NARROW},
        {RT_ACCURACY_STANDARD, MUTANT_SLAB_MARGIN_WIDE},
        {RT_ACCURACY_STANDARD, MUTANT_SLAB_MARGIN_NARROW},
        /* The robust tests' t is within the box by itself: a margin shows where it takes away. */
        {RT_ACCURACY_ROBUST, MUTANT_SLAB_MARGIN_ROBUST_LESS},
    };
    for (size_t m = 0; m < sizeof mutants / sizeof *mutants; ++m) {
        rt_scene scene;
        make_scene(&scene, mutants[m].level);
        test_mutate_kernels(mutants[m].mutant);
        if (!differs(&scene, false))
            fail_msg("nobody notices: %s", test_mutations[mutants[m].mutant].what);
        test_restore_kernels();
        rt_scene_clear(&scene);
    }
}

/* The tree's boxes are those of the robust levels. */
static void the_tree_has_the_references(void **state)
{
    (void)state;
    rt_scene scene;
    make_scene(&scene, RT_ACCURACY_ROBUST);
    int primitive = 0;
    for (int kind = 0; kind < RT_KIND_COUNT; ++kind)
        for (size_t i = 0; i < scene.kinds[kind].count; ++i) {
            rt_reference box;
            vec lo, hi;
            rt_boxes_of(&scene, (enum rt_kind)kind, i, i + 1, &box);
            rt_scalar_float_box(&scene, primitive++, &lo, &hi);
            assert_memory_equal(box.lo, &lo, sizeof lo);
            assert_memory_equal(box.hi, &hi, sizeof hi);
        }
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_kernels_have_the_references),
        cmocka_unit_test(a_wrong_margin_is_noticed),
        cmocka_unit_test(the_tree_has_the_references),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
