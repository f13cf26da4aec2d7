/* A scene's primitives by kind (kernels/primitives/kinds.h): what holds for every kind alike. */
#ifndef RT_SCENE_PRIMITIVE_H
#define RT_SCENE_PRIMITIVE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/primitives/kinds.h"

/* The primitives of one kind, in file order. */
typedef struct rt_primitives {
    void *items;        /* owned: rt_sphere, rt_triangle, ... */
    int32_t *materials; /* owned: of each */
    size_t count, capacity;
} rt_primitives;

typedef struct rt_kind_row {
    const char *names;       /* in `--stats` and messages, such as "spheres" */
    size_t size, block_size; /* bytes of one, and of a block of them */
} rt_kind_row;

extern const rt_kind_row rt_kinds[RT_KIND_COUNT];

/* Makes room for so many more; false without memory. */
bool rt_primitives_reserve(rt_primitives *primitives, enum rt_kind kind, size_t more);
void rt_primitives_clear(rt_primitives *primitives);

/* The largest coordinate or length of all, by magnitude. */
float rt_primitives_largest(const rt_primitives *primitives, enum rt_kind kind);
/* Multiplies them all by a power of two. */
void rt_primitives_scale(rt_primitives *primitives, enum rt_kind kind, int exponent);

#endif
