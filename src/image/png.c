/* Our own, since what there is does not do it: stb_image_write knows 8 bits alone and no gAMA, and
 * libpng takes zlib, which takes several times as long as libdeflate, for files that are larger. */
#include "image/png.h"

#include <libdeflate.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* Smaller and faster than zlib's level 1; libdeflate's own level 1 is slower on rendered pictures,
 * and level 3 takes a fifth longer for 2 per cent. */
#define LEVEL 2
/* PNG's filter Up for every row. Trying all five on each row takes as long as the compression and
 * makes rendered pictures no smaller. */
#define FILTER_UP 2
#define COLOR_RGB 2
#define COMPONENTS 3

static void put_number(uint8_t out[4], uint32_t number)
{
    for (int i = 0; i < 4; ++i)
        out[i] = (uint8_t)(number >> (24 - 8 * i));
}

static void put_chunk(rt_image_take *take, void *sink, const char *type, void *data, size_t length)
{
    uint8_t head[8], checksum[4];
    put_number(head, (uint32_t)length);
    memcpy(head + 4, type, 4);
    put_number(checksum, libdeflate_crc32(libdeflate_crc32(0, type, 4), data, length));
    take(sink, head, sizeof head);
    take(sink, data, (int)length);
    take(sink, checksum, sizeof checksum);
}

static void put_head(rt_image_take *take, void *sink, const rt_image_pixels *picture, int bits)
{
    uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    uint8_t size[13] = {[8] = (uint8_t)bits, [9] = COLOR_RGB};
    put_number(size, (uint32_t)picture->width);
    put_number(size + 4, (uint32_t)picture->height);
    take(sink, signature, sizeof signature);
    put_chunk(take, sink, "IHDR", size, sizeof size);
    const bool is_srgb = picture->transfer == RT_TRANSFER_SRGB;
    uint8_t intent = 0; /* perceptual */
    uint8_t gamma[4];
    put_number(gamma, is_srgb ? 45455 : 100000);
    if (is_srgb)
        put_chunk(take, sink, "sRGB", &intent, sizeof intent);
    put_chunk(take, sink, "gAMA", gamma, sizeof gamma);
}

/* A row's bytes, the higher one of two first. */
static void load_row(uint8_t *restrict row, const rt_image_pixels *picture, int bits, size_t y)
{
    const size_t count = COMPONENTS * (size_t)picture->width;
    if (bits == 8) {
        memcpy(row, (const uint8_t *)picture->pixels + y * count, count);
        return;
    }
    const uint16_t *restrict steps = (const uint16_t *)picture->pixels + y * count;
    for (size_t i = 0; i < count; ++i) {
        row[2 * i] = (uint8_t)(steps[i] >> 8);
        row[2 * i + 1] = (uint8_t)steps[i];
    }
}

static void filter_row(uint8_t *restrict out, const uint8_t *restrict row,
                       const uint8_t *restrict above, size_t bytes)
{
    *out++ = FILTER_UP;
    for (size_t i = 0; i < bytes; ++i)
        out[i] = (uint8_t)(row[i] - above[i]);
}

/* All rows, filtered, from malloc; NULL without memory. */
static uint8_t *filter(const rt_image_pixels *picture, int bits, size_t bytes)
{
    const size_t height = (size_t)picture->height;
    uint8_t *out = malloc((bytes + 1) * height);
    uint8_t *rows = calloc(2, bytes); /* this one and the one above, which is black at first */
    for (size_t y = 0; out && rows && y < height; ++y) {
        uint8_t *row = rows + (y % 2) * bytes, *above = rows + ((y + 1) % 2) * bytes;
        load_row(row, picture, bits, y);
        filter_row(out + y * (bytes + 1), row, above, bytes);
    }
    if (!rows) {
        free(out);
        out = NULL;
    }
    free(rows);
    return out;
}

/* The compressed rows, from malloc, and their size; NULL where there is no memory or a chunk cannot
 * hold them. */
static uint8_t *compress(const uint8_t *rows, size_t length, size_t *size)
{
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(LEVEL);
    if (!compressor)
        return NULL;
    const size_t bound = libdeflate_zlib_compress_bound(compressor, length);
    uint8_t *out = malloc(bound);
    *size = out ? libdeflate_zlib_compress(compressor, rows, length, out, bound) : 0;
    libdeflate_free_compressor(compressor);
    if (*size > 0 && *size <= INT_MAX)
        return out;
    free(out);
    return NULL;
}

static int encode(rt_image_take *take, void *sink, const rt_image_pixels *picture, int bits)
{
    const size_t bytes = COMPONENTS * (size_t)picture->width * (size_t)(bits / 8);
    uint8_t *rows = filter(picture, bits, bytes);
    size_t size = 0;
    uint8_t *compressed =
        rows ? compress(rows, (bytes + 1) * (size_t)picture->height, &size) : NULL;
    free(rows);
    if (!compressed)
        return 0;
    put_head(take, sink, picture, bits);
    put_chunk(take, sink, "IDAT", compressed, size);
    put_chunk(take, sink, "IEND", compressed, 0);
    free(compressed);
    return 1;
}

int rt_png_encode_8(rt_image_take *take, void *sink, const rt_image_pixels *picture)
{
    return encode(take, sink, picture, 8);
}

int rt_png_encode_16(rt_image_take *take, void *sink, const rt_image_pixels *picture)
{
    return encode(take, sink, picture, 16);
}
