#include "scene/primitive.h"

#include <math.h>
#include <stdlib.h>

#include "common/array.h"

#define ROW(name, names, NAMES) {#names, sizeof(rt_##name), sizeof(rt_##name##_block)},
const rt_kind_row rt_kinds[RT_KIND_COUNT] = {RT_KINDS(ROW)};

/* Every field is a float, and there is nothing else. */
#define ONE_FLOAT(field) +sizeof(float)
#define IS_FLOATS(name, names, NAMES)                                                              \
    _Static_assert(sizeof(rt_##name) == 0 RT_FIELDS_##name(ONE_FLOAT), "floats side by side");
RT_KINDS(IS_FLOATS)

bool rt_primitives_reserve(rt_primitives *p, enum rt_kind kind, size_t more)
{
    /* Two arrays grow in step: the capacity moves once both have. */
    size_t capacity = p->capacity;
    if (!rt_array_reserve(&p->items, p->count + more, &capacity, rt_kinds[kind].size))
        return false;
    capacity = p->capacity;
    if (!rt_array_reserve(&p->materials, p->count + more, &capacity, sizeof *p->materials))
        return false;
    p->capacity = capacity;
    return true;
}

void rt_primitives_clear(rt_primitives *p)
{
    free(p->items);
    free(p->materials);
    *p = (rt_primitives){0};
}

float rt_primitives_largest(const rt_primitives *p, enum rt_kind kind)
{
    const float *values = p->items;
    const size_t count = p->count * rt_kinds[kind].size / sizeof *values;
    float most = 0.0f;
    for (size_t i = 0; i < count; ++i)
        most = fmaxf(most, fabsf(values[i]));
    return most;
}

void rt_primitives_scale(rt_primitives *p, enum rt_kind kind, int exponent)
{
    float *values = p->items;
    const size_t count = p->count * rt_kinds[kind].size / sizeof *values;
    for (size_t i = 0; i < count; ++i)
        values[i] = ldexpf(values[i], exponent);
}
