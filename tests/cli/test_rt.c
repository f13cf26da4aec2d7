/* The program itself, run as a user runs it: what it prints, what it leaves, and its exit codes. */
#define _GNU_SOURCE
#include "support/mutants.h"
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

static void assert_says(const char *text)
{
    if (!strstr(errors, text))
        fail_msg("'%s' is not in: %s", text, errors);
}

static void assert_exists(const char *name, bool exists)
{
    struct stat info;
    if ((stat(test_path(name), &info) == 0) != exists)
        fail_msg("%s %s", name, exists ? "is not there" : "is there");
}

static void success(void **state)
{
    (void)state;
    assert_int_equal(run("$RT scenes/icecream.txt $T/a.png --size 64x48"), 0);
    assert_says("rt: device "); /* stderr names the choice */
    assert_exists("a.png", true);
    assert_int_equal(run("$RT -q scenes/icecream.txt $T/a.hdr --size 8x8"), 0);
    assert_string_equal(errors, "");
    assert_int_equal(run("$RT --help >$T/help; $RT -h | cmp - $T/help"), 0);
    assert_int_equal(run("$RT --version >$T/version && grep -q '^rt [0-9]' $T/version"), 0);
    assert_int_equal(run("$RT --list-devices >$T/list && grep -q '^0 ' $T/list"), 0);
    assert_int_equal(run("$RT --grammar | grep -q sphere"), 0);
}

static void from_any_folder_by_pipes(void **state)
{
    (void)state;
    assert_int_equal(run("$RT -q --size 32x32 scenes/sphere.txt $T/file.png &&"
                         "$RT -q --size 32x32 - - <scenes/sphere.txt >$T/pipe.png &&"
                         "cmp $T/file.png $T/pipe.png"),
                     0);
    assert_int_equal(run("rt=$(realpath $RT) && cp scenes/sphere.txt $T/s.txt && cd $T &&"
                         "\"$rt\" -q --size 32x32 s.txt here.png && cmp here.png file.png"),
                     0);
}

/* A sky of 0.18 at one stop down: 0.09 linear, 0.3317 by sRGB's curve. */
static void pictures_for_screens_and_for_those_who_measure(void **state)
{
    (void)state;
    static const char scene[] = "rt 1\nbackground 0.18 0.18 0.18\nimage width 4 height 4";
    char text[200];
    snprintf(text, sizeof text, "%s encoding srgb exposure -1\n", scene);
    test_write_text(test_path("srgb.txt"), text);
    snprintf(text, sizeof text, "%s exposure -1\n", scene);
    test_write_text(test_path("linear.txt"), text);
    assert_int_equal(run("for s in srgb linear; do for f in tga exr png16; do"
                         " $RT -q -d scalar --format $f $T/$s.txt $T/$s.$f || exit; done; done"),
                     0);
    /* Behind a TGA's head of 18 bytes, a run of four pixels. */
    assert_int_equal(
        run("tail -c +20 $T/srgb.tga | head -c 3 | od -An -tu1 | grep -q '85 *85 *85'"), 0);
    assert_int_equal(
        run("tail -c +20 $T/linear.tga | head -c 3 | od -An -tu1 | grep -q '23 *23 *23'"), 0);
    assert_int_equal(run("cmp $T/srgb.exr $T/linear.exr"), 0);
    assert_int_equal(run("head -c 45 $T/srgb.png16 | grep -aq sRGB &&"
                         " head -c 45 $T/linear.png16 | grep -aq gAMA"),
                     0);
    /* An option is there for standard output too, and the same bytes go there. */
    assert_int_equal(run("$RT -q -d scalar --format exr $T/srgb.txt - | cmp - $T/srgb.exr"), 0);
}

/* Writes a scene of a red ball straight ahead, and more. */
static void write_ball(const char *name, const char *more)
{
    char text[400];
    snprintf(text, sizeof text,
             "rt 1\nimage width 16 height 16\nmaterial red kd 1 0 0\n"
             "sphere center 0 0 -5 radius 1 material red\n%s\n",
             more);
    test_write_text(test_path(name), text);
}

