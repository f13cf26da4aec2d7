#include "image/stb_write.h"

#include <libdeflate.h>
#include <limits.h>
#include <stdlib.h>

/* Smaller and faster than zlib's level 1; libdeflate's own level 1 is slower on rendered pictures,
 * and level 3 takes a fifth longer for 2 per cent. */
#define LEVEL 2

unsigned char *rt_zlib_compress(unsigned char *data, int length, int *out_length, int quality)
{
    (void)quality; /* stb's own scale */
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(LEVEL);
    if (!compressor)
        return NULL;
    const size_t bound = libdeflate_zlib_compress_bound(compressor, (size_t)length);
    unsigned char *out = malloc(bound);
    const size_t size =
        out ? libdeflate_zlib_compress(compressor, data, (size_t)length, out, bound) : 0;
    libdeflate_free_compressor(compressor);
    if (size > 0 && size <= INT_MAX) {
        *out_length = (int)size;
        return out;
    }
    free(out);
    return NULL;
}

unsigned int rt_crc32(const unsigned char *bytes, int length)
{
    return libdeflate_crc32(0, bytes, (size_t)length);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#pragma GCC diagnostic pop
