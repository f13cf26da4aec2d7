#include "bvh/blocks.h"

#include <stdlib.h>
#include <string.h>

#include "common/parallel.h"

/* Slots that a thread copies at a time. */
#define CHUNK ((size_t)16384)

size_t rt_blocks_slots_before(const rt_blocks *blocks, enum rt_kind kind)
{
    size_t count = 0;
    for (int k = 0; k < (int)kind; ++k)
        count += blocks->counts[k];
    return count * RT_BLOCK_PRIMITIVES;
}

size_t rt_blocks_slots(const rt_blocks *blocks)
{
    return rt_blocks_slots_before(blocks, RT_KIND_COUNT);
}

bool rt_blocks_make(rt_blocks *blocks)
{
    const size_t slots = rt_blocks_slots(blocks);
    bool good = true;
    for (int k = 0; k < RT_KIND_COUNT; ++k) {
        blocks->kinds[k] = calloc(blocks->counts[k] + 1, rt_kinds[k].block_size);
        good = good && blocks->kinds[k];
    }
    blocks->order = malloc((slots + RT_ORDER_PADDING) * sizeof *blocks->order);
    if (!good || !blocks->order)
        return false;
    memset(blocks->order, 0xff, (slots + RT_ORDER_PADDING) * sizeof *blocks->order); /* -1 */
    return true;
}

typedef struct gathering {
    const rt_scene *scene;
    rt_blocks *blocks;
} gathering;

/* From primitives of `fields` floats each to their places in blocks: slots from `begin` up to
 * `end`, whose primitives `order` has by index, of which the first is `first`. */
static inline void gather(float *blocks, const float *items, size_t fields, const int32_t *order,
                          size_t begin, size_t end, size_t first)
{
    for (size_t slot = begin; slot < end; ++slot) {
        if (order[slot] < 0)
            continue;
        const float *item = items + fields * ((size_t)order[slot] - first);
        float *place = blocks + slot / RT_BLOCK_PRIMITIVES * fields * RT_BLOCK_PRIMITIVES +
                       slot % RT_BLOCK_PRIMITIVES;
        for (size_t field = 0; field < fields; ++field)
            place[field * RT_BLOCK_PRIMITIVES] = item[field];
    }
}

/* A loop a kind, so that it knows the number of fields. */
#define GATHER_KIND(name, names, NAMES)                                                            \
    case RT_KIND_##NAMES:                                                                          \
        gather(blocks->kinds[kind], scene->kinds[kind].items, sizeof(rt_##name) / sizeof(float),   \
               order, begin, end, first);                                                          \
        break;

static void gather_kind(const rt_scene *scene, const rt_blocks *blocks, enum rt_kind kind,
                        const int32_t *order, size_t begin, size_t end)
{
    const size_t first = rt_scene_primitives_before(scene, kind);
    switch (kind) {
        RT_KINDS(GATHER_KIND)
    case RT_KIND_COUNT:
        break;
    }
}

static size_t lesser(size_t a, size_t b)
{
    return a < b ? a : b;
}

static void gather_chunk(void *context, size_t chunk)
{
    const gathering *g = context;
    size_t begin = chunk * CHUNK, end = begin + CHUNK; /* counted from the kind's first slot */
    const int32_t *order = g->blocks->order;
    for (int k = 0; k < RT_KIND_COUNT; ++k) {
        const size_t slots = g->blocks->counts[k] * RT_BLOCK_PRIMITIVES;
        gather_kind(g->scene, g->blocks, (enum rt_kind)k, order, lesser(begin, slots),
                    lesser(end, slots));
        order += slots;
        begin -= lesser(begin, slots);
        end -= lesser(end, slots);
    }
}

void rt_blocks_gather(rt_blocks *blocks, const rt_scene *scene, int threads)
{
    gathering g = {scene, blocks};
    const size_t slots = rt_blocks_slots(blocks);
    rt_parallel((slots + CHUNK - 1) / CHUNK, threads, gather_chunk, &g);
}

static size_t blocks_for(size_t primitives)
{
    return (primitives + RT_BLOCK_PRIMITIVES - 1) / RT_BLOCK_PRIMITIVES;
}

bool rt_blocks_in_order(rt_blocks *blocks, const rt_scene *scene, rt_status *status)
{
    *blocks = (rt_blocks){0};
    for (int k = 0; k < RT_KIND_COUNT; ++k)
        blocks->counts[k] = blocks_for(scene->kinds[k].count);
    if (!rt_blocks_make(blocks)) {
        rt_blocks_clear(blocks);
        return rt_status_no_memory(status, "the scene");
    }
    int32_t primitive = 0;
    for (int k = 0; k < RT_KIND_COUNT; ++k) {
        int32_t *order = blocks->order + rt_blocks_slots_before(blocks, (enum rt_kind)k);
        for (size_t i = 0; i < scene->kinds[k].count; ++i)
            order[i] = primitive++;
    }
    rt_blocks_gather(blocks, scene, 1);
    return true;
}

void rt_blocks_clear(rt_blocks *blocks)
{
    for (int k = 0; k < RT_KIND_COUNT; ++k)
        free(blocks->kinds[k]);
    free(blocks->order);
    *blocks = (rt_blocks){0};
}
