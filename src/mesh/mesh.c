#define _GNU_SOURCE
#include "mesh/mesh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "mesh/build.h"

static bool is_white(char c)
{
    return c == '\n' || rt_text_is_blank(c);
}

/* True where the text begins with "solid" as a word of its own. */
static bool begins_solid(const rt_mesh_source *source)
{
    rt_text text = rt_mesh_text(source, NULL);
    return rt_token_resembles(rt_text_word(&text), "solid");
}

static bool is_binary_stl(const rt_mesh_source *source)
{
    return source->length >= RT_MESH_STL_HEADER &&
           rt_mesh_stl_size(rt_mesh_little32(source->bytes + RT_MESH_STL_HEADER - 4)) ==
               source->length;
}

/* Tells the format by the content. The size of a binary STL file comes before its first word, which
 * may be "solid" in spite of the format; a text cannot have that size, since four characters make a
 * count that takes gigabytes. OBJ has no mark, so it is what is left. */
static bool read_source(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status)
{
    if (source->length == 0)
        return rt_status_fail(status, RT_ERROR_SCENE,
                              "%s:1:1: error: the file is empty; a mesh is OBJ, PLY or STL",
                              source->name);
    if (source->length >= 4 && memcmp(source->bytes, "ply", 3) == 0 && is_white(source->bytes[3]))
        return rt_mesh_read_ply(mesh, source, status);
    if (is_binary_stl(source))
        return rt_mesh_read_stl_binary(mesh, source, status);
    const char *nul = memchr(source->bytes, '\0', source->length);
    /* A header of 80 characters without a NUL is lawful, but the count behind it has one. */
    if (nul && source->length >= RT_MESH_STL_HEADER &&
        (size_t)(nul - source->bytes) < RT_MESH_STL_HEADER)
        return rt_mesh_read_stl_binary(mesh, source, status);
    if (nul) {
        const rt_text text = rt_mesh_text(source, status);
        return rt_text_fail(&text, nul,
                            "found a NUL byte; a mesh is OBJ or STL text, binary STL, "
                            "or begins with 'ply'");
    }
    if (begins_solid(source))
        return rt_mesh_read_stl_text(mesh, source, status);
    return rt_mesh_read_obj(mesh, source, status);
}

static bool is_zero(const float v[3])
{
    return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f;
}

/* Keeps the normals of those triangles that have three, none of them zero, since a smooth surface
 * needs all three; some programs write 0 0 0 for "none". */
static void settle_normals(rt_mesh *mesh)
{
    bool any = false;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        int32_t *normals = mesh->normal_corners + 3 * i;
        bool all = true;
        for (int k = 0; k < 3; ++k)
            all = all && normals[k] >= 0 && !is_zero(mesh->normals + 3 * (size_t)normals[k]);
        for (int k = 0; k < 3 && !all; ++k)
            normals[k] = -1;
        any = any || all;
    }
    if (any)
        return;
    free(mesh->normals);
    free(mesh->normal_corners);
    mesh->normals = NULL;
    mesh->normal_corners = NULL;
    mesh->normal_count = mesh->normal_capacity = 0;
}

/* Likewise the texture coordinates of triangles that have three. */
static void settle_uvs(rt_mesh *mesh)
{
    bool any = false;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        int32_t *uvs = mesh->uv_corners + 3 * i;
        const bool all = uvs[0] >= 0 && uvs[1] >= 0 && uvs[2] >= 0;
        for (int k = 0; k < 3 && !all; ++k)
            uvs[k] = -1;
        any = any || all;
    }
    if (any)
        return;
    free(mesh->uvs);
    free(mesh->uv_corners);
    mesh->uvs = NULL;
    mesh->uv_corners = NULL;
    mesh->uv_count = mesh->uv_capacity = 0;
}

