/* From a scene to what it calls for. */
#include "support/support.h"

#include <string.h>

#include "scene/effects.h"

#define MATERIAL "material m shininess 32\n"
#define SPHERE "sphere center 0 0 -3 radius 1 material m\n"
#define TRIANGLE "triangle a 0 0 -1 b 1 0 -1 c 0 1 -1 material m"

static rt_effects effects_of(const char *text)
{
    rt_scene scene;
    test_scene(&scene, text);
    const rt_effects effects = rt_effects_of(&scene);
    rt_scene_clear(&scene);
    return effects;
}

static void phong_alone_calls_for_nothing(void **state)
{
    (void)state;
    const rt_effects e = effects_of(MATERIAL SPHERE);
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        assert_false(e.on[i]);
    assert_true(e.has_kind[RT_KIND_SPHERES]);
    assert_false(e.has_kind[RT_KIND_TRIANGLES]);
    assert_int_equal(e.cull_sign, 0);
    assert_int_equal(e.exponent_bits, 8);
    assert_false(e.has_fractional_exponent);
}

static void culling_needs_triangles(void **state)
{
    (void)state;
    assert_false(effects_of(MATERIAL SPHERE "cull back\n").on[RT_EFFECT_CULL]);
    assert_int_equal(effects_of(MATERIAL SPHERE "cull back\n").cull_sign, 0);
    const rt_effects e = effects_of(MATERIAL "cull back winding cw\n" TRIANGLE "\n");
    assert_true(e.on[RT_EFFECT_CULL]);
    assert_int_equal(e.called_by[RT_EFFECT_CULL].line, 3);
    assert_int_equal(e.cull_sign, -1);
    assert_true(e.has_kind[RT_KIND_TRIANGLES]);
    assert_false(e.has_kind[RT_KIND_SPHERES]);
}

static void vertex_normals_call_for_smoothness(void **state)
{
    (void)state;
    assert_false(effects_of(MATERIAL TRIANGLE "\n").on[RT_EFFECT_SMOOTH]);
    const rt_effects e =
        effects_of(MATERIAL TRIANGLE "\n" TRIANGLE " na 0 0 1 nb 0 0 1 nc 0 0 1\n");
    assert_true(e.on[RT_EFFECT_SMOOTH]);
    assert_int_equal(e.called_by[RT_EFFECT_SMOOTH].line, 4);
}

static void exponents_decide_the_power(void **state)
{
    (void)state;
    assert_int_equal(effects_of("material m shininess 255\n" SPHERE).exponent_bits, 8);
    assert_int_equal(effects_of("material m shininess 256\n" SPHERE).exponent_bits, 20);
    assert_int_equal(effects_of("material m shininess 1e6\n" SPHERE).exponent_bits, 20);
    assert_true(effects_of("material m shininess 2.5\n" SPHERE).has_fractional_exponent);
    const rt_effects unused = effects_of("material n shininess 2.5\n" MATERIAL SPHERE);
    assert_false(unused.has_fractional_exponent);
}

/* Which line of a scene calls for an effect, 0 for none; that no other effect is on. */
static int line_of(const char *text, enum rt_effect effect)
{
    rt_scene scene;
    test_scene(&scene, text);
    const rt_effects e = rt_effects_of(&scene);
    rt_scene_clear(&scene);
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        if (e.on[i] && i != (int)effect)
            fail_msg("%s is on, and not only %s, in:\n%s", rt_effect_name((enum rt_effect)i),
                     rt_effect_name(effect), text);
    return e.on[effect] ? e.called_by[effect].line : 0;
}

#define BALL "sphere center 0 0 -3 radius 1 material a\n"

