/* The files of a study, of figures that are made up. */
#define _GNU_SOURCE
#include "support/made_up.h"
#include "support/support.h"

#include <ctype.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/csv.h"
#include "study/html.h"
#include "study/judge.h"
#include "study/markdown.h"
#include "study/plot.h"
#include "study/strip.h"
#include "study/study_json.h"

static void assert_says(const char *text, const char *words)
{
    if (!strstr(text, words))
        fail_msg("'%s' is not in: %s", words, text);
}

/* What goes to `out` in a block, as text. */
#define PRINTED(text, print)                                                                       \
    do {                                                                                           \
        size_t size_ = 0;                                                                          \
        FILE *out = open_memstream(&(text), &size_);                                               \
        assert_non_null(out);                                                                      \
        print;                                                                                     \
        assert_int_equal(fclose(out), 0);                                                          \
    } while (0)

/* Fields with commas and quotes are quoted, every line has as many as the first, and ends in CRLF;
 * what was not measured is an empty field. */
static void csv(void **state)
{
    (void)state;
    rt_study study;
    char *text = NULL;
    test_make_up_study(&study, 1);
    PRINTED(text, rt_study_print_csv(&study, out));
    assert_int_equal(test_count_text(text, "\r\n"), 7);
    assert_int_equal(test_count_text(text, "\n"), 7);
    assert_int_equal(test_count_text(text, "\n\"made, up.txt\",\"a \"\"device\"\"\",100,100,"), 6);
    assert_int_equal(test_count_text(text, ",robust,16,160000,"), 1);
    assert_says(text, ",seconds_kernel_q1,seconds_kernel_median,");
    assert_says(text, ",against_converged_rms_steps,");
    const size_t columns = test_count_text(strtok(text, "\n"), ",");
    for (int i = 0; i < 6; ++i) {
        const char *line = strtok(NULL, "\n");
        assert_int_equal(test_count_text(line, ","), columns + 1); /* one is within a field */
        assert_non_null(strstr(line, ",10000,5000,0,,,,0,0,0,0,0\r"));
    }
    free(text);
    rt_study_clear(&study);
}

static void write_json(const rt_study *study, const char *path)
{
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    assert_good(rt_output_open(&output, path, &status), &status);
    assert_good(rt_study_write_json(study, &output, &status), &status);
    assert_good(rt_output_commit(&output, &status), &status);
}

/* What is read is what was written, to the byte when it is written again. */
static void json_there_and_back(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_study study, read;
    test_make_up_study(&study, 2);
    study.devices[1].lacks[RT_ACCURACY_DOUBLE] = true;
    study.devices[1].kernel_is_wall = true;
    study.devices[0].held = 0.25;
    test_cell(&study, RT_ACCURACY_ROBUST, 2)->visible = 77;
    write_json(&study, test_path("a.json"));
    assert_good(rt_study_read_json(&read, test_path("a.json"), &status), &status);
    assert_int_equal(read.entry_count, 4);
    assert_string_equal(read.devices[1].name, "a \"device\"");
    assert_true(read.devices[1].lacks[RT_ACCURACY_DOUBLE] && read.devices[1].kernel_is_wall);
    assert_int_equal(read.plan.samples[2], 16);
    assert_int_equal(read.rounds[2], 9);
    assert_true(isnan(read.entries[0].t_p50));
    assert_int_equal(test_cell(&read, RT_ACCURACY_ROBUST, 2)->visible, 77);
    assert_near(test_cell(&read, RT_ACCURACY_ROBUST, 2)->kernel.high, 0.024 * 1.01, 1e-9);
    write_json(&read, test_path("b.json"));
    char *a = test_read_file(test_path("a.json"), NULL);
    char *b = test_read_file(test_path("b.json"), NULL);
    assert_string_equal(a, b);
    free(a);
    free(b);
    rt_study_clear(&read);
    study.edges = RT_EDGES_TRACED;
    write_json(&study, test_path("a.json"));
    assert_good(rt_study_read_json(&read, test_path("a.json"), &status), &status);
    assert_int_equal(read.edges, RT_EDGES_TRACED);
    rt_study_clear(&read);
    rt_study_clear(&study);
}

