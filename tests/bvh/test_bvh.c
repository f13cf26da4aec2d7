/* The tree against brute force: for every scene, however ill shaped, the same hits to the bit. */
#include "support/mutants.h"
#include "support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bvh/box.h"
#include "bvh/bvh.h"
#include "reference/scalar.h"

#define RAYS 16384

static void vector(test_random *random, float size, float out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = test_random_float(random, -size, size);
}

static void add_material(rt_scene *scene)
{
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const rt_material material = rt_material_make(zero, zero, zero, 1.0f);
    rt_status status = RT_STATUS_INIT;
    rt_scene_init(scene);
    assert_good(rt_scene_add_material(scene, &material, &status), &status);
}

static void add_triangle(rt_scene *scene, const float p[9])
{
    rt_triangle triangle;
    rt_status status = RT_STATUS_INIT;
    memcpy(&triangle, p, sizeof triangle);
    assert_good(rt_scene_add_triangle(scene, &triangle, NULL, 0, &status), &status);
}

static void add_sphere(rt_scene *scene, const float c[3], float radius)
{
    const rt_sphere sphere = {c[0], c[1], c[2], radius};
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_scene_add_sphere(scene, &sphere, 0, &status), &status);
}

/* Small primitives of both kinds anywhere in a cube of side 2. */
static void fill_random(rt_scene *scene, uint64_t seed, int triangles, int spheres)
{
    test_random random = {seed};
    add_material(scene);
    for (int i = 0; i < triangles; ++i) {
        float p[9];
        vector(&random, 1.0f, p);
        for (int k = 3; k < 9; ++k)
            p[k] = p[k % 3] + test_random_float(&random, -0.1f, 0.1f);
        add_triangle(scene, p);
    }
    for (int i = 0; i < spheres; ++i) {
        float c[3];
        vector(&random, 1.0f, c);
        add_sphere(scene, c, test_random_float(&random, 0.001f, 0.05f));
    }
}

/* Half of the rays go together in blocks from one point, half go anywhere; some have an end, some
 * run along an axis. */
static void fill_rays(rt_ray *rays, uint64_t seed)
{
    test_random random = {seed};
    for (int i = 0; i < RAYS; ++i) {
        rt_ray *r = &rays[i];
        *r = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        vector(&random, 1.5f, r->origin);
        vector(&random, 1.0f, r->direction);
        if (i < RAYS / 2) {
            const float eye[3] = {0.1f, 0.2f, 3.0f};
            memcpy(r->origin, eye, sizeof eye);
            r->direction[0] = (float)(i / 64 % 16) / 8.0f - 1.0f + (float)(i % 8) / 64.0f;
            r->direction[1] = (float)(i / 1024) / 4.0f - 1.0f + (float)(i / 8 % 8) / 32.0f;
            r->direction[2] = -2.5f;
        } else if (i % 8 == 1) {
            r->direction[i / 8 % 3] = 0.0f;
            r->direction[(i / 8 + 1) % 3] = -0.0f;
        } else if (i % 8 == 2) {
            r->tmax = test_random_float(&random, 0.0f, 2.0f);
        }
    }
}

static void trace(const rt_scene *scene, const rt_ray *rays, bool tree, const int shape[2],
                  rt_hit *hits, uint8_t *occluded)
{
    rt_status status = RT_STATUS_INIT;
    const rt_render_options options = {
        .lanes = shape[0], .packet = shape[1], .with_occlusion = true};
    test_use_tree(tree);
    rt_renderer *renderer = test_renderer(scene, &options);
    test_use_tree(true);
    assert_good(rt_renderer_trace(renderer, rays, RAYS, hits, &status), &status);
    assert_good(rt_renderer_occluded(renderer, rays, RAYS, occluded, &status), &status);
    rt_renderer_free(renderer);
}

/* The tree in several shapes of packet, and brute force on the device; clears the scene. Each shape
 * is a program to compile, so scenes of one kind have fewer: the walk is the same. */
