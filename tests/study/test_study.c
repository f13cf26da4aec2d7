/* --study as a user runs it: its files, its messages, what it leaves behind. */
#define _GNU_SOURCE
#include "support/support.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "study/study.h"

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

/* Behind the report's name; the plot is the last two. */
static const char *const endings[] = {".json",         ".csv", ".md", ".html",
                                      "-pictures.png", ".svg", ".png"};
#define ENDINGS 7
#define ENDINGS_WITHOUT_PLOT 5

static void assert_files(const char *report, bool figures, bool plot)
{
    for (int i = 0; i < ENDINGS; ++i) {
        char name[64];
        struct stat info;
        snprintf(name, sizeof name, "%s%s", report, endings[i]);
        const bool exists = stat(test_path(name), &info) == 0;
        if (exists != (i < ENDINGS_WITHOUT_PLOT ? figures : plot))
            fail_msg("%s %s", name, exists ? "is there" : "is not there");
        assert_true(!exists || info.st_size > 100);
    }
    char command[128];
    snprintf(command, sizeof command, "[ -z \"$(ls $T/%s*.?????? 2>/dev/null)\" ]", report);
    assert_int_equal(run(command), 0);
}

static bool has_gnuplot(void)
{
    return run("command -v gnuplot >$T/which") == 0;
}

static char *read_text(const char *name)
{
    char *text = test_read_file(test_path(name), NULL);
    assert_non_null(text);
    return text;
}

static json_t *read_json(const char *name)
{
    json_error_t error;
    json_t *root = json_load_file(test_path(name), JSON_REJECT_DUPLICATES, &error);
    if (!root)
        fail_msg("%s", error.text);
    return root;
}

/* The verdict and the names of all files are on standard output. */
static void assert_told(const char *out, const char *report, bool plot)
{
    for (int i = 0; i < (plot ? ENDINGS : ENDINGS_WITHOUT_PLOT); ++i) {
        char name[256];
        snprintf(name, sizeof name, "\n%s/%s%s ", test_folder(), report, endings[i]);
        assert_says(out, name);
    }
    assert_int_equal(test_count_text(out, ".svg"), plot);
    assert_says(out,
                "Cannot tell what the levels cost: too few repeats. None of them is visibly wrong");
    assert_says(out, "\nstandard: right, as far as you can see. What it costs: cannot tell.\n");
}

static void a_tiny_study(void **state)
{
    (void)state;
    const bool plots = has_gnuplot();
    assert_int_equal(run(TINY "scenes/icecream.txt >$T/out"), 0);
    assert_files("tiny", true, plots);
    char *text = read_text("out");
    assert_told(text, "tiny", plots);
    free(text);
    text = read_text("tiny.csv");
    assert_int_equal(test_count_text(text, "\r\n"), 5);
    assert_int_equal(test_count_text(text, ",24,16,fast,1,"), 1);
    assert_int_equal(test_count_text(text, ",24,16,standard,4,"), 1);
    free(text);
    json_t *root = read_json("tiny.json");
    const json_t *level = json_array_get(json_object_get(root, "same_rays"), 1);
    assert_string_equal(json_string_value(json_object_get(level, "level")), "standard");
    assert_int_equal(json_integer_value(json_object_get(level, "rays")), 24 * 16);
    assert_true(json_integer_value(json_object_get(level, "hits")) > 10);
    assert_true(json_real_value(json_object_get(json_object_get(level, "t_error_ulp"), "p50")) <
                8.0);
    const json_t *cell = json_array_get(json_object_get(root, "pictures"), 1);
    assert_int_equal(json_integer_value(json_object_get(
                         json_object_get(cell, "against_same_samples"), "pixels_over_1")),
                     0);
    json_decref(root);
    text = read_text("tiny.md");
    assert_says(text, "None of them is visibly wrong");
    assert_says(text, "not applicable, no mesh of the scene is closed"); /* the cone has no lid */
    assert_true((strstr(text, "(tiny.svg)") != NULL) == plots);
    assert_says(text, "(tiny-pictures.png)");
    free(text);
}

