#include "study/plan.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/number.h"

rt_study_plan rt_study_plan_default(void)
{
    return (rt_study_plan){{true, true, true, true}, {1, 4, 16, 64}, 4, 9};
}

bool rt_study_plan_read_levels(rt_study_plan *plan, const char *text)
{
    bool levels[RT_ACCURACY_COUNT] = {false};
    for (const char *next = text; next;) {
        char name[16];
        enum rt_accuracy level;
        const size_t length = strcspn(next, ",");
        if (length >= sizeof name)
            return false;
        memcpy(name, next, length);
        name[length] = '\0';
        if (!rt_accuracy_of_name(name, &level))
            return false;
        levels[level] = true;
        next = next[length] ? next + length + 1 : NULL;
    }
    memcpy(plan->levels, levels, sizeof levels);
    return true;
}

static int compare_ints(const void *a, const void *b)
{
    const int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

bool rt_study_plan_read_samples(rt_study_plan *plan, const char *text)
{
    int samples[RT_STUDY_SAMPLES_LISTED] = {0};
    size_t count = 0;
    for (const char *next = text; next;) {
        int64_t value = 0;
        const size_t length = strcspn(next, ",");
        if (count == RT_STUDY_SAMPLES_LISTED ||
            rt_number_int(next, length, &value) != RT_NUMBER_OK || value < 1 ||
            value > RT_SAMPLES_MAX)
            return false;
        samples[count++] = (int)value;
        next = next[length] ? next + length + 1 : NULL;
    }
    qsort(samples, count, sizeof *samples, compare_ints);
    plan->sample_count = 0;
    for (size_t i = 0; i < count; ++i)
        if (i == 0 || samples[i] != samples[i - 1])
            plan->samples[plan->sample_count++] = samples[i];
    return true;
}
