/* Random points, the same on every device: integers, then correctly rounded arithmetic. They depend
 * on the picture's seed, the pixel, on what they are for and on the sample's number, and on nothing
 * else.
 *
 * The points of one purpose are the first two dimensions of Sobol's sequence, in an order of their
 * own and scrambled by Owen's nested permutations, both by hashing (Burley, Practical Hash-based
 * Owen Scrambling, JCGT 9.4, 2020): each point alone is evenly distributed, so that a mean is right
 * at any count, and every 2^k points from a multiple of 2^k on are one to each elementary interval,
 * so that its error falls faster than with independent points. Purposes are scrambled apart. */

#if RT_ACCURACY == RT_DOUBLE
#define LITERAL(x) x
#else
#define LITERAL(x) x##f
#endif

/* Wellons' lowbias32. */
INLINE uint scramble(uint x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

/* Of a sequence: what a pixel's rays of that many bounces need random numbers for. */
INLINE uint sequence_of(uint seed, int x, int y, uint purpose, int bounce)
{
    const uint of_bounce = scramble((uint)bounce + scramble(seed ^ 0x9e3779b9u));
    return scramble((uint)x + scramble((uint)y + scramble(purpose + of_bounce)));
}

INLINE uint reversed(uint x)
{
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
    return x >> 16 | x << 16;
}

/* Owen's scrambling of a fraction whose bits are reversed: each bit is turned by a hash of those
 * that weigh more (Laine and Karras 2011; constants by Vegdahl). */
INLINE uint permuted(uint x, uint seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* Pascal's matrix modulo 2 on the bits of x: a point of Sobol's second dimension, bits reversed. */
INLINE uint pascal(uint x)
{
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    x ^= (x & 0xffff0000u) >> 16;
    return x;
}

/* 24 bits as a number in [0, 1). */
INLINE number unit_interval(uint bits)
{
    return (number)(int)(bits >> 8) * (number)0x1p-24f;
}

/* Point `index` of a sequence, in the unit square. */
INLINE void sample_point(uint sequence, uint index, number *u, number *v)
{
    const uint place = reversed(permuted(reversed(index), scramble(sequence)));
    *u = unit_interval(reversed(permuted(place, scramble(sequence + 1u))));
    *v = unit_interval(reversed(permuted(pascal(place), scramble(sequence + 2u))));
}

/* From the unit square to the unit disk, equal areas to equal areas (Shirley and Chiu 1997). Sine
 * and cosine for at most an eighth of a turn by Taylor's series: the error is below 1e-7. */
INLINE void disk(number u, number v, number *x, number *y)
{
    const number a = fma((number)2.0f, u, (number)-1.0f);
    const number b = fma((number)2.0f, v, (number)-1.0f);
    /* |b| not by fabs, as for SUM_OF_SIZES of surface.cl. */
    const int flat = fabs(a) > (b < (number)0.0f ? -b : b);
    const number r = flat ? a : b;
    const number q = r == (number)0.0f ? (number)0.0f : DIVIDE_1(flat ? b : a, r);
    const number phi = (number)LITERAL(0.78539816339744830962) * q;
    const number z = phi * phi;
    const number one = (number)1.0f;
    number sine = fma(z, (number)(LITERAL(1.0) / LITERAL(362880.0)),
                      (number)(LITERAL(-1.0) / LITERAL(5040.0)));
    sine = fma(z, sine, (number)(LITERAL(1.0) / LITERAL(120.0)));
    sine = fma(z, sine, (number)(LITERAL(-1.0) / LITERAL(6.0)));
    sine = phi * fma(z, sine, one);
    number cosine =
        fma(z, (number)(LITERAL(1.0) / LITERAL(40320.0)), (number)(LITERAL(-1.0) / LITERAL(720.0)));
    cosine = fma(z, cosine, (number)(LITERAL(1.0) / LITERAL(24.0)));
    cosine = fma(z, cosine, (number)LITERAL(-0.5));
    cosine = fma(z, cosine, one);
    *x = r * (flat ? cosine : sine);
    *y = r * (flat ? sine : cosine);
}

/* Two unit vectors that stand on the unit vector n and on each other (Duff et al. 2017). */
INLINE void frame_about(vec3 n, vec3 *t1, vec3 *t2)
{
    const number s = copysign((number)1.0f, n.z);
    const number a = DIVIDE_1((number)-1.0f, s + n.z);
    const number b = (n.x * n.y) * a;
    *t1 = (vec3){fma(s * (n.x * n.x), a, (number)1.0f), s * b, -s * n.x};
    *t2 = (vec3){b, fma(n.y * n.y, a, s), -n.y};
}
