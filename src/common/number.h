/* Decimal numbers from text, correctly rounded and independent of the locale. */
#ifndef RT_COMMON_NUMBER_H
#define RT_COMMON_NUMBER_H

#include <stddef.h>
#include <stdint.h>

enum rt_number_result {
    RT_NUMBER_OK,
    RT_NUMBER_SYNTAX, /* not [+-]digits[.digits][e[+-]digits] as a whole */
    RT_NUMBER_RANGE   /* too large for the type */
};

/* Reads all of text[0..length) as the nearest float (ties to even); denormals are kept, a smaller
 * value becomes 0. `text` must be followed by a readable byte that cannot go on a number, such as
 * white space or a terminator. "inf", "nan" and hexadecimal are syntax errors. */
enum rt_number_result rt_number_float(const char *text, size_t length, float *value);

/* Reads all of text[0..length) as a whole number: digits with an optional sign. */
enum rt_number_result rt_number_int(const char *text, size_t length, int64_t *value);

#endif
