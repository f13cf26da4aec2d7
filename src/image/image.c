#include "image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define QUANTIZE_BLOCK 64

bool rt_image_init(rt_image *image, int width, int height, bool with_hits, rt_status *status)
{
    const size_t pixels = (size_t)width * (size_t)height;
    *image = (rt_image){width, height, calloc(pixels, 3 * sizeof *image->rgb), NULL};
    if (with_hits)
        image->hits = calloc(pixels, sizeof *image->hits);
    if (image->rgb && (!with_hits || image->hits))
        return true;
    rt_image_clear(image);
    return rt_status_no_memory(status, "the picture");
}

void rt_image_clear(rt_image *image)
{
    free(image->rgb);
    free(image->hits);
    *image = (rt_image){0};
}

static inline float at_least_0(float c)
{
    return c > 0.0f ? c : 0.0f; /* NaN fails the comparison */
}

static inline float at_most_1(float c)
{
    return c < 1.0f ? c : 1.0f;
}

static inline uint8_t nearest_step(float c)
{
    return (uint8_t)(int)(255.0f * c + 0.5f);
}

uint8_t rt_image_step(float component)
{
    return nearest_step(at_most_1(at_least_0(component)));
}

/* Loops of known length with one selection each are what gcc too vectorises at -O2: seven times as
 * fast as one loop. */
static void quantize_block(const float *restrict rgb, uint8_t *restrict steps)
{
    float c[QUANTIZE_BLOCK];
    for (int i = 0; i < QUANTIZE_BLOCK; ++i)
        c[i] = at_least_0(rgb[i]);
    for (int i = 0; i < QUANTIZE_BLOCK; ++i)
        c[i] = at_most_1(c[i]);
    for (int i = 0; i < QUANTIZE_BLOCK; ++i)
        steps[i] = nearest_step(c[i]);
}

uint8_t *rt_image_steps(const rt_image *image, rt_status *status)
{
    const size_t count = 3 * (size_t)image->width * (size_t)image->height;
    const float *rgb = image->rgb;
    uint8_t *steps = malloc(count);
    if (!steps) {
        rt_status_no_memory(status, "the picture");
        return NULL;
    }
    size_t i = 0;
    for (; i + QUANTIZE_BLOCK <= count; i += QUANTIZE_BLOCK)
        quantize_block(rgb + i, steps + i);
    for (; i < count; ++i)
        steps[i] = rt_image_step(rgb[i]);
    return steps;
}

#define GRID_COARSEST 64

bool rt_image_every(const rt_image *image,
                    bool (*holds)(const void *context, int x, int y, const float rgb[3]),
                    const void *context)
{
    for (int step = GRID_COARSEST; step > 0; step /= 4)
        for (int y = 0; y < image->height; y += step)
            for (int x = 0; x < image->width; x += step) {
                const size_t pixel = (size_t)y * (size_t)image->width + (size_t)x;
                if (!holds(context, x, y, image->rgb + 3 * pixel))
                    return false;
            }
    return true;
}

static bool is_finite_pixel(const float *rgb)
{
    return isfinite(rgb[0]) && isfinite(rgb[1]) && isfinite(rgb[2]);
}

rt_image_difference rt_image_compare(const rt_image *a, const rt_image *b)
{
    rt_image_difference d = {.first_x = -1, .first_y = -1};
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    double squares = 0.0;
    for (size_t i = 0; i < pixels; ++i) {
        const float *p = a->rgb + 3 * i, *q = b->rgb + 3 * i;
        int worst = 0;
        for (int c = 0; c < 3; ++c) {
            const int step = abs(rt_image_step(p[c]) - rt_image_step(q[c]));
            worst = step > worst ? step : worst;
            squares += (double)(step * step);
        }
        d.max_step = worst > d.max_step ? worst : d.max_step;
        const bool is_finite = is_finite_pixel(p) && is_finite_pixel(q);
        d.non_finite += !is_finite;
        /* Bits are what is compared, not values. */
        const bool hit_off =
            a->hits && b->hits && memcmp(&a->hits[i], &b->hits[i], sizeof *a->hits) != 0;
        d.hits += hit_off;
        d.pixels += worst > 1;
        if ((hit_off || worst > 1 || !is_finite) && d.first_x < 0) {
            d.first_x = (int)(i % (size_t)a->width);
            d.first_y = (int)(i / (size_t)a->width);
        }
    }
    d.rms_step = sqrt(squares / (3.0 * (double)pixels));
    return d;
}
