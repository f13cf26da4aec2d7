#include "truth/bias.h"

#include <math.h>
#include <string.h>

void truth_expect(truth_tally *t, const truth_picture *picture)
{
    double size = 0.0, middle = 0.0;
    memset(t, 0, sizeof *t);
    truth_integrate(picture, t->truth);
    for (size_t i = 0; i < TRUTH_PIXELS; ++i) {
        if (isnan(t->truth[i]))
            continue;
        t->pixels[t->pixel_count++] = i;
        t->tilt[i] = t->truth[i] - floor(t->truth[i]);
        size += t->truth[i];
        middle += t->tilt[i];
    }
    for (size_t k = 0; k < t->pixel_count; ++k)
        t->tilt[t->pixels[k]] -= middle / (double)t->pixel_count;
    t->size = fmax(1.0, size / (double)t->pixel_count);
    t->lawful = picture->row->lawful;
    t->has_pixels = picture->scene->samples > 1;
}

/* Mean and standard deviation of values of the pixels that are looked at. */
static void spread_of(const truth_tally *t, const double *values, double *mean, double *deviation)
{
    const double count = (double)t->pixel_count;
    double sum = 0.0, squares = 0.0;
    for (size_t k = 0; k < t->pixel_count; ++k)
        sum += values[t->pixels[k]];
    *mean = sum / count;
    for (size_t k = 0; k < t->pixel_count; ++k) {
        const double off = values[t->pixels[k]] - *mean;
        squares += off * off;
    }
    *deviation = sqrt(squares / (count - 1.0));
}

/* What is beyond `lawful` of a mean, in standard errors. Where there is no noise rounding's share
 * stands in for it. */
static double in_errors(const truth_tally *t, double mean, double deviation, double lawful,
                        double rounding)
{
    const double error = deviation / sqrt((double)t->pixel_count);
    return fmax(0.0, fabs(mean) - lawful) / hypot(rounding, error);
}

/* The mean size of a weight. */
static double size_of(const truth_tally *t, enum truth_weight weight)
{
    double sum = 0.0;
    for (size_t k = 0; k < t->pixel_count; ++k)
        sum += weight == TRUTH_TILT ? fabs(t->tilt[t->pixels[k]]) : 1.0;
    return sum / (double)t->pixel_count;
}

double truth_bias(truth_tally *t, int count, enum truth_weight weight, const double *errors)
{
    const double size = size_of(t, weight), lawful = size * t->lawful;
    /* Colours are floats, and so is the sum of `count` of them, rounded at each addition. */
    const double rounding = size * t->size * (0x1p-20 + count * 0x1p-25);
    double values[TRUTH_PIXELS] = {0.0}, mean, deviation;
    if (size < 1e-6)
        return 0.0;
    for (size_t k = 0; k < t->pixel_count; ++k) {
        const size_t i = t->pixels[k];
        values[i] = (weight == TRUTH_TILT ? t->tilt[i] : 1.0) * errors[i];
    }
    spread_of(t, values, &mean, &deviation);
    const double unit = fmax(deviation, rounding);
    for (size_t k = 0; k < t->pixel_count; ++k)
        t->sum[weight][t->pixels[k]] += values[t->pixels[k]] / unit;
    t->sum_lawful[weight] += lawful / unit;
    t->sum_rounding[weight] += rounding / unit;
    return in_errors(t, mean, deviation, lawful, rounding);
}

/* Pixel by pixel first: counts share samples. */
double truth_bias_of_all(const truth_tally *t, enum truth_weight weight)
{
    double mean, deviation;
    if (t->sum_rounding[weight] == 0.0)
        return 0.0;
    spread_of(t, t->sum[weight], &mean, &deviation);
    return in_errors(t, mean, deviation, t->sum_lawful[weight], t->sum_rounding[weight]);
}
