/* The native format: every statement's values, every way of writing a line, and the table that
 * describes it. */
#define _GNU_SOURCE
#include "support/support.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_text/grammar.h"
#include "scene_file/read.h"

static void assert_vector(rt_vec3 v, float x, float y, float z)
{
    assert_true(v.x == x && v.y == y && v.z == z);
}

static void defaults(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "");
    assert_int_equal(s.width, 512);
    assert_int_equal(s.height, 512);
    assert_vector(s.camera.from, 0, 0, 0);
    assert_vector(s.camera.at, 0, 0, -1);
    assert_vector(s.camera.up, 0, 1, 0);
    assert_true(s.camera.vfov == 90.0f);
    assert_vector(s.background, 0, 0, 0);
    assert_vector(s.ambient, 0, 0, 0);
    assert_int_equal(s.cull, RT_CULL_NONE);
    assert_int_equal(s.light_count + s.material_count + s.sphere_count + s.triangle_count, 0);
    rt_scene_clear(&s);
}

static void every_statement(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "image width 640 height 480\n"
                   "camera from 1 2 3 at 4 5 6 up 0 0 1 vfov 35.5\n"
                   "background 0.25 0.5 3\nambient 0.125 0 2\n"
                   "light point at -1 2.5 1e3 color 4 5 6\n"
                   "light directional direction 0 -3 0 color 0.5 0.25 0.125\n"
                   "light point at 0 0 0\n"
                   "material red ka 0.1 0.2 0.3 kd 0.4 0.5 0.6 ks 0.7 0.8 0.9 shininess 32\n"
                   "material \"dull green\" kd 0 1 0 shininess 2.5\n"
                   "sphere center 1 2 3 radius 0.5 material red\n"
                   "triangle a 1 2 3 b 4 5 6 c 7 8 10 material \"dull green\"\n"
                   "triangle a 0 0 0 b 1 0 0 c 0 1 0 material red na 1 2 3 nb 4 5 6 nc 7 8 9\n"
                   "cull front winding cw\n");
    assert_int_equal(s.width, 640);
    assert_int_equal(s.height, 480);
    assert_vector(s.camera.from, 1, 2, 3);
    assert_vector(s.camera.at, 4, 5, 6);
    assert_vector(s.camera.up, 0, 0, 1);
    assert_true(s.camera.vfov == 35.5f);
    assert_vector(s.background, 0.25f, 0.5f, 3);
    assert_vector(s.ambient, 0.125f, 0, 2);
    assert_int_equal(s.light_count, 3);
    const rt_light lights[3] = {{-1, 2.5f, 1000, 1, 4, 5, 6, 0, 0, 1, 0, 0},
                                {-0.0f, 1, -0.0f, 0, 0.5f, 0.25f, 0.125f, 0, 0, 1, 0, 0},
                                {0, 0, 0, 1, 1, 1, 1, 0, 0, 1, 0, 0}};
    assert_memory_equal(s.lights, lights, sizeof lights);
    assert_int_equal(s.material_count, 2);
    assert_true(s.materials[0].ka_g == 0.2f && s.materials[0].kd_b == 0.6f &&
                s.materials[0].ks_r == 0.7f && s.materials[0].exponent == 32);
    assert_true(s.materials[1].exponent == -1 && s.materials[1].shininess == 2.5f);
    assert_int_equal(s.sphere_count, 1);
    const rt_sphere sphere = {1, 2, 3, 0.5f};
    assert_memory_equal(&s.spheres[0], &sphere, sizeof sphere);
    assert_int_equal(s.sphere_materials[0], 0);
    assert_int_equal(s.triangle_count, 2);
    const rt_triangle triangle = {1, 2, 3, 4, 5, 6, 7, 8, 10};
    assert_memory_equal(&s.triangles[0], &triangle, sizeof triangle);
    assert_int_equal(s.triangle_materials[0], 1);
    assert_int_equal(s.triangle_normals[0], -1);
    assert_int_equal(s.triangle_normals[1], 0);
    for (int i = 0; i < 9; ++i)
        assert_true(s.normals[i] == (float)(i + 1) / 8.0f); /* 9 brought to [1, 2) */
    assert_int_equal(s.cull, RT_CULL_FRONT);
    assert_int_equal(s.winding, RT_WINDING_CW);
    assert_int_equal(s.cull_place.line, 14);
    assert_int_equal(s.smooth_place.line, 13);
    rt_scene_clear(&s);
}

