/* Closed meshes among the triangles of a scene. */
#include "support/support.h"

#include "study/closed_mesh.h"

/* Two tetrahedra, of which one lacks a side, and a stray triangle. */
static void closed_meshes(void **state)
{
    (void)state;
    static const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -0.0f, 1}};
    static const int sides[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const rt_material dull = {0};
    rt_status status = RT_STATUS_INIT;
    rt_study_mesh mesh;
    rt_scene scene;
    rt_scene_init(&scene);
    assert_good(rt_scene_add_material(&scene, &dull, &status), &status);
    assert_good(rt_study_mesh_find(&mesh, &scene, &status), &status);
    assert_int_equal(mesh.count, 0);
    for (int i = 0; i < 7; ++i) {
        const float *a = corners[sides[i % 4][0]], *b = corners[sides[i % 4][1]],
                    *c = corners[sides[i % 4][2]], dx = i < 3 ? 5.0f : 0.0f;
        const rt_triangle t = {a[0] + dx, a[1], a[2], b[0] + dx, b[1], b[2], c[0] + dx, c[1], c[2]};
        assert_good(rt_scene_add_triangle(&scene, &t, NULL, 0, &status), &status);
        assert_good(rt_study_mesh_find(&mesh, &scene, &status), &status);
        assert_int_equal(mesh.count, i == 6 ? 4 : 0);
        if (i < 6)
            rt_study_mesh_clear(&mesh);
    }
    /* In a tetrahedron everyone is everyone's neighbour. */
    int seen = 0;
    for (size_t i = 0; i < mesh.count; ++i) {
        assert_true(mesh.triangles[i].ax < 5.0f);
        seen |= 1 << mesh.colors[i];
    }
    assert_int_equal(seen, 15);
    rt_study_mesh_clear(&mesh);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_meshes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
