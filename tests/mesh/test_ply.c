/* One mesh is written in all three forms of PLY from one description, and damaged in many ways. */
#define _GNU_SOURCE
#include <math.h>
#include "support/mesh_files.h"

/* A file as it is written: values go out as text, or as bytes in either order. */
typedef struct writer {
    char bytes[4096];
    size_t length;
    enum form { ASCII, LITTLE, BIG } form;
} writer;

static const char *const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};

static void put_header(writer *w, enum form form, const char *elements)
{
    w->form = form;
    w->length =
        (size_t)snprintf(w->bytes, sizeof w->bytes,
                         "ply\nformat %s 1.0\ncomment by hand\nobj_info none\n%send_header\n",
                         forms[form], elements);
}

static void put_bits(writer *w, uint64_t bits, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        w->bytes[w->length++] = (char)(bits >> 8 * (w->form == BIG ? size - 1 - i : i));
}

/* One value of a type: b h i (1, 2, 4 bytes), f d. */
static void put_value(writer *w, char type, double value)
{
    if (w->form == ASCII) {
        w->length += (size_t)sprintf(w->bytes + w->length, "%.9g\n", value);
        return;
    }
    uint32_t float_bits;
    uint64_t double_bits;
    const float narrow = (float)value;
    memcpy(&float_bits, &narrow, sizeof narrow);
    memcpy(&double_bits, &value, sizeof value);
    if (type == 'f')
        put_bits(w, float_bits, 4);
    else if (type == 'd')
        put_bits(w, double_bits, 8);
    else
        put_bits(w, (uint64_t)(int64_t)value, type == 'b' ? 1 : type == 'h' ? 2 : 4);
}

/* The values in order, one letter of `types` each. */
static void put_values(writer *w, const char *types, const double *values)
{
    for (size_t i = 0; types[i]; ++i)
        put_value(w, types[i], values[i]);
}

#define PUT(w, types, ...) put_values(w, types, (const double[]){__VA_ARGS__})

#define ALL_ELEMENTS                                                                               \
    "element camera 2\nproperty uchar id\nproperty list ushort double lens\n"                      \
    "element vertex 5\nproperty uint8 red\nproperty float x\nproperty double y\nproperty short "   \
    "z\n"                                                                                          \
    "property float32 nx\nproperty float nz\nproperty float ny\n"                                  \
    "property list uchar char junk\n"                                                              \
    "element empty 9\n"                                                                            \
    "element face 2\nproperty float quality\nproperty list uchar int vertex_indices\n"             \
    "element tristrips 1\nproperty list int int16 vertex_index\n"

/* Every kind of element and property, wanted or not. */
static void make_all(writer *w, enum form form)
{
    put_header(w, form, ALL_ELEMENTS);
    PUT(w, "bh", 1, 0);
    PUT(w, "bhdd", 2, 2, 0.5, 0.25);
    PUT(w, "bfdhfffbbb", 200, 0, 0, 0, 0, 1, 2, 2, -1, -2);
    PUT(w, "bfdhfffb", 200, 4, 0, -3, 0, 1, 2, 0);
    PUT(w, "bfdhfffb", 200, 4, 4, 0, 0, 1, 2, 0);
    PUT(w, "bfdhfffb", 200, 0, 4, 0, 0, 1, 2, 0);
    PUT(w, "bfdhfffb", 200, 0.5, 0.5, 0, 0, 1, 2, 0);
    PUT(w, "fbiii", 0.5, 3, 0, 1, 2);
    PUT(w, "fbiiii", 0.5, 4, 1, 4, 3, 0); /* concave at 4 */
    PUT(w, "ihhhhhhhhhhh", 11, 0, 1, 2, 3, -1, 1, 2, 2, 3, 4, -1);
}

static void all_forms(void **state)
{
    (void)state;
    for (int form = ASCII; form <= BIG; ++form) {
        writer w;
        make_all(&w, (enum form)form);
        rt_mesh mesh = read_good(w.bytes, w.length, NULL);
        CORNERS(mesh, 0, 1, 2, 4, 3, 0, 4, 0, 1, 0, 1, 2, 2, 1, 3, 2, 3, 4);
        NORMALS(mesh, 0, 1, 2, 4, 3, 0, 4, 0, 1, 0, 1, 2, 2, 1, 3, 2, 3, 4);
        FLOATS(mesh.positions, 0, 0, 0, 4, 0, -3, 4, 4, 0, 0, 4, 0, 0.5, 0.5, 0);
        FLOATS(mesh.normals, 0, 2, 1);
        rt_mesh_clear(&mesh);
    }
}

