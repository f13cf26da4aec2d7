#define _GNU_SOURCE
#include "support/mesh_files.h"

static void zero_normals_are_none(void **state)
{
    (void)state;
    rt_mesh mesh = GOOD(SQUARE "vn 0 0 0\nf 1//1 2//1 3//1\n");
    assert_null(mesh.normals);
    assert_null(mesh.normal_corners);
    assert_int_equal(mesh.normal_count, 0);
    rt_mesh_clear(&mesh);
    mesh = read_good("v 0 0 0\n", 8, ": warning: the mesh has no triangles");
    rt_mesh_clear(&mesh);
}

static void unreadable_file(void **state)
{
    (void)state;
    rt_mesh mesh;
    rt_status status = RT_STATUS_INIT;
    assert_false(rt_mesh_read(&mesh, "/nonexistent/mesh.obj", &status));
    assert_string_equal(status.text, "rt: cannot read '/nonexistent/mesh.obj': "
                                     "No such file or directory\n");
    assert_empty(&mesh);
    rt_status_clear(&status);
}

static void transforms(void **state)
{
    (void)state;
    const char *text = SQUARE "vn 0 3 4\nf 1//1 2//1 3//1\n";
    rt_mesh mesh = GOOD(text);
    const double move[12] = {2, 0, 0, 10, 0, 1, 0, 20, 0, 0, 0.5, 30};
    assert_null(rt_mesh_transform(&mesh, move));
    FLOATS(mesh.positions, 10, 20, 30, 18, 20, 30, 18, 24, 30, 10, 24, 30);
    /* (0, 3, 4) by the inverse's transpose: (0, 3, 8) made unit. */
    assert_true(mesh.normals[0] == 0.0f);
    assert_true(mesh.normals[1] == (float)(3 / 8.5440037453175312));
    assert_true(mesh.normals[2] == (float)(8 / 8.5440037453175312));
    CORNERS(mesh, 0, 1, 2);
    const double mirror[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    assert_null(rt_mesh_transform(&mesh, mirror));
    CORNERS(mesh, 0, 2, 1);
    assert_true(mesh.normals[2] == (float)(8 / 8.5440037453175312));
    const double flat[12] = {1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0};
    assert_string_equal(rt_mesh_transform(&mesh, flat), "the matrix has no inverse");
    const double huge[12] = {1e38, 0, 0, 0, 0, 1e38, 0, 0, 0, 0, 1e38, 0};
    assert_string_equal(rt_mesh_transform(&mesh, huge), "a coordinate is too large for a float");
    rt_mesh_clear(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(zero_normals_are_none),
        cmocka_unit_test(unreadable_file),
        cmocka_unit_test(transforms),
    };
    return cmocka_run_group_tests(tests, name_the_mesh, NULL);
}
