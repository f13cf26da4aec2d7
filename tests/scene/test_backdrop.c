/* Which pictures show their background alone, and which are black: drawn by the reference. */
#include "support/support.h"

#include <math.h>

#include "scene/backdrop.h"

#define BALL                                                                                       \
    "material red kd 1 0 0\nlight point at 0 0 0\nsphere center 0 0 5 radius 1 material red\n"
#define AHEAD "camera at 0 0 1\n"

static void draw(const char *text, rt_scene *s, rt_image *image)
{
    test_scene(s, text);
    if (s->width == 512)
        s->width = s->height = 48;
    test_draw_scalar(s, image);
}

static void backdrops_are_known(void **state)
{
    (void)state;
    static const struct {
        const char *scene;
        bool is_backdrop;
    } pictures[] = {
        {BALL, true},
        {BALL AHEAD, false},
        {BALL "background 0.2 0.5 7", true},
        {BALL "background 0.2 0.5 7\n" AHEAD, false},
        {BALL "background 0.2 0.5 7 top 0 1 0.5", true},
        {BALL "background 0.2 0.5 7 top 0 1 0.5\n" AHEAD, false},
        {BALL "background 0 0 0 top 0 1 0.5\nimage samples 7", true},
        {BALL "background 0 0 0 top 0 1 0.5\nimage samples 7 filter tent width 3 height 2", true},
        {BALL "background 1 0 0 top 0 1 0.5\nimage samples 3 width 2 height 31\n"
              "camera vfov 170 up 1 2 3",
         true},
        {BALL "background 1 0 0 top 0 1 0.5\nimage samples 5\ncamera aperture 1 focus 3", true},
        {BALL "background 1 0 0 top 0 1 0.5\nfog 0.3 0.4 0.5 density 2", true},
        {BALL "background 1 0 0 top 0 1 0.5\nfog 0.3 0.4 0.5 density 0.1\n" AHEAD, false},
        /* One pixel's worth in the last row. */
        {"background 1 1 1\nmaterial m ka 0 0 0\nimage width 40 height 40\n"
         "sphere center 0.98 -0.98 -1 radius 0.02 material m",
         false},
    };
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; ++i) {
        rt_scene s;
        rt_image image;
        draw(pictures[i].scene, &s, &image);
        if (rt_scene_is_backdrop(&s, &image) != pictures[i].is_backdrop)
            fail_msg("%s", pictures[i].scene);
        rt_image_clear(&image);
        rt_scene_clear(&s);
    }
}

static void no_pixel_is_passed_over(void **state)
{
    (void)state;
    rt_scene s;
    rt_image image;
    draw("background 0.5 0.5 0.5\nimage width 40 height 20", &s, &image);
    assert_true(rt_scene_is_backdrop(&s, &image));
    for (int i = 0; i < 40 * 20; ++i) {
        image.rgb[3 * i + i % 3] = i % 2 ? NAN : 0.6f;
        assert_false(rt_scene_is_backdrop(&s, &image));
        image.rgb[3 * i + i % 3] = 0.5f;
    }
    rt_image_clear(&image);
    rt_scene_clear(&s);
}

static void black_is_less_than_half_a_step(void **state)
{
    (void)state;
    rt_scene s;
    rt_image image;
    draw("image width 3 height 3", &s, &image);
    assert_true(rt_scene_is_black(&s, &image));
    image.rgb[26] = 0.49f / 255.0f;
    assert_true(rt_scene_is_black(&s, &image));
    s.encoding.exposure = 1.0f;
    assert_false(rt_scene_is_black(&s, &image));
    s.encoding = (rt_encoding){RT_TRANSFER_SRGB, 0.0f};
    assert_false(rt_scene_is_black(&s, &image));
    s.encoding = (rt_encoding){RT_TRANSFER_LINEAR, 0.0f};
    image.rgb[26] = 0.51f / 255.0f;
    assert_false(rt_scene_is_black(&s, &image));
    image.rgb[26] = NAN;
    assert_false(rt_scene_is_black(&s, &image));
    rt_image_clear(&image);
    rt_scene_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(backdrops_are_known),
        cmocka_unit_test(no_pixel_is_passed_over),
        cmocka_unit_test(black_is_less_than_half_a_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
