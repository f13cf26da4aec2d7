/* The lane type of the trace stage, and the arithmetic that must give the same bits everywhere.
 *
 * A `real` holds RT_LANES rays' values of one quantity; a `mask` is -1 in the lanes that are on
 * and 0 elsewhere. Every multiply-add is a written fma, so that there is nothing left for a
 * compiler to contract: contraction on or off, the bits are the same. */
#pragma OPENCL FP_CONTRACT OFF

#define RT_PASTE_(a, b) a##b
#define RT_PASTE(a, b) RT_PASTE_(a, b)

/* What rays, hits and shading are computed in; the trace stage has a `real` of them in its lanes.
 * Boxes and primitives are float at every level. */
#if RT_ACCURACY == RT_DOUBLE
#define RT_NUMBER double
#define RT_BITS long
#define NUMBER_MAX DBL_MAX
#define RT_HALF_ULP 0x1p-53
#define SIGN_BIT 0x8000000000000000L
#define EXPONENT_BITS 0x7ff0000000000000L
#else
#define RT_NUMBER float
#define RT_BITS int
#define NUMBER_MAX FLT_MAX
#define RT_HALF_ULP 0x1p-24f
#define SIGN_BIT 0x80000000
#define EXPONENT_BITS 0x7f800000
#endif
typedef RT_NUMBER number;

/* The children of a node, in lanes. */
typedef RT_PASTE(RT_NUMBER, 16) number16;
typedef RT_PASTE(RT_BITS, 16) mask16;
#define LOAD_16(p) RT_PASTE(RT_PASTE(convert_, RT_NUMBER), 16)(vload16(0, p))

/* Wide vectors go by memory between functions where the device has no registers of that width; all
 * functions are inlined, so there is nothing to warn of. */
#ifdef __clang__
#pragma clang diagnostic ignored "-Wpsabi"
#endif

/* At the level fast the compiler takes for granted that nothing is infinite; what is, is told by
 * its bits (stages/trace.cl). Clang 18 and later warn of every INFINITY then, on the user's
 * terminal. */
#if defined(__clang__) && defined(__has_warning)
#if __has_warning("-Wnan-infinity-disabled")
#pragma clang diagnostic ignored "-Wnan-infinity-disabled"
#endif
#endif

/* Extensions of clang, which most runtimes for CPUs compile by. */
#ifdef __has_builtin
#define HAS_BUILTIN(name) __has_builtin(name)
#else
#define HAS_BUILTIN(name) 0
#endif

#if RT_LANES == 1
typedef number real;
typedef RT_BITS mask;
#define AS_REAL RT_PASTE(as_, RT_NUMBER)
#define AS_MASK RT_PASTE(as_, RT_BITS)
#define LOAD_REAL(p) (*(p))
#define STORE_REAL(v, p) (*(p) = (v))
#define STORE_INDEX(v, p) (*(p) = (int)(v))
/* Scalar comparisons give 1 for true, vector ones -1. */
#define MASK(condition) (-(mask)(condition))
#define ANY(m) ((m) != 0)
#define SELECT(off, on, m) ((m) ? (on) : (off))
#else
typedef RT_PASTE(RT_NUMBER, RT_LANES) real;
typedef RT_PASTE(RT_BITS, RT_LANES) mask;
#define AS_REAL RT_PASTE(RT_PASTE(as_, RT_NUMBER), RT_LANES)
#define AS_MASK RT_PASTE(RT_PASTE(as_, RT_BITS), RT_LANES)
#define LOAD_REAL(p) RT_PASTE(vload, RT_LANES)(0, p)
#define STORE_REAL(v, p) RT_PASTE(vstore, RT_LANES)(v, 0, p)
#define STORE_INDEX(v, p) RT_PASTE(vstore, RT_LANES)(RT_PASTE(convert_int, RT_LANES)(v), 0, p)
#define MASK(condition) (condition)
#if HAS_BUILTIN(__builtin_reduce_or)
#define ANY(m) (__builtin_reduce_or(m) != 0)
#else
#define ANY(m) RT_PASTE(lanes_or, RT_LANES)(RT_PASTE(convert_char, RT_LANES)(m))
#endif
#define SELECT(off, on, m) select(off, on, m)
#endif