/* The page needs no file, and holds the strip and the plot. */
static void the_page(void **state)
{
    (void)state;
    assert_int_equal(run(TINY "scenes/icecream.txt >$T/out"), 0);
    char *page = read_text("tiny.html");
    assert_int_equal(test_count_text(page, "src="), 1);
    assert_says(page, "src=\"data:image/png;base64,iVBORw0KGgo");
    assert_int_equal(test_count_text(page, "href=\"http"), 0);
    assert_int_equal(test_count_text(page, "<svg"), has_gnuplot());
    assert_int_equal(test_count_text(page, "tiny."), 0);
    free(page);
}

/* rt --plot makes of the figures what the study has made, to the byte, and leaves them alone. */
static void drawn_again(void **state)
{
    (void)state;
    if (!has_gnuplot())
        skip();
    assert_int_equal(run(TINY "scenes/icecream.txt >$T/first && mkdir -p $T/kept && "
                              "mv $T/tiny.svg $T/tiny.png $T/tiny.md $T/tiny.csv $T/tiny.html "
                              "$T/kept && cp $T/tiny.json $T/tiny-pictures.png $T/kept"),
                     0);
    assert_int_equal(run("$RT --plot $T/tiny.json >$T/again"), 0);
    assert_files("tiny", true, true);
    assert_int_equal(run("for f in $T/kept/*; do [ \"${f%.png}\" = \"$f\" ] || continue; "
                         "sed 's/gnuplot_plot_[0-9]*//' $f >$T/a; sed 's/gnuplot_plot_[0-9]*//' "
                         "$T/${f##*/} >$T/b; cmp $T/a $T/b || exit 1; done"),
                     0);
    assert_int_equal(run("sed '/^[^ ]*\\.json/d; /-pictures/d; s/  */ /' $T/first >$T/a; "
                         "sed 's/  */ /' $T/again >$T/b; cmp $T/a $T/b"),
                     0);
    /* Alone, as somebody has sent them. */
    assert_int_equal(run("mkdir $T/sent && cp $T/tiny.json $T/sent && $RT --plot $T/sent/tiny.json "
                         ">$T/again && [ -s $T/sent/tiny.png ] && grep -q 'pictures are not here' "
                         "$T/sent/tiny.html && [ ! -e $T/sent/tiny-pictures.png ]"),
                     0);
    assert_int_equal(run("echo '{\"scene\": 1}' >$T/bad.json; $RT --plot $T/bad.json"), 1);
    assert_says(errors, "bad.json: error: this is not a report of --study: scene\n");
    assert_int_equal(run("echo '{' >$T/bad.json; $RT --plot $T/bad.json"), 1);
    assert_says(errors, "bad.json:2:0: error: ");
    assert_int_equal(run("mkdir -p $T/none && PATH=$T/none /bin/sh -c \"$RT --plot "
                         "$T/sent/tiny.json\""),
                     4);
    assert_says(errors, "there is no gnuplot");
}

/* PoCL has a device that works in one thread beside the usual one. */
static void two_devices(void **state)
{
    (void)state;
    const char *both = "POCL_DEVICES='pthread basic' ";
    char command[512];
    snprintf(command, sizeof command, "[ $(%s $RT --list-devices | grep -c '^[01] ') = 2 ]", both);
    if (run(command) != 0)
        skip();
    snprintf(command, sizeof command,
             "%s $RT --device 0,1 --study $T/tiny --study-levels standard --study-samples 4 "
             "--study-repeats 1 --size 24x16 scenes/sphere.txt >$T/out",
             both);
    assert_int_equal(run(command), 0);
    char *text = read_text("out");
    assert_says(text, "Cannot tell which is faster, device 0 (");
    assert_says(text, ": too few repeats.");
    assert_says(text, "\nstandard, device 1: right");
    free(text);
    json_t *root = read_json("tiny.json");
    const json_t *cells = json_object_get(root, "pictures");
    assert_int_equal(json_array_size(json_object_get(root, "devices")), 2);
    assert_int_equal(json_array_size(json_object_get(root, "same_rays")), 2);
    assert_int_equal(json_array_size(cells), 2);
    for (size_t i = 0; i < 2; ++i) {
        const json_t *cell = json_array_get(cells, i);
        const json_t *ratio = json_object_get(cell, "kernel_ratio_to_first_device");
        const double median = json_number_value(json_object_get(ratio, "median"));
        assert_int_equal(json_integer_value(json_object_get(cell, "device")), i);
        assert_true(i ? median > 0.0 : fabs(median - 1.0) < 1e-9);
    }
    json_decref(root);
    text = read_text("tiny.md");
    assert_says(text, "\nDevice 1: ");
    assert_says(text, "| standard, device 1 | ");
    free(text);
}

