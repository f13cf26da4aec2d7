/* Closed meshes, rays aimed at their edges and vertices, and how often these cross them.
 *
 * Random rays find a leak once in ten million; rays aimed at edges find what there is. A crossing
 * is counted apart from its distance, of which rounding decides between neighbours: triangles that
 * share a vertex differ in some bit of their colour, and for each bit two scenes hold those with
 * and those without it. A ray that hits exactly one triangle hits in exactly one of the two. */
#ifndef RT_TESTS_HARD_MESH_H
#define RT_TESTS_HARD_MESH_H

#include "hard/hard.h"

typedef struct hard_mesh {
    float (*vertices)[3];
    int (*triangles)[3]; /* counter-clockwise from outside */
    int *colors;         /* of the triangles */
    int vertex_count, triangle_count, color_bits;
    double center[3], size; /* where it is and how large */
} hard_mesh;

/* A jittered ball of 8 * n^2 triangles of radius about `size`. Its inside is seen whole from any
 * point within a tenth of its size from the centre, so that each ray from there crosses it once. */
void hard_mesh_ball(hard_mesh *mesh, int n, const double center[3], double size);
/* A flat fan of n triangles in the plane z = 0, about the origin; vertex 0 is the hub. */
void hard_mesh_fan(hard_mesh *mesh, int n);
/* A quad of side 10 in the plane z = 0 with a seam along the diagonal or across it. */
void hard_mesh_quad(hard_mesh *mesh, bool across);
void hard_mesh_clear(hard_mesh *mesh);

enum hard_aim {
    HARD_AIM_ANYWHERE, /* random directions */
    HARD_AIM_EDGES,    /* at a + f (b - a) */
    HARD_AIM_VERTICES,
    HARD_AIM_SEAM /* the one ray of the table, and its neighbours */
};

/* Adds the mesh's triangles to a scene that has a material; with bit >= 0 those whose colour has
 * `value` there. */
void hard_mesh_fill(rt_scene *scene, const hard_mesh *mesh, int bit, int value);
/* Rays `first` to `first` + `count` of those that are aimed so. */
void hard_mesh_aim(const hard_mesh *mesh, enum hard_aim aim, size_t first, size_t count,
                   rt_ray *rays);

typedef struct hard_crossings {
    size_t rays, none, several;
} hard_crossings;

/* Traces `count` rays from within the mesh, half of them in blocks of neighbours, which walk the
 * tree as packets, half of them in any order. */
hard_crossings hard_count(const hard_way *way, const hard_mesh *mesh, enum hard_aim aim,
                          size_t count);

#endif
