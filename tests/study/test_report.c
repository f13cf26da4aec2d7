/* What a study says and writes, of figures that are made up. */
#define _GNU_SOURCE
#include "support/support.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/plot.h"
#include "study/report.h"
#include "study/table.h"
#include "study/verdict.h"

static void assert_says(const char *text, const char *words)
{
    if (!strstr(text, words))
        fail_msg("'%s' is not in: %s", words, text);
}

/* A study of standard and robust at 1, 4 and 16 samples, as somebody might have measured it: too
 * few samples put 1000 pixels off, then 500, then 100. */
static void make_up(rt_study *study, rt_study_cell cells[6])
{
    static const rt_device device = {
        .name = "a \"device\"", .platform_name = "platform", .driver = "1"};
    static const size_t off[] = {1000, 500, 100};
    *study = (rt_study){.scene = "made, up.txt",
                        .device = &device,
                        .width = 100,
                        .height = 100,
                        .plan = {{false, true, true, false}, {1, 4, 16}, 3, 9},
                        .base = RT_ACCURACY_STANDARD,
                        .reference_is_scalar = true,
                        .reference_level = RT_ACCURACY_DOUBLE,
                        .converged_samples = 64,
                        .level_count = 2,
                        .cells = cells,
                        .cell_count = 6,
                        .no_edges = "the scene has no triangles"};
    for (size_t i = 0; i < 6; ++i) {
        const double ms = 1e-3 * study->plan.samples[i / 2] * (i % 2 ? 1.5 : 1.0);
        const double ratio = i % 2 ? 1.5 : 1.0;
        cells[i] = (rt_study_cell){.level = i % 2 ? RT_ACCURACY_ROBUST : RT_ACCURACY_STANDARD,
                                   .samples = study->plan.samples[i / 2],
                                   .kernel = {0.99 * ms, ms, 1.01 * ms},
                                   .ratio = {0.99 * ratio, ratio, 1.01 * ratio},
                                   .seen = {.over_1 = off[i / 2], .rms = 4.0 / (double)(1 + i / 2)},
                                   .arithmetic = {.rms = i % 2 ? 0.0 : 0.01}};
        study->sampling[i / 2] = (rt_study_error){.over_1 = off[i / 2], .rms = 4.0};
    }
    for (size_t i = 0; i < 2; ++i)
        study->levels[i] = (rt_study_level){.level = i ? RT_ACCURACY_ROBUST : RT_ACCURACY_STANDARD,
                                            .rays = 10000,
                                            .t_p50 = NAN,
                                            .t_p99 = NAN,
                                            .t_max = NAN};
}

/* The verdict where robust changes so many pixels at 1, 4 and 16 samples. */
static void assert_verdict(size_t at_1, size_t at_4, size_t at_16, const char *words)
{
    rt_study study;
    rt_study_cell cells[6];
    make_up(&study, cells);
    cells[1].changed = at_1;
    cells[3].changed = at_4;
    cells[5].changed = at_16;
    char *text = rt_study_verdict(&study);
    assert_non_null(text);
    assert_says(text, words);
    assert_true((strstr(text, "The levels agree") != NULL) ==
                (at_1 <= 10 && at_4 <= 5 && at_16 <= 1));
    free(text);
}

static void what_a_level_buys(void **state)
{
    (void)state;
    assert_verdict(0, 0, 0, "Up to 16 samples a pixel, robust changes nothing that you can see");
    assert_verdict(10, 5, 1, "Up to 16 samples a pixel, robust changes nothing that you can see");
    assert_verdict(10, 5, 2,
                   "Below 16 samples a pixel, robust changes nothing that you can see on "
                   "this scene; from 16 on it does (at 16: 2 of 10000 pixels");
    assert_verdict(10, 6, 2, "Below 4 samples a pixel, robust changes nothing that you can see");
    assert_verdict(11, 6, 2, "At every count of samples, robust changes what you see");
    assert_verdict(11, 5, 1,
                   "From 4 samples a pixel on, robust changes nothing that you can see on "
                   "this scene; below it does (at 1: 11 of 10000 pixels");
    assert_verdict(10, 6, 1,
                   "At 1 and 16 samples a pixel, robust changes nothing that you can see "
                   "on this scene; at 4 it does (at 4: 6 of");
}

