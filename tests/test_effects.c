/* From a scene to what it calls for. */
#include "support.h"

#include <string.h>

#include "effects.h"

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
    assert_true(e.has_spheres);
    assert_false(e.has_triangles);
    assert_int_equal(e.cull_sign, 0);
    assert_int_equal(e.exponent_bits, 8);
    assert_false(e.has_fractional_exponent);
}

static void culling_needs_triangles(void **state)
{
    (void)state;
    assert_false(effects_of(MATERIAL SPHERE "cull back\n").on[RT_EFFECT_CULLING]);
    assert_int_equal(effects_of(MATERIAL SPHERE "cull back\n").cull_sign, 0);
    const rt_effects e = effects_of(MATERIAL "cull back winding cw\n" TRIANGLE "\n");
    assert_true(e.on[RT_EFFECT_CULLING]);
    assert_int_equal(e.called_by[RT_EFFECT_CULLING].line, 3);
    assert_int_equal(e.cull_sign, -1);
    assert_true(e.has_triangles);
    assert_false(e.has_spheres);
}

static void vertex_normals_call_for_smoothness(void **state)
{
    (void)state;
    assert_false(effects_of(MATERIAL TRIANGLE "\n").on[RT_EFFECT_SMOOTH_NORMALS]);
    const rt_effects e =
        effects_of(MATERIAL TRIANGLE "\n" TRIANGLE " na 0 0 1 nb 0 0 1 nc 0 0 1\n");
    assert_true(e.on[RT_EFFECT_SMOOTH_NORMALS]);
    assert_int_equal(e.called_by[RT_EFFECT_SMOOTH_NORMALS].line, 4);
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
        cmocka_unit_test(every_effect_has_a_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