static void every_statement_of_an_effect(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "image samples 16 filter tent\ncamera aperture 0.25 focus 3\n"
                   "background 0.1 0.2 0.3 top 0.4 0.5 6\nfog 0.5 0.25 0.125 density 0.75\n"
                   "occlusion distance 2.5\ndepth 0\n");
    assert_int_equal(s.samples, 16);
    assert_int_equal(s.filter, RT_FILTER_TENT);
    assert_true(s.camera.aperture == 0.25f && s.camera.focus == 3.0f);
    assert_true(s.has_gradient);
    assert_vector(s.background, 0.1f, 0.2f, 0.3f);
    assert_vector(s.background_top, 0.4f, 0.5f, 6);
    assert_vector(s.fog, 0.5f, 0.25f, 0.125f);
    assert_true(s.fog_density == 0.75f);
    assert_int_equal(s.occlusion_samples, 16);
    assert_true(s.occlusion_distance == 2.5f);
    assert_int_equal(s.depth, 0);
    rt_scene_clear(&s);
    test_scene(&s, "");
    assert_int_equal(s.samples, 1);
    assert_int_equal(s.filter, RT_FILTER_BOX);
    assert_true(s.camera.aperture == 0.0f && s.camera.focus == 0.0f);
    assert_false(s.has_gradient);
    assert_true(s.fog_density == 0.0f);
    assert_int_equal(s.occlusion_samples, 0);
    assert_int_equal(s.depth, 32);
    rt_scene_clear(&s);
}

static void materials_beyond_phong(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "material a reflect 0.25 transmit 0.75 ior 1.25 absorb 1 2 3\n"
                   "material b checker 0.1 0.2 0.3 cell 4\nmaterial c checker 0 0 0\n"
                   "material d reflect 0.9 transmit 0.1\n");
    const rt_material *m = s.materials;
    assert_true(m[0].reflect == 0.25f && m[0].transmit == 0.75f && m[0].ior == 1.25f);
    assert_true(m[0].absorb_r == 1 && m[0].absorb_g == 2 && m[0].absorb_b == 3);
    assert_true(m[0].cell == 0 && m[0].texture == -1);
    assert_true(m[1].reflect == 0 && m[1].transmit == 0 && m[1].ior == 1.5f && m[1].absorb_b == 0);
    assert_true(m[1].checker_r == 0.1f && m[1].checker_b == 0.3f && m[1].cell == 4);
    assert_true(m[2].checker_r == 0 && m[2].cell == 1);
    for (int i = 0; i < 4; ++i)
        assert_int_equal(s.material_places[i].line, 2 + i);
    rt_scene_clear(&s);
}

/* `shadows` counts for every light that does not say otherwise, above it and below. */
static void whose_shadows(void **state)
{
    (void)state;
    static const char *const lights = "light point at 0 1 0\nlight point at 0 2 0 shadow off\n"
                                      "light point at 0 3 0 shadow on radius 2 samples 9\n";
    static const struct {
        const char *statement;
        int shadow;
    } cases[] = {{"", 0}, {"shadows off\n", 0}, {"shadows on\n", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[400];
        rt_scene s;
        snprintf(text, sizeof text, "%s%slight directional direction 0 -1 0\n", lights,
                 cases[i].statement);
        test_scene(&s, text);
        const int expected[4] = {cases[i].shadow, 0, 1, cases[i].shadow};
        for (int k = 0; k < 4; ++k)
            assert_int_equal(s.lights[k].shadow, expected[k]);
        assert_true(s.lights[2].radius == 2.0f && s.lights[0].radius == 0.0f);
        assert_int_equal(s.lights[2].samples, 9);
        assert_int_equal(s.lights[0].samples, 1);
        rt_scene_clear(&s);
    }
    rt_scene s;
    test_scene(&s, "light point at 0 0 0 radius 0.5\nlight point at 0 0 0 samples 7\n");
    assert_int_equal(s.lights[0].samples, 16);
    assert_int_equal(s.lights[1].samples, 1);
    rt_scene_clear(&s);
}

static void triangles_with_texture_coordinates(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "material m\ntriangle a 0 0 0 b 1 0 0 c 0 1 0 material m\n"
                   "triangle a 0 0 0 b 1 0 0 c 0 1 0 material m tc 5 6 ta 1 2 tb 3 -4\n"
                   "triangle a 0 0 0 b 1 0 0 c 0 1 0 material m ta 0 0 tb 1 0 tc 0 1\n");
    assert_int_equal(s.triangle_uvs[0], -1);
    assert_int_equal(s.triangle_uvs[1], 0);
    assert_int_equal(s.triangle_uvs[2], 1);
    assert_int_equal(s.uv_count, 2);
    const float expected[RT_UV_COMPONENTS] = {1, 2, 3, -4, 5, 6};
    assert_memory_equal(s.uvs, expected, sizeof expected);
    rt_scene_clear(&s);
}

static void pairs_in_any_order(void **state)
{
    (void)state;
    rt_scene s;
    test_scene(&s, "material m shininess 4 ks 1 1 1 ka 0.5 0.5 0.5\n"
                   "sphere material m radius 2 center 1 2 3\n");
    const rt_sphere sphere = {1, 2, 3, 2};
    assert_memory_equal(&s.spheres[0], &sphere, sizeof sphere);
    assert_true(s.materials[0].exponent == 4 && s.materials[0].ka_r == 0.5f);
    rt_scene_clear(&s);
}