/* One warning each, on the device and on the scalar path, and none where none is wanted. */
static void black_pictures_speak(void **state)
{
    (void)state;
    static const char *const scenes[][2] = {
        {"", "the picture is black, since there is no light"},
        {"light point at 0 0 0\ncamera at 0 0 1", "nothing is in view"},
        {"light point at 0 0 0\ncamera at 0 0 1\nbackground 1 1 1 top 0 0 1", "nothing is in view"},
        {"light point at 0 0 0\ncamera from 0 0 -5 at 0 0 0", "the camera is inside of a sphere"},
        {"light point at 0 0 -50", "the picture is black, since no light reaches"},
        {"light point at 0 0 0", NULL},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i) {
        write_ball("black.txt", scenes[i][0]);
        for (int scalar = 0; scalar < 2; ++scalar) {
            assert_int_equal(run(scalar ? "$RT -d scalar $T/black.txt $T/black.png"
                                        : "$RT $T/black.txt $T/black.png"),
                             0);
            if (scenes[i][1])
                assert_says(scenes[i][1]);
            assert_int_equal(test_count_text(errors, ": warning: "), scenes[i][1] != NULL);
        }
        assert_int_equal(run("$RT -q $T/black.txt $T/black.png"), 0);
        assert_string_equal(errors, "");
    }
    /* Where hit records are there already, they are asked. */
    write_ball("black.txt", scenes[1][0]);
    assert_int_equal(run("$RT --hits $T/black.hits $T/black.txt"), 0);
    assert_says("nothing is in view");
}

static void a_bad_scene_is_1(void **state)
{
    (void)state;
    assert_int_equal(run("$RT scenes/bad/unknown-name.txt $T/bad.png"), 1);
    assert_says("scenes/bad/unknown-name.txt:3:8: error: found 'centre'");
    assert_exists("bad.png", false);
    assert_int_equal(run("$RT $T/nowhere.txt $T/bad.png"), 1);
    assert_says("No such file or directory");
    assert_int_equal(run("printf 'rt 1\\nfoo\\n' | $RT - $T/bad.png"), 1);
    assert_says("<stdin>:2:1: error: found 'foo'");
    assert_int_equal(run("$RT scenes/bad/many-errors.txt $T/bad.png"), 1);
    assert_says("rt: 5 more errors");
}

static void misuse_is_2(void **state)
{
    (void)state;
    assert_int_equal(run("$RT"), 2);
    assert_says("no scene is given");
    assert_int_equal(run("$RT scenes/sphere.txt"), 2);
    assert_int_equal(run("$RT scenes/sphere.txt $T/a.gif"), 2);
    assert_int_equal(run("$RT --lanes 5 scenes/sphere.txt $T/a.png"), 2);
}

static void no_device_is_3(void **state)
{
    (void)state;
    assert_int_equal(
        run("mkdir -p $T/empty; OCL_ICD_VENDORS=$T/empty $RT scenes/sphere.txt $T/n.png"), 3);
    assert_says("pocl-opencl-icd");
    assert_says("--device scalar");
    assert_exists("n.png", false);
    assert_int_equal(run("OCL_ICD_VENDORS=$T/empty $RT --list-devices"), 3);
    assert_int_equal(run("OCL_ICD_VENDORS=$T/empty $RT --device scalar --size 8x8 "
                         "scenes/sphere.txt $T/n.png"),
                     0);
    assert_int_equal(run("$RT --device 99 scenes/sphere.txt $T/n.png"), 3);
    assert_says("no device fits '99'");
    assert_int_equal(run("RT_DEVICE=no-such-thing $RT scenes/sphere.txt $T/n.png"), 3);
    assert_says("no device fits 'no-such-thing'");
}

