/* The tiles of one picture, in one queue from which each renderer takes its next: the faster a
 * device is, the more of them are its own. */
#ifndef RT_RENDER_TILES_H
#define RT_RENDER_TILES_H

#include <stdatomic.h>
#include <stdbool.h>

#include "kernels/layout.h"

typedef struct rt_tiles {
    int width, height, side; /* of the picture and of a tile, in pixels */
    int count, takers;
    atomic_int taken; /* may run past count */
    atomic_int finished;
    atomic_int staying; /* takers that have not declined */
} rt_tiles;

/* One renderer at the queue; each belongs to one thread. */
typedef struct rt_taker {
    rt_tiles *tiles;
    int finished;
} rt_taker;

void rt_tiles_init(rt_tiles *tiles, int width, int height, int side, int takers);

/* The next tile, row by row from the top, cut at the picture's edges; false where none is left, or
 * where the taker is so slow that the others are done with all that are left before it would be
 * with one. */
bool rt_tiles_take(rt_taker *taker, rt_tile *tile);

/* Tells that a tile's pixels are in the picture. */
void rt_tiles_finish(rt_taker *taker);

/* The part of the tiles that is finished, 0 to 1. */
double rt_tiles_done(const rt_tiles *tiles);

/* From now on none is left. */
void rt_tiles_stop(rt_tiles *tiles);

#endif
