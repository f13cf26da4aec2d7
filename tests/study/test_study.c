/* --study as a user runs it: its files, its messages, what it leaves behind. */
#define _GNU_SOURCE
#include "support/support.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char errors[8192];

/* Runs a command in which $T is the test folder and $RT the program. */
static int run(const char *command)
{
    setenv("T", test_folder(), 1);
    return test_run(command, errors, sizeof errors);
}

static void assert_says(const char *text, const char *words)
{
    if (!strstr(text, words))
        fail_msg("'%s' is not in: %s", words, text);
}

#define TINY                                                                                       \
    "$RT --study $T/tiny --study-levels fast,standard --study-samples 1,4 --study-repeats 1 "      \
    "--size 24x16 "

static void assert_files(const char *report, bool tables, bool plot)
{
    static const char *const endings[] = {"json", "csv", "md", "svg", "png"};
    for (int i = 0; i < 5; ++i) {
        char name[64];
        struct stat info;
        snprintf(name, sizeof name, "%s.%s", report, endings[i]);
        const bool exists = stat(test_path(name), &info) == 0;
        if (exists != (i < 3 ? tables : plot))
            fail_msg("%s %s", name, exists ? "is there" : "is not there");
        assert_true(!exists || info.st_size > 100);
    }
    char command[128];
    snprintf(command, sizeof command, "[ -z \"$(ls $T/%s.*.?????? 2>/dev/null)\" ]", report);
    assert_int_equal(run(command), 0);
}

static bool has_gnuplot(void)
{
    return run("command -v gnuplot >$T/which") == 0;
}

static void a_tiny_study(void **state)
{
    (void)state;
    const bool plots = has_gnuplot();
    assert_int_equal(run(TINY "scenes/icecream.txt"), 0);
    assert_files("tiny", true, plots);
    char *text = test_read_file(test_path("tiny.csv"), NULL);
    assert_int_equal(test_count_text(text, "\r\n"), 5);
    assert_int_equal(test_count_text(text, ",24,16,fast,1,"), 1);
    assert_int_equal(test_count_text(text, ",24,16,standard,4,"), 1);
    free(text);
    json_error_t error;
    json_t *root = json_load_file(test_path("tiny.json"), JSON_REJECT_DUPLICATES, &error);
    if (!root)
        fail_msg("%s", error.text);
    const json_t *level = json_array_get(json_object_get(root, "same_rays"), 1);
    assert_string_equal(json_string_value(json_object_get(level, "level")), "standard");
    assert_int_equal(json_integer_value(json_object_get(level, "rays")), 24 * 16);
    assert_true(json_integer_value(json_object_get(level, "hits")) > 10);
    assert_true(json_real_value(json_object_get(json_object_get(level, "t_error_ulp"), "p50")) <
                8.0);
    /* The cone has no lid. */
    assert_true(json_is_null(json_object_get(level, "edge_rays")));
    const json_t *cell = json_array_get(json_object_get(root, "pictures"), 1);
    assert_int_equal(json_integer_value(json_object_get(
                         json_object_get(cell, "against_same_samples"), "pixels_over_1")),
                     0);
    json_decref(root);
    text = test_read_file(test_path("tiny.md"), NULL);
    assert_says(text, "\nThe levels agree");
    assert_says(text, "not applicable, no mesh of the scene is closed");
    assert_true((strstr(text, "(tiny.svg)") != NULL) == plots);
    free(text);
}

/* A closed mesh: Moller and Trumbore's test is not watertight, which rays at edges show at once. */
static void edges(void **state)
{
    (void)state;
    assert_int_equal(run("$RT -q --study $T/mesh --study-levels standard --study-samples 1 "
                         "--study-repeats 1 --size 16x16 scenes/mesh.txt"),
                     0);
    json_error_t error;
    json_t *root = json_load_file(test_path("mesh.json"), 0, &error);
    assert_non_null(root);
    const json_t *level = json_array_get(json_object_get(root, "same_rays"), 0);
    assert_int_equal(json_integer_value(json_object_get(level, "edge_rays")), 200000);
    const json_int_t leaks = json_integer_value(json_object_get(level, "leaks"));
    const json_int_t doubles = json_integer_value(json_object_get(level, "double_hits"));
    assert_true(leaks > 200 && leaks < 100000);
    assert_true(doubles > 200 && doubles < 100000);
    json_decref(root);
}

