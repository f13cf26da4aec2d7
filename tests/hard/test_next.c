/* Rays that start on a surface: rows 18 and 21 to 23 of the hard cases, by whole pictures whose
 * truth is known: what must be lit, and what must be dark. */
#include "hard/mesh.h"
#include "hard/naive.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TOLD HARD_REPORT

/* The constant that one finds in textbooks. */
static const hard_naive fixed_offset = {.mutant = MUTANT_FIXED_OFFSET};

typedef bool pixel_fn(const float rgb[3]);

static bool is_dark(const float rgb[3])
{
    return !(rgb[1] > 0.0f);
}

static bool is_lit(const float rgb[3])
{
    return !(rgb[1] == 0.0f);
}

static bool is_not_white(const float rgb[3])
{
    return !(fabsf(rgb[1] - 1.0f) < 1e-4f);
}

/* Pixels, of those that hit something, for which `is_wrong`, a million. */
static double wrong_pixels(const hard_way *way, rt_scene *scene, pixel_fn *is_wrong)
{
    rt_image image;
    size_t wrong = 0, hit = 0;
    hard_draw(way, scene, &image);
    for (size_t i = 0; i < (size_t)image.width * (size_t)image.height; ++i) {
        hit += image.hits[i].primitive != RT_MISS;
        wrong += image.hits[i].primitive != RT_MISS && is_wrong(image.rgb + 3 * i);
    }
    assert_true(hit > 0);
    rt_image_clear(&image);
    return hard_per_million(wrong, hit);
}

/* ---- Spheres ---- */

static void measure_sphere(const hard_way *way, const void *of, double figures[])
{
    const double r = *(const double *)of;
    rt_scene scene;
    /* The light is where the eye is: what is seen is lit. */
    hard_read(&scene,
              "image width 256 height 256\ncamera from 0 0 %.9g at 0 0 0 vfov 50\n"
              "light point at 0 0 %.9g shadow on\nmaterial m kd 1 1 1\n"
              "sphere center 0 0 0 radius %.9g material m\n",
              3.0 * r, 3.0 * r, r);
    figures[0] = wrong_pixels(way, &scene, is_dark);
    rt_scene_clear(&scene);
    /* Glass as dense as air: in at the front, out at the far root, and nothing left for a third
     * surface. */
    hard_read(&scene,
              "image width 256 height 256\ncamera from 0 0 %.9g at 0 0 0 vfov 50\n"
              "background 1 1 1\ndepth 2\nmaterial m transmit 1 ior 1\n"
              "sphere center 0 0 0 radius %.9g material m\n",
              3.0 * r, r);
    figures[1] = wrong_pixels(way, &scene, is_not_white);
    rt_scene_clear(&scene);
}

static void spheres(void **state)
{
    (void)state;
    static const double radii[] = {1e-3, 1.0, 1e3, 1e6};
    for (int i = 0; i < 4; ++i) {
        char name[64];
        snprintf(name, sizeof name, "next rays from a sphere of radius %g", radii[i]);
        const hard_case c = {.row = 18,
                             .name = name,
                             .figures = {{"self-hits outward a million", {10, 10, 0, 0}},
                                         {"wrong roots inward a million", {10, 10, 0, 0}}},
                             .naives = {&hard_naive_no_offset},
                             .measure = measure_sphere,
                             .of = &radii[i]};
        hard_hold(&c);
    }
    hard_finish();
}

/* ---- Meshes in their own shadow ---- */

typedef struct place {
    double center, size;
} place;

static void measure_self_shadow(const hard_way *way, const void *of, double figures[])
{
    const place *p = of;
    const double eye = (double)(float)(p->center + 3.0 * p->size);
    rt_scene scene;
    hard_mesh mesh;
    hard_read(&scene,
              "image width 256 height 256\ncamera from %.9g %.9g %.9g at %.9g %.9g %.9g vfov 25\n"
              "light point at %.9g %.9g %.9g shadow on\nmaterial m kd 1 1 1\n",
              eye, eye, eye, p->center, p->center, p->center, eye, eye, eye);
    hard_mesh_ball(&mesh, 10, (const double[3]){p->center, p->center, p->center}, p->size);
    hard_mesh_fill(&scene, &mesh, -1, 0);
    figures[0] = wrong_pixels(way, &scene, is_dark);
    hard_mesh_clear(&mesh);
    rt_scene_clear(&scene);
}

static void self_shadow(void **state)
{
    (void)state;
    static const place places[] = {{0, 1e-5}, {0, 1e-2}, {0, 1}, {0, 1e3}, {0, 1e5}, {1e5, 10}};
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        char name[64];
        snprintf(name, sizeof name, "a mesh of size %g at %g, lit from the eye", places[i].size,
                 places[i].center);
        const hard_case c = {
            .row = 21,
            .name = name,
            .figures = {{"shadowed by itself a million", {100, 100, 0, 0}}},
            .naives = {&hard_naive_no_offset, places[i].size > 100 ? &fixed_offset : NULL},
            .measure = measure_self_shadow,
            .of = &places[i]};
        hard_hold(&c);
    }
    hard_finish();
}

