/* From colours to integers: the curve of sRGB by IEC 61966-2-1, exposure, and steps held against
 * the formula at every place where one begins. */
#include "support/support.h"

#include <math.h>
#include <stdlib.h>

#include "image/encoding.h"

static const rt_encoding srgb = {RT_TRANSFER_SRGB, 0.0f};
static const rt_encoding linear = {RT_TRANSFER_LINEAR, 0.0f};

/* One step of 8 bits and one of 16. */
static void assert_steps(float c, const rt_encoding *encoding, int expected_8, int expected_16)
{
    rt_status status = RT_STATUS_INIT;
    float rgb[3] = {c, c, c};
    const rt_image image = {1, 1, rgb, NULL};
    uint8_t *of_8 = rt_encode_8(&image, encoding, &status);
    uint16_t *of_16 = rt_encode_16(&image, encoding, &status);
    assert_good(of_8 && of_16, &status);
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(of_8[i], expected_8);
        assert_int_equal(of_16[i], expected_16);
    }
    free(of_8);
    free(of_16);
}

static void the_curve_of_srgb(void **state)
{
    (void)state;
    assert_near(rt_srgb_of_linear(0.0), 0.0, 0.0);
    assert_near(rt_srgb_of_linear(0.001), 0.01292, 1e-17);
    assert_near(rt_srgb_of_linear(0.0031308), 0.040449936, 1e-16);
    /* Where its parts meet they are 3e-8 apart. */
    assert_near(rt_srgb_of_linear(nextafter(0.0031308, 1.0)), 0.0404499072, 1e-9);
    assert_near(rt_srgb_of_linear(0.18), 0.46135612950044, 1e-14);
    assert_near(rt_srgb_of_linear(0.5), 0.73535698305244, 1e-13);
    assert_near(rt_srgb_of_linear(1.0), 1.0, 1e-15);
}

static void known_steps(void **state)
{
    (void)state;
    assert_steps(0.0f, &srgb, 0, 0);
    assert_steps(0.0031308f, &srgb, 10, 2651);
    assert_steps(0.18f, &srgb, 118, 30235);
    assert_steps(0.5f, &srgb, 188, 48192);
    assert_steps(1.0f, &srgb, 255, 65535);
    assert_steps(0.0f, &linear, 0, 0);
    assert_steps(0.18f, &linear, 46, 11796);
    assert_steps(0.5f, &linear, 128, 32768);
    assert_steps(1.0f, &linear, 255, 65535);
    const rt_encoding *const both[] = {&srgb, &linear};
    for (int i = 0; i < 2; ++i) {
        assert_steps(-1.0f, both[i], 0, 0);
        assert_steps(-INFINITY, both[i], 0, 0);
        assert_steps(NAN, both[i], 0, 0);
        assert_steps(1.5f, both[i], 255, 65535);
        assert_steps(INFINITY, both[i], 255, 65535);
    }
}

static void exposure_is_in_stops_and_comes_first(void **state)
{
    (void)state;
    assert_steps(0.25f, &(rt_encoding){RT_TRANSFER_LINEAR, 1.0f}, 128, 32768);
    assert_steps(0.25f, &(rt_encoding){RT_TRANSFER_LINEAR, -1.0f}, 32, 8192);
    assert_steps(0.75f, &(rt_encoding){RT_TRANSFER_LINEAR, 1.0f}, 255, 65535);
    assert_steps(3.0f, &(rt_encoding){RT_TRANSFER_LINEAR, -2.0f}, 191, 49151); /* 0.75 */
    assert_steps(0.5f, &(rt_encoding){RT_TRANSFER_LINEAR, 0.5f}, 180, 46340);  /* 0.70711 */
    assert_steps(0.09f, &(rt_encoding){RT_TRANSFER_SRGB, 1.0f}, 118, 30235);
    assert_steps(0.72f, &(rt_encoding){RT_TRANSFER_SRGB, -2.0f}, 118, 30235);
    assert_steps(0.0f, &(rt_encoding){RT_TRANSFER_SRGB, 64.0f}, 0, 0);
    assert_steps(1e-18f, &(rt_encoding){RT_TRANSFER_SRGB, 64.0f}, 255, 65535);
    assert_steps(1e30f, &(rt_encoding){RT_TRANSFER_SRGB, -64.0f}, 255, 65535);
    assert_steps(NAN, &(rt_encoding){RT_TRANSFER_SRGB, 1.0f}, 0, 0);
}

static int step_by_formula(float component, double most)
{
    const double c = (double)component;
    return (int)floor(most * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055) +
                      0.5);
}

/* Numbers of all sizes, and those about each place where a step begins. */
static void steps_of_srgb_are_the_formulas(void **state)
{
    (void)state;
    enum { COUNT = 3 * 40000 };
    rt_status status = RT_STATUS_INIT;
    rt_image image;
    test_random random = {5};
    assert_good(rt_image_init(&image, COUNT / 3, 1, false, &status), &status);
    int n = 0;
    for (int k = 1; k < 256; ++k) {
        const double s = (k - 0.5) / 255.0;
        float c = (float)(s <= 0.040449936 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4));
        for (int i = 0; i < 8; ++i)
            c = nextafterf(c, 0.0f);
        for (int i = 0; i < 16; ++i, c = nextafterf(c, 1.0f))
            image.rgb[n++] = c;
    }
    for (int i = 0; i <= 4096; ++i)
        image.rgb[n++] = (float)i / 4096.0f;
    for (; n < COUNT; ++n)
        image.rgb[n] = n % 3 ? test_random_float(&random, 0.0f, 1.0f)
                             : exp2f(test_random_float(&random, -20.0f, 0.0f));
    uint8_t *of_8 = rt_encode_8(&image, &srgb, &status);
    uint16_t *of_16 = rt_encode_16(&image, &srgb, &status);
    assert_good(of_8 && of_16, &status);
    for (int i = 0; i < COUNT; ++i) {
        assert_int_equal(of_8[i], step_by_formula(image.rgb[i], 255.0));
        assert_int_equal(of_16[i], step_by_formula(image.rgb[i], 65535.0));
    }
    free(of_8);
    free(of_16);
    rt_image_clear(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_curve_of_srgb),
        cmocka_unit_test(known_steps),
        cmocka_unit_test(exposure_is_in_stops_and_comes_first),
        cmocka_unit_test(steps_of_srgb_are_the_formulas),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
