/* The largest closed mesh of a scene: triangles that hang together by their edges, each edge shared
 * by exactly two. */
#ifndef RT_STUDY_CLOSED_MESH_H
#define RT_STUDY_CLOSED_MESH_H

#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

/* Colours of triangles: no two that share an edge have the same. A triangle has three neighbours,
 * so four are enough. */
#define RT_MESH_COLORS 4

typedef struct rt_study_mesh {
    rt_triangle *triangles; /* owned */
    uint8_t *colors;        /* owned */
    size_t count;           /* 0 where no mesh is closed */
} rt_study_mesh;

/* Vertices are the same where their coordinates are. */
bool rt_study_mesh_find(rt_study_mesh *mesh, const rt_scene *scene, rt_status *status);
void rt_study_mesh_clear(rt_study_mesh *mesh);

#endif
