/* Twins: pictures of random scenes, each effect alone and all of them together, on the device and
 * by the scalar reference. Every ray of every path is the same to the bit, so colours can differ by
 * what the device's exp, exp2 and arc functions round otherwise, and by nothing else. */
#include "support/mutants.h"
#include "support/support.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference/scalar.h"

/* What a random scene asks for. */
enum {
    SAMPLES = 1 << 0,
    TENT = 1 << 1,
    LENS = 1 << 2,
    GRADIENT = 1 << 3,
    FOG = 1 << 4,
    CHECKER = 1 << 5,
    TEXTURE = 1 << 6,
    NEAREST = 1 << 7,
    HARD = 1 << 8,
    SOFT = 1 << 9,
    OCCLUSION = 1 << 10,
    MIRROR = 1 << 11,
    GLASS = 1 << 12,
    ABSORB = 1 << 13,
    SMOOTH = 1 << 14,
    CULL = 1 << 15,
    POWER = 1 << 16,
};
#define ALL ((1 << 16) - 1 - TENT - NEAREST - CULL)

typedef struct text {
    char *at, *end;
    double size; /* of the scene: what its lengths are multiplied by */
} text;

__attribute__((format(printf, 2, 3))) static void say(text *t, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(t->at, (size_t)(t->end - t->at), format, arguments);
    va_end(arguments);
    assert_true(length >= 0 && length < t->end - t->at);
    t->at += length;
}

static double within(test_random *random, double low, double high)
{
    return (double)test_random_float(random, (float)low, (float)high);
}

/* Three numbers of their own. */
static void say_three(text *t, test_random *random, const char *name, double low, double high)
{
    const double x = within(random, low, high), y = within(random, low, high);
    say(t, " %s %.6g %.6g %.6g", name, x, y, within(random, low, high));
}

/* The same, for a point. */
static void say_point(text *t, test_random *random, const char *name, double low, double high)
{
    say_three(t, random, name, low * t->size, high * t->size);
}

#define MATERIALS 5

static void say_material(text *t, test_random *random, int number, int asked)
{
    say(t, "material m%d", number);
    say_three(t, random, "ka", 0.2, 1);
    say_three(t, random, "kd", 0, 1);
    say_three(t, random, "ks", 0, 1);
    say(t, " shininess %g", asked & POWER ? 2.5 + number : 1 + 7 * number);
    const double share = within(random, 0.2, 0.8);
    const bool is_glass = asked & GLASS && number % 2 == 0;
    if (asked & MIRROR && number % 3 != 1)
        say(t, " reflect %.6g", is_glass ? share : 0.5 + 0.5 * share);
    if (is_glass) {
        const double rest = asked & MIRROR ? 1 - share : 1;
        say(t, " transmit %.6g ior %.6g", 0.99 * rest, within(random, 0.7, 2));
        if (asked & ABSORB)
            say_three(t, random, "absorb", 0, 1 / t->size);
    }
    if (asked & CHECKER && number != 1)
        say(t, " checker 0.1 0.5 0.9 cell %.6g", t->size * within(random, 0.2, 0.9));
    if (asked & TEXTURE && number != 2)
        say(t, " texture \"texture.bmp\" filter %s wrap %s",
            asked & NEAREST ? "nearest" : "bilinear", number % 2 ? "clamp" : "repeat");
    say(t, "\n");
}

static void say_lights(text *t, test_random *random, int asked)
{
    const char *shadow = asked & (HARD | SOFT) ? "on" : "off";
    say(t, "light directional");
    say_three(t, random, "direction", -1, 0.2);
    say(t, " color 0.3 0.4 0.2 shadow %s\n", asked & HARD ? "on" : "off");
    for (int i = 0; i < 2; ++i) {
        say(t, "light point");
        say_point(t, random, "at", -5, 5);
        say_three(t, random, "color", 0.2, 0.8);
        say(t, " shadow %s", shadow);
        if (asked & SOFT && (i == 0 || !(asked & HARD)))
            say(t, " radius %.6g samples %d", t->size * within(random, 0.1, 1), 3 + 6 * i);
        say(t, "\n");
    }
}

