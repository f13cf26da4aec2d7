/* Files: pictures in several formats, a row each, and hit records. */
#ifndef RT_IMAGE_FORMATS_H
#define RT_IMAGE_FORMATS_H

#include <stdbool.h>
#include <stddef.h>

#include "common/file.h"
#include "common/status.h"
#include "image/encoding.h"
#include "image/image.h"

/* Where an encoder's bytes go; it cannot refuse them. */
typedef void rt_image_take(void *sink, void *bytes, int length);

/* What encoders take: three components a pixel, row by row from the top. */
typedef struct rt_image_pixels {
    int width, height;
    enum rt_transfer transfer; /* of integers; floats are linear */
    const void *pixels;        /* uint8_t, uint16_t or float, as the format says */
} rt_image_pixels;

/* Gives the file to `take`; nonzero on success. */
typedef int rt_image_encode(rt_image_take *take, void *sink, const rt_image_pixels *picture);

enum rt_image_numbers { RT_IMAGE_8_BITS, RT_IMAGE_16_BITS, RT_IMAGE_FLOATS };

typedef struct rt_image_format {
    const char *name;
    const char *extensions[2]; /* without a dot, in the order of preference; NULL for none */
    enum rt_image_numbers numbers;
    rt_image_encode *encode;
} rt_image_format;

/* The format that a file name's extension stands for, in any case; "-" is PNG. NULL for none. */
const rt_image_format *rt_image_format_of(const char *path);
/* The format of that name, in any case; NULL for none. */
const rt_image_format *rt_image_format_named(const char *name);

/* Room for either list. */
#define RT_IMAGE_FORMATS_LIST_SIZE 200

/* Writes the formats' extensions, each behind `before`, such as ".png, .bmp or .hdr", to
 * text[0..size). */
void rt_image_formats_list(const char *before, char *text, size_t size);
/* Likewise their names, of which one may be no extension. */
void rt_image_formats_list_names(char *text, size_t size);

/* Encodes to an open output; the caller commits or discards it. `encoding` is for integers; formats
 * of floats have the picture as it is. */
bool rt_image_write(const rt_image *image, const rt_image_format *format,
                    const rt_encoding *encoding, rt_output *output, rt_status *status);

/* Writes the hit records: for each pixel, row by row from the top, little-endian int32 primitive
 * index and float32 t, u, v. */
bool rt_image_write_hits(const rt_image *image, rt_output *output, rt_status *status);

#endif
