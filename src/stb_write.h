/* stb_image_write with zlib's compressor under its PNG: the library's own takes several times as
 * long for files a little larger. */
#ifndef RT_STB_WRITE_H
#define RT_STB_WRITE_H

/* Returns a buffer from malloc and its size, or NULL; what STBIW_ZLIB_COMPRESS calls. */
unsigned char *rt_zlib_compress(unsigned char *data, int length, int *out_length, int quality);

#define STBIW_ZLIB_COMPRESS rt_zlib_compress
#include <stb_image_write.h>

#endif