static void what_a_level_costs(void **state)
{
    (void)state;
    rt_study study;
    rt_study_cell cells[6];
    make_up(&study, cells);
    char *text = rt_study_verdict(&study);
    assert_says(text, "It takes 1.50 times the kernel time of standard, quartiles 1.48 to 1.52.");
    free(text);
    /* 1 is between the quartiles, or just one of them. */
    cells[5].ratio = (rt_spread){0.98, 1.02, 1.05};
    text = rt_study_verdict(&study);
    assert_says(text, "Against standard it has no measurable cost: 1.02 of its kernel time, "
                      "quartiles 0.98 to 1.05.");
    free(text);
    assert_true(rt_study_is_free(&(rt_spread){1.0, 1.1, 1.2}));
    assert_true(rt_study_is_free(&(rt_spread){1.004, 1.1, 1.2}));
    assert_false(rt_study_is_free(&(rt_spread){1.01, 1.1, 1.2}));
    assert_false(rt_study_is_free(&(rt_spread){0.8, 0.9, 0.99}));
    study.kernel_is_wall = true;
    cells[5].ratio = (rt_spread){1.1, 1.2, 1.3};
    text = rt_study_verdict(&study);
    assert_says(text, "It takes 1.20 times the time of standard");
    free(text);
}

/* By arithmetic; robust is exact unless said otherwise. */
static void what_goes_wrong(void **state)
{
    (void)state;
    rt_study study;
    rt_study_cell cells[6];
    make_up(&study, cells);
    char *text = rt_study_verdict(&study);
    assert_says(text, "The levels agree: this scene has no case so hard that one could see a "
                      "difference. No level studied puts pixels off by arithmetic where you could "
                      "see it; standard takes the least time.\n");
    free(text);
    cells[4].arithmetic.over_1 = 1; /* hidden by 100 that too few samples put off */
    text = rt_study_verdict(&study);
    assert_says(text, "The levels agree");
    free(text);
    cells[4].arithmetic.over_1 = 2;
    text = rt_study_verdict(&study);
    assert_null(strstr(text, "The levels agree"));
    assert_says(text, "standard puts pixels off by arithmetic where you can see it; of the others, "
                      "robust takes the least time.\n");
    free(text);
    cells[1].arithmetic.over_1 = 11;
    text = rt_study_verdict(&study);
    assert_says(text, "standard and robust put pixels off by arithmetic where you can see it, and "
                      "no other was studied.\n");
    free(text);
    cells[0] = cells[1];
    study.level_count = study.plan.sample_count = 1;
    text = rt_study_verdict(&study);
    assert_string_equal(text, "standard puts pixels off by arithmetic where you can see it, and no "
                              "other was studied.\n");
    free(text);
    cells[0].arithmetic.over_1 = 0;
    text = rt_study_verdict(&study);
    assert_string_equal(text, "No level studied puts pixels off by arithmetic where you could see "
                              "it.\n");
    free(text);
}

/* Robust has no error of arithmetic; against the converged picture it is as good as standard. */
static void what_is_dominated(void **state)
{
    (void)state;
    rt_study study;
    rt_study_cell cells[6];
    make_up(&study, cells);
    rt_study_conclude(&study);
    for (size_t i = 0; i < 6; ++i) {
        assert_int_equal(cells[i].seen_is_dominated, i % 2);
        assert_int_equal(cells[i].arithmetic_is_dominated, false);
    }
    cells[3].arithmetic.rms = 0.02;
    rt_study_conclude(&study);
    assert_true(cells[3].arithmetic_is_dominated);
    assert_false(cells[2].arithmetic_is_dominated);
}

static char *written(bool (*write)(const rt_study *, rt_output *, rt_status *),
                     const rt_study *study)
{
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    assert_good(rt_output_open(&output, test_path("made-up"), &status), &status);
    assert_good(write(study, &output, &status), &status);
    assert_good(rt_output_commit(&output, &status), &status);
    return test_read_file(test_path("made-up"), NULL);
}

/* Fields with commas and quotes are quoted, every line has as many as the first, and ends in CRLF;
 * what was not measured is an empty field. */
static void csv(void **state)
{
    (void)state;
    rt_study study;
    rt_study_cell cells[6];
    make_up(&study, cells);
    char *text = written(rt_study_write_csv, &study);
    assert_int_equal(test_count_text(text, "\r\n"), 7);
    assert_int_equal(test_count_text(text, "\n"), 7);
    assert_int_equal(test_count_text(text, "\n\"made, up.txt\",\"a \"\"device\"\"\",100,100,"), 6);
    assert_int_equal(test_count_text(text, ",robust,16,"), 1);
    const size_t columns = test_count_text(strtok(text, "\n"), ",");
    for (int i = 0; i < 6; ++i) {
        const char *line = strtok(NULL, "\n");
        assert_int_equal(test_count_text(line, ","), columns + 1); /* one is within a field */
        assert_non_null(strstr(line, ",10000,0,0,,,,0,0,,,\r"));
    }
    free(text);
}

