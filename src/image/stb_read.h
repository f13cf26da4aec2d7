/* stb_image for the formats that textures come in, from memory alone. */
#ifndef RT_IMAGE_STB_READ_H
#define RT_IMAGE_STB_READ_H

#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#include <stb_image.h>

#endif