/* ---- Light that must not come through ---- */

/* The eye is between two plates; the lamp is above both. */
static void measure_plates(const hard_way *way, const void *of, double figures[])
{
    const double size = *(const double *)of, gap = 1e-5 * size;
    rt_scene scene;
    hard_read(&scene,
              "image width 256 height 256\ncamera from %.9g 0 %.9g at 0 0 %.9g up 0 0 1 vfov 60\n"
              "light point at %.9g %.9g %.9g shadow on\nmaterial m kd 1 1 1\n",
              -0.1 * size, 0.5 * gap, 0.5 * gap, 0.3 * size, 0.2 * size, 3.0 * size);
    for (int plate = 0; plate < 2; ++plate) {
        const float z = (float)(plate ? gap : 0.0), s = (float)size;
        hard_add_triangle(&scene, (const float[9]){-s, -s, z, s, -s, z, s, s, z});
        hard_add_triangle(&scene, (const float[9]){-s, -s, z, s, s, z, -s, s, z});
    }
    rt_image image;
    hard_draw(way, &scene, &image);
    size_t lit = 0, below = 0;
    for (size_t i = 0; i < (size_t)image.width * (size_t)image.height; ++i)
        if (image.hits[i].primitive == 0 || image.hits[i].primitive == 1) {
            ++below;
            lit += is_lit(image.rgb + 3 * i);
        }
    assert_true(below > 0);
    figures[0] = hard_per_million(lit, below);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

static void plates(void **state)
{
    (void)state;
    /* Other than at size 1 the constant offset is no naive variant: a small scene's unit makes it
     * one that fits. */
    static const double sizes[] = {1.0, 1e-3, 1e4};
    for (int i = 0; i < 3; ++i) {
        char name[64];
        snprintf(name, sizeof name, "plates of size %g at a gap of 1e-5 of it", sizes[i]);
        const hard_case c = {.row = 22,
                             .name = name,
                             .figures = {{"lit through the upper a million", {TOLD, TOLD, 0, 0}}},
                             .naives = {i ? NULL : &fixed_offset},
                             .measure = measure_plates,
                             .of = &sizes[i]};
        hard_hold(&c);
    }
    hard_finish();
}

static void measure_sealed(const hard_way *way, const void *of, double figures[])
{
    (void)of;
    rt_scene scene;
    hard_mesh mesh;
    hard_read(&scene, "image width 256 height 256\ncamera from 0 0 0 at 1 0.5 0.25 vfov 120\n"
                      "light point at 3 2 1 shadow on\nmaterial m kd 1 1 1\n");
    hard_mesh_ball(&mesh, 10, (const double[3]){0, 0, 0}, 1.0);
    hard_mesh_fill(&scene, &mesh, -1, 0);
    figures[0] = wrong_pixels(way, &scene, is_lit);
    hard_mesh_clear(&mesh);
    rt_scene_clear(&scene);
}

static void measure_sealed_edges(const hard_way *way, const void *of, double figures[])
{
    static rt_ray rays[HARD_CHUNK];
    const double center[3] = {0, 0, 0};
    (void)of;
    for (int aim = 0; aim < 2; ++aim) {
        rt_scene scene;
        hard_mesh mesh;
        hard_mesh_ball(&mesh, 10, center, 1.0);
        hard_scene(&scene);
        hard_mesh_fill(&scene, &mesh, -1, 0);
        hard_mesh_aim(&mesh, aim ? HARD_AIM_VERTICES : HARD_AIM_EDGES, 0, HARD_CHUNK, rays);
        figures[aim] = hard_per_million(hard_open_rays(way, &scene, rays, HARD_CHUNK), HARD_CHUNK);
        hard_mesh_clear(&mesh);
        rt_scene_clear(&scene);
    }
}

static void sealed(void **state)
{
    (void)state;
    static const hard_naive moller_strict = {.mutant = MUTANT_EDGES_LEFT_OUT};
    const hard_case rooms = {.row = 23,
                             .name = "inside a sealed mesh, the lamp outside",
                             .figures = {{"lit a million", {1, 1, 0, 0}}},
                             .naives = {&moller_strict},
                             .measure = measure_sealed};
    hard_hold(&rooms);
    const hard_case edges = {.row = 23,
                             .name = "shadow rays from inside a sealed mesh",
                             .figures = {{"open at edges a million", {TOLD, TOLD, 0, 0}},
                                         {"open at vertices a million", {TOLD, TOLD, 0, 0}}},
                             .naives = {&moller_strict},
                             .measure = measure_sealed_edges};
    hard_hold(&edges);
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(spheres), cmocka_unit_test(self_shadow),
                                       cmocka_unit_test(plates), cmocka_unit_test(sealed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
