#include "render/tiles.h"

void rt_tiles_init(rt_tiles *tiles, int width, int height, int side, int takers)
{
    tiles->width = width;
    tiles->height = height;
    tiles->side = side;
    tiles->count = ((width + side - 1) / side) * ((height + side - 1) / side);
    tiles->takers = takers;
    atomic_init(&tiles->staying, takers);
    atomic_init(&tiles->taken, 0);
    atomic_init(&tiles->finished, 0);
}

/* The last taker that stays may not leave: it is the one that the others count on. */
static bool leave(rt_tiles *tiles)
{
    int staying = atomic_load(&tiles->staying);
    while (staying > 1)
        if (atomic_compare_exchange_weak(&tiles->staying, &staying, staying - 1))
            return true;
    return false;
}

/* All began together, so tiles finished are speeds. The fastest makes at least `finished / takers`
 * tiles in the time in which this one has made its own; if at that pace it alone has all that are
 * left behind it, and the one that it is at, before this one would have one more, then one more
 * would only keep the picture waiting. Equal takers never decline. */
static bool declines(const rt_taker *taker)
{
    rt_tiles *tiles = taker->tiles;
    const int left = tiles->count - atomic_load(&tiles->taken);
    const int finished = atomic_load(&tiles->finished);
    return tiles->takers > 1 && left > 0 && taker->finished > 0 &&
           (double)(left + 1) * tiles->takers * taker->finished < finished && leave(tiles);
}

bool rt_tiles_take(rt_taker *taker, rt_tile *tile)
{
    rt_tiles *tiles = taker->tiles;
    const int side = tiles->side;
    const int columns = (tiles->width + side - 1) / side;
    if (declines(taker))
        return false;
    const int i = atomic_fetch_add(&tiles->taken, 1);
    if (i >= tiles->count)
        return false;
    *tile = (rt_tile){i % columns * side, i / columns * side, side, side};
    if (tile->width > tiles->width - tile->x)
        tile->width = tiles->width - tile->x;
    if (tile->height > tiles->height - tile->y)
        tile->height = tiles->height - tile->y;
    return true;
}

void rt_tiles_finish(rt_taker *taker)
{
    taker->finished++;
    atomic_fetch_add(&taker->tiles->finished, 1);
}

double rt_tiles_done(const rt_tiles *tiles)
{
    return (double)atomic_load(&tiles->finished) / tiles->count;
}

void rt_tiles_stop(rt_tiles *tiles)
{
    atomic_store(&tiles->taken, tiles->count);
}
