/* What the scalar stages share: a vector of one ray, and correctly rounded scalar division and
 * square root. A struct of scalars, not float3: runtimes vectorise these stages across work-items,
 * and a vector type inside would stop them. Macros, not functions: a struct that a function returns
 * leaves aliasing intrinsics behind where it is inlined, which Oclgrind 21.10 does not know. */

typedef struct vec3 {
    number x, y, z;
} vec3;

#if RT_LANES == 1
#define DIVIDE_1(a, b) DIVIDE(a, b)
#define ROOT_1(a) ROOT(a)
#elif RT_ROUNDING == 0 || RT_ACCURACY == RT_DOUBLE || RT_ACCURACY == RT_FAST
#define DIVIDE_1(a, b) ((a) / (b))
#define ROOT_1(a) sqrt(a)
#elif RT_ROUNDING == 1
#define DIVIDE_1(a, b) convert_float(convert_double(a) / convert_double(b))
#define ROOT_1(a) convert_float(sqrt(convert_double(a)))
#else
#define DIVIDE_1(a, b) (DIVIDE((real)(a), (real)(b)).s0)
#define ROOT_1(a) (ROOT((real)(a)).s0)
#endif

#define SCALE(v, s) ((vec3){(v).x * (s), (v).y * (s), (v).z * (s)})
#define MULTIPLY(a, b) ((vec3){(a).x * (b).x, (a).y * (b).y, (a).z * (b).z})
/* a * s + b; s is a number, not a float. */
#define ADD_SCALED(a, s, b)                                                                        \
    ((vec3){fma((a).x, (s), (b).x), fma((a).y, (s), (b).y), fma((a).z, (s), (b).z)})
/* The factor that makes a vector unit whose components are of moderate size; infinite for the zero
 * vector, which then becomes NaN. */
#define RECIPROCAL_LENGTH(v) DIVIDE_1(1.0f, ROOT_1(DOT(v, v)))
#define LOAD3(array, stride, i)                                                                    \
    ((vec3){(array)[i], (array)[(stride) + (i)], (array)[2 * (size_t)(stride) + (i)]})
#define STORE3(v, array, stride, i)                                                                \
    do {                                                                                           \
        (array)[i] = (v).x;                                                                        \
        (array)[(stride) + (i)] = (v).y;                                                           \
        (array)[2 * (size_t)(stride) + (i)] = (v).z;                                               \
    } while (0)

/* The power of two that brings the largest component of `v` to [1, 2), so that squares and products
 * of components neither overflow nor vanish; multiplying by it is exact. For vectors whose largest
 * component is zero, denormal or nearly infinite it is some finite power of two. */
INLINE number moderating_factor(vec3 v)
{
    /* The greatest exponent, as bits: one instruction a maximum, which fmax is not. */
#if RT_ACCURACY == RT_DOUBLE
    const long bits = 0x7ff0000000000000L, x = as_long(v.x) & bits, y = as_long(v.y) & bits,
               z = as_long(v.z) & bits;
    return as_double(0x7fe0000000000000L - min(max(max(x, y), z), 0x7fd0000000000000L));
#else
    const int bits = 0x7f800000, x = as_int(v.x) & bits, y = as_int(v.y) & bits,
              z = as_int(v.z) & bits;
    return as_float(0x7f000000 - min(max(max(x, y), z), 0x7e800000));
#endif
}

/* Makes a vector unit, whatever its length; NaN for the zero vector. */
INLINE void make_unit(vec3 *v)
{
    const vec3 moderate = SCALE(*v, moderating_factor(*v));
    *v = SCALE(moderate, RECIPROCAL_LENGTH(moderate));
}

/* The same of a vector that may be zero, which stays as it is; returns whether it has a direction.
 * That is decided before the division: relaxed math takes for granted that no number is NaN or
 * infinite, and makes a test of the quotient true. */
INLINE int make_unit_if_any(vec3 *v)
{
    const vec3 moderate = SCALE(*v, moderating_factor(*v));
    const number squared = DOT(moderate, moderate);
    const int has_direction = squared > (number)0.0f;
    const number factor = DIVIDE_1(1.0f, ROOT_1(has_direction ? squared : (number)1.0f));
    *v = SCALE(moderate, factor);
    return has_direction;
}