/* The same scene however its text is laid out. */
static void layout_does_not_matter(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "rt 1\nmaterial m\nsphere center 1 2 3 radius 4 material m\n",
        "rt 1\r\nmaterial m\r\nsphere center 1 2 3 radius 4 material m\r\n",
        "\xef\xbb\xbfrt 1\nmaterial m\nsphere center 1 2 3 radius 4 material m",
        "\n\n# a comment\n\trt\t1 # another\n material m#\n\n\tsphere   center +1 2. 3e0\tradius "
        "4.0 "
        "material \"m\" # sphere\n   ",
        "rt 1\nmaterial m\nsphere center 1 2 3 radius 4 material m#no blank before",
    };
    const rt_sphere sphere = {1, 2, 3, 4};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        rt_scene s;
        const char *path = test_path("layout.txt");
        test_write_text(path, texts[i]);
        test_scene_file(&s, path);
        assert_int_equal(s.sphere_count, 1);
        assert_memory_equal(&s.spheres[0], &sphere, sizeof sphere);
        rt_scene_clear(&s);
    }
}

static void lines_of_ten_megabytes(void **state)
{
    (void)state;
    const size_t length = 10u << 20;
    char *text = malloc(length);
    assert_non_null(text);
    memset(text, ' ', length);
    memcpy(text, "rt 1\nmaterial m\nsphere center 1 2 3", 35);
    memcpy(text + length - 21, " radius 4 material m\n", 21);
    const char *path = test_path("long.txt");
    test_write_file(path, text, length);
    rt_scene s;
    test_scene_file(&s, path);
    assert_int_equal(s.sphere_count, 1);
    rt_scene_clear(&s);
    /* One token that is as long is an error that does not print it whole. */
    memset(text + 35, 'x', length - 35);
    test_write_file(path, text, length);
    rt_status status = RT_STATUS_INIT;
    rt_scene_init(&s);
    assert_false(rt_scene_read(&s, path, &status));
    assert_true(status.length < 1000);
    rt_scene_clear(&s);
    rt_status_clear(&status);
    free(text);
}

static void includes_are_relative_to_their_file(void **state)
{
    (void)state;
    char command[300];
    snprintf(command, sizeof command, "mkdir -p %s/parts/more", test_folder());
    assert_int_equal(test_run(command, NULL, 0), 0);
    test_write_text(test_path("parts/materials.txt"), "rt 1\nmaterial m\ninclude \"more/s.txt\"\n");
    test_write_text(test_path("parts/more/s.txt"), "sphere center 0 0 0 radius 1 material m");
    rt_scene s;
    test_scene(&s, "include \"parts/materials.txt\"\nsphere center 0 0 0 radius 2 material m\n");
    assert_int_equal(s.sphere_count, 2);
    assert_true(s.spheres[1].radius == 2.0f);
    assert_int_equal(s.file_count, 3);
    rt_scene_clear(&s);
}

static void a_triangle_without_area_is_told(void **state)
{
    (void)state;
    const char *text = "rt 1\nmaterial m\n"
                       "triangle a 0 0 0 b 1 1 1 c 2 2 2 material m\n"
                       "triangle a 0 0 0 b 1 0 0 c 0 1 0 material m\n"
                       "triangle a 1 0 0 b 1 0 0 c 0 1 0 material m\n";
    const char *path = test_path("flat.txt");
    test_write_text(path, text);
    rt_status status = RT_STATUS_INIT;
    rt_scene s;
    rt_scene_init(&s);
    assert_true(rt_scene_read(&s, path, &status));
    assert_int_equal(s.triangle_count, 3); /* indices stay */
    assert_non_null(strstr(status.text, "flat.txt:3:1: warning: the triangle has no area"));
    assert_non_null(strstr(status.text, "(2 such)"));
    rt_scene_clear(&s);
    rt_status_clear(&status);
}

/* The table of scenes/README.md is the parser's own. */
static void the_readme_has_the_grammar(void **state)
{
    (void)state;
    char *grammar = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&grammar, &size);
    assert_non_null(stream);
    rt_grammar_print(stream);
    fclose(stream);
    char *readme = test_read_file("scenes/README.md", NULL);
    assert_non_null(readme);
    if (!strstr(readme, grammar))
        fail_msg("scenes/README.md's table is not what ./rt --grammar prints");
    free(grammar);
    free(readme);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults),
        cmocka_unit_test(every_statement),
        cmocka_unit_test(every_statement_of_an_effect),
        cmocka_unit_test(materials_beyond_phong),
        cmocka_unit_test(whose_shadows),
        cmocka_unit_test(triangles_with_texture_coordinates),
        cmocka_unit_test(pairs_in_any_order),
        cmocka_unit_test(layout_does_not_matter),
        cmocka_unit_test(lines_of_ten_megabytes),
        cmocka_unit_test(includes_are_relative_to_their_file),
        cmocka_unit_test(a_triangle_without_area_is_told),
        cmocka_unit_test(the_readme_has_the_grammar),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
