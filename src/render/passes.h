/* A tile's way through the stages. */
#ifndef RT_RENDER_PASSES_H
#define RT_RENDER_PASSES_H

#include "render/flight.h"

/* Takes a tile through all stages, and queues the reads of what comes of it. Where that takes
 * several passes, asks the watch between them; `done` and `share` are the parts of the picture that
 * are done before and that the tile is. */
bool rt_passes_start(rt_renderer *renderer, const rt_tile *tile, const rt_sample_range *range,
                     rt_image *image, flight *f, const rt_watch *watch, double done, double share,
                     rt_status *status);

/* Brings what the times count of rays by RT_TALLY_... up to date. */
bool rt_passes_read_tallies(rt_renderer *renderer, rt_status *status);

#endif