static void assert_equals_brute_force(rt_scene *scene, bool must_hit)
{
    static const int shapes[][2] = {{0, 0}, {1, 1}, {4, 16}, {8, 8}, {16, 64}, {1, 8}};
    const bool has_both = scene->sphere_count > 0 && scene->triangle_count > 0;
    const size_t count = has_both || test_is_long() ? sizeof shapes / sizeof *shapes : 2;
    rt_ray *rays = malloc(RAYS * sizeof *rays);
    rt_hit *expected = malloc(RAYS * sizeof *expected), *actual = malloc(RAYS * sizeof *actual);
    uint8_t *occluded = malloc(2 * RAYS);
    assert_true(rays && expected && actual && occluded);
    fill_rays(rays, 7);
    trace(scene, rays, false, shapes[0], expected, occluded);
    size_t hits = 0;
    for (int i = 0; i < RAYS; ++i) {
        hits += expected[i].primitive != RT_MISS;
        assert_int_equal(occluded[i], expected[i].primitive != RT_MISS);
    }
    assert_true(!must_hit || hits > 100);
    for (size_t s = 0; s < count; ++s) {
        trace(scene, rays, true, shapes[s], actual, occluded + RAYS);
        for (int i = 0; i < RAYS; ++i)
            if (memcmp(&expected[i], &actual[i], sizeof *actual) != 0)
                fail_msg("%d lanes, packets of %d, ray %d: primitive %d at %a; by brute force %d "
                         "at %a",
                         shapes[s][0], shapes[s][1], i, actual[i].primitive, (double)actual[i].t,
                         expected[i].primitive, (double)expected[i].t);
        assert_memory_equal(occluded, occluded + RAYS, RAYS);
    }
    free(rays);
    free(expected);
    free(actual);
    free(occluded);
    rt_scene_clear(scene);
}

static void no_primitive(void **state)
{
    (void)state;
    rt_scene scene;
    add_material(&scene);
    assert_equals_brute_force(&scene, false);
}

static void few_primitives(void **state)
{
    (void)state;
    for (int count = 1; count < 40; count += 7) {
        rt_scene scene;
        fill_random(&scene, (uint64_t)count, count, count / 2);
        assert_equals_brute_force(&scene, false);
    }
}

static void many_of_both_kinds(void **state)
{
    (void)state;
    rt_scene scene;
    fill_random(&scene, 1, 2000, 1500);
    assert_equals_brute_force(&scene, true);
}

static void all_in_one_point(void **state)
{
    (void)state;
    rt_scene scene;
    add_material(&scene);
    const float point[9] = {0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f};
    for (int i = 0; i < 300; ++i)
        add_triangle(&scene, point);
    assert_equals_brute_force(&scene, false);
}

static void identical_triangles(void **state)
{
    (void)state;
    rt_scene scene;
    add_material(&scene);
    const float p[9] = {-1, -1, 0, 1, -1, 0.1f, 0, 1, 0};
    for (int i = 0; i < 1000; ++i)
        add_triangle(&scene, p);
    assert_equals_brute_force(&scene, true);
}

/* A plane of the axes: flat boxes, and rays within it. */
static void all_coplanar(void **state)
{
    (void)state;
    test_random random = {5};
    rt_scene scene;
    add_material(&scene);
    for (int i = 0; i < 800; ++i) {
        float p[9];
        vector(&random, 1.0f, p);
        for (int k = 3; k < 9; ++k)
            p[k] = p[k % 3] + test_random_float(&random, -0.2f, 0.2f);
        p[2] = p[5] = p[8] = 0.0f;
        add_triangle(&scene, p);
    }
    assert_equals_brute_force(&scene, true);
}

static void one_huge_among_tiny(void **state)
{
    (void)state;
    rt_scene scene;
    fill_random(&scene, 9, 500, 500);
    const float huge[9] = {-1e6f, -1e6f, -3, 1e6f, -1e6f, -3, 0, 1e6f, -3};
    const float far[3] = {0, -1e5f - 2, 0};
    add_triangle(&scene, huge);
    add_sphere(&scene, far, 1e5f);
    assert_equals_brute_force(&scene, true);
}

