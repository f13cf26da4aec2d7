/* PNG, of 8 and of 16 bits (ISO/IEC 15948). */
#ifndef RT_IMAGE_PNG_H
#define RT_IMAGE_PNG_H

#include "image/formats.h"

/* Encoders of rt_image_format. The file says how its integers stand for colours: by gAMA 1 where
 * they are linear, by sRGB where they are sRGB's, and then by gAMA 0.45455 for readers that do not
 * know that. */
rt_image_encode rt_png_encode_8, rt_png_encode_16;

#endif
