/* How far a study is, by a clock that is made up: never back, and within a factor of 2 of the truth
 * once a tenth is done. */
#include "support/support.h"

#include <stdio.h>

#include "study/forecast.h"

/* A part as it comes: its kind and amount, what a unit takes in truth, in how many ticks. */
typedef struct part {
    enum rt_work kind;
    double amount, seconds;
    int ticks;
} part;

static double all_of(const part *parts, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += parts[i].amount * parts[i].seconds;
    return sum;
}

/* Runs through parts that have all been planned. */
static void run(rt_forecast *f, const part *parts, size_t count)
{
    const double all = all_of(parts, count);
    double now = f->start, before = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const double seconds = parts[i].amount * parts[i].seconds, began = now;
        rt_forecast_begin(f, parts[i].kind, parts[i].amount, now);
        for (int k = 0; k <= parts[i].ticks; ++k) {
            const double part_done = (double)k / parts[i].ticks;
            now = began + seconds * part_done;
            const double done = rt_forecast_done(f, part_done, now);
            assert_true(done >= before && done <= 1.0);
            before = done;
            const double passed = now - f->start;
            if (passed < 0.1 * all)
                continue;
            const double estimate = passed / done;
            if (!(estimate > 0.5 * all && estimate < 2.0 * all))
                fail_msg("after %g of %g s: %g s in all", passed, all, estimate);
        }
    }
    assert_near(before, 1.0, 1e-9);
}

static void plan(rt_forecast *f, const part *parts, size_t count)
{
    *f = (rt_forecast){.start = 1000.0, .began = 1000.0};
    for (size_t i = 0; i < count; ++i)
        rt_forecast_plan(f, parts[i].kind, parts[i].amount);
}

/* What was reckoned is right: then so is every answer. */
static void all_is_known(void **state)
{
    (void)state;
    const part parts[] = {{RT_WORK_BUILD, 8, 2.0, 8},
                          {RT_WORK_REFERENCE, 256, 0.1, 256},
                          {RT_WORK_PICTURES, 100, 0.3, 100}};
    rt_forecast f;
    plan(&f, parts, 3);
    rt_forecast_expect(&f, RT_WORK_BUILD, 2.0);
    rt_forecast_expect(&f, RT_WORK_REFERENCE, 0.1);
    rt_forecast_expect(&f, RT_WORK_PICTURES, 0.3);
    rt_forecast_begin(&f, RT_WORK_BUILD, 8.0, 1000.0);
    assert_near(rt_forecast_done(&f, 0.5, 1008.0), 8.0 / 71.6, 1e-9);
    plan(&f, parts, 3);
    rt_forecast_expect(&f, RT_WORK_REFERENCE, 0.1);
    rt_forecast_expect(&f, RT_WORK_PICTURES, 0.3);
    rt_forecast_expect(&f, RT_WORK_BUILD, 2.0);
    run(&f, parts, 3);
}

/* Programs that take long where one did not know, then pictures that do; each is learnt. */
static void what_is_learnt(void **state)
{
    (void)state;
    for (double build = 0.05; build < 30.0; build *= 3.0)
        for (double sample = 0.02; sample < 2.0; sample *= 3.0) {
            const part parts[] = {
                {RT_WORK_BUILD, 4, build, 4},         {RT_WORK_BUILD, 4, 1.2 * build, 4},
                {RT_WORK_TRY, 1, 8.0 * sample, 2},    {RT_WORK_RAYS, 1, 1.0, 4},
                {RT_WORK_REFERENCE, 256, sample, 64}, {RT_WORK_PICTURES, 50, 1.3 * sample, 36},
                {RT_WORK_PICTURES, 160, sample, 36},  {RT_WORK_PICTURES, 640, 0.8 * sample, 36}};
            rt_forecast f;
            plan(&f, parts, 8);
            rt_forecast_expect(&f, RT_WORK_BUILD, 4.0);
            rt_forecast_expect(&f, RT_WORK_TRY, 2.0);
            rt_forecast_expect(&f, RT_WORK_RAYS, 1.0);
            /* As a study's first pictures tell them. */
            rt_forecast_expect(&f, RT_WORK_REFERENCE, 1.1 * sample);
            rt_forecast_expect(&f, RT_WORK_PICTURES, 1.2 * sample);
            run(&f, parts, 8);
        }
}

/* What is dropped is not waited for; what is planned late does not bring the progress back. */
static void plans_that_change(void **state)
{
    (void)state;
    rt_forecast f = {.start = 0.0};
    rt_forecast_expect(&f, RT_WORK_PICTURES, 1.0);
    rt_forecast_plan(&f, RT_WORK_PICTURES, 10.0);
    rt_forecast_begin(&f, RT_WORK_PICTURES, 5.0, 0.0);
    assert_near(rt_forecast_done(&f, 1.0, 5.0), 0.5, 1e-9);
    rt_forecast_plan(&f, RT_WORK_PICTURES, 10.0);
    assert_near(rt_forecast_done(&f, 1.0, 5.0), 0.5, 1e-9);
    rt_forecast_begin(&f, RT_WORK_PICTURES, 10.0, 5.0);
    assert_near(rt_forecast_done(&f, 1.0, 15.0), 0.75, 1e-9);
    assert_near(rt_forecast_rate(&f, RT_WORK_PICTURES), 1.0, 1e-9);
    rt_forecast_drop(&f, RT_WORK_PICTURES, 7.0); /* more than there is */
    assert_near(rt_forecast_done(&f, 1.0, 15.0), 1.0, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_is_known),
        cmocka_unit_test(what_is_learnt),
        cmocka_unit_test(plans_that_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