static void assert_refused(const char *path, const char *words)
{
    rt_status status = RT_STATUS_INIT;
    rt_study study;
    assert_false(rt_study_read_json(&study, path, &status));
    assert_int_equal(status.code, RT_ERROR_SCENE);
    assert_says(status.text, words);
    assert_null(study.cells);
    rt_status_clear(&status);
}

/* Each member of the file, left out or of another type, is an error that names it; and so is each
 * prefix of the file, and each number made too large for what it counts. */
static void json_that_is_damaged(void **state)
{
    (void)state;
    rt_study study;
    json_error_t error;
    const char *path = test_path("damaged.json");
    test_make_up_study(&study, 1);
    write_json(&study, path);
    size_t length = 0;
    char *whole = test_read_file(path, &length);
    json_t *root = json_loads(whole, 0, &error);
    const char *key;
    json_t *value;
    json_object_foreach(root, key, value)
    {
        if (strcmp(key, "verdict") == 0)
            continue; /* for readers alone */
        json_t *less = json_deep_copy(root);
        json_object_set_new(less, key, json_real(0.5));
        assert_int_equal(json_dump_file(less, path, 0), 0);
        assert_refused(path, "this is not a report of --study");
        json_object_del(less, key);
        assert_int_equal(json_dump_file(less, path, 0), 0);
        assert_refused(path, "this is not a report of --study");
        json_decref(less);
    }
    json_t *cell = json_array_get(json_object_get(root, "pictures"), 3);
    json_object_del(cell, "visible_pixels");
    assert_int_equal(json_dump_file(root, path, 0), 0);
    assert_refused(path, "pictures: visible_pixels");
    json_t *entry = json_array_get(json_object_get(root, "same_rays"), 1);
    json_object_set_new(entry, "device", json_integer(7));
    assert_int_equal(json_dump_file(root, path, 0), 0);
    assert_refused(path, "same_rays: device");
    json_decref(root);
    for (size_t i = 0; i + 2 < length; i += 97) {
        test_write_file(path, whole, i);
        assert_refused(path, "damaged.json:");
    }
    assert_refused(test_path("missing.json"), "No such file or directory");
    free(whole);
    rt_study_clear(&study);
}

static void md(void **state)
{
    (void)state;
    rt_study study;
    char *text = NULL;
    test_make_up_study(&study, 1);
    PRINTED(text, rt_study_print_markdown(&study, "name", true, true, out));
    assert_says(text, "# What accuracy costs: made, up.txt\n\n**Take standard: ");
    assert_says(text, "](name-pictures.png)");
    assert_says(text, "](name.svg)");
    assert_true(strstr(text, "-pictures.png") < strstr(text, "name.svg"));
    assert_says(text, "\n| 16 | robust | 24 | 1.50 (1.48 to 1.52) | ");
    assert_says(text, "scalar path in double, at 64 samples");
    assert_says(text, "not applicable, the scene has no triangles.");
    assert_null(strstr(text, "does not have"));
    free(text);
    /* On a poorer device, where the scalar path takes too long. */
    study.devices[0].lacks[RT_ACCURACY_DOUBLE] = true;
    study.devices[0].kernel_is_wall = true;
    study.reference_is_scalar = false;
    study.reference_level = RT_ACCURACY_ROBUST;
    study.reference_seconds = 123.4;
    test_cell(&study, RT_ACCURACY_ROBUST, 0)->ratio = (rt_spread){0.9, 1.0, 1.2};
    test_cell(&study, RT_ACCURACY_ROBUST, 1)->ratio = (rt_spread){0.98, 1.0, 1.02};
    PRINTED(text, rt_study_print_markdown(&study, "name", false, false, out));
    assert_says(text, "This device does not have the level double.");
    assert_says(text, "would take 123 s for one sample a pixel, so the reference of the pictures "
                      "is a \"device\" at robust");
    assert_says(text, " | the reference |");
    assert_says(text, "has no clock");
    assert_says(text, "| cannot tell (0.90 to 1.20) |");
    assert_says(text, "| no measurable difference (0.98 to 1.02) |");
    assert_null(strstr(text, "!["));
    free(text);
    rt_study_clear(&study);
}

