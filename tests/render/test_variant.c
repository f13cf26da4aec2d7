/* From effects, walk and device to the options that the kernels are built with. */
#include "support/support.h"

#include <stdlib.h>
#include <string.h>

#include "render/variant.h"

static void options_name_what_the_scene_has(void **state)
{
    (void)state;
    char options[RT_VARIANT_OPTIONS_SIZE];
    const rt_effects effects = {.has_kind[RT_KIND_TRIANGLES] = true,
                                .on = {[RT_EFFECT_CULL] = true, [RT_EFFECT_HARD_SHADOWS] = true},
                                .cull_sign = -1,
                                .exponent_bits = 8};
    const rt_walk walk = {
        .lanes = 4, .packet = 64, .stack_size = 65, .accuracy = RT_ACCURACY_STANDARD};
    rt_variant_options(RT_PART_ALL, &effects, &walk, RT_ROUNDING_DOUBLE, options);
    static const char first[] =
        "-cl-std=CL1.2 -cl-kernel-arg-info -DRT_PART=0 -DRT_ACCURACY=1 -DRT_LANES=4 "
        "-DRT_ROUNDING=1 -DRT_PACKET=64 -DRT_TREE=1 -DRT_STACK=256 -DRT_SHININESS_BITS=8 "
        "-DRT_SHININESS_FRACTION=0 ";
    assert_memory_equal(options, first, sizeof first - 1);
    assert_non_null(
        strstr(options, " -DRT_LIGHTS=0 -DRT_SPHERES=0 -DRT_TRIANGLES=1 -DRT_CULL=-1 "));
    /* Every effect is told, whether it is on or not. */
#define START(word, name) " -DRT_" #word "=",
    static const char *const starts[] = {RT_EFFECTS(START)};
#undef START
    for (int e = RT_EFFECT_SMOOTH; e < RT_EFFECT_COUNT; ++e) {
        const char *start = strstr(options, starts[e]);
        assert_non_null(start);
        assert_int_equal(atoi(start + strlen(starts[e])), effects.on[e]);
    }
    rt_variant_options(RT_PART_ALL, &effects, &walk, RT_ROUNDING_DEVICE, options);
    assert_non_null(strstr(options, "-cl-fp32-correctly-rounded-divide-sqrt"));
}

/* Walks are the same whatever is shaded, and what is shaded whatever the walk. */
static void parts_follow_from_what_they_are_of(void **state)
{
    (void)state;
    char plain[RT_VARIANT_OPTIONS_SIZE], other[RT_VARIANT_OPTIONS_SIZE];
    const rt_effects phong = {.has_kind[RT_KIND_SPHERES] = true, .exponent_bits = 8};
    rt_effects rich = phong, culled = phong, bent = phong, shaded = phong;
    rich.on[RT_EFFECT_FOG] = rich.on[RT_EFFECT_CHECKER] = rich.has_fractional_exponent = true;
    bent.on[RT_EFFECT_REFRACT] = true;
    shaded.on[RT_EFFECT_SOFT_SHADOWS] = true;
    rich.exponent_bits = 20;
    rich.light_count = 3;
    culled.on[RT_EFFECT_CULL] = true;
    culled.cull_sign = 1;
    const rt_walk walk = {.lanes = 8, .packet = 64, .stack_size = 65, .accuracy = 2};
    const rt_walk single = {.lanes = 8, .packet = 8, .stack_size = 0, .accuracy = 2};
    for (int part = RT_PART_TRACE; part < RT_PART_COUNT; ++part) {
        const bool walks = part == RT_PART_TRACE || part == RT_PART_OCCLUDE;
        rt_variant_options(part, &phong, &walk, RT_ROUNDING_DEVICE, plain);
        rt_variant_options(part, &rich, &walk, RT_ROUNDING_DEVICE, other);
        assert_int_equal(strcmp(plain, other) != 0, part == RT_PART_STAGES);
        rt_variant_options(part, &bent, &walk, RT_ROUNDING_DEVICE, other);
        assert_int_equal(strcmp(plain, other) != 0, !walks);
        rt_variant_options(part, &shaded, &walk, RT_ROUNDING_DEVICE, other);
        assert_int_equal(strcmp(plain, other) != 0,
                         part == RT_PART_STAGES || part == RT_PART_SECONDARY);
        rt_variant_options(part, &culled, &walk, RT_ROUNDING_DEVICE, other);
        assert_int_equal(strcmp(plain, other) != 0, walks);
        rt_variant_options(part, &phong, &single, RT_ROUNDING_DEVICE, other);
        assert_int_equal(strcmp(plain, other) != 0, walks);
    }
}

static void rounding_follows_the_device(void **state)
{
    (void)state;
    rt_device device = {.rounds_divide_sqrt = true, .has_fp64 = true};
    assert_int_equal(rt_variant_rounding(&device), RT_ROUNDING_DEVICE);
    device.rounds_divide_sqrt = false;
    assert_int_equal(rt_variant_rounding(&device), RT_ROUNDING_DOUBLE);
    device.has_fp64 = false;
    assert_int_equal(rt_variant_rounding(&device), RT_ROUNDING_FMA);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(options_name_what_the_scene_has),
                                       cmocka_unit_test(parts_follow_from_what_they_are_of),
                                       cmocka_unit_test(rounding_follows_the_device)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
