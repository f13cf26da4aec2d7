/* How far shadow rays go: what is before a light hides it, however near, what is behind it does
 * not, and a lamp that is in a wall shines from it. On the device and by the scalar reference, at
 * sizes from 1e-5 to 1e5. */
#include "support/mutants.h"
#include "support/support.h"

#include <stdio.h>

#define SIDE 48

/* Where the lamp is, times the scene's size. */
#define LAMP_X 0.3
#define LAMP_Y 6.0
#define LAMP_Z -0.2

/* The floor y = 0 seen from above, with `more` beside it. */
static void read_room(rt_scene *scene, double size, enum rt_accuracy level, const char *more)
{
    char text[2000];
    snprintf(text, sizeof text,
             "image width %d height %d\ncamera from 0 %.9g %.9g at 0 0 0 vfov 60\n"
             "light point at %.9g %.9g %.9g shadow on\nmaterial m kd 1 1 1\n"
             "triangle a %.9g 0 %.9g b %.9g 0 %.9g c %.9g 0 %.9g material m\n"
             "triangle a %.9g 0 %.9g b %.9g 0 %.9g c %.9g 0 %.9g material m\n%s",
             SIDE, SIDE, 3 * size, 4 * size, LAMP_X * size, LAMP_Y * size, LAMP_Z * size, -9 * size,
             9 * size, 9 * size, 9 * size, 9 * size, -9 * size, -9 * size, 9 * size, 9 * size,
             -9 * size, -9 * size, -9 * size, more);
    test_scene(scene, text);
    scene->accuracy = level;
}

/* Pixels of the floor that are lit. */
static size_t count_lit(const rt_image *image, size_t *floor)
{
    size_t lit = 0;
    *floor = 0;
    for (size_t i = 0; i < SIDE * SIDE; ++i) {
        const int primitive = image->hits[i].primitive;
        const bool is_floor = primitive == image->hits[SIDE * SIDE - 1].primitive ||
                              primitive == image->hits[SIDE * SIDE - 1].primitive + 1;
        *floor += is_floor;
        lit += is_floor && !(image->rgb[3 * i] == 0.0f);
    }
    return lit;
}

/* Whether all of the floor is lit, or else none of it; the reference is left out for mutants. */
static bool is_all(double size, enum rt_accuracy level, bool lit, bool is_mutant, const char *more)
{
    rt_scene scene;
    bool good = true;
    read_room(&scene, size, level, more);
    for (int reference = 0; reference < (is_mutant ? 1 : 2); ++reference) {
        rt_image image;
        size_t floor;
        if (reference)
            test_draw_scalar(&scene, &image);
        else
            test_draw(&scene, NULL, &image);
        const size_t found = count_lit(&image, &floor);
        assert_true(floor > SIDE * SIDE / 2);
        if (found != (lit ? floor : 0)) {
            good = false;
            if (!is_mutant)
                print_message("%s, %s, size %g: %zu of %zu lit with %s", rt_accuracy_name(level),
                              reference ? "reference" : "device", size, found, floor, more);
        }
        rt_image_clear(&image);
    }
    rt_scene_clear(&scene);
    return good;
}

/* A level triangle about the lamp's axis, at the height `y` and out to `reach`. */
static const char *plate(double size, double y, double reach)
{
    static char text[300];
    const double x = LAMP_X, z = LAMP_Z;
    snprintf(text, sizeof text,
             "triangle a %.9g %.9g %.9g b %.9g %.9g %.9g c %.9g %.9g %.9g material m\n",
             size * (x - reach), size * y, size * (z - reach), size * (x + reach), size * y,
             size * (z - reach), size * x, size * y, size * (z + reach));
    return text;
}

static const char *ball(double size, double y, double radius)
{
    static char text[200];
    snprintf(text, sizeof text, "sphere center %.9g %.9g %.9g radius %.9g material m\n",
             size * LAMP_X, size * y, size * LAMP_Z, size * radius);
    return text;
}

/* Shades and lids a part of the way before the lamp and behind it, each larger than that part. */
static bool shades_hold(enum rt_accuracy level, bool is_mutant)
{
    static const double sizes[] = {1e-5, 1e-2, 1, 1e3, 1e5};
    static const double parts[] = {1e-2, 1e-4, 1e-5, 1e-6};
    bool good = true;
    for (size_t s = 0; s < (is_mutant ? 1 : 5); ++s)
        for (size_t i = 0; i < 4; ++i)
            for (int k = 0; k < 2; ++k) {
                const double size = sizes[s], reach = k ? 0.4 : 20 * parts[i] * LAMP_Y;
                good &= is_all(size, level, false, is_mutant,
                               plate(size, LAMP_Y * (1 - parts[i]), reach));
                good &= is_all(size, level, true, is_mutant,
                               plate(size, LAMP_Y * (1 + parts[i]), reach));
            }
    return good;
}

/* Globes about the lamp, and balls behind it. */
static bool globes_hold(enum rt_accuracy level)
{
    static const double sizes[] = {1e-5, 1, 1e5};
    static const double parts[] = {1e-2, 1e-4, 1e-5};
    bool good = true;
    for (size_t s = 0; s < 3; ++s)
        for (size_t i = 0; i < 3; ++i) {
            const double size = sizes[s], r = parts[i] * LAMP_Y;
            good &= is_all(size, level, false, false, ball(size, LAMP_Y, r));
            good &= is_all(size, level, true, false, ball(size, LAMP_Y + 1.01 * r, r));
        }
    return good;
}

/* Ceilings and walls through the lamp itself, which shines from them. */
static bool walls_hold(bool is_mutant)
{
    static const double reaches[] = {0.5, 7, 100, 1000};
    bool good = true;
    for (size_t i = 0; i < 4; ++i)
        for (int k = 0; k < (is_mutant ? 1 : 3); ++k) {
            const double size = k == 0 ? 1 : k == 1 ? 1.1e-5 : 1.3e5;
            good &=
                is_all(size, RT_ACCURACY_ROBUST, true, is_mutant, plate(size, LAMP_Y, reaches[i]));
            /* A ball that touches it from above. */
            good &=
                is_all(size, RT_ACCURACY_ROBUST, true, is_mutant, ball(size, LAMP_Y + 0.5, 0.5));
        }
    return good;
}

static void what_is_before_the_light_hides_it(void **state)
{
    (void)state;
    assert_true(shades_hold(RT_ACCURACY_STANDARD, false));
    assert_true(shades_hold(RT_ACCURACY_ROBUST, false));
    test_mutate_kernels(MUTANT_PROBE_TOO_SHORT);
    assert_false(shades_hold(RT_ACCURACY_ROBUST, true));
    test_mutate_kernels(MUTANT_PROBE_TOO_LONG);
    assert_false(shades_hold(RT_ACCURACY_ROBUST, true));
    test_restore_kernels();
}

static void a_globe_hides_the_light_in_it(void **state)
{
    (void)state;
    assert_true(globes_hold(RT_ACCURACY_STANDARD));
    assert_true(globes_hold(RT_ACCURACY_ROBUST));
}

static void a_light_in_a_wall_shines(void **state)
{
    (void)state;
    assert_true(walls_hold(false));
    test_mutate_kernels(MUTANT_PROBE_WITHOUT_GAP);
    assert_false(walls_hold(true));
    test_restore_kernels();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_before_the_light_hides_it),
        cmocka_unit_test(a_globe_hides_the_light_in_it),
        cmocka_unit_test(a_light_in_a_wall_shines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
