/* Random points, the same on every device: integers, then correctly rounded arithmetic. They depend
 * on the pixel, on what they are for and on the sample's number, and on nothing else. */

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

INLINE uint seed_of(int x, int y, uint dimension)
{
    return scramble((uint)x + scramble((uint)y + scramble(dimension)));
}

/* 24 bits as a number in [0, 1). */
INLINE number unit_interval(uint bits)
{
    return (number)(int)(bits >> 8) * (number)0x1p-24f;
}

/* A set of samples, each in a cell of its own of the unit square; made once for many points. */
typedef struct strata {
    int columns, rows;
    float inverse_columns;
    uint cells, inverse_cells; /* the latter 2^32 / cells */
} strata;

INLINE void make_strata(int count, strata *g)
{
    g->columns = (int)sqrt((float)count);
    while (g->columns * g->columns < count)
        ++g->columns;
    while ((g->columns - 1) * (g->columns - 1) >= count)
        --g->columns;
    g->rows = (count + g->columns - 1) / g->columns;
    g->inverse_columns = 1.0f / (float)g->columns;
    g->cells = (uint)(g->columns * g->rows);
    g->inverse_cells = 0xffffffffu / g->cells;
}

/* bits % cells. There is no vector instruction for that: the quotient by a product is at most 2 too
 * small. */
INLINE uint cell_of(const strata *g, uint bits)
{
    const uint quotient = (uint)(((ulong)bits * g->inverse_cells) >> 32);
    uint rest = bits - quotient * g->cells;
    rest -= rest >= g->cells ? g->cells : 0;
    rest -= rest >= g->cells ? g->cells : 0;
    return rest;
}

/* Sample `s` of a set. Dimensions but the pixel's go through the cells from one of their own, or
 * pixel and lens would move together. */
INLINE void stratified(const strata *g, int s, uint seed, uint dimension, number *u, number *v)
{
    uint cell = (uint)s + (dimension == RT_DIMENSION_PIXEL ? 0 : cell_of(g, seed));
    cell -= cell >= g->cells ? g->cells : 0;
    /* Row and column; half a cell keeps the product's rounding from mattering. */
    const int row = (int)(((float)(int)cell + 0.5f) * g->inverse_columns);
    const int column = (int)cell - row * g->columns;
    *u = DIVIDE_1((number)column + unit_interval(scramble(seed + 2 * (uint)s)), (number)g->columns);
    *v = DIVIDE_1((number)row + unit_interval(scramble(seed + 2 * (uint)s + 1)), (number)g->rows);
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
