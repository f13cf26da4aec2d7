/* OpenEXR: the picture's floats as they are. */
#ifndef RT_IMAGE_EXR_H
#define RT_IMAGE_EXR_H

#include "image/formats.h"

/* An encoder of rt_image_format: scan lines of B, G and R in float, linear, compressed without loss
 * (ZIP). The same picture gives the same bytes. */
rt_image_encode rt_exr_encode;

#endif
