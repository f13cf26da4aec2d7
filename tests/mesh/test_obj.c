#define _GNU_SOURCE
#include "support/mesh_files.h"

static void obj_variants(void **state)
{
    (void)state;
    rt_mesh mesh = GOOD("\xef\xbb\xbf# comment\r\n"
                        "o thing\r\n"
                        "v 0 0 0 1.0\r\n"
                        "\tv  4e0 -0.5 +.25 # w and colours may follow\r\n"
                        "v 4 4 0 0.1 0.2 0.3\r\n"
                        "vt 0 0\r\nvn 0 0 1\r\nvp 1\r\n"
                        "g a b\r\ns off\r\nl 1 2\r\np 1\r\nwhatever 9\r\n"
                        "f 1 2 3\r\n"
                        "f 1/1 2/1 3/1 # comment\r\n"
                        "f 1//1 2//1 3//1\r\n"
                        "f 1/1/1 2/1/1 \\\r\n 3/1/1\r\n"
                        "f 1/ 2// 3//\r\n"
                        "f -3 -2//-1 -1/-1/-1");
    CORNERS(mesh, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2);
    NORMALS(mesh, -1, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, -1, -1);
    FLOATS(mesh.positions, 0, 0, 0, 4, -0.5, 0.25, 4, 4, 0);
    FLOATS(mesh.normals, 0, 0, 1);
    assert_int_equal(mesh.materials[5], -1);
    rt_mesh_clear(&mesh);
    assert_empty(&mesh);
}