/* The first line is "rt 1". */
static void each_effect_is_called_for_by_its_statement_alone(void **state)
{
    (void)state;
    static const struct {
        enum rt_effect effect;
        int line; /* 0: the effect is off */
        const char *text;
    } cases[] = {
        {RT_EFFECT_CHECKER, 3, "material b\nmaterial a checker 0 0 0\n" BALL},
        {RT_EFFECT_CHECKER, 0, "material b checker 0 0 0\nmaterial a\n" BALL},
        {RT_EFFECT_CHECKER, 0, "material a checker 0 0 0\n"},
        {RT_EFFECT_CHECKER, 2,
         "material a checker 1 1 1\nmaterial b checker 0 0 0\n"
         "sphere center 9 9 9 radius 1 material b\n" BALL},
        {RT_EFFECT_HARD_SHADOWS, 3, "material a\nlight point at 0 9 0 shadow on\n" BALL},
        {RT_EFFECT_HARD_SHADOWS, 3,
         "material a\nlight directional direction 0 -1 0 shadow on\n" BALL "shadows off\n"},
        {RT_EFFECT_HARD_SHADOWS, 5, "material a\nlight point at 0 9 0\n" BALL "shadows on\n"},
        {RT_EFFECT_HARD_SHADOWS, 0, "material a\nlight point at 0 9 0\n" BALL "shadows off\n"},
        {RT_EFFECT_HARD_SHADOWS, 0, "light point at 0 9 0\nshadows on\n"},
        {RT_EFFECT_HARD_SHADOWS, 0, "material a\nshadows on\n" BALL},
        {RT_EFFECT_HARD_SHADOWS, 0,
         "material a\nlight point at 0 9 0 shadow off\nshadows on\n" BALL},
        {RT_EFFECT_SOFT_SHADOWS, 3, "material a\nlight point at 0 9 0 radius 1\nshadows on\n" BALL},
        {RT_EFFECT_SOFT_SHADOWS, 3, "material a\nlight point at 0 9 0 radius 1 shadow on\n" BALL},
        {RT_EFFECT_SOFT_SHADOWS, 0, "material a\nlight point at 0 9 0 radius 1\n" BALL},
        {RT_EFFECT_REFLECT, 2, "material a reflect 0.5\n" BALL},
        {RT_EFFECT_REFLECT, 0, "material a reflect 0\n" BALL},
        {RT_EFFECT_REFLECT, 0, "depth 0\nmaterial a reflect 0.5\n" BALL},
        {RT_EFFECT_REFLECT, 0, "material b reflect 0.5\nmaterial a\n" BALL},
        {RT_EFFECT_REFRACT, 2, "material a transmit 0.5\n" BALL},
        {RT_EFFECT_REFRACT, 0, "material a transmit 0 ior 2 absorb 1 1 1\n" BALL},
        {RT_EFFECT_REFRACT, 0, "depth 0\nmaterial a transmit 1 absorb 1 1 1\n" BALL},
        {RT_EFFECT_AMBIENT_OCCLUSION, 3, "material a\nocclusion distance 2\n" BALL},
        {RT_EFFECT_FOG, 3, "material a\nfog 1 1 1 density 0.5\n" BALL},
        {RT_EFFECT_GRADIENT, 2, "background 1 1 1 top 0 0 0\nmaterial a\n" BALL},
        {RT_EFFECT_GRADIENT, 0, "background 1 1 1 top 1 1 1\nmaterial a\n" BALL},
        {RT_EFFECT_GRADIENT, 0, "background 1 1 1\nmaterial a\n" BALL},
        {RT_EFFECT_ANTIALIAS, 2, "image samples 2\nmaterial a\n" BALL},
        {RT_EFFECT_ANTIALIAS, 0, "image samples 1 filter tent\nmaterial a\n" BALL},
        {RT_EFFECT_LENS, 2, "camera aperture 0.1\nmaterial a\n" BALL},
        {RT_EFFECT_LENS, 0, "camera aperture 0 focus 3\nmaterial a\n" BALL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
        if (line_of(cases[i].text, cases[i].effect) != cases[i].line)
            fail_msg("%s, which line %d calls for, in:\n%s", rt_effect_name(cases[i].effect),
                     cases[i].line, cases[i].text);
}

/* Absorption comes with refraction, and a texture needs a file. */
static void effects_that_come_together(void **state)
{
    (void)state;
    const rt_effects glass = effects_of("material a transmit 1 absorb 0 0 1\n" BALL);
    assert_true(glass.on[RT_EFFECT_REFRACT] && glass.on[RT_EFFECT_ABSORB]);
    assert_int_equal(glass.called_by[RT_EFFECT_ABSORB].line, 2);
    rt_scene scene;
    test_scene_file(&scene, "scenes/textured.txt");
    assert_true(rt_effects_of(&scene).on[RT_EFFECT_TEXTURE]);
    rt_scene_clear(&scene);
    const rt_effects lights = effects_of("material a\nlight point at 0 0 0\n"
                                         "light directional direction 1 0 0\n" BALL);
    assert_true(lights.has_point_lights && lights.has_directional_lights);
    assert_int_equal(lights.light_count, 2);
    const rt_effects none = effects_of("material a\n" BALL);
    assert_false(none.has_point_lights || none.has_directional_lights);
    assert_int_equal(none.light_count, 0);
}

/* The scenes that show effects, and what each calls for. */
static void the_scenes_to_look_at(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        enum rt_effect effect;
    } scenes[] = {
        {"scenes/mirrors.txt", RT_EFFECT_REFLECT},   {"scenes/glass.txt", RT_EFFECT_REFRACT},
        {"scenes/soft.txt", RT_EFFECT_SOFT_SHADOWS}, {"scenes/focus.txt", RT_EFFECT_LENS},
        {"scenes/fog.txt", RT_EFFECT_FOG},           {"scenes/spheres.txt", RT_EFFECT_REFLECT},
        {"scenes/textured.txt", RT_EFFECT_TEXTURE}};
    rt_scene scene;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i) {
        test_scene_file(&scene, scenes[i].path);
        assert_true(rt_effects_of(&scene).on[scenes[i].effect]);
        rt_scene_clear(&scene);
    }
    test_scene_file(&scene, "scenes/gallery.txt");
    const rt_effects gallery = rt_effects_of(&scene);
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        if (!gallery.on[i] || !gallery.called_by[i].line)
            fail_msg("gallery.txt is without %s", rt_effect_name((enum rt_effect)i));
    rt_scene_clear(&scene);
}