static void kernels_that_do_not_build_are_3(void **state)
{
    (void)state;
    test_mutate_kernels(MUTANT_UNKNOWN_TYPE);
    assert_int_equal(run("$RT scenes/sphere.txt $T/k.png"), 3);
    test_restore_kernels();
    assert_says("the kernels do not build");
    assert_says("shade.cl:");
    assert_exists("k.png", false);
}

static void an_unwritable_output_is_4(void **state)
{
    (void)state;
    assert_int_equal(run("$RT scenes/sphere.txt $T/missing/a.png"), 4);
    assert_says("No such file or directory");
    assert_int_equal(run("$RT --size 8x8 scenes/sphere.txt - >/dev/full"), 4);
    assert_says("No space left on device");
    assert_int_equal(run("$RT --help >/dev/full"), 4);
    assert_int_equal(run("$RT --size 8x8 --stats - scenes/sphere.txt >/dev/full"), 4);
    assert_int_equal(run("printf old >$T/ro.png; chmod 444 $T/ro.png;"
                         "$RT --size 8x8 scenes/sphere.txt $T/ro.png"),
                     4);
    assert_int_equal(run("[ \"$(cat $T/ro.png)\" = old ]"), 0);
    assert_int_equal(run("printf old >$T/kept.png; $RT scenes/bad/nan.txt $T/kept.png;"
                         "[ \"$(cat $T/kept.png)\" = old ] && [ $(ls $T/kept* | wc -l) = 1 ]"),
                     0);
    /* A folder where a file should go leaves the picture, which is not at fault, undone too. */
    assert_int_equal(run("$RT --size 8x8 --hits $T scenes/sphere.txt $T/h.png"), 4);
    assert_exists("h.png", false);
}

static void a_difference_is_5(void **state)
{
    (void)state;
    assert_int_equal(run("$RT --verify scenes/icecream.txt --size 100x80 >$T/report"), 0);
    assert_int_equal(run("grep -q 'hit records that differ:  *0 of 8000' $T/report"), 0);
    test_mutate_kernels(MUTANT_DIFFUSE_DIM);
    assert_int_equal(
        run("$RT --verify scenes/icecream.txt $T/differs.png --size 100x80 >$T/report"), 5);
    test_restore_kernels();
    assert_says("differ, first at pixel");
    assert_exists("differs.png", true); /* it is what there is to look at */
    test_mutate_kernels(MUTANT_FARTHEST_HIT);
    assert_int_equal(run("$RT --verify scenes/icecream.txt --size 100x80 >$T/report"), 5);
    test_restore_kernels();
    /* Both sides are infinite: nothing differs, and nothing has been compared. */
    assert_int_equal(run("{ sed 's/^ambient .*/ambient 3e38 0 0/' scenes/icecream.txt; echo; echo "
                         "light directional direction 1 -1 -1 color 3e38 0 0; } >$T/bright.txt;"
                         "$RT --verify $T/bright.txt --size 100x80 >$T/report"),
                     5);
    assert_says("not finite, first at pixel");
}

/* What takes the scalar path minutes, and seconds with a hundred processors; a row takes no time.
 */
static void write_long_scene(void)
{
    assert_int_equal(run("sed 's/^image .*/image width 1000 height 16000 samples 64/' "
                         "scenes/icecream.txt >$T/long.txt"),
                     0);
}

static void an_interrupt_is_130(void **state)
{
    (void)state;
    /* It notices the signal at the next row. */
    write_long_scene();
    assert_int_equal(run("$RT -q --device scalar $T/long.txt $T/i.png &"
                         "pid=$!; sleep 0.5; kill -INT $pid; wait $pid"),
                     130);
    assert_exists("i.png", false);
    assert_int_equal(run("[ $(ls $T/i.png* 2>/dev/null | wc -l) = 0 ]"), 0);
}

/* What a long render says until it is interrupted: when it has told how far it is, or when it would
 * have. */
