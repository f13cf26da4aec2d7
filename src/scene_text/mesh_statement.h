/* The statement `mesh`: a mesh file's triangles in the scene. */
#ifndef RT_SCENE_TEXT_MESH_STATEMENT_H
#define RT_SCENE_TEXT_MESH_STATEMENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"
#include "scene_text/line.h"

/* Reads the file that the line names, relative to the source's, scales, turns and moves it and adds
 * its triangles, in the file's order, with the material of that index, or for -1 with the file's
 * own, of which those in use are added. *degenerate_count becomes the number of triangles without
 * area. False after an error at the statement, behind the mesh reader's own where there is one; the
 * scene is then as it was. */
bool rt_scene_mesh_add(rt_scene *scene, rt_source *source, const rt_line *line, int32_t material,
                       size_t *degenerate_count);

#endif
