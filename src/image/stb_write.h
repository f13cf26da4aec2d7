/* stb_image_write with libdeflate's compressor and checksum under its PNG: the library's own take
 * several times as long, for files that are larger. */
#ifndef RT_IMAGE_STB_WRITE_H
#define RT_IMAGE_STB_WRITE_H

/* Returns a buffer from malloc and its size, or NULL; what STBIW_ZLIB_COMPRESS calls. */
unsigned char *rt_zlib_compress(unsigned char *data, int length, int *out_length, int quality);

/* What STBIW_CRC32 calls. */
unsigned int rt_crc32(const unsigned char *bytes, int length);

#define STBIW_ZLIB_COMPRESS rt_zlib_compress
#define STBIW_CRC32 rt_crc32
#include <stb_image_write.h>

#endif
