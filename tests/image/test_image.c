/* Quantising and comparing. */
#include "support/support.h"

#include <math.h>

#include "image/image.h"

static void steps(void **state)
{
    (void)state;
    assert_int_equal(rt_image_step(0.0f), 0);
    assert_int_equal(rt_image_step(1.0f), 255);
    assert_int_equal(rt_image_step(0.5f), 128); /* floor(127.5 + 0.5) */
    assert_int_equal(rt_image_step(0.2f), 51);
    assert_int_equal(rt_image_step(0.001f), 0);
    assert_int_equal(rt_image_step(0.002f), 1);
    assert_int_equal(rt_image_step(-3.0f), 0);
    assert_int_equal(rt_image_step(7.0f), 255);
    assert_int_equal(rt_image_step(INFINITY), 255);
    assert_int_equal(rt_image_step(-INFINITY), 0);
    assert_int_equal(rt_image_step(NAN), 0);
    for (int i = 0; i < 256; ++i)
        assert_int_equal(rt_image_step((float)i / 255.0f), i);
}

/* No pixel is passed over, and none is asked that is not there. */
static bool is_not_marked(const void *context, int x, int y, const float rgb[3])
{
    const rt_image *image = context;
    assert_true(x >= 0 && x < image->width && y >= 0 && y < image->height);
    assert_ptr_equal(rgb, image->rgb + 3 * (y * image->width + x));
    return rgb[1] >= 0.0f;
}

static void every_pixel_is_asked(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {5, 3}, {64, 2}, {67, 35}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s) {
        rt_image image;
        rt_status status = RT_STATUS_INIT;
        assert_good(rt_image_init(&image, sizes[s][0], sizes[s][1], false, &status), &status);
        assert_true(rt_image_every(&image, is_not_marked, &image));
        for (int i = 0; i < image.width * image.height; ++i) {
            image.rgb[3 * i + 1] = -1.0f;
            assert_false(rt_image_every(&image, is_not_marked, &image));
            image.rgb[3 * i + 1] = 0.0f;
        }
        rt_image_clear(&image);
    }
}

/* A 5x3 picture with a different value everywhere, all exact 8-bit steps. */
static void make(rt_image *image, bool with_hits)
{
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_image_init(image, 5, 3, with_hits, &status), &status);
    for (int i = 0; i < 45; ++i)
        image->rgb[i] = (float)(5 * i + 3) / 255.0f;
    for (int i = 0; with_hits && i < 15; ++i)
        image->hits[i] = (rt_hit){i - 1, (float)i, 0.5f, 0.25f};
}

static void equal_pictures(void **state)
{
    (void)state;
    rt_image a, b;
    make(&a, true);
    make(&b, true);
    const rt_image_difference d = rt_image_compare(&a, &b);
    assert_int_equal(d.hits + d.pixels + d.non_finite + (size_t)d.max_step, 0);
    assert_near(d.rms_step, 0.0, 0.0);
    assert_int_equal(d.first_x, -1);
    rt_image_clear(&a);
    rt_image_clear(&b);
}

static void different_pictures(void **state)
{
    (void)state;
    rt_image a, b;
    make(&a, true);
    make(&b, true);
    b.rgb[3 * 7 + 1] += 10.0f / 255.0f; /* pixel 2,1 */
    b.rgb[3 * 9] += 1.0f / 255.0f;      /* one step is not "off" */
    b.hits[8].u = -b.hits[8].u;         /* pixel 3,1 */
    b.rgb[3 * 12 + 2] = NAN;
    const rt_image_difference d = rt_image_compare(&a, &b);
    assert_int_equal(d.hits, 1);
    assert_int_equal(d.pixels, 2);
    assert_int_equal(d.non_finite, 1);
    assert_int_equal(d.max_step, 5 * 38 + 3); /* the NaN counts as 0 */
    assert_near(d.rms_step, sqrt((100.0 + 1.0 + 193.0 * 193.0) / 45.0), 1e-9);
    assert_int_equal(d.first_x, 2);
    assert_int_equal(d.first_y, 1);
    /* The same on both sides, and yet nothing to be compared. */
    a.rgb[3 * 4] = b.rgb[3 * 4] = NAN;
    const rt_image_difference e = rt_image_compare(&a, &b);
    assert_int_equal(e.pixels, 2);
    assert_int_equal(e.non_finite, 2);
    assert_int_equal(e.first_x, 4);
    assert_int_equal(e.first_y, 0);
    rt_image_clear(&a);
    rt_image_clear(&b);
}

/* Hits are compared as bits: a zero of another sign is another record. */
static void hits_are_compared_by_bits(void **state)
{
    (void)state;
    rt_image a, b;
    make(&a, true);
    make(&b, true);
    a.hits[3].v = 0.0f;
    b.hits[3].v = -0.0f;
    assert_int_equal(rt_image_compare(&a, &b).hits, 1);
    rt_image_clear(&a);
    rt_image_clear(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps),
        cmocka_unit_test(every_pixel_is_asked),
        cmocka_unit_test(equal_pictures),
        cmocka_unit_test(different_pictures),
        cmocka_unit_test(hits_are_compared_by_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
