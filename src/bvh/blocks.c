#include "bvh/blocks.h"

#include <stdlib.h>
#include <string.h>

#include "common/parallel.h"

/* Slots that a thread copies at a time. */
#define CHUNK ((size_t)16384)

size_t rt_blocks_slots(const rt_blocks *blocks)
{
    return (blocks->sphere_blocks + blocks->triangle_blocks) * RT_BLOCK_PRIMITIVES;
}

bool rt_blocks_make(rt_blocks *blocks)
{
    const size_t slots = rt_blocks_slots(blocks);
    blocks->spheres = calloc(blocks->sphere_blocks + 1, sizeof *blocks->spheres);
    blocks->triangles = calloc(blocks->triangle_blocks + 1, sizeof *blocks->triangles);
    blocks->order = malloc((slots + RT_ORDER_PADDING) * sizeof *blocks->order);
    if (!blocks->spheres || !blocks->triangles || !blocks->order)
        return false;
    memset(blocks->order, 0xff, (slots + RT_ORDER_PADDING) * sizeof *blocks->order); /* -1 */
    return true;
}

typedef struct gathering {
    const rt_scene *scene;
    rt_blocks *blocks;
} gathering;

static void gather_sphere(rt_sphere_block *block, size_t place, const rt_sphere *sphere)
{
    block->cx[place] = sphere->cx;
    block->cy[place] = sphere->cy;
    block->cz[place] = sphere->cz;
    block->radius[place] = sphere->radius;
}

static void gather_triangle(rt_triangle_block *block, size_t place, const rt_triangle *triangle)
{
    block->ax[place] = triangle->ax;
    block->ay[place] = triangle->ay;
    block->az[place] = triangle->az;
    block->bx[place] = triangle->bx;
    block->by[place] = triangle->by;
    block->bz[place] = triangle->bz;
    block->cx[place] = triangle->cx;
    block->cy[place] = triangle->cy;
    block->cz[place] = triangle->cz;
}

static void gather_chunk(void *context, size_t chunk)
{
    const gathering *g = context;
    rt_blocks *blocks = g->blocks;
    const size_t sphere_slots = blocks->sphere_blocks * RT_BLOCK_PRIMITIVES;
    const size_t slots = sphere_slots + blocks->triangle_blocks * RT_BLOCK_PRIMITIVES;
    const size_t end = (chunk + 1) * CHUNK < slots ? (chunk + 1) * CHUNK : slots;
    for (size_t i = chunk * CHUNK; i < end; ++i) {
        const int32_t primitive = blocks->order[i];
        const size_t slot = i < sphere_slots ? i : i - sphere_slots;
        const size_t block = slot / RT_BLOCK_PRIMITIVES, place = slot % RT_BLOCK_PRIMITIVES;
        if (primitive < 0)
            continue;
        if (i < sphere_slots)
            gather_sphere(&blocks->spheres[block], place, &g->scene->spheres[primitive]);
        else
            gather_triangle(&blocks->triangles[block], place,
                            &g->scene->triangles[(size_t)primitive - g->scene->sphere_count]);
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
    *blocks = (rt_blocks){.sphere_blocks = blocks_for(scene->sphere_count),
                          .triangle_blocks = blocks_for(scene->triangle_count)};
    if (!rt_blocks_make(blocks)) {
        rt_blocks_clear(blocks);
        return rt_status_no_memory(status, "the scene");
    }
    for (size_t i = 0; i < scene->sphere_count; ++i)
        blocks->order[i] = (int32_t)i;
    for (size_t i = 0; i < scene->triangle_count; ++i)
        blocks->order[blocks->sphere_blocks * RT_BLOCK_PRIMITIVES + i] =
            (int32_t)(scene->sphere_count + i);
    rt_blocks_gather(blocks, scene, 1);
    return true;
}

void rt_blocks_clear(rt_blocks *blocks)
{
    free(blocks->spheres);
    free(blocks->triangles);
    free(blocks->order);
    *blocks = (rt_blocks){0};
}
