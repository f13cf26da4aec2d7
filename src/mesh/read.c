/* A mesh file of any format: which one it is, and what is settled alike for all. */
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
