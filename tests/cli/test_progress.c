/* The progress line, by a clock that the tests set. */
#define _GNU_SOURCE
#include "support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/progress.h"

typedef struct told {
    rt_progress progress;
    FILE *out;
    char *text;
    size_t size;
} told;

static void begin(told *t, bool in_place)
{
    t->out = open_memstream(&t->text, &t->size);
    assert_non_null(t->out);
    rt_progress_begin(&t->progress, t->out, in_place, 100.0);
}

static void assert_told(told *t, const char *expected)
{
    assert_int_equal(fclose(t->out), 0);
    assert_string_equal(t->text, expected);
    free(t->text);
}

static void a_quick_computation_says_nothing(void **state)
{
    (void)state;
    for (int in_place = 0; in_place < 2; ++in_place) {
        told t;
        begin(&t, in_place);
        rt_progress_tell(&t.progress, 0.0, 100.0);
        rt_progress_tell(&t.progress, 0.5, 100.5);
        rt_progress_tell(&t.progress, 1.0, 100.99);
        rt_progress_clear(&t.progress);
        assert_told(&t, "");
    }
}

static void in_place_ten_times_a_second(void **state)
{
    (void)state;
    told t;
    begin(&t, true);
    rt_progress_tell(&t.progress, 0.0, 101.0);
    rt_progress_tell(&t.progress, 0.25, 101.05); /* too soon */
    rt_progress_tell(&t.progress, 0.42, 112.0);
    rt_progress_tell(&t.progress, 0.42, 112.09);
    rt_progress_clear(&t.progress);
    rt_progress_clear(&t.progress);
    assert_told(&t, "\rrt:   0 %, 0:01 gone"
                    "\rrt:  42 %, 0:12 gone, 0:16 to go"
                    "\r                                \r");
}

static void what_was_longer_is_covered(void **state)
{
    (void)state;
    told t;
    begin(&t, true);
    rt_progress_tell(&t.progress, 0.001, 140.0);
    rt_progress_tell(&t.progress, 0.5, 141.0);
    assert_told(&t, "\rrt:   0 %, 0:40 gone, 11:06:00 to go"
                    "\rrt:  50 %, 0:41 gone, 0:41 to go    ");
}

static void whole_lines_once_a_second(void **state)
{
    (void)state;
    told t;
    begin(&t, false);
    rt_progress_tell(&t.progress, 0.1, 101.0);
    rt_progress_tell(&t.progress, 0.2, 101.9); /* too soon */
    rt_progress_tell(&t.progress, 0.2, 102.0);
    rt_progress_tell(&t.progress, 1.0, 110.0);
    rt_progress_clear(&t.progress);
    assert_told(&t, "rt:  10 %, 0:01 gone, 0:09 to go\n"
                    "rt:  20 %, 0:02 gone, 0:08 to go\n"
                    "rt: 100 %, 0:10 gone, 0:00 to go\n");
}

/* Parts too small to reckon from, and clocks beyond reason, stay within the line. */
static void extremes(void **state)
{
    (void)state;
    told t;
    begin(&t, false);
    rt_progress_tell(&t.progress, 1e-300, 105.0);
    rt_progress_tell(&t.progress, 0.5, 1e300);
    assert_told(&t, "rt:   0 %, 0:05 gone, 99:59:59 to go\n"
                    "rt:  50 %, 99:59:59 gone, 99:59:59 to go\n");
}

static void none_at_all(void **state)
{
    (void)state;
    rt_progress progress;
    rt_progress_begin(&progress, NULL, true, 0.0);
    rt_progress_tell(&progress, 0.5, 50.0);
    rt_progress_clear(&progress);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_quick_computation_says_nothing),
        cmocka_unit_test(in_place_ten_times_a_second),
        cmocka_unit_test(what_was_longer_is_covered),
        cmocka_unit_test(whole_lines_once_a_second),
        cmocka_unit_test(extremes),
        cmocka_unit_test(none_at_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
