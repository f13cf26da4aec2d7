/* Messages: kept, counted, and bounded. */
#define _GNU_SOURCE
#include "support/support.h"

#include <string.h>

static void the_first_error_decides_the_code(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_status_warn(&status, "careful");
    assert_int_equal(status.code, RT_OK);
    assert_false(rt_status_fail(&status, RT_ERROR_DEVICE, "one %d", 1));
    assert_false(rt_status_fail(&status, RT_ERROR_SCENE, "two"));
    assert_int_equal(status.code, RT_ERROR_DEVICE);
    assert_int_equal(status.errors, 2);
    assert_string_equal(status.text, "careful\none 1\ntwo\n");
    rt_status_clear(&status);
    assert_int_equal(status.code, RT_OK);
    assert_null(status.text);
}

static void only_so_many_are_kept(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    for (int i = 0; i < 1000; ++i)
        rt_status_fail(&status, RT_ERROR_SCENE, "message");
    assert_int_equal(status.errors, 1000);
    assert_int_equal(strlen(status.text), RT_STATUS_SHOWN * strlen("message\n"));
    rt_status_clear(&status);
}

static void what_is_printed_is_not_printed_again(void **state)
{
    (void)state;
    char text[4096] = "";
    rt_status status = RT_STATUS_INIT;
    for (int i = 0; i < RT_STATUS_SHOWN + 3; ++i)
        rt_status_fail(&status, RT_ERROR_SCENE, "message");
    FILE *out = fmemopen(text, sizeof text, "w");
    assert_non_null(out);
    rt_status_print(&status, out);
    assert_int_equal(fclose(out), 0);
    assert_string_equal(text + RT_STATUS_SHOWN * strlen("message\n"), "rt: 3 more errors\n");
    assert_string_equal(status.text, "");
    assert_int_equal(status.code, RT_ERROR_SCENE);
    rt_status_clear(&status);
}

static void long_messages_are_whole(void **state)
{
    (void)state;
    char text[5000];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    rt_status status = RT_STATUS_INIT;
    rt_status_fail(&status, RT_ERROR_SCENE, "%s", text);
    assert_int_equal(status.length, sizeof text);
    assert_int_equal(status.text[sizeof text - 1], '\n');
    rt_status_clear(&status);
}

static void control_characters_are_not_passed_on(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_status_fail(&status, RT_ERROR_SCENE, "a\x1b[2Jb\rc\td\x7f");
    assert_string_equal(status.text, "a?[2Jb?c\td?\n");
    rt_status_clear(&status);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_error_decides_the_code),
        cmocka_unit_test(only_so_many_are_kept),
        cmocka_unit_test(what_is_printed_is_not_printed_again),
        cmocka_unit_test(long_messages_are_whole),
        cmocka_unit_test(control_characters_are_not_passed_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
