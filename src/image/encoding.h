/* How the integers of a file stand for the colours of a picture. */
#ifndef RT_IMAGE_ENCODING_H
#define RT_IMAGE_ENCODING_H

#include <stdint.h>

#include "common/status.h"
#include "image/image.h"

/* The curve from a colour to what is stored: none, or that of sRGB (IEC 61966-2-1). */
enum rt_transfer { RT_TRANSFER_LINEAR, RT_TRANSFER_SRGB };

typedef struct rt_encoding {
    enum rt_transfer transfer;
    float exposure; /* in stops: colours are multiplied by 2^exposure first */
} rt_encoding;

/* sRGB's curve for a component from 0 to 1: 12.92 c up to 0.0031308, then 1.055 c^(1/2.4) - 0.055.
 */
double rt_srgb_of_linear(double component);
/* Its inverse. */
double rt_linear_of_srgb(double component);

/* All components, in their order, as steps of 8 or 16 bits: floor(most f(c 2^exposure) + 0.5) with
 * f the curve, most 255 or 65535, after clamping to 0..1; 0 for NaN. From malloc; NULL after an
 * error.
 */
uint8_t *rt_encode_8(const rt_image *image, const rt_encoding *encoding, rt_status *status);
uint16_t *rt_encode_16(const rt_image *image, const rt_encoding *encoding, rt_status *status);

#endif