bool rt_mesh_read(rt_mesh *mesh, const char *path, rt_status *status)
{
    *mesh = (rt_mesh){0};
    rt_file_text text;
    const char *reason = rt_file_read(path, &text);
    if (reason)
        return rt_status_fail(status, RT_ERROR_SCENE, "rt: cannot read '%s': %s", path, reason);
    const rt_mesh_source source = {path, text.bytes, text.length};
    const bool good = read_source(mesh, &source, status);
    rt_file_free(&text);
    if (!good) {
        rt_mesh_clear(mesh);
        return false;
    }
    settle_normals(mesh);
    settle_uvs(mesh);
    if (mesh->triangle_count == 0)
        rt_status_warn(status, "%s: warning: the mesh has no triangles", path);
    return true;
}

static void turn_corners(int32_t *corners, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        const int32_t second = corners[3 * i + 1];
        corners[3 * i + 1] = corners[3 * i + 2];
        corners[3 * i + 2] = second;
    }
}

static bool transform_positions(rt_mesh *mesh, const double m[12])
{
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        float *p = mesh->positions + 3 * i;
        const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
        for (int k = 0; k < 3; ++k) {
            const double value = m[4 * k] * x + m[4 * k + 1] * y + m[4 * k + 2] * z + m[4 * k + 3];
            if (!(fabs(value) <= (double)FLT_MAX)) /* NaN too */
                return false;
            p[k] = (float)value;
        }
    }
    return true;
}

/* The inverse's transpose is the cofactors over the determinant, and length does not matter. */
static void transform_normals(rt_mesh *mesh, const double cofactors[9], double sign)
{
    for (size_t i = 0; i < mesh->normal_count; ++i) {
        float *n = mesh->normals + 3 * i;
        if (is_zero(n)) /* of no use to any triangle */
            continue;
        double v[3];
        for (size_t k = 0; k < 3; ++k)
            v[k] = sign * (cofactors[3 * k] * (double)n[0] + cofactors[3 * k + 1] * (double)n[1] +
                           cofactors[3 * k + 2] * (double)n[2]);
        const double length = hypot(hypot(v[0], v[1]), v[2]);
        for (int k = 0; k < 3; ++k)
            n[k] = (float)(v[k] / length);
    }
}

const char *rt_mesh_transform(rt_mesh *mesh, const double m[12])
{
    double cofactors[9], largest = 0.0;
    for (int i = 0; i < 12; ++i)
        if (i % 4 != 3)
            largest = fmax(largest, fabs(m[i]));
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const double *a = m + 4 * ((i + 1) % 3), *b = m + 4 * ((i + 2) % 3);
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            /* Relative to the largest element, against overflow and underflow. */
            cofactors[3 * i + k] =
                a[u] / largest * (b[v] / largest) - a[v] / largest * (b[u] / largest);
        }
    const double determinant =
        (m[0] * cofactors[0] + m[1] * cofactors[1] + m[2] * cofactors[2]) / largest;
    if (!(fabs(determinant) > 0.0)) /* NaN too */
        return "the matrix has no inverse";
    if (!transform_positions(mesh, m))
        return "a coordinate is too large for a float";
    transform_normals(mesh, cofactors, determinant < 0.0 ? -1.0 : 1.0);
    if (determinant < 0.0) {
        turn_corners(mesh->corners, mesh->triangle_count);
        if (mesh->normal_corners)
            turn_corners(mesh->normal_corners, mesh->triangle_count);
        if (mesh->uv_corners)
            turn_corners(mesh->uv_corners, mesh->triangle_count);
    }
    return NULL;
}

void rt_mesh_clear(rt_mesh *mesh)
{
    for (size_t i = 0; i < mesh->material_count; ++i) {
        free(mesh->material_list[i].name);
        free(mesh->material_list[i].texture);
    }
    free(mesh->material_list);
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->corners);
    free(mesh->normal_corners);
    free(mesh->uvs);
    free(mesh->uv_corners);
    free(mesh->materials);
    *mesh = (rt_mesh){0};
}
