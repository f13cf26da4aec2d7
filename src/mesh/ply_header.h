/* The header of a PLY file: what its data consist of. */
#ifndef RT_MESH_PLY_HEADER_H
#define RT_MESH_PLY_HEADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "mesh/text.h"

enum rt_ply_format { RT_PLY_ASCII, RT_PLY_LITTLE, RT_PLY_BIG };

enum rt_ply_type {
    RT_PLY_INT8,
    RT_PLY_UINT8,
    RT_PLY_INT16,
    RT_PLY_UINT16,
    RT_PLY_INT32,
    RT_PLY_UINT32,
    RT_PLY_FLOAT32,
    RT_PLY_FLOAT64
};

enum rt_ply_role {
    RT_PLY_X,
    RT_PLY_Y,
    RT_PLY_Z,
    RT_PLY_NX,
    RT_PLY_NY,
    RT_PLY_NZ,
    RT_PLY_INDICES,
    RT_PLY_UNUSED
};

typedef struct rt_ply_property {
    rt_token name;
    enum rt_ply_type type;       /* of the value, or of a list's values */
    enum rt_ply_type count_type; /* of a list */
    bool is_list;
    enum rt_ply_role role;
} rt_ply_property;

enum rt_ply_kind { RT_PLY_VERTEX, RT_PLY_FACE, RT_PLY_STRIPS, RT_PLY_OTHER };

typedef struct rt_ply_element {
    rt_token name;
    enum rt_ply_kind kind;
    int64_t count;
    size_t first, property_count; /* in the header's properties */
} rt_ply_element;

typedef struct rt_ply_header {
    enum rt_ply_format format;
    rt_ply_element *elements; /* owned */
    size_t element_count, element_capacity;
    rt_ply_property *properties; /* owned */
    size_t property_count, property_capacity;
    int64_t vertex_count;
    bool has_normals;
    bool needs_rounds; /* faces come before the vertices that they are made of */
} rt_ply_header;

/* Reads an empty header, whose names then point into the text; the cursor is left at the first byte
 * of the data. After an error too, the caller clears it. */
bool rt_ply_read_header(rt_ply_header *header, rt_text *text);
void rt_ply_clear_header(rt_ply_header *header);

#endif
