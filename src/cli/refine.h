/* Pictures whose number of samples is what time or an error allows. */
#ifndef RT_CLI_REFINE_H
#define RT_CLI_REFINE_H

#include "cli/run.h"
#include "render/team.h"

/* At least so many samples a pixel, whatever the time. */
#define RT_REFINE_LEAST 4

/* Whether --seconds or --error asks for it. The scene's samples are then the most that there can
 * be, RT_SAMPLES_MAX, until rt_refine has made them those that were taken. */
bool rt_refine_is_asked(const rt_options *options);

/* The root mean square difference from what so many samples as ever would give, in 8-bit steps,
 * of the mean of `more` + `before` samples a pixel: from the difference of two pictures, the sums
 * of the first `before` and of all, of `count` numbers each. As if the two
 * parts were independent; samples that are spread evenly differ less than that. */
double rt_refine_error(const float *first, int before, const float *all, int more, size_t count);

/* Adds samples to all of the picture until the run's seconds are over or its error is reached, and
 * tells what was reached, in words and in the run's statistics. The picture is, to the byte, the
 * one that the scene gives with that number of samples (at `fast`: to an ulp). */
bool rt_refine(rt_run *run, rt_team *team, rt_image *image);

#endif
