/* What the mesh readers share with read.c, which chooses among them, and with nobody else. */
#ifndef RT_MESH_BUILD_H
#define RT_MESH_BUILD_H

#include <string.h>

#include "common/file.h"
#include "mesh/mesh.h"
#include "mesh/polygon.h"
#include "mesh/text.h"

/* Each adds one element and returns false, with the status set, when memory or the 2^31 - 1
 * elements that an index can name run out. */
bool rt_mesh_add_vertex(rt_mesh *mesh, const float position[3], rt_status *status);
bool rt_mesh_add_normal(rt_mesh *mesh, const float normal[3], rt_status *status);
bool rt_mesh_add_uv(rt_mesh *mesh, const float uv[2], rt_status *status);
bool rt_mesh_add_material(rt_mesh *mesh, const char *name, size_t length, rt_status *status);

typedef struct rt_mesh_corner {
    int32_t vertex, normal, uv; /* normal and uv: -1 for none */
} rt_mesh_corner;

bool rt_mesh_add_triangle(rt_mesh *mesh, rt_mesh_corner a, rt_mesh_corner b, rt_mesh_corner c,
                          int32_t material, rt_status *status);

/* A face being read; its memory is used again for the next one. */
typedef struct rt_mesh_face {
    rt_mesh_corner *corners; /* owned */
    size_t count, capacity;
    float *points; /* owned */
    size_t point_capacity;
    rt_polygon polygon;
} rt_mesh_face;

bool rt_mesh_face_grow(rt_mesh_face *face, rt_status *status);
void rt_mesh_face_clear(rt_mesh_face *face);

static inline bool rt_mesh_face_add(rt_mesh_face *face, rt_mesh_corner corner, rt_status *status)
{
    if (face->count >= face->capacity && !rt_mesh_face_grow(face, status))
        return false;
    face->corners[face->count++] = corner;
    return true;
}

/* Adds the triangles of a face of 3 to RT_POLYGON_CORNERS_MAX corners. */
bool rt_mesh_add_face(rt_mesh *mesh, rt_mesh_face *face, int32_t material, rt_status *status);

/* A mesh file: its bytes, followed by a NUL, and the name for messages. */
typedef struct rt_mesh_source {
    const char *name;
    const char *bytes;
    size_t length;
} rt_mesh_source;

rt_text rt_mesh_text(const rt_mesh_source *source, rt_status *status);
/* Adds "name: error: byte N: " and the message; returns false. */
bool rt_mesh_fail_byte(const rt_mesh_source *source, rt_status *status, const void *at,
                       const char *format, ...) __attribute__((format(printf, 4, 5)));

/* One reader a format. After an error the mesh holds what has been read so far. */
bool rt_mesh_read_obj(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status);
bool rt_mesh_read_ply(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status);
bool rt_mesh_read_stl_text(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status);
bool rt_mesh_read_stl_binary(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status);

/* Adds the materials of a material library (MTL). */
bool rt_mesh_read_mtl(rt_mesh *mesh, const char *path, const rt_file_text *bytes,
                      rt_status *status);

/* The number of bytes of a binary STL file with so many triangles. */
uint64_t rt_mesh_stl_size(uint64_t triangles);
#define RT_MESH_STL_HEADER ((size_t)84)

static inline uint32_t rt_mesh_little32(const char *bytes)
{
    const unsigned char *p = (const unsigned char *)bytes;
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static inline float rt_mesh_float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
