/* The trace kernel against the scalar path, bit for bit, over seeded ray sets of more than a
 * million rays in all, at every lane width. */
#include "support/mutants.h"
#include "support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reference/scalar.h"

#define RAYS 262144
#define SPHERES 40
#define TRIANGLES 60

typedef struct fixture {
    rt_ray *rays;
    rt_hit *expected, *actual;
} fixture;

static void vector(test_random *random, float size, float out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = test_random_float(random, -size, size);
}

/* Primitives of sizes from 1e-3 to 1 within a cube of side 2 * size; some are slivers, some twins,
 * some lie in a common plane, some have no area. */
static void fill_scene(rt_scene *scene, uint64_t seed, float size, enum rt_cull cull)
{
    test_random random = {seed};
    rt_status status = RT_STATUS_INIT;
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const rt_material material = rt_material_make(zero, zero, zero, 1.0f);
    rt_scene_init(scene);
    scene->cull = cull;
    assert_good(rt_scene_add_material(scene, &material, &status), &status);
    for (int i = 0; i < SPHERES; ++i) {
        float c[3];
        vector(&random, size, c);
        const float radius = size * exp2f(test_random_float(&random, -10.0f, -1.0f));
        const rt_sphere sphere = {c[0], c[1], c[2], radius};
        assert_good(rt_scene_add_sphere(scene, &sphere, 0, &status), &status);
    }
    for (int i = 0; i < TRIANGLES; ++i) {
        float p[9];
        vector(&random, size, p);
        const float reach = size * exp2f(test_random_float(&random, -6.0f, 0.0f));
        for (int k = 3; k < 9; ++k)
            p[k] = p[k % 3] + test_random_float(&random, -reach, reach);
        if (i % 5 == 1) /* in the plane z = 0 */
            p[2] = p[5] = p[8] = 0.0f;
        if (i % 10 == 2) /* a sliver */
            for (int k = 0; k < 3; ++k)
                p[6 + k] = p[k] + 0.7f * (p[3 + k] - p[k]) + 1e-6f * size;
        if (i % 20 == 3) /* no area */
            memcpy(p + 6, p + 3, 3 * sizeof *p);
        if (i % 10 == 4 && i > 10) /* a twin */
            memcpy(p, &scene->triangles[i - 3], sizeof p);
        rt_triangle triangle;
        memcpy(&triangle, p, sizeof triangle);
        assert_good(rt_scene_add_triangle(scene, &triangle, NULL, 0, &status), &status);
    }
}

/* Mirrors a ray about its aim, axis by axis, so that all rays of a block go the same way along each
 * axis: those walk as a packet, the others one by one. */
static void send_the_same_way(rt_ray *r, const float aim[3], int block)
{
    for (int k = 0; k < 3; ++k)
        if ((signbit(r->direction[k]) != 0) == (block >> k & 1)) {
            r->direction[k] = -r->direction[k];
            r->origin[k] = 2.0f * aim[k] - r->origin[k];
        }
}

/* Four kinds in turn: anywhere, aimed at edges and corners, axis-parallel, and with a segment; some
 * of the first begin at a sphere's centre or at right angles to the way there, where roots cancel.
 */
