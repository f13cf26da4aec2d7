/* --explain: the table of effects, what is measured and what is not. Times are not held against
 * anything: only what must hold whatever they are. */
#define _GNU_SOURCE
#include "support/support.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/explain.h"

#define SCENE                                                                                      \
    "image width 32 height 24 samples 2\n"                                                         \
    "light point at 5 5 5 shadow on\n"                                                             \
    "material m kd 1 1 1 checker 0 0 0 reflect 0.5\n"                                              \
    "sphere center 0 0 -3 radius 1 material m\n"                                                   \
    "sphere center 1 0 -4 radius 1 material m\n"

static char *print(const rt_explanation *e)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    rt_explain_print(e, out);
    assert_int_equal(fclose(out), 0);
    return text;
}

static void assert_line(const char *text, const char *name, const char *rest)
{
    char line[256];
    snprintf(line, sizeof line, "%-18s %s", name, rest);
    if (!strstr(text, line))
        fail_msg("'%s' is not in:\n%s", line, text);
}

static void without_cost(void **state)
{
    (void)state;
    rt_scene scene;
    char called[320];
    test_scene(&scene, SCENE);
    const rt_effects effects = rt_effects_of(&scene);
    const rt_explanation e = rt_explain(&scene, &effects);
    char *text = print(&e);
    assert_line(text, "culling", "off  not compiled\n");
    assert_line(text, "fog", "off  not compiled\n");
    static const struct {
        const char *name;
        int line;
    } on[] = {{"anti-aliasing", 2}, {"hard shadows", 3}, {"checker", 4}, {"reflection", 4}};
    for (size_t i = 0; i < 4; ++i) {
        snprintf(called, sizeof called, "on   %s:%d\n", scene.files[0], on[i].line);
        assert_line(text, on[i].name, called);
    }
    assert_non_null(strstr(text, "primitives: spheres alone; lights: 1, point alone\n"));
    assert_null(strstr(text, "milliseconds"));
    free(text);
    rt_scene_clear(&scene);
}

static void assert_ordered(const rt_spread *q)
{
    assert_true(isfinite(q->low) && isfinite(q->high));
    assert_true(q->low <= q->median && q->median <= q->high);
}

static bool count_ticks(void *context, double done)
{
    assert_true(done >= 0.0 && done <= 1.0);
    return ++*(int *)context > 0;
}

static void measured(void **state)
{
    (void)state;
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    int ticks = 0;
    const rt_watch watch = {count_ticks, &ticks};
    const rt_render_options options = {0};
    test_scene(&scene, SCENE);
    const rt_effects effects = rt_effects_of(&scene);
    rt_explanation e = rt_explain(&scene, &effects);
    const float reflect = scene.materials[0].reflect;
    assert_good(rt_explain_measure(&e, &scene, NULL, test_device(), &options, &watch, &status),
                &status);
    for (int i = 0; i < RT_EFFECT_COUNT; ++i) {
        const rt_explain_cost *c = &e.costs[i];
        assert_true(c->is_measured == e.effects.on[i]);
        if (!c->is_measured)
            continue;
        assert_ordered(&c->with);
        assert_ordered(&c->without);
        assert_ordered(&c->difference);
        assert_true(c->with.low > 0.0 && c->without.low > 0.0);
    }
    assert_true(e.costs[RT_EFFECT_HARD_SHADOWS].has_stages);
    assert_true(e.costs[RT_EFFECT_HARD_SHADOWS].stages.median > 0.0);
    assert_true(e.costs[RT_EFFECT_REFLECT].has_stages);
    assert_true(e.costs[RT_EFFECT_REFLECT].stages.median > 0.0);
    assert_false(e.costs[RT_EFFECT_CHECKER].has_stages);
    assert_true(ticks > 0);
    assert_true(scene.materials[0].reflect == reflect && scene.samples == 2); /* as it was */
    char *text = print(&e);
    assert_non_null(strstr(text, "own stages"));
    assert_non_null(strstr(text, test_device()->name));
    free(text);
    rt_scene_clear(&scene);
}

