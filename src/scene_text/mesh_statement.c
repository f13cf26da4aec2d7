#include "scene_text/mesh_statement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/file.h"
#include "mesh/mesh.h"
#include "scene/texture.h"
#include "scene_text/parser.h"

/* Fields of `mesh` in the grammar's order; the material is the caller's. */
enum field { PATH, MATERIAL, SCALE, ROTATE, TRANSLATE };

/* Multiples of 90 degrees give 0, 1 and -1 without an error. */
static void sine_and_cosine(float degrees, double *sine, double *cosine)
{
    int quarters = 0;
    const double pi = 3.14159265358979323846;
    const double rest = remquo((double)degrees, 90.0, &quarters) * pi / 180.0;
    const double s = sin(rest), c = cos(rest);
    const bool is_odd = quarters % 2 != 0;
    *sine = (is_odd ? c : s) * (quarters & 2 ? -1.0 : 1.0);
    *cosine = (is_odd ? -s : c) * (quarters & 2 ? -1.0 : 1.0);
}

/* The 3x4 matrix of rt_mesh_transform: T Rz Ry Rx S. */
static void make_matrix(const rt_value *values, double m[12])
{
    const double scale = values[SCALE].given ? (double)values[SCALE].number[0] : 1.0;
    double s[3], c[3];
    for (int i = 0; i < 3; ++i) {
        const rt_value *move = &values[TRANSLATE];
        sine_and_cosine(values[ROTATE].given ? values[ROTATE].number[i] : 0.0f, &s[i], &c[i]);
        m[4 * i + 3] = move->given ? (double)move->number[i] : 0.0;
    }
    m[0] = scale * (c[2] * c[1]);
    m[1] = scale * (c[2] * s[1] * s[0] - s[2] * c[0]);
    m[2] = scale * (c[2] * s[1] * c[0] + s[2] * s[0]);
    m[4] = scale * (s[2] * c[1]);
    m[5] = scale * (s[2] * s[1] * s[0] + c[2] * c[0]);
    m[6] = scale * (s[2] * s[1] * c[0] - c[2] * s[0]);
    m[8] = scale * -s[1];
    m[9] = scale * (c[1] * s[0]);
    m[10] = scale * (c[1] * c[0]);
}

static bool is_smooth(const rt_mesh *mesh, size_t triangle)
{
    return mesh->normal_corners && mesh->normal_corners[3 * triangle] >= 0;
}

static bool has_uvs(const rt_mesh *mesh, size_t triangle)
{
    return mesh->uv_corners && mesh->uv_corners[3 * triangle] >= 0;
}

/* Adds a material of the file with its texture; one that cannot be taken is left out, as a material
 * library is. */
static bool add_material(rt_scene *scene, const rt_mesh_material *m, const rt_source *source)
{
    rt_material material = m->material;
    char reason[RT_TEXTURE_REASON_SIZE];
    int32_t texture = -1;
    if (m->texture && !rt_texture_load(scene, m->texture, &texture, reason))
        rt_status_warn(source->status,
                       "%s:%d:1: warning: the texture '%.*s' of material '%.*s' is left out: %s",
                       source->name, source->line, RT_PATH_SHOWN, m->texture, RT_PATH_SHOWN,
                       m->name, reason);
    material.texture = texture;
    return rt_scene_place_material(scene, &material, source);
}

/* Replaces each triangle's material by its index in the scene, and adds those of the file that a
 * triangle has; what no triangle calls for is not there. */
static bool add_materials(rt_scene *scene, rt_mesh *mesh, const rt_source *source)
{
    const size_t count = mesh->material_count;
    int32_t *indices = malloc((count + 1) * sizeof *indices); /* 0 bytes may be NULL */
    if (!indices)
        return rt_status_no_memory(source->status, "materials");
    for (size_t i = 0; i < count; ++i)
        indices[i] = -1;
    bool good = true;
    for (size_t i = 0; good && i < mesh->triangle_count; ++i) {
        int32_t *index = &indices[mesh->materials[i]];
        if (*index < 0) {
            *index = (int32_t)scene->material_count;
            good = add_material(scene, &mesh->material_list[mesh->materials[i]], source);
        }
        mesh->materials[i] = *index;
    }
    free(indices);
    return good;
}