/* A corner near (x, y, z). */
static void say_corner(text *t, test_random *random, const char *name, const double *middle)
{
    const double x = middle[0] + within(random, -1, 1), y = middle[1] + within(random, -1, 1);
    const double z = middle[2] + within(random, -1, 1);
    say(t, " %s %.6g %.6g %.6g", name, t->size * x, t->size * y, t->size * z);
}

static void say_primitives(text *t, test_random *random, int asked)
{
    for (int i = 0; i < 7; ++i) {
        say(t, "sphere");
        say_point(t, random, "center", -2.5, 2.5);
        say(t, " radius %.6g material m%d\n", t->size * within(random, 0.2, 0.9), i % MATERIALS);
    }
    for (int i = 0; i < 8; ++i) {
        const double middle[] = {within(random, -2, 2), within(random, -2, 2),
                                 within(random, -2, 2)};
        say(t, "triangle");
        say_corner(t, random, "a", middle);
        say_corner(t, random, "b", middle);
        say_corner(t, random, "c", middle);
        if (asked & SMOOTH && i % 2) {
            say_three(t, random, "na", -1, 1);
            say_three(t, random, "nb", -1, 1);
            say_three(t, random, "nc", -1, 1);
        }
        if (asked & TEXTURE && i % 3) {
            const double u = within(random, -2, 2), v = within(random, -2, 2);
            say(t, " ta %.6g %.6g tb %.6g %.6g tc %.6g %.6g", u, v, u + 1, v, u, v + 2);
        }
        say(t, " material m%d\n", i % MATERIALS);
    }
    const double far = 20 * t->size, low = -2 * t->size;
    say(t, "triangle a %.6g %.6g %.6g b %.6g %.6g %.6g c 0 %.6g %.6g material m1\n", -far, low, far,
        far, low, far, low, -far);
}

/* A scene that asks for what `asked` says and for nothing else. */
static void make_scene(rt_scene *scene, uint64_t seed, int asked, double size)
{
    static char buffer[16384];
    test_random random = {seed};
    text t = {buffer, buffer + sizeof buffer, size};
    say(&t, "image width 40 height 30 samples %d filter %s\n", asked & SAMPLES ? 5 : 1,
        asked & TENT ? "tent" : "box");
    say(&t, "camera");
    say_point(&t, &random, "from", 3, 5);
    say_point(&t, &random, "at", -0.5, 0.5);
    if (asked & LENS)
        say(&t, " aperture %.6g focus %.6g", size * within(&random, 0.05, 0.5),
            size * within(&random, 3, 8));
    say(&t, " vfov 50\nbackground 0.2 0.3 0.5");
    if (asked & GRADIENT)
        say_three(&t, &random, "top", 0, 1);
    say(&t, "\nambient 0.3 0.2 0.4\ndepth %d\n", (int)within(&random, 2, 9));
    if (asked & FOG)
        say(&t, "fog 0.4 0.5 0.6 density %.6g\n", within(&random, 0.02, 0.2) / size);
    if (asked & OCCLUSION)
        say(&t, "occlusion samples 7 distance %.6g\n", size * within(&random, 0.5, 3));
    if (asked & CULL)
        say(&t, "cull back\n");
    for (int i = 0; i < MATERIALS; ++i)
        say_material(&t, &random, i, asked);
    say_lights(&t, &random, asked);
    say_primitives(&t, &random, asked);
    test_scene(scene, buffer);
}

/* 5 x 3 texels, as a bitmap of 24 bits a pixel. */
static void write_texture(void)
{
    unsigned char bytes[54 + 3 * 16] = {
        'B', 'M', sizeof bytes, [10] = 54, [14] = 40, [18] = 5, [22] = 3, [26] = 1, [28] = 24};
    test_random random = {99};
    for (int row = 0; row < 3; ++row)
        for (int i = 0; i < 15; ++i)
            bytes[54 + 16 * row + i] = (unsigned char)test_random_bits(&random);
    test_write_file(test_path("texture.bmp"), bytes, sizeof bytes);
}

typedef struct tally {
    size_t pixels, hits; /* hit records that differ */
    size_t steps;        /* pixels off by more than an 8-bit step */
    size_t off;          /* pixels off by more than rounding of colours can do */
} tally;

static bool is_off(const float *a, const float *b)
{
    for (int k = 0; k < 3; ++k)
        if (!(fabsf(a[k] - b[k]) <= 1e-4f * fmaxf(1.0f, fabsf(b[k]))))
            return true;
    return false;
}

