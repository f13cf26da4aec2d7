/* Wavefront OBJ (Advanced Visualizer Manual, appendix B1, "Object Files"): polygons with normals,
 * texture coordinates and materials. Curves, surfaces, lines, points and groups are passed over,
 * and so is what a vertex has beyond x y z, and a texture coordinate beyond u v.
 *
 * An index may name a vertex that is defined below. A polygon is split by the places of its
 * corners, so a file that does that is read twice, for its vertices and then for its faces. */
#define _GNU_SOURCE
#include <search.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesh/build.h"

#define CORNER_TAKES "a corner of 'f' takes vertex, vertex/texture, vertex//normal or all three"

/* What a name of `usemtl` stands for; the text belongs to the mesh. */
typedef struct material_name {
    const char *text;
    int32_t index;
} material_name;

/* Vertices or normals: those stored, and those defined above the line being read. */
typedef struct pool {
    const char *name;
    size_t stored, above;
} pool;

typedef struct reader {
    rt_mesh *mesh;
    rt_text text;
    rt_mesh_face face;
    pool vertices, normals, uvs;
    bool is_forward; /* first round: a face names what is defined below, so faces have to wait */
    bool is_second;  /* second round: everything but faces is there already */
    int32_t material;
    void *names;          /* tsearch tree of material_name */
    size_t missing_count; /* libraries that cannot be read */
    size_t unknown_count; /* uses of materials that no library has, and the first of them */
    rt_token unknown;
} reader;

static int compare_names(const void *a, const void *b)
{
    return strcmp(((const material_name *)a)->text, ((const material_name *)b)->text);
}

/* Makes the materials from `first` on known by name; of two with one name the first counts. */
static bool define_materials(reader *r, size_t first)
{
    for (size_t i = first; i < r->mesh->material_count; ++i) {
        material_name *name = malloc(sizeof *name);
        if (!name)
            return rt_status_no_memory(r->text.status, "materials");
        *name = (material_name){r->mesh->material_list[i].name, (int32_t)i};
        void *node = tsearch(name, &r->names, compare_names);
        if (!node || *(material_name **)node != name)
            free(name);
        if (!node)
            return rt_status_no_memory(r->text.status, "materials");
    }
    return true;
}

/* Reads the library that `name` names relative to the mesh's file. Returns NULL on success or after
 * an error in the library, which *good tells; else the reason why it cannot be read. */
static const char *read_library(reader *r, rt_token name, bool *good)
{
    char *path = rt_file_beside(r->text.name, name.text, name.length);
    if (!path) {
        *good = rt_status_no_memory(r->text.status, "a path");
        return NULL;
    }
    rt_file_text bytes;
    const char *reason = rt_file_read(path, &bytes);
    if (!reason) {
        const size_t first = r->mesh->material_count;
        *good =
            rt_mesh_read_mtl(r->mesh, path, &bytes, r->text.status) && define_materials(r, first);
        rt_file_free(&bytes);
    }
    free(path);
    return reason;
}

/* The line names files, but many programs write a single name with blanks in it. */
static bool read_libraries(reader *r)
{
    rt_text *text = &r->text;
    bool good = true;
    const char *start = text->cursor;
    const rt_token all = rt_text_rest(text);
    if (all.length == 0)
        return rt_text_fail_found(text, all, "'mtllib' takes file names");
    if (!read_library(r, all, &good))
        return good;
    text->cursor = start;
    for (rt_token name; good && (name = rt_text_token(text)).length > 0;) {
        const char *reason = read_library(r, name, &good);
        if (!reason)
            continue;
        if (r->missing_count++ >= RT_STATUS_SHOWN)
            continue;
        rt_text_warn_found(text, name, "the library cannot be read, and is left out: %s", reason);
    }
    return good;
}

static bool use_material(reader *r)
{
    const rt_token token = rt_text_rest(&r->text);
    char *text = strndup(token.text, token.length);
    if (!text)
        return rt_status_no_memory(r->text.status, "materials");
    const material_name wanted = {text, 0};
    void *node = tfind(&wanted, &r->names, compare_names);
    free(text);
    r->material = node ? (*(material_name **)node)->index : -1;
    if (!node && r->unknown_count++ == 0)
        r->unknown = token;
    return true;
}

static bool read_triple(reader *r, const char *taker, float triple[3])
{
    for (int i = 0; i < 3; ++i)
        if (!rt_text_float(&r->text, rt_text_token(&r->text), taker, &triple[i]))
            return false;
    return true;
}

static bool read_vertex(reader *r)
{
    float position[3];
    r->vertices.above++;
    if (r->is_second)
        return true;
    r->vertices.stored++;
    return read_triple(r, "'v' takes three numbers", position) &&
           rt_mesh_add_vertex(r->mesh, position, r->text.status);
}

static bool read_normal(reader *r)
{
    float normal[3];
    r->normals.above++;
    if (r->is_second)
        return true;
    r->normals.stored++;
    return read_triple(r, "'vn' takes three numbers", normal) &&
           rt_mesh_add_normal(r->mesh, normal, r->text.status);
}

/* u alone has v = 0. */
static bool read_uv(reader *r)
{
    static const char *const taker = "'vt' takes one to three numbers";
    float uv[2] = {0.0f, 0.0f};
    r->uvs.above++;
    if (r->is_second)
        return true;
    r->uvs.stored++;
    if (!rt_text_float(&r->text, rt_text_token(&r->text), taker, &uv[0]))
        return false;
    const rt_token second = rt_text_token(&r->text);
    return (second.length == 0 || rt_text_float(&r->text, second, taker, &uv[1])) &&
           rt_mesh_add_uv(r->mesh, uv, r->text.status);
}

/* Reads the digits of an index; NULL where there are none. Values stop growing beyond what can be
 * valid. */
