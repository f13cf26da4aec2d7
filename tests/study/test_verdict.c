/* What a study concludes and says, of figures that are made up. */
#define _GNU_SOURCE
#include "support/made_up.h"
#include "support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/load.h"
#include "study/report_text.h"
#include "study/verdict.h"

static void says(const char *text, const char *words, bool whether)
{
    if ((strstr(text, words) != NULL) != whether)
        fail_msg("'%s' is %s: %s", words, whether ? "not in" : "in", text);
}

static char *all_of(const rt_study *study)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    rt_study_say_all(study, out);
    assert_int_equal(fclose(out), 0);
    return text;
}

static void assert_says(const rt_study *study, const char *words)
{
    char *text = all_of(study);
    says(text, words, true);
    free(text);
}

static void assert_headline(const rt_study *study, const char *words)
{
    char *text = rt_study_headline(study);
    assert_non_null(text);
    assert_string_equal(text, words);
    free(text);
}

#define TAKE_ROBUST "Take robust: standard is visibly wrong. It takes 50 % more time than standard."

static void is_wrong_at(rt_study *study, enum rt_accuracy level, size_t sample_index)
{
    rt_study_cell *cell = test_cell(study, level, sample_index);
    cell->visible = 200;
    cell->arithmetic.max_step = 77;
}

/* A level is wrong where more than one pixel in ten thousand is visibly off, at some count. */
static void which_is_wrong(void **state)
{
    (void)state;
    rt_study study;
    test_make_up_study(&study, 1);
    assert_headline(&study, "Take standard: you cannot see a difference between the levels, and "
                            "none takes measurably less time.");
    test_cell(&study, RT_ACCURACY_STANDARD, 1)->visible = 1; /* of 10000 pixels */
    assert_false(rt_study_is_wrong(&study, 0));
    is_wrong_at(&study, RT_ACCURACY_STANDARD, 1);
    assert_true(rt_study_is_wrong(&study, 0));
    assert_false(rt_study_is_wrong(&study, 1));
    assert_headline(&study, TAKE_ROBUST);
    assert_says(&study, "To take it: --accuracy robust, or 'accuracy robust' in the scene; where "
                        "neither names a level, it is this one.");
    assert_says(&study, "standard: visibly wrong at 4 samples a pixel (at 4: 2 % of "
                        "the pixels, the worst by 77 steps of 256).");
    is_wrong_at(&study, RT_ACCURACY_STANDARD, 2);
    assert_says(&study, "standard: visibly wrong at 4 and 16 samples a pixel (at 16:");
    is_wrong_at(&study, RT_ACCURACY_STANDARD, 0);
    assert_says(&study, "standard: visibly wrong at every count of samples (at 16:");
    assert_says(&study, "robust: right, as far as you can see. At 16 samples a pixel a picture "
                        "takes 24 ms, 50 % more time than standard (quartiles of the ratio: 1.48 "
                        "to 1.52).");
    is_wrong_at(&study, RT_ACCURACY_ROBUST, 0);
    assert_int_equal(rt_study_recommended(&study, 0), study.entry_count);
    assert_headline(&study, "standard and robust are visibly wrong, and no other was studied.");
    rt_study_clear(&study);
}

/* Of the right ones the least time; a more accurate one that takes no measurably longer is better.
 */