/* Adds to the tally how the pictures of one scene differ. */
static void compare(const rt_scene *scene, tally *sum)
{
    rt_image actual, expected;
    rt_status status = RT_STATUS_INIT;
    test_draw(scene, NULL, &actual);
    test_draw_scalar(scene, &expected);
    if (scene->accuracy == RT_ACCURACY_DOUBLE)
        assert_good(rt_scalar_double_render(scene, &expected, NULL, &status), &status);
    const rt_image_difference d = rt_image_compare(&actual, &expected);
    const size_t pixels = (size_t)actual.width * (size_t)actual.height;
    assert_int_equal(d.non_finite, 0);
    for (size_t i = 0; i < pixels; ++i)
        sum->off += is_off(actual.rgb + 3 * i, expected.rgb + 3 * i);
    sum->pixels += pixels;
    sum->hits += d.hits;
    sum->steps += d.pixels;
    rt_image_clear(&actual);
    rt_image_clear(&expected);
}

static void compare_random(uint64_t first, int count, int asked, double size,
                           enum rt_accuracy level, tally *sum)
{
    for (int i = 0; i < count; ++i) {
        rt_scene scene;
        make_scene(&scene, first + (uint64_t)i, asked, size);
        scene.accuracy = level;
        compare(&scene, sum);
        rt_scene_clear(&scene);
    }
}

/* Where a texel is chosen, and not mixed from its neighbours, by an angle that a library's function
 * gives, an ulp can choose another one; nowhere else does anything hang on a function that devices
 * may round as they like. */
static void assert_twins(const char *name, const tally *t, bool chooses)
{
    print_message("%-24s %6zu pixels: hits %zu, steps %zu, off %zu\n", name, t->pixels, t->hits,
                  t->steps, t->off);
    assert_int_equal(t->hits, 0);
    if (chooses) {
        assert_true(1000 * t->steps <= t->pixels);
    } else {
        assert_int_equal(t->steps, 0);
        assert_int_equal(t->off, 0);
    }
}

static void random_scenes(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int asked;
        double size;
        enum rt_accuracy level;
    } sets[] = {
        {"Phong", 0, 1, RT_ACCURACY_ROBUST},
        {"anti-aliasing", SAMPLES, 1, RT_ACCURACY_ROBUST},
        {"tent filter", SAMPLES | TENT, 1, RT_ACCURACY_ROBUST},
        {"lens", LENS, 1, RT_ACCURACY_ROBUST},
        {"lens and samples", LENS | SAMPLES, 1, RT_ACCURACY_ROBUST},
        {"gradient", GRADIENT, 1, RT_ACCURACY_ROBUST},
        {"fog", FOG, 1, RT_ACCURACY_ROBUST},
        {"checker", CHECKER, 1, RT_ACCURACY_ROBUST},
        {"texture", TEXTURE, 1, RT_ACCURACY_ROBUST},
        {"nearest texel", TEXTURE | NEAREST, 1, RT_ACCURACY_ROBUST},
        {"hard shadows", HARD, 1, RT_ACCURACY_ROBUST},
        {"soft shadows", SOFT, 1, RT_ACCURACY_ROBUST},
        {"hard and soft shadows", HARD | SOFT, 1, RT_ACCURACY_ROBUST},
        {"occlusion", OCCLUSION, 1, RT_ACCURACY_ROBUST},
        {"mirrors", MIRROR, 1, RT_ACCURACY_ROBUST},
        {"smooth mirrors", MIRROR | SMOOTH, 1, RT_ACCURACY_ROBUST},
        {"glass", GLASS, 1, RT_ACCURACY_ROBUST},
        {"smooth glass, culled", GLASS | SMOOTH | CULL, 1, RT_ACCURACY_ROBUST},
        {"mirrors and glass", MIRROR | GLASS | ABSORB, 1, RT_ACCURACY_ROBUST},
        {"all but samples", ALL - SAMPLES, 1, RT_ACCURACY_ROBUST},
        {"all", ALL | POWER, 1, RT_ACCURACY_ROBUST},
        {"all, tiny", ALL, 1e-5, RT_ACCURACY_ROBUST},
        {"all, huge", ALL, 1e5, RT_ACCURACY_ROBUST},
        {"all, standard", ALL, 1, RT_ACCURACY_STANDARD},
    };
    for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
        tally sum = {0, 0, 0, 0};
        /* An effect alone, where all together have it too. */
        const int asked = sets[i].asked;
        if (!test_is_long() && asked & ALL && !(asked & (asked - 1)))
            continue;
        compare_random(1000 * i, 11, sets[i].asked, sets[i].size, sets[i].level, &sum);
        assert_twins(sets[i].name, &sum, sets[i].asked & NEAREST);
    }
}