/* Whatever the place of the cut, there is one message and an empty mesh. */
static void truncations(void **state)
{
    (void)state;
    for (int form = ASCII; form <= BIG; ++form) {
        writer w;
        make_all(&w, (enum form)form);
        const size_t spare = form == ASCII ? 1 : 0; /* the last newline may go */
        for (size_t length = 0; length < w.length - spare; ++length) {
            rt_mesh mesh;
            rt_status status;
            if (form == ASCII && length == w.length - 2) /* "-1" cut to "-" is an error, too */
                assert_int_equal(w.bytes[length], '1');
            assert_false(read_bytes(&mesh, w.bytes, length, &status));
            assert_int_equal(status.errors, 1);
            assert_empty(&mesh);
            rt_status_clear(&status);
        }
    }
}

/* Every byte is replaced by some others: an error or a mesh whose indices are good. */
static void damage(void **state)
{
    (void)state;
    static const unsigned char replacements[] = {0, 0x7f, 0x80, 0xff, ' ', '9'};
    for (int form = ASCII; form <= BIG; ++form) {
        writer w;
        make_all(&w, (enum form)form);
        for (size_t i = 0; i < w.length; ++i) {
            const char kept = w.bytes[i];
            for (size_t k = 0; k < sizeof replacements; ++k) {
                rt_mesh mesh;
                rt_status status;
                w.bytes[i] = (char)replacements[k];
                const bool good = read_bytes(&mesh, w.bytes, w.length, &status);
                assert_int_equal(status.errors, good ? 0 : 1);
                for (size_t c = 0; c < 3 * mesh.triangle_count; ++c)
                    assert_in_range(mesh.corners[c], 0, mesh.vertex_count - 1);
                rt_mesh_clear(&mesh);
                rt_status_clear(&status);
            }
            w.bytes[i] = kept;
        }
    }
}

#define VERTEX(count)                                                                              \
    "element vertex " count "\nproperty float x\nproperty float y\nproperty float z\n"
#define FACE(count) "element face " count "\nproperty list uchar int vertex_indices\n"

static void faces_before_vertices(void **state)
{
    (void)state;
    for (int form = ASCII; form <= BIG; ++form) {
        writer w;
        put_header(&w, (enum form)form, FACE("1") VERTEX("4"));
        PUT(&w, "biiii", 4, 0, 1, 2, 3);
        PUT(&w, "ffffffffffff", 0, 0, 0, 4, 0, 0, 1, 1, 0, 0, 4, 0);
        rt_mesh mesh = read_good(w.bytes, w.length, NULL);
        CORNERS(mesh, 0, 1, 2, 0, 2, 3);
        assert_int_equal(mesh.vertex_count, 4);
        rt_mesh_clear(&mesh);
    }
}

