#include "render/device_scene.h"

#include "scene/media.h"

/* Where uploads go and by which queue. */
typedef struct uploader {
    cl_context context;
    cl_command_queue queue;
    rt_device_scene *target;
} uploader;

bool rt_buffer_make(cl_context context, cl_mem_flags flags, size_t size, cl_mem *buffer,
                    rt_status *status)
{
    cl_int error = CL_SUCCESS;
    *buffer = clCreateBuffer(context, flags, size ? size : 1, NULL, &error);
    return RT_CL_MADE(error, "clCreateBuffer", status);
}

static bool upload(const uploader *u, const void *bytes, size_t size, cl_mem *buffer,
                   rt_status *status)
{
    return rt_buffer_make(u->context, CL_MEM_READ_ONLY, size, buffer, status) &&
           (size == 0 ||
            RT_CL(clEnqueueWriteBuffer(u->queue, *buffer, CL_TRUE, 0, size, bytes, 0, NULL, NULL),
                  status));
}

/* One array of material indices for all primitives. */
static bool upload_material_indices(const uploader *u, const rt_scene *scene, rt_status *status)
{
    const size_t size = sizeof(int32_t);
    cl_mem *buffer = &u->target->materials_of;
    bool good = rt_buffer_make(u->context, CL_MEM_READ_ONLY, rt_scene_primitive_count(scene) * size,
                               buffer, status);
    size_t at = 0;
    for (int k = 0; good && k < RT_KIND_COUNT; ++k) {
        const rt_primitives *p = &scene->kinds[k];
        good = p->count == 0 ||
               RT_CL(clEnqueueWriteBuffer(u->queue, *buffer, CL_TRUE, at, p->count * size,
                                          p->materials, 0, NULL, NULL),
                     status);
        at += p->count * size;
    }
    return good;
}

/* The arrays that the trace stage works on. */
static bool upload_geometry(const uploader *u, const rt_scene *scene, const rt_bvh *bvh,
                            rt_status *status)
{
    rt_device_scene *b = u->target;
    rt_blocks in_order = {0};
    if (!bvh && !rt_blocks_in_order(&in_order, scene, status))
        return false;
    const rt_blocks *blocks = bvh ? &bvh->blocks : &in_order;
    const size_t slots = rt_blocks_slots(blocks) + RT_ORDER_PADDING;
    bool good = upload(u, bvh ? bvh->nodes : NULL, bvh ? bvh->node_count * sizeof *bvh->nodes : 0,
                       &b->nodes, status) &&
                upload(u, blocks->order, slots * sizeof *blocks->order, &b->order, status);
    for (int k = 0; good && k < RT_KIND_COUNT; ++k) {
        b->counts[k] = (cl_int)scene->kinds[k].count;
        b->block_counts[k] = (cl_int)blocks->counts[k];
        good = upload(u, blocks->kinds[k], (blocks->counts[k] + 1) * rt_kinds[k].block_size,
                      &b->blocks[k], status);
    }
    rt_blocks_clear(&in_order);
    return good;
}

static bool upload_normals(const uploader *u, const rt_scene *scene, rt_status *status)
{
    const size_t normals = scene->normal_count * RT_NORMAL_COMPONENTS;
    return upload(u, scene->triangle_normals,
                  scene->triangle_count * sizeof *scene->triangle_normals, &u->target->normals_of,
                  status) &&
           upload(u, scene->normals, normals * sizeof *scene->normals, &u->target->normals, status);
}

static bool upload_textures(const uploader *u, const rt_scene *scene, rt_status *status)
{
    rt_device_scene *b = u->target;
    const size_t uvs = scene->uv_count * RT_UV_COMPONENTS;
    return upload(u, scene->triangle_uvs, scene->triangle_count * sizeof *scene->triangle_uvs,
                  &b->uvs_of, status) &&
           upload(u, scene->uvs, uvs * sizeof *scene->uvs, &b->uvs, status) &&
           upload(u, scene->textures, scene->texture_count * sizeof *scene->textures, &b->textures,
                  status) &&
           upload(u, scene->texels, scene->texel_count * sizeof *scene->texels, &b->texels, status);
}

static bool upload_media(const uploader *u, const rt_scene *scene, rt_status *status)
{
    rt_device_scene *b = u->target;
    rt_media media;
    if (!rt_media_find(&media, scene, status))
        return false;
    b->nesting = (rt_nesting){.bits = media.bits};
    for (int i = 0; i < media.nesting; ++i)
        b->nesting.ones |= UINT64_C(1) << i * media.bits;
    for (int i = 0; i < media.eye_count; ++i)
        b->nesting.eye = b->nesting.eye << media.bits | (uint64_t)media.eye[i];
    const bool good =
        upload(u, media.of, scene->material_count * sizeof *media.of, &b->media_of, status) &&
        upload(u, media.list, (size_t)media.count * sizeof *media.list, &b->media, status);
    rt_media_clear(&media);
    return good;
}

bool rt_device_scene_upload(rt_device_scene *target, cl_context context, cl_command_queue queue,
                            const rt_scene *scene, const rt_bvh *bvh, const rt_effects *effects,
                            rt_status *status)
{
    const uploader up = {context, queue, target}, *u = &up;
    rt_device_scene *b = target;
    return upload_geometry(u, scene, bvh, status) && upload_material_indices(u, scene, status) &&
           upload(u, scene->materials, scene->material_count * sizeof *scene->materials,
                  &b->materials, status) &&
           upload(u, scene->lights, scene->light_count * sizeof *scene->lights, &b->lights,
                  status) &&
           (!rt_effects_has(effects, RT_EFFECT_REFRACT) || upload_media(u, scene, status)) &&
           (!rt_effects_has(effects, RT_EFFECT_SMOOTH) || upload_normals(u, scene, status)) &&
           (!rt_effects_has(effects, RT_EFFECT_TEXTURE) || upload_textures(u, scene, status));
}

void rt_device_scene_release(rt_device_scene *s)
{
    const cl_mem buffers[] = {
        s->nodes,      s->order,   s->lights, s->materials, s->materials_of, s->media_of, s->media,
        s->normals_of, s->normals, s->uvs_of, s->uvs,       s->textures,     s->texels};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; ++i)
        if (buffers[i])
            clReleaseMemObject(buffers[i]);
    for (int k = 0; k < RT_KIND_COUNT; ++k)
        if (s->blocks[k])
            clReleaseMemObject(s->blocks[k]);
    *s = (rt_device_scene){0};
}
