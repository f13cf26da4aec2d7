/* What a report shows first: the scene at one level, at another, and their difference as a map of
 * heat, side by side in one picture. */
#ifndef RT_STUDY_STRIP_H
#define RT_STUDY_STRIP_H

#include <stdio.h>

#include "common/file.h"
#include "study/result.h"

/* Pixels between the three, and the widest that each may be; larger ones are made smaller, small
 * ones larger, by whole factors. */
#define RT_STRIP_GAP 16
#define RT_STRIP_SIDE_MOST 640
#define RT_STRIP_SIDE_LEAST 160

/* All zero where nothing is kept. */
typedef struct rt_study_strip {
    int width, height; /* of the pictures kept, which are of one size */
    /* Owned, 3 components a pixel in 8-bit steps: the first device's pictures by level, and the
     * reference at RT_ACCURACY_COUNT; NULL where there is none. */
    uint8_t *pictures[RT_ACCURACY_COUNT + 1];
} rt_study_strip;

void rt_study_strip_clear(rt_study_strip *strip);

/* Keeps a picture of an entry, where it may be shown, or the reference. */
bool rt_study_strip_keep(rt_study_strip *strip, const rt_study *study, size_t entry_index,
                         const rt_image *image, rt_status *status);
bool rt_study_strip_keep_reference(rt_study_strip *strip, const rt_image *image, rt_status *status);

/* How much of the strip's width lies between two of its pictures, in per cent. */
double rt_study_strip_gap(const rt_study *study);

/* Draws those that the study shows, and their difference; the caller clears the image. */
bool rt_study_strip_draw(const rt_study_strip *strip, const rt_study *study, rt_image *image,
                         rt_status *status);
/* Writes that as a PNG. */
bool rt_study_strip_write(const rt_study_strip *strip, const rt_study *study, rt_output *output,
                          rt_status *status);

/* The map's legend: what colour differences in steps have. */
#define RT_HEAT_COUNT 8
typedef struct rt_heat {
    int from, to; /* steps */
    uint8_t color[3];
} rt_heat;
extern const rt_heat rt_heats[RT_HEAT_COUNT];

#endif
