/* Pictures and hit records: their memory and their comparison. */
#ifndef RT_IMAGE_IMAGE_H
#define RT_IMAGE_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/ray.h"
#include "common/status.h"

typedef struct rt_image {
    int width, height;
    float *rgb;   /* owned: 3 * width * height linear components, row 0 at the top */
    rt_hit *hits; /* owned: width * height records in the same order, or NULL */
} rt_image;

bool rt_image_init(rt_image *image, int width, int height, bool with_hits, rt_status *status);
void rt_image_clear(rt_image *image);

/* The 8-bit step of a component: floor(255 c + 0.5) after clamping to 0..1; 0 for NaN. */
uint8_t rt_image_step(float component);

/* The steps of all components, in their order, from malloc; NULL after an error. */
uint8_t *rt_image_steps(const rt_image *image, rt_status *status);

/* Whether something holds of every pixel. Those of a coarse grid are asked first, so that the end
 * is soon where it does not. */
bool rt_image_every(const rt_image *image,
                    bool (*holds)(const void *context, int x, int y, const float rgb[3]),
                    const void *context);

/* How two pictures of one size differ. Steps are 8-bit steps. */
typedef struct rt_image_difference {
    size_t hits;          /* hit records that differ in a bit; 0 where either has none */
    size_t pixels;        /* pixels off by more than one step in some component */
    int max_step;         /* the largest difference of a component */
    double rms_step;      /* root mean square over all components */
    size_t non_finite;    /* pixels of either picture with a component that is not finite */
    int first_x, first_y; /* the first pixel that any of these counts; -1 if none */
} rt_image_difference;

rt_image_difference rt_image_compare(const rt_image *a, const rt_image *b);

#endif