/* Slivers and grazing planes, whose t rounding throws far out of their own boxes. */
static void slivers(void **state)
{
    (void)state;
    test_random random = {11};
    rt_scene scene;
    add_material(&scene);
    for (int i = 0; i < 1500; ++i) {
        float p[9];
        vector(&random, 1.0f, p);
        vector(&random, 1.0f, p + 3);
        const float along = test_random_float(&random, 0.2f, 0.8f);
        const float off = ldexpf(1.0f, -(i % 24));
        for (int k = 0; k < 3; ++k)
            p[6 + k] = p[k] + along * (p[3 + k] - p[k]) + off * test_random_float(&random, -1, 1);
        add_triangle(&scene, p);
    }
    scene.accuracy = RT_ACCURACY_STANDARD;
    assert_equals_brute_force(&scene, true);
}

static void coordinates_of_any_size(void **state)
{
    (void)state;
    test_random random = {13};
    rt_scene scene;
    add_material(&scene);
    for (int i = 0; i < 1000; ++i) {
        float p[9];
        const float size = ldexpf(1.0f, (int)(test_random_bits(&random) % 40) - 20);
        vector(&random, size, p);
        vector(&random, size, p + 3);
        vector(&random, size, p + 6);
        add_triangle(&scene, p);
        add_sphere(&scene, p, size / 16);
    }
    assert_equals_brute_force(&scene, true);
}

/* What is promised of the tree itself: boxes hold what is below, every primitive is in one leaf,
 * and the stack's size suffices for any order of walking. */
typedef struct audit {
    const rt_bvh *bvh;
    const rt_scene *scene;
    unsigned char *seen;
} audit;

static void audit_box(const float lo[3], const float hi[3], const rt_node *n, int c)
{
    assert_true(n->lo_x[c] <= lo[0] && n->lo_y[c] <= lo[1] && n->lo_z[c] <= lo[2]);
    assert_true(n->hi_x[c] >= hi[0] && n->hi_y[c] >= hi[1] && n->hi_z[c] >= hi[2]);
}

static size_t audit_node(const audit *a, int node)
{
    const rt_node *n = &a->bvh->nodes[node];
    const rt_blocks *blocks = &a->bvh->blocks;
    size_t children = 0, below = 0;
    for (int c = 0; c < RT_WIDTH; ++c) {
        if (!(n->lo_x[c] <= n->hi_x[c]))
            continue;
        ++children;
        if (n->child[c] >= 0) {
            const rt_node *m = &a->bvh->nodes[n->child[c]];
            for (int k = 0; k < RT_WIDTH; ++k)
                if (m->lo_x[k] <= m->hi_x[k])
                    audit_box((const float[]){m->lo_x[k], m->lo_y[k], m->lo_z[k]},
                              (const float[]){m->hi_x[k], m->hi_y[k], m->hi_z[k]}, n, c);
            const size_t need = audit_node(a, n->child[c]);
            below = need > below ? need : below;
            continue;
        }
        const enum rt_kind kind = (enum rt_kind)RT_LEAF_KIND(n->child[c]);
        const size_t first = rt_scene_primitives_before(a->scene, kind);
        const size_t slot = rt_blocks_slots_before(blocks, kind) +
                            (size_t)RT_LEAF_BLOCK(n->child[c]) * RT_BLOCK_PRIMITIVES;
        for (size_t k = 0; k < RT_BLOCK_PRIMITIVES; ++k) {
            const int32_t primitive = blocks->order[slot + k];
            if (primitive < 0)
                continue;
            assert_true(!a->seen[primitive]++);
            const size_t i = (size_t)primitive - first;
            rt_reference boxed;
            assert_true((size_t)primitive >= first && i < a->scene->kinds[kind].count);
            rt_boxes_of(a->scene, kind, i, i + 1, &boxed);
            audit_box(boxed.lo, boxed.hi, n, c);
        }
    }
    return children + below;
}

