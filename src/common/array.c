#include "common/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_CAPACITY 16

bool rt_array_grow(void *array, size_t count, size_t *capacity, size_t element_size)
{
    return count < *capacity || rt_array_reserve(array, count + 1, capacity, element_size);
}

bool rt_array_reserve(void *array, size_t needed, size_t *capacity, size_t element_size)
{
    if (needed <= *capacity)
        return true;
    /* At least twice as much, so that many small steps cost no more than one each. */
    size_t grown = *capacity ? 2 * *capacity : FIRST_CAPACITY;
    if (grown < needed)
        grown = needed;
    if (grown > SIZE_MAX / element_size / 2)
        return false;
    /* Copied, because a pointer to an element type may not be read as a pointer to void. */
    void *elements;
    memcpy(&elements, array, sizeof elements);
    void *moved = realloc(elements, grown * element_size);
    if (!moved)
        return false;
    memcpy(array, &moved, sizeof moved); /* the owner has it now */
    *capacity = grown;
    /* cppcheck-suppress memleak */
    return true;
}
