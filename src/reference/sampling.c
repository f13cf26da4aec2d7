/* The sample points of the scalar reference: numbers that look random and are not. They come from
 * the picture's seed, the pixel and the sample's number alone, in whole numbers first and then in
 * correctly rounded arithmetic, so that they are the same wherever and in whatever order they are
 * computed. */
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

/* One sequence for each pixel, purpose, and number of rays before. */
static uint32_t sequence_of(const stream *s, uint32_t purpose)
{
    const uint32_t picture = NAME(mix)(s->seed ^ UINT32_C(0x9e3779b9));
    return NAME(mix)(s->x + NAME(mix)(s->y + NAME(mix)(purpose + NAME(mix)(s->step + picture))));
}

/* From [0, 1): as many bits as a float holds. */
static real fraction(uint32_t bits)
{
    return (real)(bits >> 8) * (real)0x1p-24;
}

static uint32_t bits_reversed(uint32_t x)
{
    uint32_t result = 0;
    for (int i = 0; i < 32; ++i)
        result |= (x >> i & 1) << (31 - i);
    return result;
}

/* Owen's scrambling by a hash (Laine and Karras 2011; constants by Vegdahl): each bit of the
 * fraction is turned or not by a function of the bits before it. */
static uint32_t owen_scrambled(uint32_t fraction_bits, uint32_t seed)
{
    uint32_t x = bits_reversed(fraction_bits);
    x ^= x * UINT32_C(0x3d20adea);
    x += seed;
    x *= seed >> 16 | 1;
    x ^= x * UINT32_C(0x05526c56);
    x ^= x * UINT32_C(0x53a22864);
    return bits_reversed(x);
}

/* Sobol's first two dimensions by their direction numbers (Bratley and Fox 1988): those of the
 * first are single bits, those of the second follow from the polynomial x + 1. */
void NAME(sobol)(uint32_t index, uint32_t point[2])
{
    uint32_t direction = UINT32_C(1) << 31;
    point[0] = point[1] = 0;
    for (int k = 0; k < 32; ++k) {
        if (index >> k & 1) {
            point[0] ^= UINT32_C(1) << (31 - k);
            point[1] ^= direction;
        }
        direction ^= direction >> 1;
    }
}

/* The order is scrambled as the points are, which keeps runs of 2^k points together (Burley 2020).
 */
pair NAME(sample_point)(const stream *s, uint32_t purpose, uint32_t index)
{
    const uint32_t sequence = sequence_of(s, purpose);
    const uint32_t place = owen_scrambled(index, NAME(mix)(sequence));
    uint32_t point[2];
    NAME(sobol)(place, point);
    return (pair){fraction(owen_scrambled(point[0], NAME(mix)(sequence + 1))),
                  fraction(owen_scrambled(point[1], NAME(mix)(sequence + 2)))};
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