/* Adds the triangles, for which there is room. */
static bool add_triangles(rt_scene *scene, const rt_mesh *mesh, size_t *degenerate_count,
                          rt_status *status)
{
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        rt_triangle triangle;
        float corners[9], record[RT_NORMAL_COMPONENTS];
        float *normals = is_smooth(mesh, i) ? record : NULL;
        for (size_t k = 0; k < 3; ++k) {
            memcpy(corners + 3 * k, mesh->positions + 3 * (size_t)mesh->corners[3 * i + k],
                   3 * sizeof *corners);
            if (normals)
                memcpy(record + 3 * k, mesh->normals + 3 * (size_t)mesh->normal_corners[3 * i + k],
                       3 * sizeof *record);
        }
        triangle = (rt_triangle){corners[0], corners[1], corners[2], corners[3], corners[4],
                                 corners[5], corners[6], corners[7], corners[8]};
        *degenerate_count += !rt_triangle_settle(&triangle, normals);
        float uvs[RT_UV_COMPONENTS];
        for (size_t k = 0; k < 3 && has_uvs(mesh, i); ++k)
            memcpy(uvs + 2 * k, mesh->uvs + 2 * (size_t)mesh->uv_corners[3 * i + k],
                   2 * sizeof *uvs);
        if (!rt_scene_add_triangle(scene, &triangle, normals, mesh->materials[i], status) ||
            (has_uvs(mesh, i) && !rt_scene_set_uvs(scene, uvs, status)))
            return false;
    }
    return true;
}

/* Adds a mesh that stands in its place; the scene is as it was after an error. */
static bool add_mesh(rt_scene *scene, rt_mesh *mesh, size_t *degenerate_count, bool has_own,
                     const rt_source *source)
{
    const size_t material_count = scene->material_count, triangle_count = scene->triangle_count;
    const size_t normal_count = scene->normal_count, uv_count = scene->uv_count;
    size_t smooth_count = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        smooth_count += is_smooth(mesh, i);
    if (rt_scene_reserve_triangles(scene, mesh->triangle_count, smooth_count, source->status) &&
        (!has_own || add_materials(scene, mesh, source)) &&
        add_triangles(scene, mesh, degenerate_count, source->status))
        return true;
    scene->material_count = material_count;
    scene->triangle_count = triangle_count;
    scene->normal_count = normal_count;
    scene->uv_count = uv_count;
    return false;
}

/* Gives every triangle the material of that index, or for -1 checks that each has one. */
static bool settle_materials(rt_mesh *mesh, int32_t material, rt_source *source,
                             const rt_line *line, const char *path)
{
    size_t missing_count = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        if (material >= 0)
            mesh->materials[i] = material;
        missing_count += mesh->materials[i] < 0;
    }
    if (missing_count == 0)
        return true;
    return RT_FAIL_AT(source, line->start,
                      "a triangle of '%.*s' has no material; give 'material' (%zu such)",
                      RT_PATH_SHOWN, path, missing_count);
}

/* Takes the mesh at `path` as far as it goes; the caller clears it. */
static bool take_mesh(rt_scene *scene, rt_mesh *mesh, const char *path, rt_source *source,
                      const rt_line *line, int32_t material, size_t *degenerate_count)
{
    const char *at = rt_word_start(&line->values[PATH].word);
    if (!rt_mesh_read(mesh, path, source->status))
        return RT_FAIL_AT(source, at, "cannot take the mesh '%.*s'", RT_PATH_SHOWN, path);
    double matrix[12];
    make_matrix(line->values, matrix);
    const char *reason = rt_mesh_transform(mesh, matrix);
    if (reason)
        return RT_FAIL_AT(source, at, "cannot place the mesh '%.*s': %s", RT_PATH_SHOWN, path,
                          reason);
    if (!settle_materials(mesh, material, source, line, path))
        return false;
    if (!add_mesh(scene, mesh, degenerate_count, material < 0, source))
        return RT_FAIL_AT(source, at, "cannot take the mesh '%.*s'", RT_PATH_SHOWN, path);
    return true;
}

bool rt_scene_mesh_add(rt_scene *scene, rt_source *source, const rt_line *line, int32_t material,
                       size_t *degenerate_count)
{
    const rt_word *word = &line->values[PATH].word;
    char *path = rt_file_beside(source->name, word->text, word->length);
    if (!path)
        return rt_status_no_memory(source->status, "a path");
    rt_mesh mesh = {0};
    const size_t normal_count = scene->normal_count;
    const bool good = take_mesh(scene, &mesh, path, source, line, material, degenerate_count);
    if (scene->normal_count > normal_count && !scene->smooth_place.line)
        scene->smooth_place = rt_source_place(source);
    rt_mesh_clear(&mesh);
    free(path);
    return good;
}
