/* The reference's camera: anti-aliasing and the thin lens against closed formulas, in double. */
#include "support/scalar_double.h"

#include <math.h>

static void draw(const rt_scene *scene, rt_image *image)
{
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_image_init(image, scene->width, scene->height, true, &status), &status);
    assert_good(rt_scalar_double_render(scene, image, NULL, &status), &status);
}

/* Background and the floor's glow meet at the horizon, where the camera looks: the column of pixels
 * shows the integral of the filter. */
static void an_edge_shows_the_filter_s_integral(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; ++kind) {
        rt_scene scene;
        rt_image image;
        const rt_material white = test_glow(1, 1, 1);
        test_begin(&scene);
        scene.width = 2;
        scene.height = 9;
        scene.samples = 4096;
        scene.filter = kind ? RT_FILTER_TENT : RT_FILTER_BOX;
        /* A wall whose upper edge is 0.3 of a pixel below the middle of the picture's middle row.
         */
        const double pixel = 2.0 / 9, below = 0.3;
        const float top = (float)(-below * pixel);
        const rt_triangle wall = {-99, top, -1, 99, top, -1, 0, -99, -1};
        test_add_triangle(&scene, &white, &wall);
        draw(&scene, &image);
        for (int y = 0; y < 9; ++y) {
            /* Pixels from this pixel's centre down to the edge. */
            const double edge = 4 + below - y;
            double covered = 0.5 - edge;
            if (kind) {
                const double rest = fmax(0, 1 - fabs(edge));
                covered = edge > 0 ? 0.5 * rest * rest : 1 - 0.5 * rest * rest;
            }
            covered = fmin(1, fmax(0, covered));
            assert_near(image.rgb[3 * (2 * y)], covered, 0.002);
            /* And the first sample's own hit stands in the records. */
            if (covered == 0 || covered == 1)
                assert_int_equal(image.hits[2 * y].primitive, covered == 0 ? RT_MISS : 0);
        }
        rt_image_clear(&image);
        rt_scene_clear(&scene);
    }
}

typedef struct blot {
    double sum, x, y, square, reach;
} blot;

/* What a point of light becomes: its light, middle, mean square and greatest distance from there,
 * in pixels. */
static blot blot_of(const rt_image *image)
{
    blot b = {0, 0, 0, 0, 0};
    for (int pass = 0; pass < 2; ++pass) {
        double x_sum = 0, y_sum = 0;
        b.sum = 0;
        for (int y = 0; y < image->height; ++y)
            for (int x = 0; x < image->width; ++x) {
                const double light = (double)image->rgb[3 * (y * image->width + x)];
                const double across = x + 0.5 - b.x, down = y + 0.5 - b.y;
                b.sum += light;
                x_sum += light * (x + 0.5);
                y_sum += light * (y + 0.5);
                if (pass == 0 || !(light > 0))
                    continue;
                b.square += light * (across * across + down * down);
                b.reach = fmax(b.reach, hypot(across, down));
            }
        if (pass == 0) {
            b.x = x_sum / b.sum;
            b.y = y_sum / b.sum;
        }
    }
    b.square /= b.sum;
    return b;
}

/* A small ball at the distance D, the lens focused at F: its light spreads evenly over a circle of
 * the diameter A |D - F| / (D F), in units of the picture's plane at distance 1. An even disk of
 * the radius c has the mean square c^2 / 2. */
static void the_circle_of_confusion_is_the_thin_lens_s(void **state)
{
    (void)state;
    static const double distances[] = {3, 4.5, 6, 12, 24};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; ++i) {
        rt_scene scene;
        rt_image image;
        const rt_material white = test_glow(1, 1, 1);
        const double D = distances[i], F = 6, A = 0.5, pixels = 128, ball = 0.02 * D;
        test_begin(&scene);
        scene.width = scene.height = 128;
        scene.samples = 64;
        scene.camera.vfov = 53.13010235f; /* twice the angle of tangent 1/2 */
        scene.camera.aperture = (float)A;
        scene.camera.focus = (float)F;
        scene.camera.from = (rt_vec3){1, 2, 3};
        scene.camera.at = (rt_vec3){1, 2, -9};
        test_add_sphere(&scene, &white, 1, 2, (float)(3 - D), (float)ball);
        draw(&scene, &image);
        const blot b = blot_of(&image);
        const double circle = 0.5 * A * fabs(D - F) / (D * F) * pixels;
        const double image_radius = ball / D * pixels;
        assert_near(b.x, pixels / 2, 0.2);
        assert_near(b.y, pixels / 2, 0.2);
        /* Disks of the lens, of the ball and the square of the pixel add up their mean squares. */
        const double square = 0.5 * (circle * circle + image_radius * image_radius) + 1.0 / 6;
        assert_near(sqrt(b.square), sqrt(square), 0.02 * sqrt(square) + 0.02);
        assert_true(b.reach < circle + image_radius + 1.5);
        assert_true(b.reach > circle + image_radius - 1.5);
        /* Nothing of its light is lost: the ball's image is as bright as it is large. */
        assert_near(b.sum, PI * image_radius * image_radius, 0.05 * b.sum);
        rt_image_clear(&image);
        rt_scene_clear(&scene);
    }
}

