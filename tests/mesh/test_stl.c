#define _GNU_SOURCE
#include <math.h>
#include "support/mesh_files.h"

#define FACETS 3
#define SIZE (84 + 50 * FACETS)

static void put32(unsigned char *to, uint32_t value)
{
    for (int i = 0; i < 4; ++i)
        to[i] = (unsigned char)(value >> 8 * i);
}

static void put_float(unsigned char *to, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put32(to, bits);
}

/* Facet i has corners (i, 1, 2), (3, 4, 5), (6, 7, 8), a normal of NaN and an odd last number. */
static void make_binary(unsigned char bytes[SIZE], const char *header)
{
    memset(bytes, ' ', SIZE);
    memcpy(bytes, header, strlen(header));
    put32(bytes + 80, FACETS);
    for (int i = 0; i < FACETS; ++i) {
        unsigned char *facet = bytes + 84 + 50 * i;
        for (int k = 0; k < 12; ++k)
            put_float(facet + 4 * k, k < 3 ? (float)NAN : k == 3 ? (float)i : (float)(k - 3));
        facet[48] = 7;
    }
}

static void binary(void **state)
{
    (void)state;
    static const char *const headers[] = {"", "solid name", "solid\nfacet normal 0 0 1\n", "v 1 2"};
    for (size_t i = 0; i < sizeof headers / sizeof *headers; ++i) {
        unsigned char bytes[SIZE];
        make_binary(bytes, headers[i]);
        rt_mesh mesh = read_good(bytes, SIZE, NULL);
        CORNERS(mesh, 0, 1, 2, 3, 4, 5, 6, 7, 8);
        FLOATS(mesh.positions + 9, 1, 1, 2, 3, 4, 5, 6, 7, 8);
        assert_null(mesh.normal_corners);
        rt_mesh_clear(&mesh);
    }
}

static void binary_errors(void **state)
{
    (void)state;
    unsigned char bytes[SIZE + 1] = {0};
    make_binary(bytes, "solid");
    for (size_t length = 0; length < SIZE; ++length) {
        rt_mesh mesh;
        rt_status status;
        assert_false(read_bytes(&mesh, bytes, length, &status));
        assert_int_equal(status.errors, 1);
        assert_empty(&mesh);
        rt_status_clear(&status);
    }
    read_bad(bytes, SIZE - 1,
             ": error: byte 80: found a count of 3 facets, which take 234 bytes of binary STL; the "
             "file has 233");
    rt_mesh mesh = read_good(bytes, SIZE + 1, ": warning: byte 234: data behind the last facet");
    rt_mesh_clear(&mesh);
    put32(bytes + 80, 0xffffff);
    read_bad(bytes, SIZE,
             ": error: byte 80: found a count of 16777215 facets, which take 838860834 bytes "
             "of binary STL; the file has 234");
    put32(bytes + 80, 0);
    read_bad(bytes, SIZE,
             ": error: byte 80: found a count of 0 facets, which take 84 bytes of binary STL; the "
             "file has 234");
    put32(bytes + 80, FACETS);
    put_float(bytes + 84 + 50 + 16, (float)INFINITY);
    read_bad(bytes, SIZE, ": error: byte 150: found inf; a vertex takes three finite floats");
}

#define FACET                                                                                      \
    "facet normal nan 0 1\n outer loop\n  vertex 0 0 0\n  vertex 4 0 0\n  vertex 0 4e0 -.5\n"      \
    " endloop\nendfacet\n"

static void text(void **state)
{
    (void)state;
    rt_mesh mesh = GOOD("solid a name\n" FACET FACET "endsolid a name\n"
                        "SOLID\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP VERTEX 1 2 3 VERTEX 1 2 3\r\n"
                        "VERTEX 7 8 9 ENDLOOP ENDFACET\r\nENDSOLID");
    CORNERS(mesh, 0, 1, 2, 3, 4, 5, 6, 7, 8);
    FLOATS(mesh.positions + 6, 0, 4, -0.5, 0, 0, 0);
    FLOATS(mesh.positions + 24, 7, 8, 9);
    rt_mesh_clear(&mesh);
    const char *empty = "solid x\nendsolid\n";
    mesh = read_good(empty, strlen(empty), ": warning: the mesh has no triangles");
    rt_mesh_clear(&mesh);
}

static void text_errors(void **state)
{
    (void)state;
    BAD("solid a\n" FACET, ":9:1: error: the file ends; STL has 'facet' or 'endsolid' here");
    BAD("solid a\nvertex", ":2:1: error: found 'vertex'; STL has 'facet' or 'endsolid' here");
    BAD("solid a\nendsolid\nfacet", ":3:1: error: found 'facet'; STL has 'solid' here");
    BAD("solid a\nfacet 1", ":2:7: error: found '1'; a facet of STL has 'normal' here");
    BAD("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n",
        ":4:12: error: found 'nan'; 'vertex' takes three numbers");
    BAD("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0",
        ":4:11: error: the file ends; 'vertex' takes three numbers");
    BAD("solid a\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0\nvertex 0 0 "
        "0",
        ":3:1: error: found 'vertex'; a facet of STL has 'endloop' here");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(binary),
        cmocka_unit_test(binary_errors),
        cmocka_unit_test(text),
        cmocka_unit_test(text_errors),
    };
    return cmocka_run_group_tests(tests, name_the_mesh, NULL);
}