static void fill_rays(const rt_scene *scene, uint64_t seed, float size, rt_ray *rays)
{
    test_random random = {seed};
    for (int i = 0; i < RAYS; ++i) {
        rt_ray *r = &rays[i];
        r->tmin = 0.0f;
        r->tmax = INFINITY;
        vector(&random, 2.0f * size, r->origin);
        vector(&random, 1.0f, r->direction);
        float aim[3] = {0.0f, 0.0f, 0.0f};
        const uint64_t bits = test_random_bits(&random);
        if (i % 16 == 0) {
            const rt_sphere *sphere = &scene->spheres[bits % SPHERES];
            const float along = i % 32 ? 0.0f : 0.5f * sphere->radius;
            const float center[3] = {sphere->cx, sphere->cy, sphere->cz};
            memcpy(r->origin, center, sizeof center);
            r->origin[bits >> 8 & 1] += along;
            if (along > 0.0f)
                r->direction[bits >> 8 & 1] = bits & 0x1000 ? 0.0f : -0.0f;
        } else if (i % 4 == 1) {
            float p[9];
            memcpy(p, &scene->triangles[bits % TRIANGLES], sizeof p);
            const float along = bits & 0x100000 ? test_random_float(&random, 0.0f, 1.0f) : 0.0f;
            for (int k = 0; k < 3; ++k)
                aim[k] = p[k] + along * (p[3 + k] - p[k]);
            for (int k = 0; k < 3; ++k)
                r->direction[k] = aim[k] - r->origin[k];
        } else if (i % 4 == 2) {
            for (int k = 0; k < 3; ++k)
                r->direction[k] = k == (int)(bits % 3) ? 1.0f : bits & 0x100 ? -0.0f : 0.0f;
            r->origin[bits % 3] = -3.0f * size;
        } else if (i % 4 == 3) {
            r->tmin = size * test_random_float(&random, 0.0f, 1.0f);
            r->tmax = r->tmin + size * test_random_float(&random, -0.2f, 3.0f);
        }
        if (i / 64 % 2)
            send_the_same_way(r, aim, i / 128);
    }
}

static void compare(const rt_scene *scene, const fixture *f, int lanes, size_t count)
{
    rt_status status = RT_STATUS_INIT;
    const rt_render_options options = {.lanes = lanes};
    rt_renderer *renderer = test_renderer(scene, &options);
    assert_good(rt_renderer_trace(renderer, f->rays, count, f->actual, &status), &status);
    rt_renderer_free(renderer);
    for (size_t i = 0; i < count; ++i)
        if (memcmp(&f->expected[i], &f->actual[i], sizeof *f->expected) != 0)
            fail_msg("%s, %d lanes, ray %zu: primitive %d, t %a, u %a, v %a; the scalar path has "
                     "primitive %d, t %a, u %a, v %a",
                     rt_accuracy_name(scene->accuracy), lanes, i, f->actual[i].primitive,
                     (double)f->actual[i].t, (double)f->actual[i].u, (double)f->actual[i].v,
                     f->expected[i].primitive, (double)f->expected[i].t, (double)f->expected[i].u,
                     (double)f->expected[i].v);
}

static void level_equals_scalar(const fixture *f, enum rt_accuracy level, uint64_t seed, float size,
                                enum rt_cull cull)
{
    rt_scene scene;
    fill_scene(&scene, seed, size, cull);
    scene.accuracy = level;
    fill_rays(&scene, seed + 1, size, f->rays);
    (level == RT_ACCURACY_DOUBLE ? rt_scalar_double_trace
                                 : rt_scalar_float_trace)(&scene, f->rays, RAYS, f->expected);
    size_t hits = 0;
    for (int i = 0; i < RAYS; ++i)
        hits += f->expected[i].primitive != RT_MISS;
    /* A set that hits nothing, or that never misses, would prove nothing. */
    assert_true(hits > RAYS / 8 && hits < RAYS - RAYS / 16);
    const bool all = cull == RT_CULL_NONE || test_is_long();
    for (int lanes = 1; all && lanes <= 16; lanes *= lanes == 1 ? 4 : 2)
        compare(&scene, f, lanes, RAYS);
    test_use_tree(!all);
    compare(&scene, f, 0, RAYS);
    test_use_tree(true);
    rt_scene_clear(&scene);
}

static void kernels_equal_scalar(const fixture *f, uint64_t seed, float size, enum rt_cull cull)
{
    const int last = test_device()->has_fp64 ? RT_ACCURACY_DOUBLE : RT_ACCURACY_ROBUST;
    for (int level = RT_ACCURACY_STANDARD; level <= last; ++level)
        level_equals_scalar(f, (enum rt_accuracy)level, seed, size, cull);
}

