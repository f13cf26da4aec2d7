#include "stb_write.h"

#include <stdlib.h>
#include <zlib.h>

unsigned char *rt_zlib_compress(unsigned char *data, int length, int *out_length, int quality)
{
    (void)quality; /* stb's own scale; level 1 is within a few per cent of the size of level 6 */
    uLongf size = compressBound((uLong)length);
    unsigned char *out = malloc(size);
    if (out && compress2(out, &size, data, (uLong)length, Z_BEST_SPEED) == Z_OK) {
        *out_length = (int)size;
        return out;
    }
    free(out);
    return NULL;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#pragma GCC diagnostic pop
