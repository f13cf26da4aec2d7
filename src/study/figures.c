#include "study/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Errors closer than this part of each other are not told apart. */
#define ERROR_MARGIN 0.01
/* Noise hides what is off up to so many pixels away. */
#define HIDING_REACH 2
/* And hides so many times of itself: it might have been larger. */
#define HIDDEN_TIMES 2

double rt_quantile(const double *sorted, size_t count, double p)
{
    if (count == 0)
        return NAN;
    const double place = p * (double)(count - 1);
    const size_t below = (size_t)place;
    if (below + 1 >= count)
        return sorted[count - 1];
    /* Between equals nothing is computed, so that infinities do not become NaN. */
    if (sorted[below] == sorted[below + 1])
        return sorted[below];
    return sorted[below] + (place - (double)below) * (sorted[below + 1] - sorted[below]);
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

rt_spread rt_spread_of(double *values, size_t count)
{
    qsort(values, count, sizeof *values, compare_doubles);
    return (rt_spread){rt_quantile(values, count, 0.25), rt_quantile(values, count, 0.5),
                       rt_quantile(values, count, 0.75)};
}

/* Floats as integers in the order of their values. */
static int64_t ordinal(float value)
{
    int32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits < 0 ? -(int64_t)(bits & INT32_MAX) : bits;
}

uint32_t rt_ulp_distance(float a, float b)
{
    if (isnan(a) || isnan(b))
        return UINT32_MAX;
    return (uint32_t)llabs(ordinal(a) - ordinal(b));
}

static double clamped(float component)
{
    const double c = (double)component;
    return c > 0.0 ? (c < 1.0 ? c : 1.0) : 0.0; /* NaN counts as black, as in the file */
}

/* The largest difference of a component of the i-th pixel, in whole steps. */
static int steps_apart(const rt_image *a, const rt_image *b, size_t i)
{
    int worst = 0;
    for (size_t c = 3 * i; c < 3 * i + 3; ++c) {
        const int steps = abs(rt_image_step(a->rgb[c]) - rt_image_step(b->rgb[c]));
        worst = steps > worst ? steps : worst;
    }
    return worst;
}

rt_study_error rt_study_error_of(const rt_image *picture, const rt_image *reference)
{
    rt_study_error e = {0};
    const size_t pixels = (size_t)picture->width * (size_t)picture->height;
    double squares = 0.0;
    for (size_t i = 0; i < pixels; ++i) {
        const int worst = steps_apart(picture, reference, i);
        bool finite = true;
        for (size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const float p = picture->rgb[c], q = reference->rgb[c];
            const double off = 255.0 * (clamped(p) - clamped(q));
            squares += off * off;
            finite = finite && isfinite(p) && isfinite(q);
        }
        e.max_step = worst > e.max_step ? worst : e.max_step;
        e.over_0 += worst > 0;
        e.over_1 += worst > 1;
        e.over_8 += worst > 8;
        e.non_finite += !finite;
    }
    e.rms = sqrt(squares / (3.0 * (double)pixels));
    return e;
}

/* The largest of what is up to HIDING_REACH before and behind, of `count` values `stride` apart. */
static void spread_most(const uint8_t *from, uint8_t *to, size_t count, size_t stride)
{
    for (size_t i = 0; i < count; ++i) {
        const size_t first = i > HIDING_REACH ? i - HIDING_REACH : 0;
        const size_t end = i + HIDING_REACH + 1 < count ? i + HIDING_REACH + 1 : count;
        uint8_t most = 0;
        for (size_t k = first; k < end; ++k)
            most = from[k * stride] > most ? from[k * stride] : most;
        to[i * stride] = most;
    }
}

uint8_t *rt_study_noise_of(const rt_image *reference, const rt_image *converged)
{
    const size_t width = (size_t)reference->width, height = (size_t)reference->height;
    uint8_t *noise = calloc(height, width), *across = calloc(height, width);
    if (noise && across) {
        for (size_t i = 0; i < width * height; ++i)
            noise[i] = (uint8_t)steps_apart(reference, converged, i);
        for (size_t y = 0; y < height; ++y)
            spread_most(noise + y * width, across + y * width, width, 1);
        for (size_t x = 0; x < width; ++x)
            spread_most(across + x, noise + x, height, width);
    } else {
        free(noise);
        noise = NULL;
    }
    free(across);
    return noise;
}

size_t rt_study_count_visible(const rt_image *picture, const rt_image *reference,
                              const uint8_t *noise)
{
    const size_t pixels = (size_t)picture->width * (size_t)picture->height;
    size_t count = 0;
    for (size_t i = 0; i < pixels; ++i) {
        const int steps = steps_apart(picture, reference, i);
        count += steps > 1 && steps > HIDDEN_TIMES * noise[i];
    }
    return count;
}

static bool is_faster(const rt_study_point *a, const rt_study_point *b)
{
    return a->time.high < b->time.low;
}

static bool is_better(const rt_study_point *a, const rt_study_point *b)
{
    return a->error < (1.0 - ERROR_MARGIN) * b->error;
}

static bool dominates(const rt_study_point *a, const rt_study_point *b)
{
    return (is_faster(a, b) && !is_better(b, a)) || (is_better(a, b) && !is_faster(b, a));
}

bool rt_study_is_dominated(const rt_study_point *points, size_t count, size_t i)
{
    for (size_t j = 0; j < count; ++j)
        if (dominates(&points[j], &points[i]))
            return true;
    return false;
}