static void stop_a_long_render(const char *options, bool tells)
{
    char command[400];
    write_long_scene();
    snprintf(command, sizeof command,
             "$RT --device scalar %s $T/long.txt $T/p.png & pid=$!; %s; kill -INT $pid; wait $pid",
             options, tells ? TEST_WAIT_FOR_PROGRESS : "sleep 1.6");
    assert_int_equal(run(command), 130);
    assert_says("rt: interrupted\n");
    if (strchr(errors, '\r'))
        fail_msg("a carriage return in a file: %s", errors);
}

/* Standard error is a file here, in which no line is ever rewritten. */
static void progress_in_a_file(void **state)
{
    (void)state;
    stop_a_long_render("--progress always", true);
    assert_says(" gone, ");
    assert_says(" to go\n");
    stop_a_long_render("", false);
    assert_null(strstr(errors, " gone"));
    stop_a_long_render("-q --progress always", false);
    assert_null(strstr(errors, " gone"));
    assert_int_equal(run("$RT --progress always --size 64x64 scenes/icecream.txt $T/p.png"), 0);
    assert_null(strstr(errors, " gone"));
}

/* util-linux's script lends a terminal. The line is gone before the last message comes. */
static void progress_on_a_terminal(void **state)
{
    (void)state;
    /* Some sandboxes have no pseudo-terminals to lend. */
    if (run("script -qec true $T/typescript </dev/null >$T/which") != 0)
        skip();
    write_long_scene();
    run("script -qec \"timeout -s INT 2.5 $RT --device scalar $T/long.txt $T/t.png\" "
        "$T/typescript </dev/null >$T/which");
    char *text = test_read_file(test_path("typescript"), NULL);
    assert_non_null(text);
    const char *first = strstr(text, "\rrt: "), *last = strstr(text, "\rrt: interrupted");
    if (!first || !last || first == last || !strstr(first, " gone, ") || strstr(last, " gone"))
        fail_msg("%s", text);
    free(text);
}

/* One device named twice is one; two are there on machines that have them. */
static void several_devices(void **state)
{
    (void)state;
    assert_int_equal(run("$RT -q --size 99x61 --hits $T/1.hits scenes/icecream.txt $T/1.png &&"
                         "$RT -q --size 99x61 --tile 16 --device all --hits $T/all.hits --stats "
                         "$T/all.json scenes/icecream.txt $T/all.png"),
                     0);
    assert_int_equal(run("cmp $T/1.hits $T/all.hits && cmp $T/1.png $T/all.png"), 0);
    assert_int_equal(run("$RT --list-devices | tail -n +2 | wc -l >$T/count"), 0);
    json_error_t error;
    json_t *root = json_load_file(test_path("all.json"), 0, &error);
    const json_t *devices = json_object_get(root, "devices");
    char *count = test_read_file(test_path("count"), NULL);
    assert_int_equal(json_array_size(devices), atoi(count));
    size_t tiles = 0, rays = 0, index;
    const json_t *device;
    json_array_foreach(devices, index, device)
    {
        assert_true(json_is_string(json_object_get(device, "name")));
        assert_true(json_is_real(json_object_get(device, "seconds")));
        tiles += (size_t)json_integer_value(json_object_get(device, "tiles"));
        rays += (size_t)json_integer_value(json_object_get(device, "rays"));
    }
    assert_int_equal(tiles, 7 * 4);
    assert_int_equal(rays, 99 * 61);
    free(count);
    json_decref(root);
    assert_int_equal(run("$RT --size 8x8 --device 0,0,0 scenes/sphere.txt $T/same.png"), 0);
    assert_says("rt: device 0 ");
    assert_int_equal(run("$RT --size 8x8 --device 0,99 scenes/sphere.txt $T/same.png"), 3);
    assert_says("no device fits '99'");
    assert_int_equal(run("$RT --size 8x8 --device 0,scalar scenes/sphere.txt $T/same.png"), 2);
}