static void at_unit_scale(void **state)
{
    kernels_equal_scalar(*state, 100, 1.0f, RT_CULL_NONE);
}

static void culled(void **state)
{
    kernels_equal_scalar(*state, 200, 1.0f, RT_CULL_BACK);
    kernels_equal_scalar(*state, 300, 1.0f, RT_CULL_FRONT);
}

static void small_and_large(void **state)
{
    kernels_equal_scalar(*state, 400, 1e-4f, RT_CULL_NONE);
    kernels_equal_scalar(*state, 500, 1e5f, RT_CULL_NONE);
}

/* Counts that fill neither a block nor a tile. */
static void any_number_of_rays(void **state)
{
    const fixture *f = *state;
    const size_t counts[] = {0, 1, 3, 63, 64, 65, 1000, 65536, 65537};
    rt_scene scene;
    fill_scene(&scene, 600, 1.0f, RT_CULL_NONE);
    fill_rays(&scene, 601, 1.0f, f->rays);
    rt_scalar_float_trace(&scene, f->rays, RAYS, f->expected);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i)
        compare(&scene, f, 0, counts[i]);
    rt_scene_clear(&scene);
}

/* The comparison notices kernels that are almost right. */
static void a_wrong_kernel_is_noticed(void **state)
{
    static const test_mutant mutants[] = {MUTANT_EDGES_STRICT, MUTANT_DETERMINANT_MARGIN,
                                          MUTANT_LAST_OF_EQUALS, MUTANT_DOT_NOT_FUSED,
                                          MUTANT_QUOTIENT_BY_RECIPROCAL};
    const fixture *f = *state;
    rt_status status = RT_STATUS_INIT;
    rt_scene scene;
    fill_scene(&scene, 700, 1.0f, RT_CULL_NONE);
    scene.accuracy = RT_ACCURACY_STANDARD; /* most are of its tests */
    /* Twin spheres, so that <= in the place of < can show. */
    const rt_sphere twin = scene.spheres[0];
    assert_good(rt_scene_add_sphere(&scene, &twin, 0, &status), &status);
    /* A ray that meets the edge between b and c exactly: u + v is the determinant. */
    const rt_triangle corner = {3, 3, 0, 4, 3, 0, 3, 4, 0};
    assert_good(rt_scene_add_triangle(&scene, &corner, NULL, 0, &status), &status);
    fill_rays(&scene, 701, 1.0f, f->rays);
    f->rays[0] = (rt_ray){{3.5f, 3.5f, 1}, {0, 0, -1}, 0, INFINITY};
    rt_scalar_float_trace(&scene, f->rays, RAYS, f->expected);
    for (size_t m = 0; m < sizeof mutants / sizeof *mutants; m += test_is_long() ? 1 : 2) {
        test_mutate_kernels(mutants[m]);
        const rt_render_options options = {0};
        rt_renderer *renderer = test_renderer(&scene, &options);
        test_restore_kernels();
        assert_good(rt_renderer_trace(renderer, f->rays, RAYS, f->actual, &status), &status);
        rt_renderer_free(renderer);
        if (memcmp(f->expected, f->actual, RAYS * sizeof *f->expected) == 0)
            fail_msg("nobody notices %s", test_mutations[mutants[m]].name);
    }
    rt_scene_clear(&scene);
}

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    assert_non_null(f);
    f->rays = calloc(RAYS, sizeof *f->rays);
    f->expected = calloc(RAYS, sizeof *f->expected);
    f->actual = calloc(RAYS, sizeof *f->actual);
    *state = f;
    return f->rays && f->expected && f->actual ? 0 : -1;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    free(f->rays);
    free(f->expected);
    free(f->actual);
    free(f);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_unit_scale),
        cmocka_unit_test(culled),
        cmocka_unit_test(small_and_large),
        cmocka_unit_test(any_number_of_rays),
        cmocka_unit_test(a_wrong_kernel_is_noticed),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
