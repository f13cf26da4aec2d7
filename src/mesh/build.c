#define _GNU_SOURCE
#include "mesh/build.h"

#include <stdlib.h>

#include "common/array.h"
#include "scene/scene.h"

static bool has_free_index(size_t count, const char *what, rt_status *status)
{
    return count < INT32_MAX ||
           rt_status_fail(status, RT_ERROR_SCENE, "rt: more than %d %s in a mesh", INT32_MAX, what);
}

/* Adds a record of `size` floats to an array that counts in records. */
static bool add_record(float **array, size_t *count, size_t *capacity, const float *record,
                       size_t size, const char *what, rt_status *status)
{
    if (*count >= *capacity) {
        if (!has_free_index(*count, what, status))
            return false;
        if (!rt_array_grow(array, *count, capacity, size * sizeof **array))
            return rt_status_no_memory(status, what);
    }
    memcpy(*array + size * (*count)++, record, size * sizeof *record);
    return true;
}

bool rt_mesh_add_vertex(rt_mesh *mesh, const float position[3], rt_status *status)
{
    return add_record(&mesh->positions, &mesh->vertex_count, &mesh->vertex_capacity, position, 3,
                      "vertices", status);
}

bool rt_mesh_add_normal(rt_mesh *mesh, const float normal[3], rt_status *status)
{
    return add_record(&mesh->normals, &mesh->normal_count, &mesh->normal_capacity, normal, 3,
                      "normals", status);
}

bool rt_mesh_add_uv(rt_mesh *mesh, const float uv[2], rt_status *status)
{
    return add_record(&mesh->uvs, &mesh->uv_count, &mesh->uv_capacity, uv, 2, "texture coordinates",
                      status);
}

bool rt_mesh_add_material(rt_mesh *mesh, const char *name, size_t length, rt_status *status)
{
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    char *copy = strndup(name, length);
    if (!copy ||
        !RT_ARRAY_GROW(mesh->material_list, mesh->material_count, &mesh->material_capacity)) {
        free(copy);
        return rt_status_no_memory(status, "materials");
    }
    mesh->material_list[mesh->material_count++] =
        (rt_mesh_material){copy, rt_material_make(zero, zero, zero, 1.0f), NULL};
    return true;
}

/* Makes room for a triangle: four arrays grow in step, the capacity moves once all have. */
static bool grow_triangles(rt_mesh *mesh, rt_status *status)
{
    const size_t count = mesh->triangle_count;
    if (!has_free_index(count, "triangles", status))
        return false;
    size_t capacity = mesh->triangle_capacity;
    bool grown = rt_array_grow(&mesh->corners, count, &capacity, 3 * sizeof *mesh->corners);
    capacity = mesh->triangle_capacity;
    grown = grown && rt_array_grow(&mesh->normal_corners, count, &capacity,
                                   3 * sizeof *mesh->normal_corners);
    capacity = mesh->triangle_capacity;
    grown =
        grown && rt_array_grow(&mesh->uv_corners, count, &capacity, 3 * sizeof *mesh->uv_corners);
    capacity = mesh->triangle_capacity;
    grown = grown && RT_ARRAY_GROW(mesh->materials, count, &capacity);
    if (!grown)
        return rt_status_no_memory(status, "triangles");
    mesh->triangle_capacity = capacity;
    return true;
}

bool rt_mesh_add_triangle(rt_mesh *mesh, rt_mesh_corner a, rt_mesh_corner b, rt_mesh_corner c,
                          int32_t material, rt_status *status)
{
    if (mesh->triangle_count >= mesh->triangle_capacity && !grow_triangles(mesh, status))
        return false;
    const size_t i = mesh->triangle_count++;
    int32_t *corners = mesh->corners + 3 * i, *normals = mesh->normal_corners + 3 * i;
    int32_t *uvs = mesh->uv_corners + 3 * i;
    corners[0] = a.vertex;
    corners[1] = b.vertex;
    corners[2] = c.vertex;
    normals[0] = a.normal;
    normals[1] = b.normal;
    normals[2] = c.normal;
    uvs[0] = a.uv;
    uvs[1] = b.uv;
    uvs[2] = c.uv;
    mesh->materials[i] = material;
    return true;
}

bool rt_mesh_face_grow(rt_mesh_face *face, rt_status *status)
{
    return RT_ARRAY_GROW(face->corners, face->count, &face->capacity) ||
           rt_status_no_memory(status, "a face");
}

void rt_mesh_face_clear(rt_mesh_face *face)
{
    free(face->corners);
    free(face->points);
    rt_polygon_clear(&face->polygon);
    *face = (rt_mesh_face){0};
}

bool rt_mesh_add_face(rt_mesh *mesh, rt_mesh_face *face, int32_t material, rt_status *status)
{
    const rt_mesh_corner *corners = face->corners;
    if (face->count == 3)
        return rt_mesh_add_triangle(mesh, corners[0], corners[1], corners[2], material, status);
    if (face->point_capacity < face->capacity) {
        float *points = realloc(face->points, face->capacity * 3 * sizeof *points);
        if (!points)
            return rt_status_no_memory(status, "a face");
        face->points = points;
        face->point_capacity = face->capacity;
    }
    for (size_t i = 0; i < face->count; ++i)
        memcpy(face->points + 3 * i, mesh->positions + 3 * (size_t)corners[i].vertex,
               3 * sizeof *face->points);
    if (!rt_polygon_split(&face->polygon, face->points, face->count))
        return rt_status_no_memory(status, "a face");
    for (size_t i = 0; i < face->count - 2; ++i) {
        const int32_t *t = face->polygon.triangles + 3 * i;
        if (!rt_mesh_add_triangle(mesh, corners[t[0]], corners[t[1]], corners[t[2]], material,
                                  status))
            return false;
    }
    return true;
}

rt_text rt_mesh_text(const rt_mesh_source *source, rt_status *status)
{
    const bool has_mark = source->length >= 3 && memcmp(source->bytes, "\xef\xbb\xbf", 3) == 0;
    const char *start = source->bytes + (has_mark ? 3 : 0);
    return (rt_text){source->name, start, source->bytes + source->length, start, status};
}

bool rt_mesh_fail_byte(const rt_mesh_source *source, rt_status *status, const void *at,
                       const char *format, ...)
{
    char message[RT_MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    rt_message_format(message, format, arguments);
    va_end(arguments);
    return rt_status_fail(status, RT_ERROR_SCENE, "%s: error: byte %zu: %s", source->name,
                          (size_t)((const char *)at - source->bytes), message);
}