static void the_tree_is_sound_on_any_number_of_threads(void **state)
{
    (void)state;
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    fill_random(&scene, 3, 30000, 10000);
    rt_bvh one, three;
    assert_good(rt_bvh_build(&one, &scene, 1, &status), &status);
    assert_good(rt_bvh_build(&three, &scene, 3, &status), &status);
    unsigned char *seen = calloc(40000, 1);
    assert_non_null(seen);
    const audit a = {&one, &scene, seen};
    assert_true(audit_node(&a, 0) <= one.stack_size);
    for (int i = 0; i < 40000; ++i)
        assert_int_equal(seen[i], 1);
    assert_int_equal(one.node_count, three.node_count);
    assert_memory_equal(one.nodes, three.nodes, one.node_count * sizeof *one.nodes);
    free(seen);
    rt_bvh_clear(&one);
    rt_bvh_clear(&three);
    rt_scene_clear(&scene);
}

/* A hundred thousand that no plane parts: the depth stays that of halving. */
static void identical_primitives_stay_shallow(void **state)
{
    (void)state;
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    add_material(&scene);
    const float p[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (int i = 0; i < 100000; ++i)
        add_triangle(&scene, p);
    rt_bvh bvh;
    assert_good(rt_bvh_build(&bvh, &scene, 2, &status), &status);
    assert_true(bvh.stack_size <= 16 * 17);
    rt_bvh_clear(&bvh);
    rt_scene_clear(&scene);
}

/* The comparison notices a walk that skips what it may not. */
static void a_wrong_walk_is_noticed(void **state)
{
    (void)state;
    static const test_mutant mutants[] = {MUTANT_NOT_KEPT_IN_BOX, MUTANT_SLAB_SHRUNK};
    size_t noticed = 0;
    for (size_t m = 0; m < sizeof mutants / sizeof *mutants; ++m) {
        rt_scene scene;
        rt_hit *hits = malloc(2 * RAYS * sizeof *hits);
        rt_ray *rays = malloc(RAYS * sizeof *rays);
        uint8_t *occluded = malloc(RAYS);
        assert_true(hits && rays && occluded);
        test_random random = {11};
        add_material(&scene);
        for (int i = 0; i < 1500; ++i) {
            float p[9];
            vector(&random, 1.0f, p);
            vector(&random, 1.0f, p + 3);
            for (int k = 0; k < 3; ++k)
                p[6 + k] = (p[k] + p[3 + k]) / 2 + 1e-6f * test_random_float(&random, -1, 1);
            add_triangle(&scene, p);
        }
        /* The level whose t of a sliver is off by far: robust is seldom out of the box. */
        scene.accuracy = RT_ACCURACY_STANDARD;
        /* Aimed at the slivers, so that many are met. */
        fill_rays(rays, 7);
        for (int i = 0; i < RAYS; ++i) {
            float p[9];
            memcpy(p, &scene.triangles[i % 1500], sizeof p);
            for (int k = 0; k < 3; ++k)
                rays[i].direction[k] = 0.7f * p[k] + 0.3f * p[3 + k] - rays[i].origin[k];
        }
        const int shape[2] = {0, 0};
        trace(&scene, rays, false, shape, hits, occluded);
        test_mutate_kernels(mutants[m]);
        trace(&scene, rays, true, shape, hits + RAYS, occluded);
        test_restore_kernels();
        noticed += memcmp(hits, hits + RAYS, RAYS * sizeof *hits) != 0;
        free(hits);
        free(rays);
        free(occluded);
        rt_scene_clear(&scene);
    }
    assert_int_equal(noticed, sizeof mutants / sizeof *mutants);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_primitive),
        cmocka_unit_test(few_primitives),
        cmocka_unit_test(many_of_both_kinds),
        cmocka_unit_test(all_in_one_point),
        cmocka_unit_test(identical_triangles),
        cmocka_unit_test(all_coplanar),
        cmocka_unit_test(one_huge_among_tiny),
        cmocka_unit_test(slivers),
        cmocka_unit_test(coordinates_of_any_size),
        cmocka_unit_test(the_tree_is_sound_on_any_number_of_threads),
        cmocka_unit_test(identical_primitives_stay_shallow),
        cmocka_unit_test(a_wrong_walk_is_noticed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