/* Without `focus` the point that the camera looks at is sharp. */
static void the_view_s_aim_is_sharp(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image image;
    const rt_material white = test_glow(1, 1, 1);
    test_begin(&scene);
    scene.width = scene.height = 33;
    scene.samples = 64;
    scene.camera.aperture = 1;
    scene.camera.from = (rt_vec3){2, 1, 0};
    scene.camera.at = (rt_vec3){-1, 3, -6};
    test_add_sphere(&scene, &white, -1, 3, -6, 0.1f);
    draw(&scene, &image);
    for (int i = 0; i < 33 * 33; ++i)
        assert_true(image.rgb[3 * i] == 0.0f || i == 16 * 33 + 16);
    assert_true(image.rgb[3 * (16 * 33 + 16)] > 0.0f);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

/* A sample a pixel goes through the centre, the same at any filter. */
static void one_sample_is_the_centre(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image box, tent;
    const rt_material white = test_glow(1, 1, 1);
    test_begin(&scene);
    scene.width = 37;
    scene.height = 23;
    test_add_sphere(&scene, &white, 0.3f, 0.2f, -3, 1.5f);
    draw(&scene, &box);
    scene.filter = RT_FILTER_TENT;
    draw(&scene, &tent);
    assert_memory_equal(box.rgb, tent.rgb, 3 * sizeof(float) * 37 * 23);
    for (int y = 0; y < 23; ++y)
        for (int x = 0; x < 37; ++x) {
            const vec d = {(2 * x + 1 - 37) / 23.0, (22 - 2 * y) / 23.0, -1};
            const vec seen = test_look(&scene, (vec){0, 0, 0}, d);
            assert_near(box.rgb[3 * (37 * y + x)], seen.x, 0);
        }
    rt_image_clear(&box);
    rt_image_clear(&tent);
    rt_scene_clear(&scene);
}

/* Rows are taken by threads, and the watch is called by one of them at a time, with parts that only
 * grow; once it says so, the rest is left alone. */
typedef struct patience {
    int calls, most;
    double done;
    bool is_inside;
} patience;

static bool watch_rows(void *context, double done)
{
    patience *p = context;
    const bool is_alone = !p->is_inside;
    p->is_inside = true;
    const bool grows = done >= p->done;
    p->done = done;
    ++p->calls;
    p->is_inside = false;
    return is_alone && grows && p->calls < p->most;
}

static void the_watch_is_asked_and_obeyed(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image image;
    rt_status status = RT_STATUS_INIT;
    const rt_material white = test_glow(1, 1, 1);
    test_begin(&scene);
    scene.width = scene.height = 64;
    test_add_sphere(&scene, &white, 0, 0, -3, 1);
    assert_good(rt_image_init(&image, 64, 64, false, &status), &status);
    patience p = {.most = 1000};
    const rt_watch watch = {watch_rows, &p};
    assert_good(rt_scalar_double_render(&scene, &image, &watch, &status), &status);
    assert_int_equal(p.calls, 64);
    p = (patience){.most = 20};
    assert_false(rt_scalar_double_render(&scene, &image, &watch, &status));
    assert_int_equal(status.code, RT_INTERRUPTED);
    assert_int_equal(p.calls, 20);
    rt_status_clear(&status);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_edge_shows_the_filter_s_integral),
        cmocka_unit_test(the_circle_of_confusion_is_the_thin_lens_s),
        cmocka_unit_test(the_view_s_aim_is_sharp),
        cmocka_unit_test(one_sample_is_the_centre),
        cmocka_unit_test(the_watch_is_asked_and_obeyed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