static void without_gnuplot(void **state)
{
    (void)state;
    /* OpenCL runtimes find their linkers by PATH, so everything else stays. */
    assert_int_equal(run("mkdir $T/path && ln -sf /bin/* /usr/bin/* $T/path/ && rm -f "
                         "$T/path/gnuplot"),
                     0);
    assert_int_equal(run("rm -f $T/tiny.*; PATH=$T/path " TINY "scenes/sphere.txt"), 0);
    assert_says(errors, "there is no gnuplot; on Debian: apt-get install gnuplot-nox");
    assert_files("tiny", true, false);
    assert_int_equal(run("rm -f $T/tiny.*; PATH=$T/path " TINY "-q scenes/sphere.txt"), 0);
    assert_string_equal(errors, "");
    /* One that fails is no better. */
    assert_int_equal(run("rm -f $T/tiny.*; mkdir -p $T/bin && printf '#!/bin/sh\\nexit 3\\n' "
                         ">$T/bin/gnuplot && chmod +x $T/bin/gnuplot && PATH=$T/bin:$PATH " TINY
                         "scenes/sphere.txt"),
                     0);
    assert_says(errors, "gnuplot failed");
    assert_files("tiny", true, false);
}

static void names_with_quotes(void **state)
{
    (void)state;
    if (!has_gnuplot())
        skip();
    assert_int_equal(run("cp scenes/sphere.txt \"$T/it's_a.txt\" && $RT -q --study \"$T/it's\" "
                         "--study-levels fast --study-samples 1 --study-repeats 1 --size 8x8 "
                         "\"$T/it's_a.txt\" && [ -s \"$T/it's.png\" ]"),
                     0);
}

static void failures(void **state)
{
    (void)state;
    assert_int_equal(run("rm -f $T/tiny.*; " TINY "scenes/bad/unknown-name.txt"), 1);
    assert_int_equal(run("$RT --study $T/missing/r scenes/sphere.txt"), 4);
    assert_says(errors, "No such file or directory");
    assert_int_equal(run(TINY "--study-levels exact scenes/sphere.txt"), 2);
    assert_int_equal(run("mkdir -p $T/empty; OCL_ICD_VENDORS=$T/empty " TINY "scenes/sphere.txt"),
                     3);
    assert_files("tiny", false, false);
}

/* A study of minutes, stopped after one that is there already; nothing of it is touched. */
static void an_interrupt(void **state)
{
    (void)state;
    assert_int_equal(run(TINY "-q scenes/sphere.txt && cp $T/tiny.json $T/before.json"), 0);
    assert_int_equal(run("$RT --progress always --study $T/tiny --study-repeats 1000 "
                         "scenes/icecream.txt & pid=$!; " TEST_WAIT_FOR_PROGRESS
                         "; kill -INT $pid; wait $pid"),
                     130);
    assert_says(errors, " %, ");
    assert_says(errors, "rt: interrupted\n");
    assert_int_equal(run("cmp $T/tiny.json $T/before.json"), 0);
    assert_files("tiny", true, has_gnuplot());
    assert_int_equal(run("$RT -q --study $T/none --study-repeats 1000 scenes/icecream.txt & "
                         "pid=$!; sleep 1; kill -INT $pid; wait $pid"),
                     130);
    assert_files("none", false, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tiny_study),    cmocka_unit_test(edges),
        cmocka_unit_test(without_gnuplot), cmocka_unit_test(names_with_quotes),
        cmocka_unit_test(failures),        cmocka_unit_test(an_interrupt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
