/* Scenes whose pictures are black or empty say so, each with what to add; others say nothing. */
#include "support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/check.h"

#define RED "material red kd 1 0 0\n"
#define BALL RED "sphere center 0 0 -5 radius 1 material red\n"
#define LIGHT "light point at 0 10 0\n"
#define NO_LIGHT "since there is no light: add 'ambient 0.2 0.2 0.2' or a light"

/* A cube of two triangles a side, counter-clockwise as seen from outside, from -1 to 1. */
#define CUBE(material)                                                                             \
    "triangle a -1 -1 1 b 1 -1 1 c 1 1 1 material " material "\n"                                  \
    "triangle a -1 -1 1 b 1 1 1 c -1 1 1 material " material "\n"                                  \
    "triangle a 1 -1 -1 b -1 -1 -1 c -1 1 -1 material " material "\n"                              \
    "triangle a 1 -1 -1 b -1 1 -1 c 1 1 -1 material " material "\n"                                \
    "triangle a 1 -1 1 b 1 -1 -1 c 1 1 -1 material " material "\n"                                 \
    "triangle a 1 -1 1 b 1 1 -1 c 1 1 1 material " material "\n"                                   \
    "triangle a -1 -1 -1 b -1 -1 1 c -1 1 1 material " material "\n"                               \
    "triangle a -1 -1 -1 b -1 1 1 c -1 1 -1 material " material "\n"                               \
    "triangle a -1 1 1 b 1 1 1 c 1 1 -1 material " material "\n"                                   \
    "triangle a -1 1 1 b 1 1 -1 c -1 1 -1 material " material "\n"                                 \
    "triangle a -1 -1 -1 b 1 -1 -1 c 1 -1 1 material " material "\n"                               \
    "triangle a -1 -1 -1 b 1 -1 1 c -1 -1 1 material " material "\n"

/* What is said of a scene; NULL for nothing. */
typedef struct saying {
    const char *scene, *says;
} saying;

static void assert_said(const saying *sayings, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        rt_scene s;
        rt_status status = RT_STATUS_INIT;
        int warnings = 0;
        test_scene(&s, sayings[i].scene);
        const rt_effects effects = rt_effects_of(&s);
        assert_good(rt_scene_check(&s, &effects, &warnings, &status), &status);
        const char *text = status.text ? status.text : "";
        const char *expected = sayings[i].says;
        if (warnings != (expected != NULL) || (expected && !strstr(text, expected)) ||
            test_count_text(text, "warning") != (size_t)warnings)
            fail_msg("of\n%s\nis said: %s, not: %s", sayings[i].scene, text,
                     expected ? expected : "nothing");
        rt_status_clear(&status);
        rt_scene_clear(&s);
    }
}
#define ASSERT_SAID(sayings) assert_said(sayings, sizeof(sayings) / sizeof *(sayings))

static void light_is_missed(void **state)
{
    (void)state;
    static const saying sayings[] = {
        {BALL,
         "the picture is black, " NO_LIGHT ", such as one at the eye, 'light point at 0 0 0'"},
        {BALL "camera from 0.5 -2 1e-5", "'light point at 0.5 -2 1e-05'"},
        {BALL "light point at 0 10 0 color 0 0 0", "the picture is black, " NO_LIGHT},
        {BALL "background 1 1 1", "all surfaces are black, " NO_LIGHT},
        {BALL "background 0 0 0 top 0 0 1", "all surfaces are black, " NO_LIGHT},
        {BALL LIGHT, NULL},
        {BALL "ambient 0 0 0.1", NULL},
        {BALL "fog 1 1 1 density 0.1", NULL},
        {BALL "fog 0 0 0 density 0.1", "the picture is black, " NO_LIGHT},
        /* A sky is light for what shows it. */
        {"background 1 1 1\nmaterial m reflect 1\nsphere center 0 0 -5 radius 1 material m", NULL},
        {"background 1 1 1\nmaterial m transmit 1\nsphere center 0 0 -5 radius 1 material m", NULL},
        {"background 1 1 1\nmaterial m reflect 1\n" BALL, "all surfaces are black, " NO_LIGHT},
        {"material m reflect 1\nsphere center 0 0 -5 radius 1 material m",
         "the picture is black, " NO_LIGHT},
    };
    ASSERT_SAID(sayings);
}

static void primitives_are_missed(void **state)
{
    (void)state;
    static const saying sayings[] = {
        {"", "the scene has no primitive: add one, such as 'sphere center 0 0 -5 radius 1"},
        {"background 1 1 1", "the scene has no primitive"},
        {LIGHT RED, "the scene has no primitive"},
    };
    ASSERT_SAID(sayings);
}

static void an_eye_in_a_ball(void **state)
{
    (void)state;
#define IN_BALL RED LIGHT "sphere center 0 0 -0.5 radius 1 material red\n"
#define IN_SPHERE "the camera is inside of a sphere that does not transmit (its material is at "
    static const saying sayings[] = {
        {IN_BALL, IN_SPHERE},
        {IN_BALL "ambient 1 1 1", IN_SPHERE},
        {IN_BALL "camera from 0 0 0.4999", IN_SPHERE},
        {IN_BALL "camera from 0 0 0.5", NULL},
        {LIGHT "material m transmit 0.1\nsphere center 0 0 0 radius 1 material m", NULL},
        {LIGHT "depth 0\nmaterial m transmit 0.1\nsphere center 0 0 0 radius 1 material m",
         IN_SPHERE},
        /* In glass, in a ball. */
        {IN_BALL "material m transmit 1\nsphere center 0 0 0 radius 2 material m", IN_SPHERE},
        /* Through a floor. */
        {IN_BALL "triangle a -9 0 -9 b 9 0 -9 c 0 0 9 material red", IN_SPHERE},
        /* Domes: with a lamp, with things in them. */
        {IN_BALL "light point at 0 0.5 0", NULL},
        {IN_BALL "sphere center 0 0 -1 radius 0.1 material red", NULL},
        {IN_BALL "triangle a 0 0 -1 b 0.1 0 -1 c 0 0.1 -1 material red", NULL},
        /* A size in which coordinates are scaled. */
        {RED LIGHT "sphere center 0 0 0 radius 1e-20 material red", IN_SPHERE},
    };
    ASSERT_SAID(sayings);
}

