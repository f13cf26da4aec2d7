/* The fast path is Clinger's (1990): up to 19 digits whose value is below 2^53, times a power of
 * ten up to 10^22, are both exact in double, so that one multiplication or division rounds once.
 * Going on to float would round twice; that differs from rounding once only where the double lies
 * exactly between two floats, and there, as for longer numbers, the C library decides. */
#define _GNU_SOURCE
#include "common/number.h"

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define EXACT_DIGITS 19
#define EXACT_POWER 22

static const double powers_of_ten[EXACT_POWER + 1] = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* A decimal number taken apart: digits * 10^exponent. */
typedef struct decimal {
    uint64_t digits;
    bool is_cut; /* more than EXACT_DIGITS significant digits: `digits` is not the value */
    long exponent;
    bool negative;
} decimal;

/* Whether text that is digits, perhaps with a point among them, has more significant digits than 64
 * bits are sure to hold; leading zeros are not significant. */
static bool has_too_many(const char *p, const char *end)
{
    while (p < end && (*p == '0' || *p == '.'))
        ++p;
    const bool has_point = memchr(p, '.', (size_t)(end - p)) != NULL;
    return end - p - has_point > EXACT_DIGITS;
}

/* Takes in the digits from `p` on and returns their end. What follows a number is readable and does
 * not go on with it, so no end needs to be watched. */
static const char *take_digits(const char *p, uint64_t *digits)
{
    uint64_t sum = *digits;
    for (; is_digit(*p); ++p)
        sum = sum * 10 + (uint64_t)(*p - '0');
    *digits = sum;
    return p;
}

static const char *read_exponent(const char *p, const char *end, decimal *d)
{
    bool negative = false;
    if (p < end && (*p == '+' || *p == '-'))
        negative = *p++ == '-';
    if (p >= end || !is_digit(*p))
        return NULL;
    long exponent = 0;
    for (; p < end && is_digit(*p); ++p)
        if (exponent < 1000000)
            exponent = exponent * 10 + (*p - '0');
    d->exponent += negative ? -exponent : exponent;
    return p;
}

/* Returns false where the text is not a decimal number from start to end. */
static bool read_decimal(const char *p, const char *end, decimal *d)
{
    *d = (decimal){0, false, 0, false};
    if (*p == '+' || *p == '-')
        d->negative = *p++ == '-';
    const char *first = p;
    p = take_digits(p, &d->digits);
    long count = p - first;
    if (*p == '.') {
        const char *point = p++;
        p = take_digits(p, &d->digits);
        d->exponent = -(p - point - 1);
        count -= d->exponent;
    }
    if (count == 0)
        return false;
    d->is_cut = count > EXACT_DIGITS && has_too_many(first, p);
    if (p < end && (*p == 'e' || *p == 'E'))
        p = read_exponent(p + 1, end, d);
    return p == end;
}

/* The C library's conversion under the C locale, whatever locale the process has. The locale
 * object lives as long as the process. */
static float slow_float(const char *text)
{
    static locale_t c_locale;
    if (!c_locale)
        c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return c_locale ? strtof_l(text, NULL, c_locale) : strtof(text, NULL);
}

/* True where rounding `value` to float can go wrong because it has been rounded before: exactly
 * halfway between two floats, or outside the range of normal floats. */
static bool is_rounding_unsafe(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint64_t dropped = bits & 0x1fffffffU; /* 52 - 23 = 29 bits that a float lacks */
    return dropped == 0x10000000U || fabs(value) < 0x1p-126 || fabs(value) > 0x1p127;
}

enum rt_number_result rt_number_float(const char *text, size_t length, float *value)
{
    decimal d;
    if (!read_decimal(text, text + length, &d))
        return RT_NUMBER_SYNTAX;
    if (d.digits == 0 && !d.is_cut) {
        *value = d.negative ? -0.0f : 0.0f;
        return RT_NUMBER_OK;
    }
    if (!d.is_cut && d.digits < (UINT64_C(1) << 53) && d.exponent >= -EXACT_POWER &&
        d.exponent <= EXACT_POWER) {
        const double digits = (double)d.digits;
        const double magnitude = d.exponent < 0 ? digits / powers_of_ten[-d.exponent]
                                                : digits * powers_of_ten[d.exponent];
        if (!is_rounding_unsafe(magnitude)) {
            *value = (float)(d.negative ? -magnitude : magnitude);
            return RT_NUMBER_OK;
        }
    }
    *value = slow_float(text);
    return isfinite(*value) ? RT_NUMBER_OK : RT_NUMBER_RANGE;
}

enum rt_number_result rt_number_int(const char *text, size_t length, int64_t *value)
{
    const char *p = text, *end = text + length;
    bool negative = false;
    if (p < end && (*p == '+' || *p == '-'))
        negative = *p++ == '-';
    if (p >= end)
        return RT_NUMBER_SYNTAX;
    int64_t sum = 0;
    bool too_large = false;
    for (; p < end; ++p) {
        if (!is_digit(*p))
            return RT_NUMBER_SYNTAX;
        too_large = too_large || sum > (INT64_MAX - 9) / 10;
        if (!too_large)
            sum = sum * 10 + (*p - '0');
    }
    *value = negative ? -sum : sum;
    return too_large ? RT_NUMBER_RANGE : RT_NUMBER_OK;
}
