#include "study/strip.h"

#include <stdlib.h>

#include "image/formats.h"

/* Each twice as far off as the one before; colours that grow brighter as they grow warmer. */
const rt_heat rt_heats[RT_HEAT_COUNT] = {{0, 0, {16, 16, 20}},     {1, 1, {46, 46, 60}},
                                         {2, 3, {74, 26, 120}},    {4, 7, {140, 34, 110}},
                                         {8, 15, {205, 66, 72}},   {16, 31, {244, 120, 32}},
                                         {32, 63, {252, 190, 40}}, {64, 255, {255, 255, 190}}};

static const uint8_t white[3] = {255, 255, 255};

void rt_study_strip_clear(rt_study_strip *strip)
{
    for (int i = 0; i <= RT_ACCURACY_COUNT; ++i)
        free(strip->pictures[i]);
    *strip = (rt_study_strip){0};
}

static bool keep(rt_study_strip *strip, int which, const rt_image *image, rt_status *status)
{
    free(strip->pictures[which]);
    strip->width = image->width;
    strip->height = image->height;
    strip->pictures[which] = rt_image_steps(image, status);
    return strip->pictures[which] != NULL;
}

bool rt_study_strip_keep(rt_study_strip *strip, const rt_study *study, size_t entry_index,
                         const rt_image *image, rt_status *status)
{
    const rt_study_entry *entry = &study->entries[entry_index];
    return entry->device != 0 || keep(strip, (int)entry->level, image, status);
}

bool rt_study_strip_keep_reference(rt_study_strip *strip, const rt_image *image, rt_status *status)
{
    return keep(strip, RT_ACCURACY_COUNT, image, status);
}

/* How pictures are brought to the strip: `shrink` pixels to one, or one to `grow`. */
typedef struct scale {
    int shrink, grow, width, height; /* of what comes out */
} scale;

static scale scale_of(int width, int height)
{
    scale s = {(width + RT_STRIP_SIDE_MOST - 1) / RT_STRIP_SIDE_MOST, 1, 0, 0};
    if (width < RT_STRIP_SIDE_LEAST)
        s.grow = (RT_STRIP_SIDE_LEAST + width - 1) / width;
    s.width = (width + s.shrink - 1) / s.shrink * s.grow;
    s.height = (height + s.shrink - 1) / s.shrink * s.grow;
    return s;
}

/* The pixels that one of the strip stands for, from (x, y) up to (right, below). */
typedef struct patch {
    int x, y, right, below;
} patch;

static patch patch_of(const rt_study_strip *strip, const scale *s, int x, int y)
{
    patch p = {x / s->grow * s->shrink, y / s->grow * s->shrink, 0, 0};
    p.right = p.x + s->shrink < strip->width ? p.x + s->shrink : strip->width;
    p.below = p.y + s->shrink < strip->height ? p.y + s->shrink : strip->height;
    return p;
}

static void mean_of(const rt_study_strip *strip, const uint8_t *steps, const patch *p,
                    uint8_t out[3])
{
    const int count = (p->right - p->x) * (p->below - p->y);
    for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int y = p->y; y < p->below; ++y)
            for (int x = p->x; x < p->right; ++x)
                sum += steps[3 * ((size_t)y * (size_t)strip->width + (size_t)x) + (size_t)c];
        out[c] = (uint8_t)((sum + count / 2) / count);
    }
}

/* The largest difference, so that a speck is not lost. */
static const uint8_t *heat_of(const rt_study_strip *strip, const uint8_t *a, const uint8_t *b,
                              const patch *p)
{
    int worst = 0;
    for (int y = p->y; y < p->below; ++y)
        for (int x = p->x; x < p->right; ++x)
            for (int c = 0; c < 3; ++c) {
                const size_t i = 3 * ((size_t)y * (size_t)strip->width + (size_t)x) + (size_t)c;
                const int steps = abs(a[i] - b[i]);
                worst = steps > worst ? steps : worst;
            }
    int i = 0;
    while (worst > rt_heats[i].to)
        ++i;
    return rt_heats[i].color;
}

/* One column of the strip's row `y`; what lies between the three is white. */
static void draw_pixel(const rt_study_strip *strip, const rt_study *study, const scale *s, int x,
                       int y, float rgb[3])
{
    const uint8_t *a = strip->pictures[study->shown[0]], *b = strip->pictures[study->shown[1]];
    const int which = x / (s->width + RT_STRIP_GAP), column = x % (s->width + RT_STRIP_GAP);
    const patch p = patch_of(strip, s, column < s->width ? column : 0, y);
    const bool is_gap = column >= s->width;
    if (is_gap || which == 2) {
        /* Colours of the page, which are sRGB's. */
        const uint8_t *color = is_gap ? white : heat_of(strip, a, b, &p);
        for (int c = 0; c < 3; ++c)
            rgb[c] = (float)rt_linear_of_srgb((double)color[c] / 255.0);
        return;
    }
    uint8_t steps[3];
    mean_of(strip, which ? b : a, &p, steps);
    for (int c = 0; c < 3; ++c)
        rgb[c] = (float)steps[c] / 255.0f;
}

double rt_study_strip_gap(const rt_study *study)
{
    const scale s = scale_of(study->width, study->height);
    return 100.0 * RT_STRIP_GAP / (3.0 * s.width + 2.0 * RT_STRIP_GAP);
}

bool rt_study_strip_draw(const rt_study_strip *strip, const rt_study *study, rt_image *image,
                         rt_status *status)
{
    const scale s = scale_of(strip->width, strip->height);
    if (!rt_image_init(image, 3 * s.width + 2 * RT_STRIP_GAP, s.height, false, status))
        return false;
    for (int y = 0; y < image->height; ++y)
        for (int x = 0; x < image->width; ++x)
            draw_pixel(strip, study, &s, x, y,
                       image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x));
    return true;
}

bool rt_study_strip_write(const rt_study_strip *strip, const rt_study *study, rt_output *output,
                          rt_status *status)
{
    rt_image image;
    const rt_encoding encoding = {RT_TRANSFER_SRGB, 0.0f};
    if (!rt_study_strip_draw(strip, study, &image, status))
        return false;
    const bool good =
        rt_image_write(&image, rt_image_format_of("strip.png"), &encoding, output, status);
    rt_image_clear(&image);
    return good;
}
