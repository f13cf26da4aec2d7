/* The data of a PLY file: the rows that its header declares. */
#ifndef RT_MESH_PLY_DATA_H
#define RT_MESH_PLY_DATA_H

#include "mesh/build.h"
#include "mesh/ply_header.h"

/* Reads what follows the header, where the text's cursor stands. */
bool rt_ply_read_data(rt_mesh *mesh, const rt_mesh_source *source, const rt_ply_header *header,
                      rt_text *text);

#endif