static void json(void **state)
{
    (void)state;
    rt_study study;
    rt_study_cell cells[6];
    make_up(&study, cells);
    char *text = written(rt_study_write_json, &study);
    json_error_t error;
    json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    if (!root)
        fail_msg("%s", error.text);
    assert_int_equal(json_array_size(json_object_get(root, "pictures")), 6);
    assert_int_equal(json_array_size(json_object_get(root, "same_rays")), 2);
    const json_t *level = json_array_get(json_object_get(root, "same_rays"), 0);
    assert_true(json_is_null(json_object_get(level, "leaks")));
    assert_true(json_is_null(json_object_get(json_object_get(level, "t_error_ulp"), "p50")));
    json_decref(root);
    free(text);
}

static bool write_md(const rt_study *study, rt_output *output, rt_status *status)
{
    return rt_study_write_md(study, NULL, output, status);
}

static void md(void **state)
{
    (void)state;
    rt_study study;
    rt_study_cell cells[6];
    make_up(&study, cells);
    char *text = written(write_md, &study);
    assert_says(text, "\n| 16 | robust | 24 | 1.50 (1.48 to 1.52) | ");
    assert_says(text, "scalar path in double, at 64 samples");
    assert_says(text, "not applicable, the scene has no triangles.");
    assert_null(strstr(text, "does not have"));
    assert_null(strstr(text, "!["));
    free(text);
    /* On a poorer device, where the scalar path takes too long. */
    study.lacks[RT_ACCURACY_DOUBLE] = true;
    study.reference_is_scalar = false;
    study.reference_level = RT_ACCURACY_ROBUST;
    study.reference_seconds = 123.4;
    study.kernel_is_wall = true;
    text = written(write_md, &study);
    assert_says(text, "This device does not have the level double.");
    assert_says(text,
                "would take 123 s for one sample a pixel, so the reference of the pictures is "
                "the device at robust");
    assert_says(text, " | the reference | | |\n");
    assert_says(text, "This device has no clock");
    free(text);
}

static char *script_of(const rt_study *study)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    rt_study_plot_script(study, "a.svg", "it's.png", out);
    assert_int_equal(fclose(out), 0);
    return text;
}

/* What has no logarithm is drawn at the tick 0; what another does as well is grey; leaks are drawn
 * where they were looked for. */
static void the_plot(void **state)
{
    (void)state;
    rt_study study;
    rt_study_cell cells[6];
    make_up(&study, cells);
    rt_study_conclude(&study);
    char *text = script_of(&study);
    assert_says(text, "\nset output 'a.svg'\n");
    assert_says(text, "\nset output 'it''s.png'\n");
    assert_says(text, "$standard_0 << END\n1 1 0.99 1.01 4 0\n4 4 3.96 4.04 2 0\n");
    assert_says(text, "$robust_0 << END\n1 1.5 1.485 1.515 4 1\n");
    assert_says(text, "$robust_1 << END\n1 1.5 1.485 1.515 0.001 0\n");
    assert_says(text, "set ytics add (\"0\" 0.001)");
    assert_says(text, "\"robust: changes nothing that you can see up to 16 samples; 1.50 times the "
                      "time of standard\"");
    assert_null(strstr(text, "closed mesh"));
    free(text);
    study.no_edges = NULL;
    study.levels[0].edge_rays = study.levels[1].edge_rays = 1000;
    study.levels[0].leaks = 20;
    study.levels[0].double_hits = 5;
    study.reference_is_scalar = false;
    study.reference_level = RT_ACCURACY_ROBUST;
    text = script_of(&study);
    assert_says(text, "closed mesh");
    assert_says(text, "$standard_2 << END\n1 1 0.99 1.01 25000 0\nEND\n");
    assert_says(text, "$robust_2 << END\n1 1.5 1.485 1.515 1000 0\nEND\n");
    assert_says(text, "$robust_1 << END\n1 1.5 1.485 1.515 nan 0\n");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_level_buys),
        cmocka_unit_test(what_a_level_costs),
        cmocka_unit_test(what_is_dominated),
        cmocka_unit_test(what_goes_wrong),
        cmocka_unit_test(csv),
        cmocka_unit_test(json),
        cmocka_unit_test(md),
        cmocka_unit_test(the_plot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