/* Nothing that a page loads: no attribute names a file or an address. */
static void assert_stands_alone(const char *page)
{
    static const char *const attributes[] = {"src", "href", "data", "poster", "action"};
    for (size_t i = 0; i < sizeof attributes / sizeof *attributes; ++i)
        for (const char *p = page; (p = strstr(p, attributes[i]));) {
            p += strlen(attributes[i]);
            const char *value = p + strspn(p, " ");
            if (*value != '=')
                continue;
            value += 1 + strspn(value + 1, " \"'");
            if (strncmp(value, "data:", 5) != 0 && *value != '#')
                fail_msg("the page loads %.40s", value);
        }
    assert_null(strstr(page, "url("));
    assert_null(strstr(page, "@import"));
    assert_null(strstr(page, "<script"));
    assert_null(strstr(page, "<link"));
}

static void html(void **state)
{
    (void)state;
    rt_study study;
    char *text = NULL;
    test_make_up_study(&study, 1);
    rt_file_text strip = {(char[]){"\x89PNG!"}, 5};
    rt_file_text plot = {(char[]){"<?xml version='1.0'?><svg><use href='#a'/></svg>"}, 48};
    free(study.scene);
    study.scene = strdup("<it's & \"so\">.txt");
    PRINTED(text, rt_study_print_html(&study, &strip, &plot, out));
    assert_stands_alone(text);
    assert_says(text, "src=\"data:image/png;base64,iVBORyE=\"");
    assert_says(text, "<figure><svg><use href='#a'/></svg></figure>");
    assert_says(text, "&lt;it's &amp; &quot;so&quot;&gt;.txt");
    assert_says(text, "<h1>Take standard: ");
    assert_null(strstr(text, "<?xml"));
    /* The pictures come first, then what is right, then the plot, then the figures. */
    const char *const order[] = {"<h1>", "<img ", "its picture right?", "<svg", ">Pictures<"};
    for (int i = 1; i < 5; ++i)
        assert_true(strstr(text, order[i - 1]) < strstr(text, order[i]));
    assert_says(text, ">64 steps and more<");
    free(text);
    PRINTED(text, rt_study_print_html(&study, &(rt_file_text){0}, &(rt_file_text){0}, out));
    assert_stands_alone(text);
    assert_says(text, "There is no plot");
    assert_says(text, "The pictures are not here");
    free(text);
    rt_study_clear(&study);
}

