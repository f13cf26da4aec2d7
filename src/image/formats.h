/* Files: pictures in several formats, a row each, and hit records. */
#ifndef RT_IMAGE_FORMATS_H
#define RT_IMAGE_FORMATS_H

#include <stdbool.h>
#include <stddef.h>

#include "common/file.h"
#include "common/status.h"
#include "image/image.h"

/* Where an encoder's bytes go; it cannot refuse them. */
typedef void rt_image_take(void *sink, void *bytes, int length);

typedef struct rt_image_format {
    const char *extensions[2]; /* without a dot; the first is the format's name, another or NULL */
    bool takes_floats;         /* its pixels are the picture's, else 8-bit steps */
    /* Gives the file to `take`, from three components a pixel, row by row from the top; nonzero on
     * success. */
    int (*encode)(rt_image_take *take, void *sink, int width, int height, const void *pixels);
} rt_image_format;

/* The format that a file name's extension stands for, in any case; "-" is PNG. NULL for none. */
const rt_image_format *rt_image_format_of(const char *path);

/* Writes the formats' names, each behind `before`, such as ".png, .bmp or .hdr", to
 * text[0..size). */
void rt_image_formats_list(const char *before, char *text, size_t size);

/* Encodes to an open output; the caller commits or discards it. */
bool rt_image_write(const rt_image *image, const rt_image_format *format, rt_output *output,
                    rt_status *status);

/* Writes the hit records: for each pixel, row by row from the top, little-endian int32 primitive
 * index and float32 t, u, v. */
bool rt_image_write_hits(const rt_image *image, rt_output *output, rt_status *status);

#endif