/* Progress never goes back, and ends near the end. */
static void progress_goes_forward(void **state)
{
    (void)state;
    assert_int_equal(run("$RT --progress always --study $T/tiny --study-levels fast,standard "
                         "--study-samples 1,4 --size 128x128 scenes/icecream.txt >$T/out"),
                     0);
    int before = 0;
    for (const char *line = errors; (line = strstr(line, "rt: ")); line += 4) {
        int percent = 0;
        if (sscanf(line, "rt: %d %%, ", &percent) != 1)
            continue;
        if (percent < before)
            fail_msg("%d %% after %d %%", percent, before);
        before = percent;
    }
}

/* Beside a busy loop a processor the times are no verdict. */
static void a_busy_machine(void **state)
{
    (void)state;
    const bool can_tell = run("[ -r /proc/self/schedstat ] && [ -r /proc/stat ]") == 0;
    if (!can_tell || !(test_device()->type & CL_DEVICE_TYPE_CPU))
        skip();
    assert_int_equal(run("loops=; for i in $(seq $(nproc)); do sh -c 'while :; do :; done' & "
                         "loops=\"$loops $!\"; done; $RT --study $T/tiny --study-levels "
                         "fast,standard --study-samples 4 --study-repeats 5 --size 256x256 "
                         "scenes/icecream.txt >$T/out; code=$?; kill $loops; exit $code"),
                     0);
    char *text = read_text("out");
    assert_says(text, "Cannot tell what the levels cost: other programs kept the machine busy. "
                      "None of them is visibly wrong.\n");
    assert_says(text, "Other programs held the processors for ");
    free(text);
}

/* A closed mesh: Moller and Trumbore's test is not watertight, which rays at edges show at once. */
static void edges(void **state)
{
    (void)state;
    assert_int_equal(run("$RT -q --study $T/mesh --study-levels standard --study-samples 1 "
                         "--study-repeats 1 --size 16x16 scenes/mesh.txt >$T/out"),
                     0);
    json_t *root = read_json("mesh.json");
    const json_t *level = json_array_get(json_object_get(root, "same_rays"), 0);
    assert_int_equal(json_integer_value(json_object_get(level, "edge_rays")), 200000);
    const json_int_t leaks = json_integer_value(json_object_get(level, "leaks"));
    const json_int_t doubles = json_integer_value(json_object_get(level, "double_hits"));
    assert_true(leaks > 200 && leaks < 100000);
    assert_true(doubles > 200 && doubles < 100000);
    json_decref(root);
}

/* It is said before the work, and the report comes without the plot. */
static void without_gnuplot(void **state)
{
    (void)state;
    /* OpenCL runtimes find their linkers by PATH, so everything else stays. */
    assert_int_equal(run("mkdir $T/path && ln -sf /bin/* /usr/bin/* $T/path/ && rm -f "
                         "$T/path/gnuplot"),
                     0);
    assert_int_equal(run("rm -f $T/tiny*; PATH=$T/path " TINY "scenes/sphere.txt >$T/out"), 0);
    assert_says(errors, "without its plot: there is no gnuplot; on Debian: apt-get install "
                        "gnuplot-nox. Afterwards 'rt --plot ");
    assert_true(strstr(errors, "gnuplot") < strstr(errors, "rt: device "));
    assert_files("tiny", true, false);
    char *text = read_text("out");
    assert_told(text, "tiny", false);
    free(text);
    assert_int_equal(run("rm -f $T/tiny*; PATH=$T/path " TINY "-q scenes/sphere.txt >$T/out"), 0);
    assert_string_equal(errors, "");
    /* One that fails is no better. */
    assert_int_equal(run("rm -f $T/tiny*; mkdir -p $T/bin && printf '#!/bin/sh\\nexit 3\\n' "
                         ">$T/bin/gnuplot && chmod +x $T/bin/gnuplot && PATH=$T/bin:$PATH " TINY
                         "scenes/sphere.txt >$T/out"),
                     0);
    assert_says(errors, "without its plot: gnuplot fails.");
    assert_true(strstr(errors, "gnuplot") < strstr(errors, "rt: device "));
    assert_files("tiny", true, false);
}

