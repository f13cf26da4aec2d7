#include "image/formats.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <stb_image_write.h>

#include "image/exr.h"
#include "image/png.h"

#define COMPONENTS 3
#define JPG_QUALITY 95

static int encode_bmp(rt_image_take *take, void *sink, const rt_image_pixels *p)
{
    return stbi_write_bmp_to_func(take, sink, p->width, p->height, COMPONENTS, p->pixels);
}

static int encode_tga(rt_image_take *take, void *sink, const rt_image_pixels *p)
{
    return stbi_write_tga_to_func(take, sink, p->width, p->height, COMPONENTS, p->pixels);
}

static int encode_jpg(rt_image_take *take, void *sink, const rt_image_pixels *p)
{
    return stbi_write_jpg_to_func(take, sink, p->width, p->height, COMPONENTS, p->pixels,
                                  JPG_QUALITY);
}

static int encode_hdr(rt_image_take *take, void *sink, const rt_image_pixels *p)
{
    return stbi_write_hdr_to_func(take, sink, p->width, p->height, COMPONENTS, p->pixels);
}

/* The first is that of standard output. */
static const rt_image_format formats[] = {
    {"png", {"png"}, RT_IMAGE_8_BITS, rt_png_encode_8},
    {"bmp", {"bmp"}, RT_IMAGE_8_BITS, encode_bmp},
    {"tga", {"tga"}, RT_IMAGE_8_BITS, encode_tga},
    {"jpg", {"jpg", "jpeg"}, RT_IMAGE_8_BITS, encode_jpg},
    {"hdr", {"hdr"}, RT_IMAGE_FLOATS, encode_hdr},
    {"exr", {"exr"}, RT_IMAGE_FLOATS, rt_exr_encode},
    {"png16", {NULL}, RT_IMAGE_16_BITS, rt_png_encode_16},
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

const rt_image_format *rt_image_format_named(const char *name)
{
    for (size_t i = 0; i < FORMATS; ++i)
        if (strcasecmp(name, formats[i].name) == 0)
            return &formats[i];
    return NULL;
}

/* The names, or the extensions of those that have one. */
static void list(bool names, const char *before, char *text, size_t size)
{
    size_t left = 0, length = 0;
    for (size_t i = 0; i < FORMATS; ++i)
        left += names || formats[i].extensions[0];
    const size_t count = left;
    for (size_t i = 0; i < FORMATS && length < size; ++i) {
        const char *word = names ? formats[i].name : formats[i].extensions[0];
        if (!word)
            continue;
        const char *comma = left == count ? "" : left > 1 ? ", " : " or ";
        length += (size_t)snprintf(text + length, size - length, "%s%s%s", comma, before, word);
        --left;
    }
}

void rt_image_formats_list(const char *before, char *text, size_t size)
{
    list(false, before, text, size);
}

void rt_image_formats_list_names(char *text, size_t size)
{
    list(true, "", text, size);
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

/* The numbers that a format takes, from malloc, or NULL after an error. */
static void *numbers_of(const rt_image *image, const rt_image_format *format,
                        const rt_encoding *encoding, rt_status *status)
{
    if (format->numbers == RT_IMAGE_8_BITS)
        return rt_encode_8(image, encoding, status);
    return rt_encode_16(image, encoding, status);
}

bool rt_image_write(const rt_image *image, const rt_image_format *format,
                    const rt_encoding *encoding, rt_output *output, rt_status *status)
{
    sink s = {output, status, true};
    const bool has_floats = format->numbers == RT_IMAGE_FLOATS;
    void *numbers = has_floats ? NULL : numbers_of(image, format, encoding, status);
    if (!has_floats && !numbers)
        return false;
    const rt_image_pixels picture = {image->width, image->height, encoding->transfer,
                                     has_floats ? image->rgb : numbers};
    const int encoded = format->encode(take, &s, &picture);
    free(numbers);
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
