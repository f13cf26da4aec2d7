/* A closed mesh seen from inside: each ray, aimed at an edge or at a vertex, meets it exactly once.
 *
 * Triangles are dealt out to scenes in each of which no two touch, so that the number of scenes
 * that a ray hits is the number of triangles that it hits. */
#include "support/mutants.h"
#include "support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reference/scalar.h"

#define RINGS 12
#define SECTORS 16
#define VERTICES (2 + (RINGS - 1) * SECTORS)
#define TRIANGLES (2 * (RINGS - 1) * SECTORS)
#define COLORS 64
#define RAYS 65536

typedef struct mesh {
    float vertices[VERTICES][3];
    int triangles[TRIANGLES][3];
    int colors[TRIANGLES], color_count;
} mesh;

/* How the mesh lies: scaled, then moved. */
typedef struct place {
    float scale, offset[3];
} place;

static bool touch(const int a[3], const int b[3])
{
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (a[i] == b[k])
                return true;
    return false;
}

/* A sphere of rings and sectors with two poles, its vertices off at random. */
static void make_mesh(mesh *m, const place *p)
{
    test_random random = {77};
    for (int i = 0; i < VERTICES; ++i) {
        const int ring = i == VERTICES - 1 ? RINGS : i == 0 ? 0 : 1 + (i - 1) / SECTORS;
        const double a = 3.14159265358979 * ring / RINGS;
        const double b = 2 * 3.14159265358979 * ((i - 1) % SECTORS + 0.5 * (ring % 2)) / SECTORS;
        const double at[3] = {sin(a) * cos(b), cos(a), sin(a) * sin(b)};
        for (int k = 0; k < 3; ++k) {
            const float jitter = test_random_float(&random, -0.02f, 0.02f);
            m->vertices[i][k] = ((float)at[k] + jitter) * p->scale + p->offset[k];
        }
    }
    int count = 0;
    for (int ring = 0; ring < RINGS; ++ring)
        for (int s = 0; s < SECTORS; ++s) {
            const int next = (s + 1) % SECTORS, above = 1 + (ring - 1) * SECTORS,
                      below = 1 + ring * SECTORS;
            const int upper[3] = {ring ? above + s : 0, below + next, below + s};
            const int lower[3] = {above + s, above + next,
                                  ring == RINGS - 1 ? VERTICES - 1 : below + next};
            if (ring < RINGS - 1)
                memcpy(m->triangles[count++], upper, sizeof upper);
            if (ring > 0)
                memcpy(m->triangles[count++], lower, sizeof lower);
        }
    assert_int_equal(count, TRIANGLES);
    m->color_count = 0;
    for (int i = 0; i < TRIANGLES; ++i) {
        bool taken[COLORS] = {false};
        for (int k = 0; k < i; ++k)
            if (touch(m->triangles[i], m->triangles[k]))
                taken[m->colors[k]] = true;
        int color = 0;
        while (taken[color])
            ++color;
        m->colors[i] = color;
        m->color_count = color >= m->color_count ? color + 1 : m->color_count;
        assert_true(m->color_count < COLORS);
    }
}

static void fill_scene(rt_scene *scene, const mesh *m, int color)
{
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const rt_material material = rt_material_make(zero, zero, zero, 1.0f);
    rt_status status = RT_STATUS_INIT;
    rt_scene_init(scene);
    assert_good(rt_scene_add_material(scene, &material, &status), &status);
    for (int i = 0; i < TRIANGLES; ++i) {
        if (m->colors[i] != color)
            continue;
        float p[9];
        for (int k = 0; k < 9; ++k)
            p[k] = m->vertices[m->triangles[i][k / 3]][k % 3];
        rt_triangle t;
        memcpy(&t, p, sizeof t);
        assert_good(rt_scene_add_triangle(scene, &t, NULL, 0, &status), &status);
    }
}

/* Toward points of edges, or vertices, each block of 64 from one origin to neighbours. */
static void fill_rays(const mesh *m, const place *p, rt_ray *rays)
{
    test_random random = {78};
    float origin[3] = {0, 0, 0};
    for (int i = 0; i < RAYS; ++i) {
        if (i % 64 == 0)
            for (int k = 0; k < 3; ++k)
                origin[k] = p->offset[k] + p->scale * test_random_float(&random, -0.3f, 0.3f);
        const int *t = m->triangles[(i / 64 + i % 64 / 16) % TRIANGLES];
        const float *a = m->vertices[t[i % 3]], *b = m->vertices[t[(i + 1) % 3]];
        const float part = i % 4 ? test_random_float(&random, 0.0f, 1.0f) : 0.0f;
        rays[i] = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        for (int k = 0; k < 3; ++k) {
            rays[i].origin[k] = origin[k];
            rays[i].direction[k] = a[k] + part * (b[k] - a[k]) - origin[k];
        }
    }
}

typedef struct tally {
    size_t leaks, doubles;
} tally;

