/* The sample points of the scalar reference: numbers that look random and are not. They come from
 * the pixel and the sample's number alone, in whole numbers first and then in correctly rounded
 * arithmetic, so that they are the same wherever and in whatever order they are computed. */
#include "reference/effects.h"

/* Wellons' lowbias32: every bit of x reaches every bit of the result. */
uint32_t NAME(mix)(uint32_t x)
{
    x ^= x >> 16;
    x *= UINT32_C(0x7feb352d);
    x ^= x >> 15;
    x *= UINT32_C(0x846ca68b);
    x ^= x >> 16;
    return x;
}

static uint32_t seed_of(const stream *s, uint32_t dimension)
{
    return NAME(mix)(s->x + NAME(mix)(s->y + NAME(mix)(dimension)));
}

/* From [0, 1): as many bits as a float holds. */
static real fraction(uint32_t bits)
{
    return (real)(bits >> 8) * (real)0x1p-24;
}

pair NAME(stratified)(const stream *s, uint32_t dimension, uint32_t count, uint32_t sample)
{
    uint32_t columns = 1;
    while (columns * columns < count)
        ++columns;
    const uint32_t rows = (count + columns - 1) / columns;
    const uint32_t seed = seed_of(s, dimension);
    /* Sample s of the pixel and sample s of the lens must not always lie in the same corner. */
    const uint32_t offset = dimension == DIMENSION_PIXEL ? 0 : seed % (columns * rows);
    const uint32_t cell = (sample + offset) % (columns * rows);
    const uint32_t column = cell % columns, row = cell / columns;
    const real x = (real)column + fraction(NAME(mix)(seed + 2 * sample));
    const real y = (real)row + fraction(NAME(mix)(seed + 2 * sample + 1));
    return (pair){x / (real)columns, y / (real)rows};
}

uint32_t NAME(dimension_at)(const stream *s, uint32_t dimension)
{
    return dimension + 1024 * (s->step + 64 * s->sample);
}

/* Inverts the filter's integral, so that samples of equal weight follow its shape. */
real NAME(filtered)(enum rt_filter filter, real t)
{
    if (filter == RT_FILTER_BOX)
        return t - (real)0.5;
    if (t < (real)0.5)
        return SQRT(2 * t) - 1;
    return 1 - SQRT(FMA(-2, t, 2));
}

/* Sine and cosine in [-pi/4, pi/4] by Taylor's series: errors below 1e-7, and the same bits on
 * every device, which the libraries' functions do not promise. */
void NAME(sine_cosine)(real phi, real *sine, real *cosine)
{
    const real z = phi * phi;
    real s = FMA(z, (real)(1.0 / 362880.0), (real)(-1.0 / 5040.0));
    s = FMA(z, s, (real)(1.0 / 120.0));
    s = FMA(z, s, (real)(-1.0 / 6.0));
    *sine = phi * FMA(z, s, 1);
    real c = FMA(z, (real)(1.0 / 40320.0), (real)(-1.0 / 720.0));
    c = FMA(z, c, (real)(1.0 / 24.0));
    c = FMA(z, c, (real)-0.5);
    *cosine = FMA(z, c, 1);
}

/* Shirley and Chiu 1997: squares about the centre become circles, areas keep their proportions. */
pair NAME(disk)(pair square)
{
    const real quarter_pi = (real)0.78539816339744830962;
    const real a = FMA(2, square.x, -1), b = FMA(2, square.y, -1);
    real sine, cosine;
    if (a == 0 && b == 0)
        return (pair){0, 0};
    if (FABS(a) > FABS(b)) {
        NAME(sine_cosine)(quarter_pi * (b / a), &sine, &cosine);
        return (pair){a * cosine, a * sine};
    }
    NAME(sine_cosine)(quarter_pi * (a / b), &sine, &cosine);
    return (pair){b * sine, b * cosine};
}

/* Duff et al. 2017: no case of n loses its digits, not even n.z near -1. */
void NAME(axes_about)(vec n, vec *t1, vec *t2)
{
    const real sign = COPYSIGN(1, n.z);
    const real a = -1 / (sign + n.z);
    const real b = n.x * n.y * a;
    *t1 = (vec){FMA(sign * (n.x * n.x), a, 1), sign * b, -sign * n.x};
    *t2 = (vec){b, FMA(n.y * n.y, a, sign), -n.y};
}

/* Malley: a disk lifted to the hemisphere above it is cosine-weighted. */
vec NAME(hemisphere)(pair square, vec normal)
{
    const pair p = NAME(disk)(square);
    const real rest = FMA(-p.x, p.x, FMA(-p.y, p.y, 1));
    const real height = SQRT(rest > 0 ? rest : 0);
    vec t1, t2;
    NAME(axes_about)(normal, &t1, &t2);
    return add_scaled(normal, height, add_scaled(t2, p.y, times(t1, p.x)));
}
