/* Numbers from text: held against the C library bit for bit, and syntax by example. */
#define _GNU_SOURCE
#include "support/support.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/number.h"

static void same_as_library(const char *text)
{
    float value = -1.0f;
    const float expected = strtof(text, NULL);
    const enum rt_number_result result = rt_number_float(text, strlen(text), &value);
    if (!isfinite(expected)) {
        assert_int_equal(result, RT_NUMBER_RANGE);
        return;
    }
    assert_int_equal(result, RT_NUMBER_OK);
    if (memcmp(&value, &expected, sizeof value) != 0)
        fail_msg("%s gives %.9g, not %.9g", text, (double)value, (double)expected);
}

static void random_decimals_equal_the_library(void **state)
{
    (void)state;
    test_random random = {1};
    for (int i = 0; i < 300000; ++i) {
        const uint64_t bits = test_random_bits(&random);
        const int digits = 1 + (int)(bits % 24);
        const int point = (int)(bits >> 8) % (digits + 1);
        char text[64];
        int length = 0;
        if (bits & 0x80)
            text[length++] = '-';
        for (int d = 0; d < digits; ++d) {
            if (d == point)
                text[length++] = '.';
            text[length++] = (char)('0' + test_random_bits(&random) % 10);
        }
        const int exponent = (int)(test_random_bits(&random) % 100) - 55;
        snprintf(text + length, sizeof text - (size_t)length, "%c%d", i & 1 ? 'e' : 'E', exponent);
        same_as_library(text);
    }
}

static void printed_floats_come_back(void **state)
{
    (void)state;
    test_random random = {2};
    for (int i = 0; i < 300000; ++i) {
        const uint32_t bits = (uint32_t)test_random_bits(&random);
        float expected, value;
        memcpy(&expected, &bits, sizeof expected);
        if (!isfinite(expected))
            continue;
        char text[64];
        snprintf(text, sizeof text, "%.*g", 9 + i % 12, (double)expected);
        assert_int_equal(rt_number_float(text, strlen(text), &value), RT_NUMBER_OK);
        assert_memory_equal(&value, &expected, sizeof value);
    }
}

/* Exactly between two floats, and just above: where rounding twice goes wrong. */
static void ties_round_once(void **state)
{
    (void)state;
    test_random random = {3};
    for (int i = 0; i < 20000; ++i) {
        const uint32_t odd = 0x800000U | ((uint32_t)test_random_bits(&random) & 0x7fffffU);
        const double middle = ldexp(2.0 * odd + 1.0, (int)(test_random_bits(&random) % 40) - 30);
        char text[128];
        snprintf(text, sizeof text, "%.60f", middle);
        same_as_library(text);
        snprintf(text, sizeof text, "%.60f", nextafter(middle, INFINITY));
        same_as_library(text);
        snprintf(text, sizeof text, "%.17g", middle);
        same_as_library(text);
    }
    same_as_library("16777217");
    same_as_library("16777217.0000000001");
    same_as_library("1.4012984643e-45");
    same_as_library("7.006492321624085e-46");
    same_as_library("7.006492321624086e-46");
    same_as_library("3.4028235677973366e38");
    same_as_library("3.4028235e38");
    same_as_library("1e39");
    same_as_library("1e-400");
    same_as_library("0e999999999999");
    same_as_library("000000000000000000000000000000.00000000000000000000000000001");
    same_as_library("18446744073709551616"); /* 2^64: twenty digits that leave 64 bits at 0 */
    same_as_library("0000000000000000000000.01234567890123456789");
    same_as_library("00000000000000000000000000000000000000000.0000000000000000000");
    same_as_library("0.00000000000000000000000000123456789012345678901234567890");
}

static void only_decimal_numbers_are_numbers(void **state)
{
    (void)state;
    const char *const good[] = {"0", "-0", "+1", ".5", "5.", "1e5", "1E+5", "1.5e-3"};
    const char *const bad[] = {"",     ".",    "+",     "-",        "e5",  "1e",       "1e+",
                               "1..2", "1,5",  "nan",   "inf",      "0x1", "1f",       "1 ",
                               "--1",  "1e5.", "1e5e5", "infinity", "1d5", "\xc2\xb5", "1-"};
    float value;
    for (size_t i = 0; i < sizeof good / sizeof *good; ++i)
        assert_int_equal(rt_number_float(good[i], strlen(good[i]), &value), RT_NUMBER_OK);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i)
        assert_int_equal(rt_number_float(bad[i], strlen(bad[i]), &value), RT_NUMBER_SYNTAX);
}

/* A locale with a decimal comma, where the machine has one, changes nothing. */
static void the_locale_does_not_matter(void **state)
{
    (void)state;
    if (!setlocale(LC_ALL, "de_DE.UTF-8") && !setlocale(LC_ALL, "de_DE"))
        print_message("no German locale is installed: the C library's default is tested\n");
    float value = 0.0f;
    const char *slow = "1.50000000000000000000000000000000001";
    assert_int_equal(rt_number_float("1.5", 3, &value), RT_NUMBER_OK);
    assert_near(value, 1.5, 0.0);
    assert_int_equal(rt_number_float(slow, strlen(slow), &value), RT_NUMBER_OK);
    assert_near(value, 1.5, 0.0);
    setlocale(LC_ALL, "C");
}

static void whole_numbers(void **state)
{
    (void)state;
    int64_t value = 0;
    assert_int_equal(rt_number_int("-42", 3, &value), RT_NUMBER_OK);
    assert_int_equal(value, -42);
    assert_int_equal(rt_number_int("4x", 2, &value), RT_NUMBER_SYNTAX);
    assert_int_equal(rt_number_int("", 0, &value), RT_NUMBER_SYNTAX);
    assert_int_equal(rt_number_int("99999999999999999999", 20, &value), RT_NUMBER_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_decimals_equal_the_library),
        cmocka_unit_test(printed_floats_come_back),
        cmocka_unit_test(ties_round_once),
        cmocka_unit_test(only_decimal_numbers_are_numbers),
        cmocka_unit_test(the_locale_does_not_matter),
        cmocka_unit_test(whole_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
