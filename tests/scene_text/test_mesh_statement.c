/* The statement `mesh`: every format through a scene, places computed by hand, whose material a
 * triangle has, and a scene that stays as it was when a mesh is refused. scenes/bad/mesh-*.txt has
 * the messages. */
#define _GNU_SOURCE
#include "support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_file/read.h"

/* One corner on each axis. */
#define AXES "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"

static void assert_triangle(const rt_scene *s, size_t index, rt_triangle expected)
{
    assert_true(index < s->triangle_count);
    assert_memory_equal(&s->triangles[index], &expected, sizeof expected);
}

/* Reads a scene that has warnings or errors; the caller clears both. */
static bool read_scene(rt_scene *s, const char *text, rt_status *status)
{
    const char *path = test_path("scene.txt");
    test_write_text(path, text);
    *status = RT_STATUS_INIT;
    rt_scene_init(s);
    return rt_scene_read(s, path, status);
}

static void every_format(void **state)
{
    (void)state;
    static const float corners[12] = {0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    char stl[134] = {0}, ply[256];
    stl[80] = 1;
    memcpy(stl + 84, corners, 12);
    memcpy(stl + 96, corners + 3, 36);
    test_write_file(test_path("b.stl"), stl, sizeof stl);
    const int header =
        snprintf(ply, sizeof ply,
                 "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                 "property float y\nproperty float z\nelement face 1\n"
                 "property list uchar uchar vertex_indices\nend_header\n");
    memcpy(ply + header, corners + 3, 36);
    memcpy(ply + header + 36, "\3\0\1\2", 4);
    test_write_file(test_path("b.ply"), ply, (size_t)header + 40);
    test_write_text(test_path("a.obj"), AXES);
    test_write_text(test_path("a.ply"),
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                    "end_header\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n");
    test_write_text(test_path("a.stl"),
                    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\n"
                    "vertex 0 0 1\nendloop\nendfacet\nendsolid s\n");
    rt_scene s;
    test_scene(&s, "material m\nmaterial n\nmesh \"a.obj\" material n\nmesh \"a.ply\" material n\n"
                   "mesh \"a.stl\" material n\nmesh \"b.ply\" material n\n"
                   "mesh \"b.stl\" material n\n");
    assert_int_equal(s.triangle_count, 5);
    assert_int_equal(s.normal_count, 0);
    for (size_t i = 0; i < 5; ++i) {
        assert_triangle(&s, i, (rt_triangle){1, 0, 0, 0, 1, 0, 0, 0, 1});
        assert_int_equal(s.triangle_materials[i], 1);
        assert_int_equal(s.triangle_normals[i], -1);
    }
    rt_scene_clear(&s);
}

/* The values are exact: a quarter turn has no rounding in it. */
static void scaled_then_turned_then_moved(void **state)
{
    (void)state;
    test_write_text(test_path("axes.obj"), AXES);
    rt_scene s;
    test_scene(&s, "material m\n"
                   "mesh \"axes.obj\" material m scale 2\n"
                   "mesh \"axes.obj\" material m rotate 90 0 0\n"
                   "mesh \"axes.obj\" material m rotate 0 90 0\n"
                   "mesh \"axes.obj\" material m rotate 0 0 90\n"
                   "mesh \"axes.obj\" material m rotate 90 90 0\n"
                   "mesh \"axes.obj\" translate 10 20 30 scale 2 rotate 90 90 90 material m\n"
                   "mesh \"axes.obj\" material m rotate 0 0 -90\n"
                   "mesh \"axes.obj\" material m rotate 720 -180 450\n");
    assert_triangle(&s, 0, (rt_triangle){2, 0, 0, 0, 2, 0, 0, 0, 2});
    assert_triangle(&s, 1, (rt_triangle){1, 0, 0, 0, 0, 1, 0, -1, 0});
    assert_triangle(&s, 2, (rt_triangle){0, 0, -1, 0, 1, 0, 1, 0, 0});
    assert_triangle(&s, 3, (rt_triangle){0, 1, 0, -1, 0, 0, 0, 0, 1});
    assert_triangle(&s, 4, (rt_triangle){0, 0, -1, 1, 0, 0, 0, -1, 0});
    assert_triangle(&s, 5, (rt_triangle){10, 20, 28, 10, 22, 30, 12, 20, 30});
    assert_triangle(&s, 6, (rt_triangle){0, -1, 0, 1, 0, 0, 0, 0, 1});
    assert_triangle(&s, 7, (rt_triangle){0, -1, 0, -1, 0, 0, 0, 0, -1});
    rt_scene_clear(&s);
    test_scene(&s, "material m\nmesh \"axes.obj\" material m scale 4 rotate 0 0 30\n");
    assert_near(s.triangles[0].ax, 3.4641016151377544, 2.5e-7);
    assert_near(s.triangles[0].ay, 2.0, 2.5e-7);
    assert_near(s.triangles[0].bx, -2.0, 2.5e-7);
    rt_scene_clear(&s);
}

static void normals_turn_with_it(void **state)
{
    (void)state;
    test_write_text(test_path("smooth.obj"),
                    AXES "vn 0 0 8\nvn 0 3 4\nvn -2 0 0\nf 1//1 2//2 3//3\n");
    rt_scene s;
    test_scene(&s, "material m\n\nmesh \"smooth.obj\" rotate 90 0 0 translate 1 2 3 material m\n");
    assert_int_equal(s.triangle_count, 2);
    assert_int_equal(s.triangle_normals[0], -1);
    assert_int_equal(s.triangle_normals[1], 0);
    assert_int_equal(s.normal_count, 1);
    assert_int_equal(s.smooth_place.line, 4);
    const float expected[9] = {0, -1, 0, 0, -0.8f, 0.6f, -1, 0, 0};
    for (int i = 0; i < 9; ++i)
        assert_true(s.normals[i] == expected[i]);
    rt_scene_clear(&s);
}

/* Of the library's materials those in use are in the scene, and `material` stands above them. */
static void materials_of_the_file(void **state)
{
    (void)state;
    test_write_text(test_path("two.mtl"),
                    "newmtl red\nKd 1 0 0\nnewmtl idle\nNs 2.5\n"
                    "newmtl blue\nKa 0 0 0.5\nKd 0 0 1\nKs 0.25 0.5 1\nNs 7\n");
    test_write_text(test_path("two.obj"), "mtllib two.mtl\n" AXES "usemtl blue\nf 1 2 3\n"
                                          "usemtl red\nf 1 2 3\n");
    /* The first face comes before any material. */
    rt_scene s;
    rt_status status;
    assert_false(read_scene(&s, "rt 1\nmaterial m\nmesh \"two.obj\"\n", &status));
    assert_non_null(strstr(status.text, "scene.txt:3:1: error: a triangle of '"));
    assert_non_null(strstr(status.text, "has no material; give 'material' (1 such)\n"));
    assert_int_equal(s.material_count, 1);
    assert_int_equal(s.triangle_count, 0);
    rt_scene_clear(&s);
    rt_status_clear(&status);

    test_write_text(test_path("two.obj"), "mtllib two.mtl\nusemtl blue\n" AXES
                                          "usemtl red\nf 1 2 3\nusemtl blue\nf 2 1 3\n");
    test_scene(&s, "material m\nmesh \"two.obj\"\nmesh \"two.obj\" material m\n"
                   "material red\nsphere center 0 0 0 radius 1 material red\n");
    assert_int_equal(s.material_count, 4);
    const int32_t expected[6] = {1, 2, 1, 0, 0, 0};
    assert_int_equal(s.triangle_count, 6);
    assert_memory_equal(s.triangle_materials, expected, sizeof expected);
    const float half[3] = {0, 0, 0.5f}, blue[3] = {0, 0, 1}, shine[3] = {0.25f, 0.5f, 1};
    const rt_material material = rt_material_make(half, blue, shine, 7);
    assert_memory_equal(&s.materials[1], &material, sizeof material);
    assert_true(s.materials[2].kd_r == 1 && s.materials[2].kd_b == 0);
    assert_int_equal(s.sphere_materials[0], 3); /* the file's names are its own */
    rt_scene_clear(&s);
}

/* Texture coordinates come with the triangles, the pictures that materials name with those. */
static void textures_of_the_file(void **state)
{
    (void)state;
    /* Binary pictures of one pixel: 58 bytes of BMP. */
    static const unsigned char bmp[58] = {'B', 'M', 58, 0, 0, 0, 0, 0, 0, 0,  54, 0, 0, 0,  40,
                                          0,   0,   0,  1, 0, 0, 0, 1, 0, 0,  0,  1, 0, 24, 0,
                                          0,   0,   0,  0, 4, 0, 0, 0, 0, 0,  0,  0, 0, 0,  0,
                                          0,   0,   0,  0, 0, 0, 0, 0, 0, 10, 20, 30};
    test_write_file(test_path("dot.bmp"), bmp, sizeof bmp);
    test_write_text(test_path("uv.mtl"), "newmtl a\nKd 1 1 1\nmap_Kd dot.bmp\nnewmtl b\n"
                                         "map_Kd none.png\nnewmtl c\nmap_Kd idle.png\n");
    test_write_text(test_path("uv.obj"), "mtllib uv.mtl\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\n" AXES
                                         "f 1/1 2/2 3/3\nusemtl b\nf 1/3 2/2 3/1\n");
    rt_scene s;
    rt_status status;
    assert_true(
        read_scene(&s, "rt 1\nmaterial m\nmesh \"uv.obj\"\nmesh \"uv.obj\" material m\n", &status));
    assert_int_equal(s.texture_count, 1);
    assert_int_equal(s.texels[0], 0x0a141e);
    assert_int_equal(s.materials[1].texture, 0);
    assert_int_equal(s.materials[2].texture, -1);
    assert_int_equal(s.material_places[1].line, 3);
    const int32_t records[6] = {-1, 0, 1, -1, 2, 3};
    assert_memory_equal(s.triangle_uvs, records, sizeof records);
    const float second[RT_UV_COMPONENTS] = {0, 1, 1, 0, 0, 0};
    assert_memory_equal(s.uvs + RT_UV_COMPONENTS, second, sizeof second);
    assert_non_null(strstr(status.text, "scene.txt:3:1: warning: the texture '"));
    assert_non_null(strstr(status.text, "none.png' of material 'b' is left out: No such file"));
    assert_null(strstr(status.text, "idle.png"));
    rt_scene_clear(&s);
    rt_status_clear(&status);
}

static void paths_are_relative_to_their_file(void **state)
{
    (void)state;
    char command[300];
    snprintf(command, sizeof command, "mkdir -p %s/parts/meshes", test_folder());
    assert_int_equal(test_run(command, NULL, 0), 0);
    test_write_text(test_path("parts/meshes/a.mtl"), "newmtl red\nKd 1 0 0\n");
    test_write_text(test_path("parts/meshes/a.obj"), "mtllib a.mtl\nusemtl red\n" AXES);
    test_write_text(test_path("parts/mesh.txt"), "mesh \"meshes/a.obj\"\n");
    char *text = NULL;
    assert_true(asprintf(&text, "include \"parts/mesh.txt\"\nmesh \"%s\"\n",
                         test_path("parts/meshes/a.obj")) > 0);
    rt_scene s;
    test_scene(&s, text);
    free(text);
    assert_int_equal(s.triangle_count, 2);
    assert_int_equal(s.material_count, 2);
    rt_scene_clear(&s);
}

static void triangles_without_area_are_counted(void **state)
{
    (void)state;
    test_write_text(test_path("flat.obj"), AXES "v 2 0 0\nf 1 1 2\nf 1 2 3\nf 4 1 4\n");
    rt_scene s;
    rt_status status;
    assert_true(read_scene(&s,
                           "rt 1\nmaterial m\nmesh \"flat.obj\" material m scale 3\n"
                           "triangle a 0 0 0 b 1 1 1 c 2 2 2 material m\n",
                           &status));
    assert_int_equal(s.triangle_count, 5); /* indices stay */
    assert_triangle(&s, 1, (rt_triangle){3, 0, 0, 3, 0, 0, 3, 0, 0});
    assert_triangle(&s, 2, (rt_triangle){3, 0, 0, 0, 3, 0, 0, 0, 3});
    assert_triangle(&s, 3, (rt_triangle){6, 0, 0, 6, 0, 0, 6, 0, 0});
    assert_non_null(strstr(status.text, "scene.txt:3:1: warning: the triangle has no area"));
    assert_non_null(strstr(status.text, "(3 such)\n"));
    rt_scene_clear(&s);
    rt_status_clear(&status);
}

static void a_refused_mesh_leaves_nothing(void **state)
{
    (void)state;
    test_write_text(test_path("good.obj"), AXES);
    test_write_text(test_path("red.mtl"), "newmtl red\nKd 1 0 0\n");
    test_write_text(test_path("cut.obj"),
                    "mtllib red.mtl\nusemtl red\n" AXES "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 2\n");
    rt_scene s;
    rt_status status;
    assert_false(read_scene(&s,
                            "rt 1\nmaterial m\nmesh \"good.obj\" material m\nmesh \"cut.obj\"\n"
                            "mesh \"good.obj\" material m\n",
                            &status));
    assert_int_equal(status.errors, 2);
    assert_non_null(strstr(status.text, "cut.obj:9:6: error: the line ends; 'f' takes three"));
    assert_non_null(strstr(status.text, "scene.txt:4:6: error: cannot take the mesh '"));
    assert_int_equal(s.triangle_count, 2);
    assert_int_equal(s.material_count, 1);
    assert_int_equal(s.normal_count, 0);
    assert_int_equal(s.smooth_place.line, 0);
    rt_scene_clear(&s);
    rt_status_clear(&status);
}

static void the_scene_to_look_at(void **state)
{
    (void)state;
    rt_scene s;
    test_scene_file(&s, "scenes/mesh.txt");
    assert_int_equal(s.triangle_count, 3 * 1440);
    assert_int_equal(s.normal_count, 3 * 1440);
    assert_int_equal(s.material_count, 4);
    rt_scene_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format),
        cmocka_unit_test(scaled_then_turned_then_moved),
        cmocka_unit_test(normals_turn_with_it),
        cmocka_unit_test(materials_of_the_file),
        cmocka_unit_test(textures_of_the_file),
        cmocka_unit_test(paths_are_relative_to_their_file),
        cmocka_unit_test(triangles_without_area_are_counted),
        cmocka_unit_test(a_refused_mesh_leaves_nothing),
        cmocka_unit_test(the_scene_to_look_at),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