static void hit_records(void **state)
{
    (void)state;
    assert_int_equal(run("$RT -q --hits $T/device.hits --size 40x30 scenes/icecream.txt &&"
                         "$RT -q --device scalar --hits $T/scalar.hits --size 40x30 "
                         "scenes/icecream.txt && cmp $T/device.hits $T/scalar.hits"),
                     0);
    size_t length = 0;
    free(test_read_file(test_path("device.hits"), &length));
    assert_int_equal(length, 40 * 30 * 16);
}

static double number_at(const json_t *root, const char *object, const char *key)
{
    const json_t *value = json_object_get(object ? json_object_get(root, object) : root, key);
    if (!json_is_number(value))
        fail_msg("--stats has no number %s.%s", object ? object : "", key);
    return json_number_value(value);
}

static void statistics(void **state)
{
    (void)state;
    static const char *const seconds[] = {"parse",  "accel",    "program", "upload",
                                          "kernel", "readback", "encode",  "total"};
    static const char *const stages[] = {"camera", "trace", "shade", "resolve"};
    assert_int_equal(run("$RT -q --stats $T/stats.json --size 50x40 scenes/icecream.txt $T/s.png"),
                     0);
    json_error_t error;
    json_t *root = json_load_file(test_path("stats.json"), 0, &error);
    if (!root)
        fail_msg("%s", error.text);
    assert_true(json_is_string(json_object_get(root, "device")));
    assert_string_equal(json_string_value(json_object_get(root, "accuracy")), "robust");
    assert_near(number_at(root, NULL, "width"), 50, 0);
    assert_near(number_at(root, NULL, "height"), 40, 0);
    assert_true(number_at(root, NULL, "lanes") >= 1);
    assert_near(number_at(root, "primitives", "spheres"), 3, 0);
    assert_near(number_at(root, "primitives", "triangles"), 6, 0);
    assert_near(number_at(root, "rays", "primary"), 2000, 0);
    assert_near(number_at(root, "rays", "shadow"), 0, 0);
    assert_near(number_at(root, "rays", "total"), 2000, 0);
    double sum = 0.0;
    for (size_t i = 0; i < sizeof seconds / sizeof *seconds; ++i)
        sum += number_at(root, "seconds", seconds[i]);
    const double total = number_at(root, "seconds", "total");
    assert_true(total > 0.0 && sum - total <= total);
    for (size_t i = 0; i < sizeof stages / sizeof *stages; ++i)
        assert_true(number_at(root, "stages", stages[i]) >= 0.0);
    assert_int_equal(json_array_size(json_object_get(root, "effects")), 0);
    assert_int_equal(json_array_size(json_object_get(root, "devices")), 1);
    json_decref(root);
    assert_int_equal(run("$RT -q --stats - --size 8x8 scenes/triangle.txt | grep -q culling"), 0);
    assert_int_equal(run("$RT -q --device scalar --stats - --size 8x8 scenes/sphere.txt |"
                         "grep -q '\"device\": \"scalar\"'"),
                     0);
}

int main(void)
{
    if (!getenv("RT"))
        setenv("RT", "./rt", 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(success),
        cmocka_unit_test(from_any_folder_by_pipes),
        cmocka_unit_test(pictures_for_screens_and_for_those_who_measure),
        cmocka_unit_test(black_pictures_speak),
        cmocka_unit_test(a_bad_scene_is_1),
        cmocka_unit_test(misuse_is_2),
        cmocka_unit_test(no_device_is_3),
        cmocka_unit_test(kernels_that_do_not_build_are_3),
        cmocka_unit_test(an_unwritable_output_is_4),
        cmocka_unit_test(a_difference_is_5),
        cmocka_unit_test(an_interrupt_is_130),
        cmocka_unit_test(progress_in_a_file),
        cmocka_unit_test(progress_on_a_terminal),
        cmocka_unit_test(several_devices),
        cmocka_unit_test(hit_records),
        cmocka_unit_test(statistics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