static bool stop(void *context, double done)
{
    (void)done;
    return ++*(int *)context < 3;
}

static void a_measurement_can_be_stopped(void **state)
{
    (void)state;
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    int ticks = 0;
    const rt_watch watch = {stop, &ticks};
    const rt_render_options options = {0};
    test_scene(&scene, SCENE);
    const rt_effects effects = rt_effects_of(&scene);
    rt_explanation e = rt_explain(&scene, &effects);
    assert_false(rt_explain_measure(&e, &scene, NULL, test_device(), &options, &watch, &status));
    assert_int_equal(status.code, RT_INTERRUPTED);
    rt_status_clear(&status);
    rt_scene_clear(&scene);
}

/* As a user runs it: no device is needed without measuring. */
static void the_program(void **state)
{
    (void)state;
    char errors[1024];
    setenv("T", test_folder(), 1);
    assert_int_equal(test_run("mkdir -p $T/none; OCL_ICD_VENDORS=$T/none $RT --explain --no-cost "
                              "scenes/icecream.txt >$T/table && ! grep -q ' on ' $T/table && "
                              "[ $(grep -c 'not compiled' $T/table) = 14 ]",
                              errors, sizeof errors),
                     0);
    assert_string_equal(errors, "");
    assert_int_equal(test_run("$RT -q --explain --size 32x24 --stats $T/e.json scenes/triangle.txt "
                              ">$T/table && grep -q '^culling  *on  *scenes/triangle.txt:' "
                              "$T/table",
                              errors, sizeof errors),
                     0);
    json_t *root = json_load_file(test_path("e.json"), 0, NULL);
    const json_t *effects = json_object_get(root, "effects");
    assert_int_equal(json_array_size(effects), RT_EFFECT_COUNT);
    const json_t *culling = json_array_get(effects, RT_EFFECT_CULL);
    assert_true(json_is_true(json_object_get(culling, "on")));
    assert_string_equal(json_string_value(json_object_get(culling, "file")), "scenes/triangle.txt");
    assert_true(json_is_number(json_object_get(json_object_get(culling, "cost"), "median")));
    assert_true(json_is_false(json_object_get(json_array_get(effects, RT_EFFECT_FOG), "on")));
    assert_true(json_is_string(json_object_get(root, "device")));
    json_decref(root);
    assert_int_equal(test_run("$RT --explain --no-cost --stats - scenes/icecream.txt | head -1 | "
                              "grep -qx '{'",
                              errors, sizeof errors),
                     0);
}

/* Phong alone is what a scene without effects has. */
static void effects_none(void **state)
{
    (void)state;
    char errors[1024];
    test_write_text(test_path("phong.txt"), "rt 1\nlight point at 5 5 5\nmaterial m kd 1 1 1\n"
                                            "sphere center 0 0 -3 radius 1 material m\n"
                                            "sphere center 1 0 -4 radius 1 material m\n");
    test_write_text(test_path("more.txt"), "rt 1\n" SCENE);
    assert_int_equal(test_run("$RT -q --size 32x24 $T/phong.txt $T/phong.png && "
                              "$RT -q --size 32x24 --effects none $T/more.txt $T/none.png && "
                              "$RT -q --size 32x24 $T/more.txt $T/more.png && "
                              "cmp $T/phong.png $T/none.png && ! cmp -s $T/more.png $T/none.png && "
                              "$RT --verify --size 32x24 --effects none $T/more.txt >$T/report",
                              errors, sizeof errors),
                     0);
}

int main(void)
{
    if (!getenv("RT"))
        setenv("RT", "./rt", 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_cost),
        cmocka_unit_test(measured),
        cmocka_unit_test(a_measurement_can_be_stopped),
        cmocka_unit_test(the_program),
        cmocka_unit_test(effects_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
