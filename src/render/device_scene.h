/* A scene's arrays in a device's memory. */
#ifndef RT_RENDER_DEVICE_SCENE_H
#define RT_RENDER_DEVICE_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "bvh/bvh.h"
#include "common/status.h"
#include "opencl/cl.h"
#include "scene/effects.h"
#include "scene/scene.h"

typedef struct rt_device_scene {
    cl_mem nodes, order, blocks[RT_KIND_COUNT]; /* the tree and its leaves' blocks */
    cl_mem materials_of, materials, lights;     /* the first by primitive */
    cl_mem media_of, media; /* where light is refracted; the first by material */
    rt_nesting nesting;
    cl_mem normals_of, normals;           /* where normals are smooth; by triangle */
    cl_mem uvs_of, uvs, textures, texels; /* where there are textures; the first by triangle */
    cl_int counts[RT_KIND_COUNT], block_counts[RT_KIND_COUNT];
} rt_device_scene;

/* Uploads all that the effects have use for; without a tree the blocks are in the scene's own
 * order. On failure, too, the caller releases what there is. */
bool rt_device_scene_upload(rt_device_scene *target, cl_context context, cl_command_queue queue,
                            const rt_scene *scene, const rt_bvh *bvh, const rt_effects *effects,
                            rt_status *status);
void rt_device_scene_release(rt_device_scene *target);

/* A buffer that holds at least one byte, since OpenCL has no empty ones. */
bool rt_buffer_make(cl_context context, cl_mem_flags flags, size_t size, cl_mem *buffer,
                    rt_status *status);

#endif