static void obj_texture_coordinates(void **state)
{
    (void)state;
    rt_mesh mesh = GOOD(SQUARE "vt 0.25\nvt 1 -2\nvt 3 4 5\nvn 0 0 1\nf 1/1 2/2 3/3\n"
                               "f 1/1/1 2/2/1 3/-1/1\nf 1/1 2/2 3\nf 1/2 2/4 3/3\nvt 7 8\n"
                               "f 1/4 2/3 3/2 4/1\n");
    static const int32_t expected[] = {0, 1, 2, 0, 1, 2, -1, -1, -1, 1, 3, 2, 3, 2, 1, 3, 1, 0};
    assert_indices(mesh.uv_corners, 3 * mesh.triangle_count, expected, 18);
    FLOATS(mesh.uvs, 0.25, 0, 1, -2, 3, 4, 7, 8);
    NORMALS(mesh, -1, -1, -1, 0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
    const double mirror[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    assert_null(rt_mesh_transform(&mesh, mirror));
    static const int32_t turned[] = {0, 2, 1};
    assert_indices(mesh.uv_corners, 3, turned, 3);
    rt_mesh_clear(&mesh);
    /* Indices into nothing are left over from a program that dropped what they name. */
    mesh = GOOD(SQUARE "f 1/7 2/8 3/9\nf 1/-1 2/-1 3/-1\n");
    assert_null(mesh.uvs);
    assert_null(mesh.uv_corners);
    rt_mesh_clear(&mesh);
    BAD(SQUARE "vt 0 0\nf 1/1 2/2 3/1\n", ":6:7: error: found '2/2'; texture coordinates go from "
                                          "1 to 1, or from -1 to -1 here");
    BAD(SQUARE "vt 0 0\nf 1/1 2/-2 3/1\n", ":6:7: error: found '2/-2'; texture coordinates go from "
                                           "1 to 1, or from -1 to -1 here");
    BAD("vt\n", ":1:3: error: the line ends; 'vt' takes one to three numbers");
    BAD("vt 0 x\n", ":1:6: error: found 'x'; 'vt' takes one to three numbers");
}

static void obj_polygons(void **state)
{
    (void)state;
    rt_mesh mesh = GOOD(SQUARE "v 1 1 0\nvn 0 0 1\nvn 0 1 0\nf 1 2 3 4\nf 1//1 2//2 5//1 4//2\n");
    /* The second one is an arrowhead, which a fan from its first corner would turn inside out. */
    CORNERS(mesh, 0, 1, 2, 0, 2, 3, 0, 1, 4, 0, 4, 3);
    rt_mesh_clear(&mesh);
    mesh = GOOD(SQUARE "v 1 1 0\nf 2 5 4 1\n");
    CORNERS(mesh, 4, 3, 0, 4, 0, 1);
    rt_mesh_clear(&mesh);
}

/* Indices from the end count the vertices above; those from the start may name one below. */
static void obj_order(void **state)
{
    (void)state;
    rt_mesh mesh = GOOD("v 9 9 9\nf 2 3 4 5\nf -1 -1 -1\nv 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n"
                        "f -4 -3 -2\n");
    CORNERS(mesh, 1, 2, 3, 1, 3, 4, 0, 0, 0, 1, 2, 3);
    assert_int_equal(mesh.vertex_count, 5);
    rt_mesh_clear(&mesh);
    mesh = GOOD("f 1//1 2//1 3//1\nv 0 0 0\nv 4 0 0\nv 1 1 0\nvn 0 0 2\n");
    NORMALS(mesh, 0, 0, 0);
    assert_int_equal(mesh.normal_count, 1);
    rt_mesh_clear(&mesh);
    BAD("f 1 2 3\n# below\n  f 1 2 5\nv 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 6\n",
        ":3:9: error: found '5'; vertices go from 1 to 3");
}

static void obj_errors(void **state)
{
    (void)state;
    BAD("", ":1:1: error: the file is empty; a mesh is OBJ, PLY or STL");
    BAD("hello\n", ":1:1: error: no line begins with 'v', so this is no OBJ; a mesh is OBJ, PLY or "
                   "STL");
    BAD("v 1 2\n", ":1:6: error: the line ends; 'v' takes three numbers");
    BAD("v 1 2", ":1:6: error: the file ends; 'v' takes three numbers");
    BAD("v 1 2 x3\n", ":1:7: error: found 'x3'; 'v' takes three numbers");
    BAD("v nan 2 3\n", ":1:3: error: found 'nan'; 'v' takes three numbers");
    BAD("v 1 1e39 3\n", ":1:5: error: found '1e39'; 'v' takes three numbers");
    BAD("vn inf 2 3\n", ":1:4: error: found 'inf'; 'vn' takes three numbers");
    BAD(SQUARE "f 1 2\n", ":5:6: error: the line ends; 'f' takes three corners or more");
    BAD(SQUARE "f 1 2 0\n", ":5:7: error: found '0'; vertices go from 1 to 4, or from -4 to -1 "
                            "here");
    BAD(SQUARE "f 1 2 5\n", ":5:7: error: found '5'; vertices go from 1 to 4, or from -4 to -1 "
                            "here");
    BAD(SQUARE "f 1 2 -5\n", ":5:7: error: found '-5'; vertices go from 1 to 4, or from -4 to -1 "
                             "here");
    BAD(SQUARE "f 1 2 99999999999999999999\n", ":5:7: error: found '99999999999999999999'; "
                                               "vertices go from 1 to 4, or from -4 to -1 here");
    BAD(SQUARE "f 1 2 3//1\n", ":5:7: error: found '3//1'; the file has no normals");
    BAD(SQUARE "vn 0 0 1\nf 1 2 3//2\n",
        ":6:7: error: found '3//2'; normals go from 1 to 1, or from -1 to -1 here");
    BAD(SQUARE "f 1 2 3.5\n", ":5:7: error: found '3.5'; a corner of 'f' takes vertex, "
                              "vertex/texture, vertex//normal or all three");
    BAD(SQUARE "f 1 2 3/1/1/1\n", ":5:7: error: found '3/1/1/1'; a corner of 'f' takes vertex, "
                                  "vertex/texture, vertex//normal or all three");
    BAD(SQUARE "f 1 2 \033[1m\n", ":5:7: error: found '?[1m'; a corner of 'f' takes vertex, "
                                  "vertex/texture, vertex//normal or all three");
    read_bad(SQUARE "o long enough a name to lie behind the place of a count of facets, 84 bytes\n"
                    "v 0 \0 0\n",
             116,
             ":6:5: error: found a NUL byte; a mesh is OBJ or STL text, binary STL, or begins with "
             "'ply'");
}

static void mtl_colours(void **state)
{
    (void)state;
    test_write_text(test_path("my red.mtl"),
                    "# c\nKd 1 1 1\nnewmtl red paint \r\nKa 0.25 0 0\r\nKd 2 -1 0.5\n\tKs .5\n"
                    "Ns 2.5\nillum 2\nmap_Kd a b.png \r\nnewmtl plain\nmap_Kd -s 1 1 1 -clamp on "
                    "c.png\nnewmtl red paint\nKd 0 1 0");
    test_write_text(test_path("b.mtl"), "newmtl plain\nKd 1 1 1\nnewmtl blue\nKd 0 0 1\nNs 1e9\n");
    rt_mesh mesh = GOOD("mtllib my red.mtl\nmtllib b.mtl b.mtl\n" SQUARE
                        "f 1 2 3\nusemtl red paint\nf 1 2 3\nusemtl blue\nf 1 2 3 4\n");
    assert_int_equal(mesh.material_count, 7);
    const int32_t used[] = {-1, 0, 4, 4};
    assert_indices(mesh.materials, mesh.triangle_count, used, 4);
    const rt_material *red = &mesh.material_list[0].material,
                      *blue = &mesh.material_list[4].material;
    assert_string_equal(mesh.material_list[0].name, "red paint");
    FLOATS(&red->ka_r, 0.25, 0, 0, 1, 0, 0.5, 0.5, 0.5, 0.5, 2.5);
    assert_int_equal(red->exponent, -1);
    assert_string_equal(mesh.material_list[0].texture, test_path("a b.png"));
    assert_string_equal(mesh.material_list[1].texture, test_path("c.png"));
    assert_null(mesh.material_list[2].texture);
    FLOATS(&blue->ka_r, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1e6);
    rt_mesh_clear(&mesh);
    const char *text = "mtllib b.mtl no.mtl\n" SQUARE "usemtl green\nf 1 2 3\n";
    mesh = read_good(text, strlen(text),
                     ":1:14: warning: found 'no.mtl'; the library cannot be read, and is left out: "
                     "No such file or directory");
    assert_int_equal(mesh.material_count, 2);
    rt_mesh_clear(&mesh);
    text = "mtllib b.mtl\n" SQUARE "usemtl green\nf 1 2 3\nusemtl plain\nusemtl grey\n";
    mesh = read_good(text, strlen(text),
                     ":6:8: warning: found 'green'; 'usemtl' takes the name of a material of a "
                     "library named above (2 such)");
    rt_mesh_clear(&mesh);
}

static void mtl_errors(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"newmtl\n", ":1:7: error: the line ends; 'newmtl' takes a name"},
        {"newmtl a\nKd 1 x 1\n", ":2:6: error: found 'x'; 'Kd' takes three numbers from 0 to 1"},
        {"newmtl a\nKa 1 1\n", ":2:7: error: the line ends; 'Ka' takes three numbers from 0 to 1"},
        {"newmtl a\nmap_Kd\n", ":2:7: error: the line ends; 'map_Kd' takes a file name"},
        {"newmtl a\nNs nan\n", ":2:4: error: found 'nan'; 'Ns' takes a number from 0 up"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rt_mesh mesh;
        rt_status status;
        char expected[256];
        test_write_text(test_path("bad.mtl"), cases[i][0]);
        assert_false(read_bytes(&mesh, "mtllib bad.mtl\nv 0 0 0\n", 23, &status));
        snprintf(expected, sizeof expected, "%s/bad.mtl%s\n", test_folder(), cases[i][1]);
        assert_string_equal(status.text, expected);
        assert_empty(&mesh);
        rt_status_clear(&status);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obj_texture_coordinates),
        cmocka_unit_test(obj_variants),
        cmocka_unit_test(obj_polygons),
        cmocka_unit_test(obj_order),
        cmocka_unit_test(obj_errors),
        cmocka_unit_test(mtl_colours),
        cmocka_unit_test(mtl_errors),
    };
    return cmocka_run_group_tests(tests, name_the_mesh, NULL);
}