static void an_eye_in_a_mesh(void **state)
{
    (void)state;
#define IN_MESH "the camera is inside of a closed mesh that does not transmit"
    static const saying sayings[] = {
        {RED LIGHT CUBE("red"), IN_MESH},
        {RED LIGHT CUBE("red") "camera from 0.99 0.99 0.99 at 0 0 0", IN_MESH},
        {RED LIGHT CUBE("red") "camera from 1.01 0.99 0.99 at 0 0 0", NULL},
        {"material glass transmit 1\n" LIGHT CUBE("glass"), NULL},
        /* Its backs, or its fronts, are not there. */
        {RED LIGHT CUBE("red") "cull back", NULL},
        {RED LIGHT CUBE("red") "cull front", IN_MESH},
        {RED LIGHT CUBE("red") "cull back winding cw", IN_MESH},
        /* Rooms. */
        {RED LIGHT CUBE("red") "light point at 0.5 0.5 0.5", NULL},
        {RED LIGHT CUBE("red") "sphere center 0 0 -0.5 radius 0.1 material red", NULL},
        {RED LIGHT CUBE("red") "material blue kd 0 0 1\n"
                               "triangle a 0 0 -0.5 b 0.1 0 -0.5 c 0 0.1 -0.5 material blue",
         NULL},
        {RED LIGHT CUBE("red") "material blue kd 0 0 1\n"
                               "triangle a -9 -2 -9 b 9 -2 -9 c 0 -2 9 material blue",
         IN_MESH},
    };
    ASSERT_SAID(sayings);
}

static void an_open_mesh_is_no_body(void **state)
{
    (void)state;
    rt_scene s;
    rt_status status = RT_STATUS_INIT;
    int warnings = 0;
    test_scene(&s, RED LIGHT CUBE("red"));
    s.triangle_count -= 2; /* its floor: a sixth of all directions is open */
    const rt_effects effects = rt_effects_of(&s);
    assert_good(rt_scene_check(&s, &effects, &warnings, &status), &status);
    assert_int_equal(warnings, 0);
    rt_scene_clear(&s);
}

/* The place of the camera's statement, of the material's, and two warnings at once. */
static void warnings_name_places(void **state)
{
    (void)state;
    rt_scene s;
    rt_status status = RT_STATUS_INIT;
    int warnings = 0;
    const char *path = test_path("inside.txt");
    test_write_text(path, "rt 1\ncamera from 0 0 0\n\n" RED
                          "sphere center 0 0 0 radius 1 material red\n");
    test_scene_file(&s, path);
    const rt_effects effects = rt_effects_of(&s);
    assert_good(rt_scene_check(&s, &effects, &warnings, &status), &status);
    assert_int_equal(warnings, 2);
    char expected[512];
    snprintf(expected, sizeof expected, "%s: warning: the picture is black", path);
    assert_non_null(strstr(status.text, expected));
    snprintf(expected, sizeof expected, "%s:2:1: warning: the camera is inside", path);
    assert_non_null(strstr(status.text, expected));
    snprintf(expected, sizeof expected, "%s:4)", path);
    assert_non_null(strstr(status.text, expected));
    rt_status_clear(&status);
    rt_scene_clear(&s);
}

static void assert_view_is_proposed(const char *scene, const char *says)
{
    rt_scene s;
    rt_status status = RT_STATUS_INIT;
    test_scene(&s, scene);
    rt_scene_warn_of_view(&s, &status);
    if (!strstr(status.text, says))
        fail_msg("'%s' is not in: %s", says, status.text);
    rt_status_clear(&status);
    rt_scene_clear(&s);
}

static void a_view_is_proposed(void **state)
{
    (void)state;
    /* The ball about a cube of side 2 has a radius of sqrt 3, which 60 degrees hold from twice
     * that, and 90 degrees from sqrt 2 times that. */
    assert_view_is_proposed(RED "camera vfov 60\nsphere center 3 0 5 radius 1 material red\n",
                            "try 'camera from 3 0 8.464102 at 3 0 5 vfov 60'");
    assert_view_is_proposed(RED "sphere center 3 0 5 radius 1 material red\n",
                            "try 'camera from 3 0 7.44949 at 3 0 5 vfov 90'");
    assert_view_is_proposed(RED
                            "triangle a 0 0 1e-20 b 2e-20 0 1e-20 c 0 2e-20 1e-20 material red\n",
                            "at 1e-20 1e-20 1e-20 vfov 90'");
    assert_view_is_proposed(RED "cull back\nsphere center 3 0 5 radius 1 material red\n",
                            "hits a primitive that 'cull' leaves; try");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_missed),         cmocka_unit_test(primitives_are_missed),
        cmocka_unit_test(an_eye_in_a_ball),        cmocka_unit_test(an_eye_in_a_mesh),
        cmocka_unit_test(an_open_mesh_is_no_body), cmocka_unit_test(warnings_name_places),
        cmocka_unit_test(a_view_is_proposed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
