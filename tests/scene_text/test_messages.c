/* Scenes that are wrong: every error of scenes/bad/ with its exact text, and files cut anywhere. */
#define _GNU_SOURCE
#include "support/support.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_file/read.h"

/* Whether a text is as expected, where "..." at the end of a line is any rest of it: lists of what
 * there is grow with the grammar. */
static bool is_as_expected(const char *text, const char *expected)
{
    while (*expected) {
        if (strncmp(expected, "...\n", 4) == 0) {
            expected += 3;
            text += strcspn(text, "\n");
        }
        if (*text++ != *expected++)
            return false;
    }
    return *text == '\0';
}

static void every_bad_scene_has_its_message(void **state)
{
    (void)state;
    DIR *folder = opendir("scenes/bad");
    assert_non_null(folder);
    int scenes = 0, expectations = 0;
    for (const struct dirent *entry; (entry = readdir(folder));) {
        char path[600], expected_path[600];
        const char *dot = strrchr(entry->d_name, '.');
        expectations += dot && strcmp(dot, ".expected") == 0;
        if (!dot || strcmp(dot, ".txt") != 0)
            continue;
        ++scenes;
        snprintf(path, sizeof path, "scenes/bad/%s", entry->d_name);
        snprintf(expected_path, sizeof expected_path, "scenes/bad/%.*s.expected",
                 (int)(dot - entry->d_name), entry->d_name);
        char *expected = test_read_file(expected_path, NULL);
        if (!expected)
            fail_msg("%s is not there", expected_path);
        rt_status status = RT_STATUS_INIT;
        rt_scene s;
        rt_scene_init(&s);
        assert_false(rt_scene_read(&s, path, &status));
        assert_int_equal(status.code, RT_ERROR_SCENE);
        char *text = NULL;
        const size_t more = status.errors > RT_STATUS_SHOWN ? status.errors - RT_STATUS_SHOWN : 0;
        if (more)
            assert_true(asprintf(&text, "%srt: %zu more errors\n", status.text, more) > 0);
        if (!is_as_expected(text ? text : status.text, expected))
            fail_msg("%s says:\n%s", path, text ? text : status.text);
        free(text);
        free(expected);
        rt_scene_clear(&s);
        rt_status_clear(&status);
    }
    closedir(folder);
    assert_true(scenes >= 50);
    assert_int_equal(scenes, expectations);
}

static void a_missing_file(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_scene s;
    rt_scene_init(&s);
    assert_false(rt_scene_read(&s, "/nowhere/scene.txt", &status));
    assert_int_equal(status.code, RT_ERROR_SCENE);
    assert_string_equal(status.text,
                        "rt: cannot read '/nowhere/scene.txt': No such file or directory\n");
    rt_status_clear(&status);
    assert_false(rt_scene_read(&s, "scenes", &status));
    assert_string_equal(status.text, "rt: cannot read 'scenes': Is a directory\n");
    rt_status_clear(&status);
    rt_scene_clear(&s);
}

/* No truncation of a good scene crashes the parser (and the sanitizers watch). */
static void survive_every_prefix(const char *scene)
{
    size_t length = 0;
    char *text = test_read_file(scene, &length);
    assert_non_null(text);
    const char *path = test_path("prefix.txt");
    for (size_t i = 0; i < length; i += 7) {
        test_write_file(path, text, i);
        rt_status status = RT_STATUS_INIT;
        rt_scene s;
        rt_scene_init(&s);
        const bool good = rt_scene_read(&s, path, &status);
        assert_true(good == (status.code == RT_OK));
        rt_scene_clear(&s);
        rt_status_clear(&status);
    }
    free(text);
}

static void every_prefix_is_survived(void **state)
{
    (void)state;
    survive_every_prefix("scenes/icecream.txt");
    survive_every_prefix("scenes/gallery.txt"); /* its mesh and its picture are not found */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_bad_scene_has_its_message),
        cmocka_unit_test(a_missing_file),
        cmocka_unit_test(every_prefix_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
