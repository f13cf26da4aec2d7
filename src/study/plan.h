/* What a study measures: which levels, at how many samples a pixel, how often; and how. */
#ifndef RT_STUDY_PLAN_H
#define RT_STUDY_PLAN_H

#include <stdbool.h>
#include <stddef.h>

#include "bvh/bvh.h"
#include "common/accuracy.h"
#include "opencl/device.h"
#include "scene/effects.h"

#define RT_STUDY_SAMPLES_LISTED 16
#define RT_STUDY_REPEATS_MAX 1000
/* Devices that a study holds side by side. */
#define RT_STUDY_DEVICES_MOST 8

typedef struct rt_study_plan {
    bool levels[RT_ACCURACY_COUNT];
    int samples[RT_STUDY_SAMPLES_LISTED]; /* a pixel, rising */
    size_t sample_count;
    int repeats; /* timed ones, after one that is not; more where the times are uneven */
} rt_study_plan;

/* All levels at 1, 4, 16 and 64 samples a pixel, nine times. */
rt_study_plan rt_study_plan_default(void);

/* Lists with commas between their items, such as "fast,robust" and "1,4". The order does not
 * matter, and what is there twice counts once. False, and the plan as it was, for a list that is
 * empty, too long, or has an item that is not a level or a number from 1 to 4096. */
bool rt_study_plan_read_levels(rt_study_plan *plan, const char *text);
bool rt_study_plan_read_samples(rt_study_plan *plan, const char *text);

/* How the studied pictures are rendered. */
typedef struct rt_study_how {
    const rt_device *const *devices;
    size_t device_count; /* 1 to RT_STUDY_DEVICES_MOST */
    const rt_bvh *bvh;   /* of the scene, or NULL to try every primitive */
    int lanes, tile;     /* as in rt_render_options */
    enum rt_effects_mode effects;
} rt_study_how;

#endif