static tally count_hits(const place *p, enum rt_accuracy level, const rt_render_options *options)
{
    mesh m;
    tally t = {0, 0};
    rt_status status = RT_STATUS_INIT;
    rt_ray *rays = malloc(RAYS * sizeof *rays);
    rt_hit *hits = malloc(RAYS * sizeof *hits), *again = malloc(RAYS * sizeof *again);
    unsigned char *counts = calloc(RAYS, 1);
    assert_true(rays && hits && again && counts);
    make_mesh(&m, p);
    fill_rays(&m, p, rays);
    for (int color = 0; color < m.color_count; ++color) {
        rt_scene scene;
        fill_scene(&scene, &m, color);
        scene.accuracy = level;
        rt_renderer *renderer = test_renderer(&scene, options);
        assert_good(rt_renderer_trace(renderer, rays, RAYS, hits, &status), &status);
        rt_renderer_free(renderer);
        if (level != RT_ACCURACY_DOUBLE)
            rt_scalar_float_trace(&scene, rays, RAYS, again);
        for (int i = 0; i < RAYS; ++i)
            counts[i] = (unsigned char)(counts[i] + (hits[i].primitive != RT_MISS));
        if (level != RT_ACCURACY_DOUBLE)
            assert_memory_equal(hits, again, RAYS * sizeof *hits);
        rt_scene_clear(&scene);
    }
    for (int i = 0; i < RAYS; ++i) {
        t.leaks += counts[i] == 0;
        t.doubles += counts[i] > 1;
    }
    free(rays);
    free(hits);
    free(again);
    free(counts);
    return t;
}

static const place places[] = {
    {1.0f, {0, 0, 0}}, {1.0f, {148376, 1234, -223423}}, {1e-6f, {0, 0, 0}}};

static void each_ray_meets_the_mesh_once(void **state)
{
    (void)state;
    static const rt_render_options shapes[] = {
        {.lanes = 0}, {.lanes = 1, .packet = 1}, {.lanes = 4}};
    const int last = test_device()->has_fp64 ? RT_ACCURACY_DOUBLE : RT_ACCURACY_ROBUST;
    for (size_t p = 0; p < sizeof places / sizeof *places; ++p)
        for (int level = RT_ACCURACY_ROBUST; level <= last; ++level)
            for (size_t s = 0; s < sizeof shapes / sizeof *shapes; ++s) {
                test_use_tree(s != 2);
                const tally t = count_hits(&places[p], (enum rt_accuracy)level, &shapes[s]);
                test_use_tree(true);
                if (t.leaks || t.doubles)
                    fail_msg("%s, place %zu, shape %zu: %zu leaks, %zu double hits",
                             rt_accuracy_name((enum rt_accuracy)level), p, s, t.leaks, t.doubles);
            }
}

/* The rays are hard enough: Moller and Trumbore's test lets some through and counts some twice. */
static void standard_is_not_watertight(void **state)
{
    (void)state;
    const rt_render_options options = {0};
    size_t leaks = 0, doubles = 0;
    for (size_t p = 0; p < sizeof places / sizeof *places; ++p) {
        const tally t = count_hits(&places[p], RT_ACCURACY_STANDARD, &options);
        leaks += t.leaks;
        doubles += t.doubles;
    }
    if (leaks < 100 || doubles < 100)
        fail_msg("%zu leaks and %zu double hits only", leaks, doubles);
}

/* Each part of the test is needed. */
static void a_wrong_test_is_noticed(void **state)
{
    (void)state;
    static const test_mutant mutants[] = {MUTANT_RESIDUAL_LEFT_OUT, MUTANT_EDGES_OF_BOTH,
                                          MUTANT_EDGE_TURNED, MUTANT_EDGE_ONE_SIDED};
    const rt_render_options options = {0};
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i += test_is_long() ? 1 : 2) {
        size_t noticed = 0;
        mesh m;
        rt_status status = RT_STATUS_INIT;
        rt_ray *rays = malloc(RAYS * sizeof *rays);
        rt_hit *hits = malloc(2 * RAYS * sizeof *hits);
        assert_true(rays && hits);
        make_mesh(&m, &places[1]);
        fill_rays(&m, &places[1], rays);
        for (int color = 0; color < m.color_count && !noticed; ++color) {
            rt_scene scene;
            fill_scene(&scene, &m, color);
            scene.accuracy = RT_ACCURACY_ROBUST;
            test_mutate_kernels(mutants[i]);
            rt_renderer *renderer = test_renderer(&scene, &options);
            test_restore_kernels();
            assert_good(rt_renderer_trace(renderer, rays, RAYS, hits, &status), &status);
            rt_renderer_free(renderer);
            rt_scalar_float_trace(&scene, rays, RAYS, hits + RAYS);
            noticed = memcmp(hits, hits + RAYS, RAYS * sizeof *hits) != 0;
            rt_scene_clear(&scene);
        }
        free(rays);
        free(hits);
        if (!noticed)
            fail_msg("nobody notices %s", test_mutations[mutants[i]].name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_ray_meets_the_mesh_once),
        cmocka_unit_test(standard_is_not_watertight),
        cmocka_unit_test(a_wrong_test_is_noticed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
