/* For the tests of the mesh readers: files are written to a temporary folder, read back, and
 * compared with what they say. */
#ifndef RT_TESTS_SUPPORT_MESH_FILES_H
#define RT_TESTS_SUPPORT_MESH_FILES_H

#include "support/support.h"

#include <stdio.h>
#include <string.h>

#include "mesh/mesh.h"

static char mesh_path[512]; /* of the file that is read */

static inline bool read_bytes(rt_mesh *mesh, const void *bytes, size_t length, rt_status *status)
{
    test_write_file(mesh_path, bytes, length);
    *status = RT_STATUS_INIT;
    return rt_mesh_read(mesh, mesh_path, status);
}

/* The file is read without a word, or with the one warning given (without the file's name). */
static inline rt_mesh read_good(const void *bytes, size_t length, const char *warning)
{
    rt_mesh mesh;
    rt_status status;
    const bool good = read_bytes(&mesh, bytes, length, &status);
    if (!good)
        fail_msg("%s", status.text);
    char expected[1024] = "";
    if (warning)
        snprintf(expected, sizeof expected, "%s%s\n", mesh_path, warning);
    assert_string_equal(status.text ? status.text : "", expected);
    for (size_t i = 0; i < 3 * mesh.triangle_count; ++i)
        assert_in_range(mesh.corners[i], 0, mesh.vertex_count - 1);
    rt_status_clear(&status);
    return mesh;
}

static inline void assert_empty(const rt_mesh *mesh)
{
    const rt_mesh empty = {0};
    assert_memory_equal(mesh, &empty, sizeof empty);
}

/* Reading fails with the one message given (without the file's name) and leaves nothing. */
static inline void read_bad(const void *bytes, size_t length, const char *message)
{
    rt_mesh mesh;
    rt_status status;
    assert_false(read_bytes(&mesh, bytes, length, &status));
    char expected[1024];
    snprintf(expected, sizeof expected, "%s%s\n", mesh_path, message);
    assert_string_equal(status.text, expected);
    assert_int_equal(status.code, RT_ERROR_SCENE);
    assert_empty(&mesh);
    rt_status_clear(&status);
}

#define GOOD(text) read_good(text, strlen(text), NULL)
#define BAD(text, message) read_bad(text, strlen(text), message)

static inline void assert_indices(const int32_t *found, size_t count, const int32_t *expected,
                                  size_t expected_count)
{
    assert_int_equal(count, expected_count);
    assert_memory_equal(found, expected, count * sizeof *found);
}

#define CORNERS(mesh, ...)                                                                         \
    assert_indices((mesh).corners, 3 * (mesh).triangle_count, (const int32_t[]){__VA_ARGS__},      \
                   sizeof((const int32_t[]){__VA_ARGS__}) / sizeof(int32_t))
#define NORMALS(mesh, ...)                                                                         \
    assert_indices((mesh).normal_corners, 3 * (mesh).triangle_count,                               \
                   (const int32_t[]){__VA_ARGS__},                                                 \
                   sizeof((const int32_t[]){__VA_ARGS__}) / sizeof(int32_t))

/* Bit for bit, so that NaN never passes. */
static inline void assert_floats(const float *found, const float *expected, size_t count)
{
    assert_memory_equal(found, expected, count * sizeof *found);
}

#define FLOATS(found, ...)                                                                         \
    assert_floats(found, (const float[]){__VA_ARGS__},                                             \
                  sizeof((const float[]){__VA_ARGS__}) / sizeof(float))

#define SQUARE "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n"

/* For cmocka_run_group_tests. */
static inline int name_the_mesh(void **state)
{
    (void)state;
    snprintf(mesh_path, sizeof mesh_path, "%s/mesh", test_folder());
    return 0;
}

#endif
