/* A picture on the floor. */
#include "truth/worlds.h"

#include <math.h>

#include "truth/forms.h"

#define TEXELS 96

/* A ramp, which shows where a picture is shifted, and noise; 0 to 255. Row 0 is the lowest. */
static int texel(int column, int row)
{
    test_random random = {(uint64_t)(row * TEXELS + column)};
    return column + row / 2 + (int)(test_random_bits(&random) % 112);
}

/* A bitmap of 24 bits a pixel, whose rows go up. */
static void write_picture(void)
{
    static unsigned char bytes[54 + 3 * TEXELS * TEXELS] = {
        'B', 'M', [10] = 54, [14] = 40, [18] = TEXELS, [22] = TEXELS, [26] = 1, [28] = 24};
    for (int i = 0; i < 3 * TEXELS * TEXELS; ++i)
        bytes[54 + i] = (unsigned char)texel(i / 3 % TEXELS, i / 3 / TEXELS);
    const unsigned size = sizeof bytes;
    for (int i = 0; i < 4; ++i)
        bytes[2 + i] = (unsigned char)(size >> 8 * i);
    test_write_file(test_path("texels.bmp"), bytes, sizeof bytes);
}

/* Bilinear between the middles of texels; the picture's middle is the floor's. */
static double bilinear(truth_vec at, double width)
{
    const double x = at.x / width + 0.5 * TEXELS - 0.5, y = at.y / width + 0.5 * TEXELS - 0.5;
    const int column = (int)floor(x), row = (int)floor(y);
    const double f = x - column, g = y - row;
    return ((1 - g) * ((1 - f) * texel(column, row) + f * texel(column + 1, row)) +
            g * ((1 - f) * texel(column, row + 1) + f * texel(column + 1, row + 1))) /
           255.0;
}

static void add_texels(truth_text *text, double width)
{
    const double side = width * TEXELS;
    write_picture();
    fprintf(text->out,
            "material picture ka 1 1 1 texture \"texels.bmp\"\n"
            "triangle a %.9g %.9g 0 b %.9g %.9g 0 c %.9g %.9g 0 ta -1 -1 tb 3 -1 tc -1 3 "
            "material picture\n",
            -1.5 * side, -1.5 * side, 2.5 * side, -1.5 * side, -1.5 * side, 2.5 * side);
}

void truth_add_large_texels(truth_text *text)
{
    add_texels(text, 4.0);
}

double truth_large_texels(const truth_picture *p, const truth_ray *ray)
{
    (void)p;
    return bilinear(truth_floor(ray), 4.0);
}

void truth_add_small_texels(truth_text *text)
{
    add_texels(text, 0.4);
}

double truth_small_texels(const truth_picture *p, const truth_ray *ray)
{
    (void)p;
    return bilinear(truth_floor(ray), 0.4);
}
