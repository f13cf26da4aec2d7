#include "mesh/mesh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

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
        if (n[0] == 0.0f && n[1] == 0.0f && n[2] == 0.0f) /* of no use to any triangle */
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