static void which_to_take(void **state)
{
    (void)state;
    rt_study study;
    test_make_up_study(&study, 1);
    assert_int_equal(rt_study_recommended(&study, 0), 0);
    test_cell(&study, RT_ACCURACY_ROBUST, 2)->ratio = (rt_spread){0.90, 0.91, 0.92};
    assert_int_equal(rt_study_recommended(&study, 0), 1);
    test_cell(&study, RT_ACCURACY_ROBUST, 2)->ratio = (rt_spread){0.99, 1.02, 1.03};
    assert_int_equal(rt_study_recommended(&study, 0), 1);
    assert_headline(&study, "Take robust: you cannot see a difference between the levels, and "
                            "none takes measurably less time. It takes no measurably longer than "
                            "standard.");
    assert_says(&study, "robust: right, as far as you can see. At 16 samples a pixel a picture "
                        "takes 24 ms, no measurable difference to the time of standard");
    test_cell(&study, RT_ACCURACY_ROBUST, 2)->ratio = (rt_spread){1.01, 1.02, 1.025};
    assert_int_equal(rt_study_recommended(&study, 0), 0);
    test_cell(&study, RT_ACCURACY_ROBUST, 2)->ratio = (rt_spread){2.29, 2.31, 2.33};
    assert_says(&study, "2.3 times the time of standard");
    test_cell(&study, RT_ACCURACY_ROBUST, 2)->ratio = (rt_spread){0.89, 0.90, 0.91};
    assert_says(&study, "10 % less time than standard");
    rt_study_clear(&study);
}

/* What is shown beside the least accurate level: the one to take, else the most accurate one. */
static void what_is_shown(void **state)
{
    (void)state;
    rt_study study;
    test_make_up_study(&study, 1);
    assert_int_equal(study.shown[0], RT_ACCURACY_STANDARD);
    assert_int_equal(study.shown[1], RT_ACCURACY_ROBUST);
    study.entry_count = 1;
    study.plan.sample_count = 1;
    rt_study_conclude(&study);
    assert_int_equal(study.shown[1], RT_ACCURACY_COUNT);
    assert_headline(&study, "Nothing is wrong at standard that you could see.");
    is_wrong_at(&study, RT_ACCURACY_STANDARD, 0);
    assert_headline(&study, "standard is visibly wrong, and no other was studied.");
    rt_study_clear(&study);
}

/* No verdict on times, neither in the headline nor elsewhere, but what is right and wrong is told.
 */
static void assert_doubt(rt_study *study, enum rt_doubt kind, const char *in_short,
                         const char *reason)
{
    char *wanted = NULL;
    assert_int_equal(rt_study_doubt_of(study, 0).kind, kind);
    assert_true(asprintf(&wanted,
                         "Cannot tell what the levels cost: %s. Visibly wrong: "
                         "standard; right: robust.",
                         in_short) > 0);
    assert_headline(study, wanted);
    free(wanted);
    char *text = all_of(study);
    says(text, reason, true);
    says(text, "What it costs: cannot tell.", true);
    says(text, "Take ", false);
    says(text, "more time", false);
    says(text, "less time", false);
    says(text, "no measurable", false);
    says(text, " ms", false);
    free(text);
    /* Without times the first that is right is the one to look at. */
    assert_int_equal(rt_study_recommended(study, 0), 1);
}

static void what_cannot_be_told(void **state)
{
    (void)state;
    rt_study study;
    test_make_up_study(&study, 1);
    is_wrong_at(&study, RT_ACCURACY_STANDARD, 2);
    assert_int_equal(rt_study_doubt_of(&study, 0).kind, RT_DOUBT_NONE);
    rt_study_cell *cell = test_cell(&study, RT_ACCURACY_ROBUST, 2);
    const rt_study_cell before = *cell;
    /* As a machine with two busy loops beside it gives them: "no measurable cost" would be false.
     */
    cell->ratio = (rt_spread){0.90, 1.06, 1.23};
    study.rounds[2] = 18;
    assert_doubt(&study, RT_DOUBT_UNEVEN, "the times are too uneven",
                 "After 18 rounds the time of robust is still between 0.90 and 1.23 of that of "
                 "standard in half of them");
    *cell = before;
    study.devices[0].held = 0.5;
    assert_doubt(&study, RT_DOUBT_BUSY, "other programs kept the machine busy",
                 "Other programs held the processors for 50 % of the time");
    study.devices[0].held = 0.02;
    assert_int_equal(rt_study_doubt_of(&study, 0).kind, RT_DOUBT_NONE);
    cell->kernel.median *= 0.3; /* 16 samples take 1.2 times as long as 4 */
    assert_doubt(&study, RT_DOUBT_NO_GROWTH, "the times do not grow with the work",
                 "At robust, 16 samples a pixel took 1.2 times the time of 4, for 4.0 times the "
                 "rays.");
    cell->kernel.median *= 20.0;
    assert_int_equal(rt_study_doubt_of(&study, 0).kind, RT_DOUBT_NO_GROWTH);
    *cell = before;
    study.rounds[2] = 1;
    assert_doubt(&study, RT_DOUBT_FEW, "too few repeats",
                 "Each picture was timed 1 time; to tell times apart takes at least 5.");
    test_cell(&study, RT_ACCURACY_STANDARD, 2)->visible = 0;
    assert_headline(&study, "Cannot tell what the levels cost: too few repeats. None of them is "
                            "visibly wrong.");
    rt_study_clear(&study);
}