/* A binary file of two vertices and a face, one value of which is bad. */
static void binary_errors(void **state)
{
    (void)state;
    static const struct {
        const char *elements;
        double x;
        double face[4];
        const char *message;
    } cases[] = {
        {VERTEX("2") FACE("1"),
         0,
         {3, 0, 1, 2},
         ": error: byte 232: found the vertex 2; this file has vertices from 0 to 1"},
        {VERTEX("2") FACE("1"),
         0,
         {3, 0, -1, 1},
         ": error: byte 228: found the vertex -1; this file has vertices from 0 to 1"},
        {VERTEX("2") FACE("1"),
         0,
         {2, 0, 1, 0},
         ": error: byte 223: found a face of 2 corners; a face takes 3 to 65536"},
        {VERTEX("2") FACE("1"),
         0,
         {255, 0, 1, 0},
         ": error: byte 223: found a count of 255 in 'vertex_indices' of element 'face'; the file "
         "has 12 bytes left"},
        {VERTEX("2") FACE("1"),
         NAN,
         {3, 0, 1, 0},
         ": error: byte 199: found nan; 'x' of element 'vertex' takes a finite float"},
        {VERTEX("2") FACE("99"),
         0,
         {3, 0, 1, 0},
         ":9:9: error: found 'face'; 99 rows of 1 bytes or more are declared; the file has 13 "
         "bytes "
         "left"},
        {VERTEX("2000000000") FACE("1"),
         0,
         {3, 0, 1, 0},
         ":5:9: error: found 'vertex'; 2000000000 rows of 12 bytes or more are declared; the file "
         "has 37 bytes left"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
        for (int form = LITTLE; form <= BIG; ++form) {
            writer w;
            put_header(&w, LITTLE, cases[i].elements);
            if (form == BIG) { /* names of one length, so that places stay */
                char *little = strstr(w.bytes, "_little_endian");
                memcpy(little, "_big_endian   ", 14);
                w.form = BIG;
            }
            PUT(&w, "ffffff", cases[i].x, 0, 0, 4, 0, 0);
            put_values(&w, "biii", cases[i].face);
            read_bad(w.bytes, w.length, cases[i].message);
        }
}

#define HEADER(elements) "ply\nformat ascii 1.0\n" elements "end_header\n"
#define TRIANGLE "0 0 0\n4 0 0\n0 4 0\n"

static void ascii_errors(void **state)
{
    (void)state;
    BAD(HEADER(VERTEX("3") FACE("1")) TRIANGLE "3 0 1 3\n",
        ":13:7: error: found the vertex 3; this file has vertices from 0 to 2");
    BAD(HEADER(VERTEX("3") FACE("1")) TRIANGLE "3 0 1.5 2\n",
        ":13:5: error: found '1.5'; 'vertex_indices' of element 'face' takes a whole number");
    BAD(HEADER(VERTEX("3") FACE("1")) "0 nan 0\n4 0 0\n0 4 0\n3 0 1 2",
        ":10:3: error: found 'nan'; 'y' of element 'vertex' takes a finite number");
    BAD(HEADER(VERTEX("3") FACE("1")) TRIANGLE "9999999999 0 1 2",
        ":13:1: error: found a count of 9999999999 in 'vertex_indices' of element 'face'; the file "
        "has 6 bytes left");
    BAD(HEADER(VERTEX("3") FACE("1")) TRIANGLE "3 0 1",
        ":13:1: error: found a count of 3 in 'vertex_indices' of element 'face'; the file has 4 "
        "bytes left");
    const char *more = HEADER(VERTEX("3") FACE("1")) TRIANGLE "3 0 1 2\n3 2 1 0\n";
    rt_mesh mesh = read_good(more, strlen(more),
                             ":14:1: warning: found '3'; the header declares no more data");
    rt_mesh_clear(&mesh);
}

static void header_errors(void **state)
{
    (void)state;
    BAD("ply\n", ":2:1: error: the file ends; 'format' is the first statement of PLY");
    BAD("ply\nformat text 1.0\n", ":2:8: error: found 'text'; 'format' takes ascii, "
                                  "binary_little_endian or binary_big_endian");
    BAD("ply\nformat ascii 2.0\n",
        ":2:14: error: found '2.0'; 'format' takes the version 1.0 after its name");
    BAD("ply\nformat ascii 1.0\nelement vertex -1\n",
        ":3:16: error: found '-1'; 'element' takes a whole number of rows");
    BAD("ply\nformat ascii 1.0\nelement vertex 3000000000\n",
        ":3:16: error: found '3000000000'; a mesh has up to 2147483647 vertices");
    BAD("ply\nformat ascii 1.0\nproperty float x\n",
        ":3:10: error: found 'float'; 'property' comes after an 'element'");
    BAD("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n",
        ":4:10: error: found 'real'; 'property' takes a type of char, uchar, short, ushort, int, "
        "uint, float, double, or int8 to float64");
    BAD("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x y\n",
        ":4:18: error: found 'y'; the statement is complete");
    BAD("ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\n",
        ":4:10: error: found 'list'; a list takes a whole type for its count");
    BAD("ply\nformat ascii 1.0\nelement face 1\nproperty list int float vertex_index\n",
        ":4:25: error: found 'vertex_index'; this list takes a whole type");
    BAD(HEADER("element vertex 1\nproperty float x\nproperty float y\n") "0 0\n",
        ":3:9: error: found 'vertex'; this element lacks x, y or z");
    BAD(HEADER(VERTEX("1") "element face 1\nproperty int a\n") "0 0 0\n0\n",
        ":7:9: error: found 'face'; this element lacks the list 'vertex_indices'");
    BAD(HEADER(VERTEX("1") VERTEX("1")),
        ":7:9: error: found 'vertex'; this element is declared above already");
    BAD(HEADER(VERTEX("1") "property int x\n"),
        ":7:14: error: found 'x'; this property is declared already");
    BAD(HEADER(FACE("0")),
        ":5:1: error: found 'end_header'; the header lacks the element 'vertex'");
    BAD("ply\nformat ascii 1.0\nvertex 3\n",
        ":3:1: error: found 'vertex'; a header has format, comment, obj_info, element, property "
        "and end_header");
    BAD("plyx\n", ":1:1: error: no line begins with 'v', so this is no OBJ; a mesh is OBJ, PLY or "
                  "STL");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_forms),     cmocka_unit_test(truncations),
        cmocka_unit_test(damage),        cmocka_unit_test(faces_before_vertices),
        cmocka_unit_test(binary_errors), cmocka_unit_test(ascii_errors),
        cmocka_unit_test(header_errors),
    };
    return cmocka_run_group_tests(tests, name_the_mesh, NULL);
}