static void names_with_quotes(void **state)
{
    (void)state;
    if (!has_gnuplot())
        skip();
    assert_int_equal(run("cp scenes/sphere.txt \"$T/it's_a.txt\" && $RT -q --study \"$T/it's\" "
                         "--study-levels fast --study-samples 1 --study-repeats 1 --size 8x8 "
                         "\"$T/it's_a.txt\" >$T/out && [ -s \"$T/it's.png\" ]"),
                     0);
}

static void failures(void **state)
{
    (void)state;
    assert_int_equal(run("rm -f $T/tiny*; " TINY "scenes/bad/unknown-name.txt"), 1);
    assert_int_equal(run("$RT --study $T/missing/r scenes/sphere.txt"), 4);
    assert_says(errors, "No such file or directory");
    assert_int_equal(run(TINY "--study-levels exact scenes/sphere.txt"), 2);
    assert_int_equal(run("mkdir -p $T/empty; OCL_ICD_VENDORS=$T/empty " TINY "scenes/sphere.txt"),
                     3);
    assert_files("tiny", false, false);
}

static bool has_ticks(void *context, double done)
{
    int *left = context;
    (void)done;
    return (*left)-- > 0;
}

/* Stopped wherever it asks, a study ends as one that is interrupted, and lets go of all once. */
static void a_stop_anywhere(void **state)
{
    (void)state;
    const rt_device *device = test_device();
    const rt_study_how how = {.devices = &device, .device_count = 1};
    rt_study_plan plan = rt_study_plan_default();
    assert_true(rt_study_plan_read_levels(&plan, "standard"));
    assert_true(rt_study_plan_read_samples(&plan, "1,2"));
    plan.repeats = 1;
    rt_scene scene;
    test_scene_file(&scene, "scenes/sphere.txt");
    scene.width = scene.height = 8;
    bool has_ended = false;
    for (int ticks = 0; !has_ended; ticks += 1 + ticks / 8) {
        rt_study study;
        rt_study_strip strip = {0};
        rt_status status = RT_STATUS_INIT;
        int left = ticks;
        const rt_watch watch = {has_ticks, &left};
        has_ended = rt_study_run(&study, &strip, &scene, "sphere", &plan, &how, &watch, &status);
        assert_true(ticks < 1000 && (has_ended || status.code == RT_INTERRUPTED));
        if (has_ended)
            rt_study_clear(&study);
        rt_study_strip_clear(&strip);
        rt_status_clear(&status);
    }
    rt_scene_clear(&scene);
}

/* A study of minutes, stopped after one that is there already; nothing of it is touched. */
static void an_interrupt(void **state)
{
    (void)state;
    assert_int_equal(run(TINY "-q scenes/sphere.txt >$T/out && cp $T/tiny.json $T/before.json"), 0);
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
        cmocka_unit_test(a_tiny_study),
        cmocka_unit_test(the_page),
        cmocka_unit_test(drawn_again),
        cmocka_unit_test(two_devices),
        cmocka_unit_test(progress_goes_forward),
        cmocka_unit_test(a_busy_machine),
        cmocka_unit_test(edges),
        cmocka_unit_test(without_gnuplot),
        cmocka_unit_test(names_with_quotes),
        cmocka_unit_test(failures),
        cmocka_unit_test(a_stop_anywhere),
        cmocka_unit_test(an_interrupt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