/* Functions of the trace stage are parts of one loop: as calls they would spill every vector. Those
 * that a variant has no use for cost nothing. */
#define INLINE static __attribute__((always_inline))

/* Whether a lane is on, where the compiler has no reduction of its own, which is one instruction.
 * Written out because PoCL's any() tests lane after lane with a branch each; as bytes the lanes fit
 * into one or two integers. */
INLINE int lanes_or4(char4 m)
{
    return as_int(m) != 0;
}
INLINE int lanes_or8(char8 m)
{
    return as_long(m) != 0;
}
INLINE int lanes_or16(char16 m)
{
    const long2 halves = as_long2(m);
    return (halves.x | halves.y) != 0;
}

/* The extremes of vectors; unlike fmin and fmax these are one instruction, and for NaN they are
 * whatever the comparison leaves. */
#define LESSER(a, b) SELECT(b, a, MASK((a) < (b)))
#define GREATER(a, b) SELECT(b, a, MASK((a) > (b)))
#define LESSER_1(a, b) ((a) < (b) ? (a) : (b))
#define GREATER_1(a, b) ((a) > (b) ? (a) : (b))
#define LESSER_N(a, b) select(b, a, (a) < (b))
#define GREATER_N(a, b) select(b, a, (a) > (b))

/* sum + error = a + b exactly (Knuth). Of vectors and of scalars, hence without a variable. */
#define TWO_SUM(sum, error, a, b)                                                                  \
    do {                                                                                           \
        sum = (a) + (b);                                                                           \
        error = ((a) - (sum - (sum - (a)))) + ((b) - (sum - (a)));                                 \
    } while (0)

/* difference + error = a - b exactly, component by component. */
#define TWO_DIFFERENCE_3(difference, error, a, b)                                                  \
    do {                                                                                           \
        TWO_SUM((difference).x, (error).x, (a).x, -(b).x);                                         \
        TWO_SUM((difference).y, (error).y, (a).y, -(b).y);                                         \
        TWO_SUM((difference).z, (error).z, (a).z, -(b).z);                                         \
    } while (0)

/* (a, b, c, d) to a b - c d as a sum of two numbers, as if in twice the precision. */
#define TWOFOLD_DIFFERENCE(type, sum, rest, a, b, c, d)                                            \
    do {                                                                                           \
        const type p_ = (a) * (b), q_ = (c) * (d);                                                 \
        TWO_SUM(sum, rest, p_, -q_);                                                               \
        rest += fma(a, b, -p_) - fma(c, d, -q_);                                                   \
    } while (0)

/* The least and the greatest of a vector's lanes. */
#if RT_LANES == 1
#define LEAST(v) (v)
#define MOST(v) (v)
#else
INLINE number least4(RT_PASTE(RT_NUMBER, 4) v)
{
    const RT_PASTE(RT_NUMBER, 2) half_ = LESSER_N(v.lo, v.hi);
    return LESSER_1(half_.x, half_.y);
}
INLINE number most4(RT_PASTE(RT_NUMBER, 4) v)
{
    const RT_PASTE(RT_NUMBER, 2) half_ = GREATER_N(v.lo, v.hi);
    return GREATER_1(half_.x, half_.y);
}
INLINE number least8(RT_PASTE(RT_NUMBER, 8) v)
{
    return least4(LESSER_N(v.lo, v.hi));
}
INLINE number most8(RT_PASTE(RT_NUMBER, 8) v)
{
    return most4(GREATER_N(v.lo, v.hi));
}
INLINE number least16(RT_PASTE(RT_NUMBER, 16) v)
{
    return least8(LESSER_N(v.lo, v.hi));
}
INLINE number most16(RT_PASTE(RT_NUMBER, 16) v)
{
    return most8(GREATER_N(v.lo, v.hi));
}
#define LEAST(v) RT_PASTE(least, RT_LANES)(v)
#define MOST(v) RT_PASTE(most, RT_LANES)(v)
#endif