static const char *read_index(const char *p, int64_t *value)
{
    const bool is_negative = *p == '-';
    if (*p == '-' || *p == '+')
        ++p;
    if (!(*p >= '0' && *p <= '9'))
        return NULL;
    int64_t sum = 0;
    for (; *p >= '0' && *p <= '9'; ++p)
        if (sum <= INT32_MAX)
            sum = 10 * sum + (*p - '0');
    *value = is_negative ? -sum : sum;
    return p;
}

/* From an index of the file, 1 for the first and -1 for the last so far, to one from 0. */
static bool resolve(reader *r, rt_token token, const pool *from, int64_t value, int32_t *index)
{
    const int64_t above = (int64_t)from->above, stored = (int64_t)from->stored;
    *index = (int32_t)(value > 0 ? value - 1 : above + value);
    if (value > 0 ? value <= stored : value < 0 && value >= -above)
        return true;
    if (value > 0 && value <= INT32_MAX && !r->is_second) {
        r->is_forward = true;
        *index = 0;
        return true;
    }
    if (stored == 0)
        return rt_text_fail_found(&r->text, token, "the file has no %s", from->name);
    char below[48] = "";
    if (above > 0)
        snprintf(below, sizeof below, ", or from -%lld to -1 here", (long long)above);
    return rt_text_fail_found(&r->text, token, "%s go from 1 to %lld%s", from->name,
                              (long long)stored, below);
}

/* Programs that drop the texture coordinates of a file tend to leave their indices in it; those
 * name nothing. */
static bool resolve_uv(reader *r, rt_token token, int64_t value, int32_t *index)
{
    const bool names_nothing = r->uvs.stored == 0 && (value < 0 || r->is_second);
    *index = -1;
    return names_nothing || resolve(r, token, &r->uvs, value, index);
}

/* Reads v, v/t, v//n or v/t/n; t and n may be left out behind their slash. */
static bool read_corner(reader *r, rt_token token, rt_mesh_corner *corner)
{
    const char *end = token.text + token.length;
    int64_t vertex, texture, normal;
    corner->normal = corner->uv = -1;
    const char *p = read_index(token.text, &vertex);
    if (p && !resolve(r, token, &r->vertices, vertex, &corner->vertex))
        return false;
    if (p && *p == '/' && ++p < end && *p != '/') {
        p = read_index(p, &texture);
        if (p && !resolve_uv(r, token, texture, &corner->uv))
            return false;
    }
    if (p && p < end && *p == '/' && ++p < end) {
        p = read_index(p, &normal);
        if (p && !resolve(r, token, &r->normals, normal, &corner->normal))
            return false;
    }
    return p == end || rt_text_fail_found(&r->text, token, CORNER_TAKES);
}

static bool read_face(reader *r)
{
    r->face.count = 0;
    for (;;) {
        const rt_token token = rt_text_token(&r->text);
        if (token.length == 0 && r->face.count < 3)
            return rt_text_fail_found(&r->text, token, "'f' takes three corners or more");
        if (token.length == 0)
            break;
        if (r->face.count == RT_POLYGON_CORNERS_MAX)
            return rt_text_fail_found(&r->text, token, "'f' takes up to %d corners",
                                      RT_POLYGON_CORNERS_MAX);
        rt_mesh_corner corner;
        if (!read_corner(r, token, &corner) || !rt_mesh_face_add(&r->face, corner, r->text.status))
            return false;
    }
    return r->is_forward || rt_mesh_add_face(r->mesh, &r->face, r->material, r->text.status);
}

static bool read_line(reader *r)
{
    const rt_token keyword = rt_text_token(&r->text);
    if (keyword.length == 1 && keyword.text[0] == 'v')
        return read_vertex(r);
    if (keyword.length == 1 && keyword.text[0] == 'f')
        return r->is_forward || read_face(r);
    if (keyword.length == 2 && memcmp(keyword.text, "vn", 2) == 0)
        return read_normal(r);
    if (keyword.length == 2 && memcmp(keyword.text, "vt", 2) == 0)
        return read_uv(r);
    if (rt_token_equals(keyword, "usemtl"))
        return use_material(r);
    if (rt_token_equals(keyword, "mtllib") && !r->is_second)
        return read_libraries(r);
    return true;
}

static bool read_lines(reader *r)
{
    r->text.cursor = r->text.start;
    r->vertices.above = r->normals.above = r->uvs.above = 0;
    r->material = -1;
    r->unknown_count = 0;
    for (; r->text.cursor < r->text.end; rt_text_next_line(&r->text))
        if (!read_line(r))
            return false;
    return true;
}

static bool read_rounds(reader *r)
{
    if (!read_lines(r))
        return false;
    if (r->is_forward) {
        r->is_forward = false;
        r->is_second = true;
        r->mesh->triangle_count = 0;
        if (!read_lines(r))
            return false;
    }
    if (r->vertices.stored == 0)
        return rt_text_fail(&r->text, r->text.start,
                            "no line begins with 'v', so this is no OBJ; a mesh is OBJ, PLY or "
                            "STL");
    if (r->unknown_count > 0 && r->missing_count == 0)
        rt_text_warn_found(&r->text, r->unknown,
                           "'usemtl' takes the name of a material of a library named above "
                           "(%zu such)",
                           r->unknown_count);
    return true;
}

bool rt_mesh_read_obj(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status)
{
    reader r = {.mesh = mesh,
                .text = rt_mesh_text(source, status),
                .vertices = {"vertices", 0, 0},
                .normals = {"normals", 0, 0},
                .uvs = {"texture coordinates", 0, 0}};
    const bool good = read_rounds(&r);
    tdestroy(r.names, free);
    rt_mesh_face_clear(&r.face);
    return good;
}