/* Taking an effect away takes that one, and absorption with refraction. */
static void removing_effects(void **state)
{
    (void)state;
    for (int removed = 0; removed < RT_EFFECT_COUNT; ++removed) {
        rt_scene scene;
        test_scene_file(&scene, "scenes/gallery.txt");
        rt_effects_remove(&scene, (enum rt_effect)removed);
        const rt_effects e = rt_effects_of(&scene);
        for (int i = 0; i < RT_EFFECT_COUNT; ++i) {
            const bool goes_too = i == RT_EFFECT_ABSORB && removed == RT_EFFECT_REFRACT;
            assert_true(e.on[i] == (i != removed && !goes_too));
        }
        rt_scene_clear(&scene);
    }
    rt_scene scene;
    test_scene_file(&scene, "scenes/gallery.txt");
    rt_effects_remove_all(&scene);
    const rt_effects e = rt_effects_of(&scene);
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        assert_false(e.on[i]);
    assert_int_equal(e.cull_sign, 0);
    rt_scene_clear(&scene);
}

static void modes_have_names(void **state)
{
    (void)state;
    enum rt_effects_mode mode = RT_EFFECTS_ALL;
    assert_true(rt_effects_mode_of_name("none", &mode));
    assert_int_equal(mode, RT_EFFECTS_NONE);
    assert_false(rt_effects_mode_of_name("some", &mode));
    assert_int_equal(mode, RT_EFFECTS_NONE);
    assert_true(rt_effects_mode_of_name("scene", &mode));
    assert_int_equal(mode, RT_EFFECTS_SCENE);
    assert_true(rt_effects_mode_of_name("all", &mode));
    assert_int_equal(mode, RT_EFFECTS_ALL);
}

static void every_effect_has_a_name(void **state)
{
    (void)state;
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        assert_string_not_equal(rt_effect_name((enum rt_effect)i), "none");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phong_alone_calls_for_nothing),
        cmocka_unit_test(culling_needs_triangles),
        cmocka_unit_test(vertex_normals_call_for_smoothness),
        cmocka_unit_test(exponents_decide_the_power),
        cmocka_unit_test(each_effect_is_called_for_by_its_statement_alone),
        cmocka_unit_test(effects_that_come_together),
        cmocka_unit_test(the_scenes_to_look_at),
        cmocka_unit_test(removing_effects),
        cmocka_unit_test(modes_have_names),
        cmocka_unit_test(every_effect_has_a_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