/* The scenes that come with the program, made small. */
static void written_scenes(void **state)
{
    (void)state;
    glob_t found;
    assert_int_equal(glob("scenes/*.txt", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; ++i) {
        rt_scene scene;
        tally sum = {0, 0, 0, 0};
        test_scene_file(&scene, found.gl_pathv[i]);
        scene.height = 90 * scene.height / scene.width;
        scene.width = 90;
        if (scene.samples > 3)
            scene.samples = 3;
        compare(&scene, &sum);
        bool chooses = false;
        for (size_t m = 0; m < scene.material_count; ++m)
            chooses = chooses || (scene.materials[m].texture >= 0 && scene.materials[m].nearest);
        assert_twins(found.gl_pathv[i], &sum, chooses);
        rt_scene_clear(&scene);
    }
    globfree(&found);
}

/* The comparison notices kernels that are almost right, each by the effect that it is about. */
static void a_wrong_kernel_is_noticed(void **state)
{
    (void)state;
    static const struct {
        int asked;
        test_mutant mutant;
    } mutants[] = {
        {SAMPLES | TENT, MUTANT_TENT_WITHOUT_ROOT},
        {SAMPLES, MUTANT_SAME_BITS_TWICE},
        {LENS, MUTANT_DISK_TURNED},
        {LENS | SAMPLES, MUTANT_LENS_WITH_PIXEL},
        {SOFT, MUTANT_FRAME_OF_ONE_SIGN},
        {SOFT, MUTANT_PROBE_FROM_ORIGIN},
        {HARD, MUTANT_PROBE_TOO_LONG},
        {HARD, MUTANT_FIRST_LIGHT_SHADOWLESS},
        {OCCLUSION, MUTANT_PROBE_COSINE},
        {OCCLUSION | SMOOTH, MUTANT_PROBE_INTO_SURFACE},
        {SOFT | OCCLUSION | MIRROR, MUTANT_PROBE_SAME_AT_BOUNCES},
        {MIRROR | SMOOTH, MUTANT_MIRRORED_INTO_SURFACE},
        {MIRROR | GLASS, MUTANT_DEPTH_ONE_LESS},
        {MIRROR | GLASS, MUTANT_ROULETTE_WITHOUT_GAIN},
        {MIRROR | GLASS, MUTANT_SPLIT_FOR_NOTHING},
        {GLASS, MUTANT_REFRACTED_FROM_FRONT},
        {GLASS, MUTANT_FRESNEL_SWAPPED},
        {GLASS, MUTANT_INDEX_INVERTED},
        {GLASS | ABSORB, MUTANT_MEDIUM_KEPT},
        {CHECKER, MUTANT_CELLS_AT_BORDER},
        {TEXTURE, MUTANT_PICTURE_UPSIDE_DOWN},
        {TEXTURE, MUTANT_TEXEL_HALF_OFF},
        {TEXTURE, MUTANT_NEVER_CLAMPED},
        {FOG, MUTANT_FOG_WITHOUT_WAY},
        {GRADIENT, MUTANT_GRADIENT_STEEP},
    };
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i += test_is_long() ? 1 : 4) {
        tally sum = {0, 0, 0, 0};
        test_mutate_kernels(mutants[i].mutant);
        compare_random(5000, 4, mutants[i].asked, 1, RT_ACCURACY_ROBUST, &sum);
        test_restore_kernels();
        if (sum.off + sum.hits == 0)
            fail_msg("nobody notices %s", test_mutations[mutants[i].mutant].name);
    }
}

static int set_up(void **state)
{
    (void)state;
    write_texture();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes),
        cmocka_unit_test(written_scenes),
        cmocka_unit_test(a_wrong_kernel_is_noticed),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