/* Times with noise, drawn from a seed: where the noise is wide there is no verdict on them. */
static void noisy_times(void **state)
{
    (void)state;
    test_random random = {1};
    for (int width = 1; width <= 40; width += 3) {
        rt_study study;
        double ratios[18];
        test_make_up_study(&study, 1);
        for (size_t i = 0; i < 18; ++i)
            ratios[i] = 1.5 * (double)test_random_float(&random, 1.0f - 0.01f * (float)width,
                                                        1.0f + 0.01f * (float)width);
        test_cell(&study, RT_ACCURACY_ROBUST, 2)->ratio = rt_spread_of(ratios, 18);
        const enum rt_doubt doubt = rt_study_doubt_of(&study, 0).kind;
        if (width <= 4)
            assert_int_equal(doubt, RT_DOUBT_NONE);
        if (width >= 25)
            assert_int_equal(doubt, RT_DOUBT_UNEVEN);
        rt_study_clear(&study);
    }
}

/* The key of the plot says of each level whether it is right and what it costs, by one rule for
 * all: nothing "changes nothing that you can see" and is wrong where one can see it. */
static void the_key(void **state)
{
    (void)state;
    rt_study study;
    test_make_up_study(&study, 1);
    is_wrong_at(&study, RT_ACCURACY_STANDARD, 2);
    char *standard = rt_study_said(rt_study_say_briefly, &study, 0);
    char *robust = rt_study_said(rt_study_say_briefly, &study, 1);
    assert_string_equal(standard, "standard: visibly wrong");
    assert_string_equal(robust, "robust: right; 50 % more time than standard");
    free(standard);
    free(robust);
    study.rounds[2] = 2;
    robust = rt_study_said(rt_study_say_briefly, &study, 1);
    assert_string_equal(robust, "robust: right; its time: cannot tell");
    free(robust);
    rt_study_clear(&study);
}

static void two_devices(void **state)
{
    (void)state;
    rt_study study;
    test_make_up_study(&study, 2);
    is_wrong_at(&study, RT_ACCURACY_STANDARD, 2);
    free(study.devices[1].name);
    study.devices[1].name = strdup("the other");
    assert_headline(&study, TAKE_ROBUST);
    assert_says(&study, "device 0 (a \"device\") is 2 times as fast as device 1 (the other) at "
                        "robust: 24 ms a picture to 48 ms.");
    assert_says(&study, "\nrobust, device 1: right, as far as you can see.");
    rt_study_cell *cell = rt_study_cell_at(&study, 2, 3);
    cell->ratio_to_first = (rt_spread){0.249, 0.25, 0.251};
    cell->kernel.median = 0.006;
    study.sampling[0].rms = 1.0;
    rt_study_cell_at(&study, 1, 3)->kernel.median = 0.0015;
    rt_study_cell_at(&study, 0, 3)->kernel.median = 0.0004;
    assert_says(&study, "device 1 (the other) is 4 times as fast as device 0 (a \"device\") at "
                        "robust: 6 ms a picture to 24 ms.");
    cell->ratio_to_first = (rt_spread){0.99, 1.0, 1.01};
    assert_says(&study, "is as fast as");
    cell->ratio_to_first = (rt_spread){1.5, 2.0, 2.5};
    assert_says(&study, "Cannot tell which is faster, device 0 (a \"device\") or device 1 (the "
                        "other): the times are too uneven.");
    cell->ratio_to_first = (rt_spread){1.99, 2.0, 2.01};
    study.devices[1].held = 0.5;
    assert_says(&study, "Cannot tell which is faster, device 0 (a \"device\") or device 1 (the "
                        "other): other programs kept the machine busy.");
    assert_headline(&study, TAKE_ROBUST);
    rt_study_clear(&study);
}