/* What boxes and primitives are made of, in lanes: their own boxes are computed in float at every
 * level, as the tree's are. */
#if RT_ACCURACY != RT_DOUBLE
typedef real floats;
#define TO_FLOATS(v) (v)
#define FROM_FLOATS(v) (v)
#elif RT_LANES == 1
typedef float floats;
#define TO_FLOATS(v) ((float)(v))
#define FROM_FLOATS(v) ((double)(v))
#else
typedef RT_PASTE(float, RT_LANES) floats;
#define TO_FLOATS(v) RT_PASTE(convert_float, RT_LANES)(v)
#define FROM_FLOATS(v) RT_PASTE(convert_double, RT_LANES)(v)
#endif
#if RT_LANES == 1
#define GREATER_FLOATS(a, b) GREATER_1(a, b)
#else
#define GREATER_FLOATS(a, b) GREATER_N(a, b)
#endif

typedef struct real3 {
    real x, y, z;
} real3;

/* Works for real3 and for vec3 alike; arguments are evaluated more than once. */
#define DOT(a, b) fma((a).x, (b).x, fma((a).y, (b).y, ((a).z * (b).z)))
#define CROSS(type, a, b)                                                                          \
    ((type){fma((a).y, (b).z, -((a).z * (b).y)), fma((a).z, (b).x, -((a).x * (b).z)),              \
            fma((a).x, (b).y, -((a).y * (b).x))})
#define SUB(type, a, b) ((type){(a).x - (b).x, (a).y - (b).y, (a).z - (b).z})

#define SPLAT3(px, py, pz) ((real3){(real)(px), (real)(py), (real)(pz)})

/* Correctly rounded division and square root, whatever the device's own do.
 *
 * By way of double the second rounding is harmless, because 53 bits are more than twice 24 and two
 * (Figueroa 1995). By fma: a reciprocal and a quotient within a few ulp become correctly rounded
 * after the residual is added back (Markstein 1990), as long as nothing leaves the range of normal
 * numbers. In double OpenCL C itself asks for it; fast takes what the device does, since a residual
 * that is NaN cannot be told under relaxed math. */
#if RT_ROUNDING == 0 || RT_ACCURACY == RT_DOUBLE || RT_ACCURACY == RT_FAST
#define DIVIDE(a, b) ((a) / (b))
#define ROOT(a) sqrt(a)
#elif RT_ROUNDING == 1
#if RT_LANES == 1
#define WIDEN convert_double
#define NARROW convert_float
#else
#define WIDEN RT_PASTE(convert_double, RT_LANES)
#define NARROW RT_PASTE(convert_float, RT_LANES)
#endif
#define DIVIDE(a, b) NARROW(WIDEN(a) / WIDEN(b))
#define ROOT(a) NARROW(sqrt(WIDEN(a)))
#else
#define DIVIDE(a, b) divide_by_fma(a, b)
#define ROOT(a) root_by_fma(a)

real divide_by_fma(real a, real b)
{
    real y = 1.0f / b;
    y = fma(fma(-b, y, (real)1.0f), y, y);
    y = fma(fma(-b, y, (real)1.0f), y, y);
    real q = a * y;
    q = fma(fma(-b, q, a), y, q);
    const real exact = fma(fma(-b, q, a), y, q);
    /* Zero, infinite and NaN operands make the residual NaN where the quotient is right. */
    return SELECT(a / b, exact, MASK(isfinite(exact)));
}

real root_by_fma(real a)
{
    const real y = 1.0f / sqrt(a);
    real g = a * y;
    const real h = 0.5f * y;
    g = fma(fma(-g, g, a), h, g);
    const real exact = fma(fma(-g, g, a), h, g);
    return SELECT(sqrt(a), exact, MASK(isfinite(exact)));
}
#endif
