#include "image/encoding.h"

#include <math.h>
#include <stdlib.h>

double rt_srgb_of_linear(double c)
{
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}

double rt_linear_of_srgb(double s)
{
    return s <= 12.92 * 0.0031308 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

static size_t count_of(const rt_image *image)
{
    return 3 * (size_t)image->width * (size_t)image->height;
}

/* NaN fails the comparison. */
static float clamp(float c)
{
    return c > 0.0f ? (c < 1.0f ? c : 1.0f) : 0.0f;
}

/* 8-bit steps of sRGB without a power for each: which buckets of 1/BUCKETS a component may be in,
 * and where steps begin. The curve's slope is 12.92 at most, so that a bucket is less than a step
 * wide and at most one step begins in it. */
#define BUCKETS 4096
_Static_assert(13 * 255 < BUCKETS, "at most one step begins in a bucket");

typedef struct curve {
    uint8_t steps[BUCKETS + 1]; /* of the least number of each bucket */
    float begins[257];          /* the least float of each step; infinite behind the last */
} curve;

static int srgb_step(float c)
{
    return (int)(255.0 * rt_srgb_of_linear((double)c) + 0.5);
}

static void make_curve(curve *s)
{
    s->begins[0] = 0.0f;
    s->begins[256] = INFINITY;
    for (int k = 1; k < 256; ++k) {
        /* The inverse is rounded: what the curve itself says decides between neighbours. */
        float c = (float)rt_linear_of_srgb((k - 0.5) / 255.0);
        while (srgb_step(c) < k)
            c = nextafterf(c, 1.0f);
        while (srgb_step(nextafterf(c, 0.0f)) >= k)
            c = nextafterf(c, 0.0f);
        s->begins[k] = c;
    }
    for (int i = 0, k = 0; i <= BUCKETS; ++i) {
        while (s->begins[k + 1] <= (float)i / BUCKETS)
            ++k;
        s->steps[i] = (uint8_t)k;
    }
}

uint8_t *rt_encode_8(const rt_image *image, const rt_encoding *encoding, rt_status *status)
{
    const bool is_srgb = encoding->transfer == RT_TRANSFER_SRGB;
    if (!is_srgb && encoding->exposure == 0.0f)
        return rt_image_steps(image, status);
    const float scale = exp2f(encoding->exposure);
    const size_t count = count_of(image);
    uint8_t *steps = malloc(count);
    if (!steps) {
        rt_status_no_memory(status, "the picture");
        return NULL;
    }
    if (!is_srgb) {
        for (size_t i = 0; i < count; ++i)
            steps[i] = rt_image_step(scale * image->rgb[i]);
        return steps;
    }
    curve s;
    make_curve(&s);
    for (size_t i = 0; i < count; ++i) {
        const float c = clamp(scale * image->rgb[i]);
        const uint8_t least = s.steps[(int)(BUCKETS * c)];
        steps[i] = (uint8_t)(least + (c >= s.begins[least + 1]));
    }
    return steps;
}

uint16_t *rt_encode_16(const rt_image *image, const rt_encoding *encoding, rt_status *status)
{
    const bool is_srgb = encoding->transfer == RT_TRANSFER_SRGB;
    const float scale = exp2f(encoding->exposure);
    const size_t count = count_of(image);
    uint16_t *steps = malloc(count * sizeof *steps);
    if (!steps) {
        rt_status_no_memory(status, "the picture");
        return NULL;
    }
    for (size_t i = 0; i < count; ++i) {
        const double c = (double)clamp(scale * image->rgb[i]);
        steps[i] = (uint16_t)(65535.0 * (is_srgb ? rt_srgb_of_linear(c) : c) + 0.5);
    }
    return steps;
}
