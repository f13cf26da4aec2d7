#include "image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "image/stb_write.h"

#define JPG_QUALITY 95
/* PNG's filter Up for every row. Trying all five on each row takes as long as the compression and
 * makes rendered pictures no smaller. */
#define PNG_FILTER_UP 2
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
        d.non_finite += !is_finite_pixel(p) || !is_finite_pixel(q);
        /* Bits are what is compared, not values. */
        const bool hit_off =
            a->hits && b->hits && memcmp(&a->hits[i], &b->hits[i], sizeof *a->hits) != 0;
        d.hits += hit_off;
        d.pixels += worst > 1;
        if ((hit_off || worst > 1) && d.first_x < 0) {
            d.first_x = (int)(i % (size_t)a->width);
            d.first_y = (int)(i / (size_t)a->width);
        }
    }
    d.rms_step = sqrt(squares / (3.0 * (double)pixels));
    return d;
}

enum rt_image_format rt_image_format_of(const char *path)
{
    static const struct {
        const char *extension;
        enum rt_image_format format;
    } formats[] = {{"png", RT_IMAGE_PNG}, {"bmp", RT_IMAGE_BMP},  {"tga", RT_IMAGE_TGA},
                   {"jpg", RT_IMAGE_JPG}, {"jpeg", RT_IMAGE_JPG}, {"hdr", RT_IMAGE_HDR}};
    if (strcmp(path, "-") == 0)
        return RT_IMAGE_PNG;
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; dot && i < sizeof formats / sizeof *formats; ++i)
        if (strcasecmp(dot + 1, formats[i].extension) == 0)
            return formats[i].format;
    return RT_IMAGE_UNKNOWN;
}

/* stb_image_write gives its bytes to a callback that cannot refuse them: after the first failure
 * the rest is dropped. */
typedef struct sink {
    rt_output *output;
    rt_status *status;
    bool good;
} sink;

static void take(void *context, void *bytes, int length)
{
    sink *s = context;
    s->good = s->good && rt_output_write(s->output, bytes, (size_t)length, s->status);
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

static uint8_t *quantize(const rt_image *image, rt_status *status)
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

bool rt_image_write(const rt_image *image, enum rt_image_format format, rt_output *output,
                    rt_status *status)
{
    const int width = image->width, height = image->height;
    sink s = {output, status, true};
    uint8_t *steps = NULL;
    if (format != RT_IMAGE_HDR && !(steps = quantize(image, status)))
        return false;
    int encoded = 0;
    switch (format) {
    case RT_IMAGE_PNG:
        stbi_write_force_png_filter = PNG_FILTER_UP;
        encoded = stbi_write_png_to_func(take, &s, width, height, 3, steps, 3 * width);
        break;
    case RT_IMAGE_BMP:
        encoded = stbi_write_bmp_to_func(take, &s, width, height, 3, steps);
        break;
    case RT_IMAGE_TGA:
        encoded = stbi_write_tga_to_func(take, &s, width, height, 3, steps);
        break;
    case RT_IMAGE_JPG:
        encoded = stbi_write_jpg_to_func(take, &s, width, height, 3, steps, JPG_QUALITY);
        break;
    case RT_IMAGE_HDR:
        encoded = stbi_write_hdr_to_func(take, &s, width, height, 3, image->rgb);
        break;
    case RT_IMAGE_UNKNOWN:
        break;
    }
    free(steps);
    if (!encoded && s.good)
        return rt_status_fail(status, RT_ERROR_OUTPUT, "rt: the picture could not be encoded");
    return s.good;
}

static void put_word(uint8_t *out, uint32_t word)
{
    for (int byte = 0; byte < 4; ++byte)
        out[byte] = (uint8_t)(word >> (8 * byte));
}

bool rt_image_write_hits(const rt_image *image, rt_output *output, rt_status *status)
{
    const size_t row_size = 16 * (size_t)image->width;
    uint8_t *row = malloc(row_size);
    if (!row)
        return rt_status_no_memory(status, "hit records");
    bool good = true;
    for (int y = 0; good && y < image->height; ++y) {
        const rt_hit *hits = image->hits + (size_t)y * (size_t)image->width;
        for (size_t x = 0; x < (size_t)image->width; ++x) {
            uint32_t words[4];
            memcpy(words, &hits[x], sizeof words);
            for (size_t i = 0; i < 4; ++i)
                put_word(row + 16 * x + 4 * i, words[i]);
        }
        good = rt_output_write(output, row, row_size, status);
    }
    free(row);
    return good;
}
