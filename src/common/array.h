/* Growing arrays: a pointer, a count and a capacity kept by their owner. */
#ifndef RT_COMMON_ARRAY_H
#define RT_COMMON_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/* Makes room for at least one element more than `count`. `array` points to the pointer to the first
 * element; it and *capacity move together. Returns false, with both as they were, when there is no
 * memory. */
bool rt_array_grow(void *array, size_t count, size_t *capacity, size_t element_size);

/* Likewise for `needed` elements in all. */
bool rt_array_reserve(void *array, size_t needed, size_t *capacity, size_t element_size);

#define RT_ARRAY_GROW(array, count, capacity)                                                      \
    rt_array_grow(&(array), count, capacity, sizeof *(array))

#endif
