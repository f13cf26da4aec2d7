/* Polygons into triangles. */
#ifndef RT_MESH_POLYGON_H
#define RT_MESH_POLYGON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The time that a polygon takes grows with its corners times its concave corners: some seconds at
 * this size, where most are concave. */
#define RT_POLYGON_CORNERS_MAX 65536

typedef struct rt_polygon_node rt_polygon_node;

/* The result for the polygon split last, and memory that is used again for the next one. */
typedef struct rt_polygon {
    int32_t *triangles; /* owned; three corners of the polygon a triangle, count - 2 triangles */
    rt_polygon_node *nodes;
    int32_t *blockers;
    size_t blocker_count, capacity;
} rt_polygon;

#define RT_POLYGON_INIT ((rt_polygon){NULL, NULL, NULL, 0, 0})

/* Splits the polygon through points[3 * i], 3 <= count <= RT_POLYGON_CORNERS_MAX, concave or not,
 * which keeps to its plane roughly at least. Triangles run around as the polygon does and sum up to
 * its area; a convex polygon becomes the fan of its first corner. Corners that repeat their
 * neighbour or lie on a line with both can give triangles without area. Where edges cross there is
 * no right answer, and some fan stands in. False when there is no memory. */
bool rt_polygon_split(rt_polygon *polygon, const float *points, size_t count);

void rt_polygon_clear(rt_polygon *polygon);

#endif
