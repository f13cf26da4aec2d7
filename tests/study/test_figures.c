/* The arithmetic of a study, by cases that are known exactly. */
#include "support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "study/figures.h"

static void quantiles(void **state)
{
    (void)state;
    const double five[] = {1, 2, 4, 8, 16};
    assert_near(rt_quantile(five, 5, 0.0), 1, 0);
    assert_near(rt_quantile(five, 5, 0.25), 2, 0);
    assert_near(rt_quantile(five, 5, 0.5), 4, 0);
    assert_near(rt_quantile(five, 5, 1.0), 16, 0);
    assert_near(rt_quantile(five, 4, 0.5), 3, 0);
    assert_near(rt_quantile(five, 2, 0.75), 1.75, 0);
    assert_near(rt_quantile(five, 1, 0.99), 1, 0);
    assert_true(isnan(rt_quantile(five, 0, 0.5)));
    const double far[] = {1, INFINITY, INFINITY};
    assert_true(isinf(rt_quantile(far, 3, 0.75)));
    double mixed[] = {9, 1, 5, 7, 3};
    const rt_spread s = rt_spread_of(mixed, 5);
    assert_near(s.low, 3, 0);
    assert_near(s.median, 5, 0);
    assert_near(s.high, 7, 0);
}

static void ulps(void **state)
{
    (void)state;
    assert_int_equal(rt_ulp_distance(1.0f, 1.0f), 0);
    assert_int_equal(rt_ulp_distance(0.0f, -0.0f), 0);
    assert_int_equal(rt_ulp_distance(1.0f, 1.0f + 0x1p-23f), 1);
    assert_int_equal(rt_ulp_distance(1.0f, 1.0f - 0x1p-24f), 1);
    assert_int_equal(rt_ulp_distance(1.0f, 2.0f), 1 << 23);
    assert_int_equal(rt_ulp_distance(0x1p-149f, -0x1p-149f), 2);
    assert_int_equal(rt_ulp_distance(3.4028234664e38f, INFINITY), 1);
    assert_int_equal(rt_ulp_distance(-INFINITY, INFINITY), 0xff000000u);
    assert_int_equal(rt_ulp_distance(NAN, 1.0f), UINT32_MAX);
    assert_int_equal(rt_ulp_distance(NAN, NAN), UINT32_MAX);
}

/* Four pixels: equal, off by 1 step, by 2 and by 9, and the components beyond 0..1 count as 0..1.
 */
static void errors_of_pictures(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_image a, b;
    assert_good(rt_image_init(&a, 4, 1, false, &status), &status);
    assert_good(rt_image_init(&b, 4, 1, false, &status), &status);
    a.rgb[0] = 2.0f;
    b.rgb[0] = 1.0f;
    a.rgb[1] = -1.0f;
    a.rgb[3] = 1.0f / 255.0f;
    b.rgb[7] = 2.0f / 255.0f;
    a.rgb[11] = 9.0f / 255.0f;
    rt_study_error e = rt_study_error_of(&a, &b);
    assert_int_equal(e.over_0, 3);
    assert_int_equal(e.over_1, 2);
    assert_int_equal(e.over_8, 1);
    assert_int_equal(e.max_step, 9);
    assert_near(e.rms, sqrt((1.0 + 4.0 + 81.0) / 12.0), 1e-6);
    assert_int_equal(e.non_finite, 0);
    /* Less than a step is seen by the mean alone. */
    memcpy(a.rgb, b.rgb, 12 * sizeof *a.rgb);
    a.rgb[2] = 0.25f / 255.0f;
    e = rt_study_error_of(&a, &b);
    assert_int_equal(e.over_0, 0);
    assert_near(e.rms, 0.25 / sqrt(12.0), 1e-6);
    a.rgb[2] = NAN;
    e = rt_study_error_of(&a, &b);
    assert_int_equal(e.non_finite, 1);
    assert_near(e.rms, 0, 0);
    e = rt_study_error_of(&b, &a);
    assert_int_equal(e.non_finite, 1);
    rt_image_clear(&a);
    rt_image_clear(&b);
}

/* A row of pixels, of which the tenth is off by 20 steps by noise: it hides 40 steps up to two
 * pixels away, and elsewhere more than one step is visible. */
static void visible_pixels(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_image picture, reference, converged;
    assert_good(rt_image_init(&picture, 20, 5, false, &status), &status);
    assert_good(rt_image_init(&reference, 20, 5, false, &status), &status);
    assert_good(rt_image_init(&converged, 20, 5, false, &status), &status);
    converged.rgb[3 * (2 * 20 + 10) + 1] = 20.0f / 255.0f;
    uint8_t *noise = rt_study_noise_of(&reference, &converged);
    assert_non_null(noise);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 20; ++x)
            assert_int_equal(noise[y * 20 + x], x >= 8 && x <= 12 ? 20 : 0);
    static const int steps[] = {0, 1, 2, 40, 41, 255};
    for (int at = 0; at < 20; ++at)
        for (size_t i = 0; i < 6; ++i) {
            picture.rgb[3 * at] = (float)steps[i] / 255.0f;
            assert_int_equal(rt_study_count_visible(&picture, &reference, noise),
                             steps[i] > (at >= 8 && at <= 12 ? 40 : 1));
            picture.rgb[3 * at] = 0.0f;
        }
    free(noise);
    rt_image_clear(&picture);
    rt_image_clear(&reference);
    rt_image_clear(&converged);
}

static rt_study_point point(double time, double spread, double error)
{
    return (rt_study_point){{time - spread, time, time + spread}, error};
}

static void domination(void **state)
{
    (void)state;
    const rt_study_point points[] = {
        point(1, 0.1, 8),      /* the fastest */
        point(2, 0.1, 4),      /* better, for more time */
        point(3, 0.1, 4),      /* as good as the one before, and slower */
        point(3, 0.1, 16),     /* worse and slower than the first */
        point(2.15, 0.1, 4),   /* slower than the second, but within the quartiles */
        point(2.0, 0.1, 4.03), /* worse than the second, but within one in a hundred */
        point(4, 0.1, 1),      /* the best */
        point(4.05, 0.1, 2),   /* as fast as the best, and worse */
    };
    static const bool expected[] = {false, false, true, true, false, false, false, true};
    const size_t count = sizeof points / sizeof *points;
    for (size_t i = 0; i < count; ++i)
        if (rt_study_is_dominated(points, count, i) != expected[i])
            fail_msg("point %zu", i);
    assert_false(rt_study_is_dominated(points, 1, 0));
    /* Of two exact ones the slower is dominated. */
    const rt_study_point exact[] = {point(1, 0.1, 0), point(2, 0.1, 0)};
    assert_false(rt_study_is_dominated(exact, 2, 0));
    assert_true(rt_study_is_dominated(exact, 2, 1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantiles),          cmocka_unit_test(ulps),
        cmocka_unit_test(errors_of_pictures), cmocka_unit_test(visible_pixels),
        cmocka_unit_test(domination),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