/* Robust has no error of arithmetic; against the converged picture it is as good as standard. */
static void what_is_dominated(void **state)
{
    (void)state;
    rt_study study;
    test_make_up_study(&study, 2);
    for (size_t i = 0; i < rt_study_cell_count(&study); ++i) {
        assert_int_equal(study.cells[i].seen_is_dominated, i % 2);
        assert_int_equal(study.cells[i].arithmetic_is_dominated, false);
    }
    test_cell(&study, RT_ACCURACY_ROBUST, 1)->arithmetic.rms = 0.02;
    rt_study_conclude(&study);
    assert_true(test_cell(&study, RT_ACCURACY_ROBUST, 1)->arithmetic_is_dominated);
    assert_false(test_cell(&study, RT_ACCURACY_STANDARD, 1)->arithmetic_is_dominated);
    rt_study_clear(&study);
}

static void what_is_free(void **state)
{
    (void)state;
    assert_true(rt_study_is_free(&(rt_spread){1.0, 1.1, 1.2}));
    assert_true(rt_study_is_free(&(rt_spread){1.004, 1.1, 1.2}));
    assert_true(rt_study_is_free(&(rt_spread){1.01, 1.1, 1.2}));
    assert_true(rt_study_is_free(&(rt_spread){0.95, 0.97, 0.99}));
    assert_false(rt_study_is_free(&(rt_spread){1.01, 1.02, 1.025}));
    assert_false(rt_study_is_free(&(rt_spread){0.86, 0.9, 0.94}));
    assert_true(rt_study_is_narrow(&(rt_spread){0.96, 1.0, 1.05}));
    assert_false(rt_study_is_narrow(&(rt_spread){0.94, 1.0, 1.05}));
    assert_false(rt_study_is_narrow(&(rt_spread){NAN, NAN, NAN}));
}

/* Two processors for ten seconds. */
static void assert_held(double ran, double waited, double busy, double stolen, double held)
{
    const rt_load before = {1.0, 2.0, 30.0, 4.0, 500.0};
    const rt_load after = {1.0 + ran, 2.0 + waited, 30.0 + busy, 4.0 + stolen, 520.0};
    assert_near(rt_load_held(&before, &after), held, 1e-9);
}

static void what_others_hold(void **state)
{
    (void)state;
    assert_held(20.0, 0.0, 20.0, 0.0, 0.0);  /* alone */
    assert_held(18.0, 4.0, 18.0, 0.0, 0.0);  /* own threads wait for each other */
    assert_held(10.0, 10.0, 20.0, 0.0, 0.5); /* two busy loops beside */
    assert_held(15.0, 5.0, 20.0, 0.0, 0.25); /* one that gets half of a processor */
    assert_held(5.0, 0.0, 15.0, 0.0, 0.0);   /* others, on a processor that is not waited for */
    assert_held(18.0, 0.0, 18.0, 2.0, 0.1);  /* another machine of the same host */
    const rt_load none = {0};
    assert_near(rt_load_held(&none, &none), 0.0, 0.0);
    /* This process's own, which has run for some time; where the system tells. */
    const rt_load now = rt_load_read();
    assert_true(now.busy <= now.all && now.ran >= 0.0 && now.ran <= now.busy + 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(which_is_wrong), cmocka_unit_test(which_to_take),
        cmocka_unit_test(what_is_shown),  cmocka_unit_test(what_cannot_be_told),
        cmocka_unit_test(noisy_times),    cmocka_unit_test(the_key),
        cmocka_unit_test(two_devices),    cmocka_unit_test(what_is_dominated),
        cmocka_unit_test(what_is_free),   cmocka_unit_test(what_others_hold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
