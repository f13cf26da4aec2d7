#include "image/formats.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "image/stb_write.h"

#define JPG_QUALITY 95
/* PNG's filter Up for every row. Trying all five on each row takes as long as the compression and
 * makes rendered pictures no smaller. */
#define PNG_FILTER_UP 2

static int encode_png(rt_image_take *take, void *sink, int width, int height, const void *pixels)
{
    stbi_write_force_png_filter = PNG_FILTER_UP;
    return stbi_write_png_to_func(take, sink, width, height, 3, pixels, 3 * width);
}

static int encode_bmp(rt_image_take *take, void *sink, int width, int height, const void *pixels)
{
    return stbi_write_bmp_to_func(take, sink, width, height, 3, pixels);
}

static int encode_tga(rt_image_take *take, void *sink, int width, int height, const void *pixels)
{
    return stbi_write_tga_to_func(take, sink, width, height, 3, pixels);
}

static int encode_jpg(rt_image_take *take, void *sink, int width, int height, const void *pixels)
{
    return stbi_write_jpg_to_func(take, sink, width, height, 3, pixels, JPG_QUALITY);
}

static int encode_hdr(rt_image_take *take, void *sink, int width, int height, const void *pixels)
{
    return stbi_write_hdr_to_func(take, sink, width, height, 3, pixels);
}

/* The first is that of standard output. */
static const rt_image_format formats[] = {
    {{"png", NULL}, false, encode_png}, {{"bmp", NULL}, false, encode_bmp},
    {{"tga", NULL}, false, encode_tga}, {{"jpg", "jpeg"}, false, encode_jpg},
    {{"hdr", NULL}, true, encode_hdr},
};
#define FORMATS (sizeof formats / sizeof *formats)

const rt_image_format *rt_image_format_of(const char *path)
{
    if (strcmp(path, "-") == 0)
        return &formats[0];
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; dot && i < FORMATS; ++i)
        for (int k = 0; k < 2 && formats[i].extensions[k]; ++k)
            if (strcasecmp(dot + 1, formats[i].extensions[k]) == 0)
                return &formats[i];
    return NULL;
}

void rt_image_formats_list(const char *before, char *text, size_t size)
{
    size_t length = 0;
    for (size_t i = 0; i < FORMATS && length < size; ++i) {
        const char *comma = i == 0 ? "" : i + 1 < FORMATS ? ", " : " or ";
        length += (size_t)snprintf(text + length, size - length, "%s%s%s", comma, before,
                                   formats[i].extensions[0]);
    }
}

/* Encoders give their bytes to a callback that cannot refuse them: after the first failure the rest
 * is dropped. */
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

bool rt_image_write(const rt_image *image, const rt_image_format *format, rt_output *output,
                    rt_status *status)
{
    sink s = {output, status, true};
    uint8_t *steps = NULL;
    if (!format->takes_floats && !(steps = rt_image_steps(image, status)))
        return false;
    const void *pixels = format->takes_floats ? (const void *)image->rgb : steps;
    const int encoded = format->encode(take, &s, image->width, image->height, pixels);
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