/* RFC 4648, section 10. */
static void base64(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {{"", ""},
                                           {"f", "Zg=="},
                                           {"fo", "Zm8="},
                                           {"foo", "Zm9v"},
                                           {"foob", "Zm9vYg=="},
                                           {"fooba", "Zm9vYmE="},
                                           {"foobar", "Zm9vYmFy"},
                                           {"\xff\xfe\xfb", "//77"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
        char *text = NULL;
        PRINTED(text, rt_print_base64(pairs[i][0], strlen(pairs[i][0]), out));
        assert_string_equal(text, pairs[i][1]);
        free(text);
    }
}

/* What has no logarithm is drawn at the tick 0; what another does as well is pale; leaks are drawn
 * where they were looked for. The title is the verdict, and the axes are words. */
static void the_plot(void **state)
{
    (void)state;
    rt_study study;
    char *text = NULL;
    test_make_up_study(&study, 1);
    test_cell(&study, RT_ACCURACY_STANDARD, 2)->visible = 200;
    rt_study_conclude(&study);
    PRINTED(text, rt_study_plot_script(&study, "a.svg", "it's.png", out));
    assert_says(text, "\nset output 'a.svg'\n");
    assert_says(text, "\nset output 'it''s.png'\n");
    assert_says(text, "set multiplot title \"Take robust: standard is visibly wrong. It "
                      "takes 50 % more time than standard.\"");
    assert_says(text, "set xlabel \"milliseconds a picture");
    assert_says(text, "set ylabel \"how far off, in steps of 256\"");
    assert_says(text, "$entry0_0 << END\n1 1 0.99 1.01 4 0\n4 4 3.96 4.04 2 0\n");
    assert_says(text, "$entry1_0 << END\n1 1.5 1.485 1.515 4 1\n");
    assert_says(text, "title 'standard: visibly wrong'");
    assert_says(text, "title 'robust: right; 50 % more time than standard'");
    assert_null(strstr(text, "closed mesh"));
    assert_null(strstr(text, "RMS"));
    free(text);
    study.edges = RT_EDGES_TRACED;
    study.entries[0].edge_rays = study.entries[1].edge_rays = 1000;
    study.entries[0].leaks = 20;
    study.entries[0].double_hits = 5;
    PRINTED(text, rt_study_plot_script(&study, "a.svg", "a.png", out));
    assert_says(text, "closed mesh");
    assert_says(text, "$entry0_1 << END\n1 1 0.99 1.01 25000 0\nEND\n");
    assert_says(text, "$entry1_1 << END\n1 1.5 1.485 1.515 1000 0\nEND\n");
    assert_says(text, "set ytics add (\"0\" 1000)");
    free(text);
    rt_study_clear(&study);
}

/* One pixel of each class of differences, in a row that is made larger and in one that is made
 * smaller, where the largest of a patch counts. */
static void the_strip(void **state)
{
    (void)state;
    static const int steps[RT_HEAT_COUNT] = {0, 1, 3, 4, 15, 16, 63, 255};
    for (int large = 0; large < 2; ++large) {
        const int grow = large ? 1 : 20, shrink = large ? 2 : 1, width = large ? 1280 : 8;
        rt_status status = RT_STATUS_INIT;
        rt_study study;
        rt_study_strip strip = {0};
        rt_image a, b, back;
        test_make_up_study(&study, 1);
        assert_good(rt_image_init(&a, width, 2, false, &status), &status);
        assert_good(rt_image_init(&b, width, 2, false, &status), &status);
        for (int i = 0; i < RT_HEAT_COUNT; ++i)
            b.rgb[3 * (i * shrink) + i % 3] = (float)steps[i] / 255.0f;
        assert_good(rt_study_strip_keep(&strip, &study, 0, &a, &status), &status);
        assert_good(rt_study_strip_keep(&strip, &study, 1, &b, &status), &status);
        rt_study_strip_draw(&strip, &study, &back, &status);
        assert_int_equal(back.width, 3 * (large ? 640 : 160) + 2 * RT_STRIP_GAP);
        assert_int_equal(back.height, large ? 1 : 40);
        for (int i = 0; i < RT_HEAT_COUNT; ++i) {
            const int x = 2 * ((large ? 640 : 160) + RT_STRIP_GAP) + i * grow;
            for (int c = 0; c < 3; ++c)
                assert_near(255 * rt_srgb_of_linear((double)back.rgb[3 * x + c]),
                            rt_heats[i].color[c], 1e-3);
        }
        assert_int_equal(rt_image_step(back.rgb[3 * (large ? 640 : 160)]), 255);
        rt_study_strip_clear(&strip);
        rt_image_clear(&a);
        rt_image_clear(&b);
        rt_image_clear(&back);
        rt_study_clear(&study);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv),
        cmocka_unit_test(json_there_and_back),
        cmocka_unit_test(json_that_is_damaged),
        cmocka_unit_test(md),
        cmocka_unit_test(html),
        cmocka_unit_test(base64),
        cmocka_unit_test(the_plot),
        cmocka_unit_test(the_strip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
