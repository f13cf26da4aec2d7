/* Triangle meshes from files: Wavefront OBJ with MTL, PLY (ascii and both binary forms), STL (ascii
 * and binary). Own readers, because of what Debian packages libassimp (C++, tens of megabytes) says
 * neither where in a file an error is nor how it rounds numbers, and libadmesh reads STL alone and
 * repairs it on the way. */
#ifndef RT_MESH_MESH_H
#define RT_MESH_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/status.h"
#include "kernels/layout.h"

typedef struct rt_mesh_material {
    char *name; /* owned */
    rt_material material;
    char *texture; /* owned: the path of its picture, or NULL */
} rt_mesh_material;

/* All arrays are owned; all indices count from 0. */
typedef struct rt_mesh {
    float *positions;                /* x y z a vertex, finite */
    float *normals;                  /* x y z a normal, finite, of any length; NULL: none is used */
    int32_t *corners;                /* three vertices a triangle */
    int32_t *normal_corners;         /* three normals a triangle, none of them zero, or -1 thrice;
                                        NULL where no triangle has any */
    float *uvs;                      /* u v a texture coordinate, finite; NULL: none is used */
    int32_t *uv_corners;             /* three of them a triangle, or -1 thrice; NULL as above */
    int32_t *materials;              /* record in `material_list` a triangle, or -1 */
    rt_mesh_material *material_list; /* as the material libraries define them, used or not */
    size_t vertex_count, vertex_capacity;
    size_t normal_count, normal_capacity;
    size_t uv_count, uv_capacity;
    size_t triangle_count, triangle_capacity;
    size_t material_count, material_capacity;
} rt_mesh;

/* Reads a mesh into *mesh, which need not be initialised and is left empty after an error. The
 * format is told by the content, not by the name. Reading stops at the first error; it names
 * file:line:column in a text file and the byte, counted from 0, in a binary one. Warnings (a
 * material library that is missing, a file without triangles) go to the status without failing. */
bool rt_mesh_read(rt_mesh *mesh, const char *path, rt_status *status);

/* Applies a 3x4 matrix, row by row, to a point written as a column (x y z 1). Normals stay at right
 * angles to the surface and become unit; a mirroring turns the corners' order, so that the outside
 * stays outside. Returns NULL on success, else the reason as text that needs no release: a matrix
 * without an inverse, or a coordinate outside fp32. The mesh is then good for rt_mesh_clear only.
 */
const char *rt_mesh_transform(rt_mesh *mesh, const double matrix[12]);

/* Releases everything and leaves an empty mesh. */
void rt_mesh_clear(rt_mesh *mesh);

#endif
