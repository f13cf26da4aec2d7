#include "common/accuracy.h"

#include <string.h>

static const char *const names[RT_ACCURACY_COUNT] = {"fast", "standard", "robust", "double"};

const char *rt_accuracy_name(enum rt_accuracy level)
{
    return names[level];
}

bool rt_accuracy_of_name(const char *name, enum rt_accuracy *level)
{
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i)
        if (strcmp(name, names[i]) == 0) {
            *level = (enum rt_accuracy)i;
            return true;
        }
    return false;
}
