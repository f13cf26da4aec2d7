#include "scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/array.h"

void rt_scene_init(rt_scene *scene)
{
    *scene = (rt_scene){0};
    scene->width = scene->height = 512;
    scene->accuracy = RT_ACCURACY_DEFAULT;
    scene->camera.at = (rt_vec3){0.0f, 0.0f, -1.0f};
    scene->camera.up = (rt_vec3){0.0f, 1.0f, 0.0f};
    scene->camera.vfov = 90.0f;
    scene->samples = 1;
    scene->depth = 32;
}

void rt_scene_clear(rt_scene *scene)
{
    for (size_t i = 0; i < scene->file_count; ++i)
        free(scene->files[i]);
    free(scene->files);
    free(scene->lights);
    free(scene->light_places);
    free(scene->materials);
    free(scene->material_places);
    for (int kind = 0; kind < RT_KIND_COUNT; ++kind)
        rt_primitives_clear(&scene->kinds[kind]);
    free(scene->triangle_normals);
    free(scene->normals);
    free(scene->triangle_uvs);
    free(scene->uvs);
    for (size_t i = 0; i < scene->texture_count; ++i)
        free(scene->texture_files[i]);
    free(scene->texture_files);
    free(scene->textures);
    free(scene->texels);
    *scene = (rt_scene){0};
}

bool rt_scene_add_light(rt_scene *scene, const rt_light *light, rt_status *status)
{
    /* Two arrays grow in step: the capacity moves once both have. */
    size_t capacity = scene->light_capacity;
    bool grown = RT_ARRAY_GROW(scene->lights, scene->light_count, &capacity);
    capacity = scene->light_capacity;
    grown = grown && RT_ARRAY_GROW(scene->light_places, scene->light_count, &capacity);
    if (!grown)
        return rt_status_no_memory(status, "lights");
    scene->light_capacity = capacity;
    scene->light_places[scene->light_count] = (rt_place){NULL, 0};
    scene->lights[scene->light_count++] = *light;
    return true;
}

bool rt_scene_add_material(rt_scene *scene, const rt_material *material, rt_status *status)
{
    size_t capacity = scene->material_capacity;
    bool grown = RT_ARRAY_GROW(scene->materials, scene->material_count, &capacity);
    capacity = scene->material_capacity;
    grown = grown && RT_ARRAY_GROW(scene->material_places, scene->material_count, &capacity);
    if (!grown)
        return rt_status_no_memory(status, "materials");
    scene->material_capacity = capacity;
    scene->material_places[scene->material_count] = (rt_place){NULL, 0};
    scene->materials[scene->material_count++] = *material;
    return true;
}

size_t rt_scene_primitives_before(const rt_scene *scene, enum rt_kind kind)
{
    size_t count = 0;
    for (int k = 0; k < (int)kind; ++k)
        count += scene->kinds[k].count;
    return count;
}

size_t rt_scene_primitive_count(const rt_scene *scene)
{
    return rt_scene_primitives_before(scene, RT_KIND_COUNT);
}

static bool has_free_indices(const rt_scene *scene, size_t count, rt_status *status)
{
    if (count <= INT32_MAX - rt_scene_primitive_count(scene))
        return true;
    return rt_status_fail(status, RT_ERROR_SCENE, "rt: more than %d primitives", INT32_MAX);
}

static bool reserve(rt_scene *scene, enum rt_kind kind, size_t more, rt_status *status)
{
    return has_free_indices(scene, more, status) &&
           (rt_primitives_reserve(&scene->kinds[kind], kind, more) ||
            rt_status_no_memory(status, rt_kinds[kind].names));
}

bool rt_scene_add_primitive(rt_scene *scene, enum rt_kind kind, const void *primitive,
                            int32_t material, rt_status *status)
{
    rt_primitives *p = &scene->kinds[kind];
    const size_t size = rt_kinds[kind].size;
    if (!reserve(scene, kind, 1, status))
        return false;
    memcpy((char *)p->items + p->count * size, primitive, size);
    p->materials[p->count++] = material;
    return true;
}

bool rt_scene_add_sphere(rt_scene *scene, const rt_sphere *sphere, int32_t material,
                         rt_status *status)
{
    return rt_scene_add_primitive(scene, RT_KIND_SPHERES, sphere, material, status);
}

bool rt_scene_reserve_triangles(rt_scene *scene, size_t triangles, size_t normals,
                                rt_status *status)
{
    if (!reserve(scene, RT_KIND_TRIANGLES, triangles, status))
        return false;
    /* Two arrays grow in step: the capacity moves once both have. */
    const size_t needed = scene->triangle_count + triangles;
    size_t capacity = scene->triangle_record_capacity;
    bool grown = rt_array_reserve(&scene->triangle_normals, needed, &capacity,
                                  sizeof *scene->triangle_normals);
    capacity = scene->triangle_record_capacity;
    grown = grown &&
            rt_array_reserve(&scene->triangle_uvs, needed, &capacity, sizeof *scene->triangle_uvs);
    if (grown)
        scene->triangle_record_capacity = capacity;
    grown =
        grown && rt_array_reserve(&scene->normals, scene->normal_count + normals,
                                  &scene->normal_capacity, RT_NORMAL_COMPONENTS * sizeof(float));
    return grown || rt_status_no_memory(status, "triangles");
}

bool rt_scene_add_triangle(rt_scene *scene, const rt_triangle *triangle, const float *normals,
                           int32_t material, rt_status *status)
{
    const size_t count = scene->triangle_count;
    /* Meshes have made room for all of theirs at once. */
    const bool has_room = count < scene->triangle_capacity &&
                          count < scene->triangle_record_capacity &&
                          (!normals || scene->normal_count < scene->normal_capacity);
    if (!(has_room ? has_free_indices(scene, 1, status)
                   : rt_scene_reserve_triangles(scene, 1, normals ? 1 : 0, status)))
        return false;
    scene->triangles[count] = *triangle;
    scene->triangle_materials[count] = material;
    scene->triangle_normals[count] = normals ? (int32_t)scene->normal_count : -1;
    scene->triangle_uvs[count] = -1;
    if (normals)
        memcpy(scene->normals + RT_NORMAL_COMPONENTS * scene->normal_count++, normals,
               RT_NORMAL_COMPONENTS * sizeof *normals);
    scene->triangle_count++;
    return true;
}

bool rt_scene_set_uvs(rt_scene *scene, const float *uvs, rt_status *status)
{
    if (!rt_array_grow(&scene->uvs, scene->uv_count, &scene->uv_capacity,
                       RT_UV_COMPONENTS * sizeof *scene->uvs))
        return rt_status_no_memory(status, "texture coordinates");
    memcpy(scene->uvs + RT_UV_COMPONENTS * scene->uv_count, uvs, RT_UV_COMPONENTS * sizeof *uvs);
    scene->triangle_uvs[scene->triangle_count - 1] = (int32_t)scene->uv_count++;
    return true;
}

rt_material rt_material_make(const float ka[3], const float kd[3], const float ks[3],
                             float shininess)
{
    const bool whole = shininess == floorf(shininess);
    return (rt_material){.ka_r = ka[0],
                         .ka_g = ka[1],
                         .ka_b = ka[2],
                         .kd_r = kd[0],
                         .kd_g = kd[1],
                         .kd_b = kd[2],
                         .ks_r = ks[0],
                         .ks_g = ks[1],
                         .ks_b = ks[2],
                         .shininess = shininess,
                         .exponent = whole ? (int)shininess : -1,
                         .ior = 1.5f,
                         .texture = -1};
}

int rt_scene_cull_sign(const rt_scene *scene)
{
    if (scene->cull == RT_CULL_NONE)
        return 0;
    /* The determinant is positive where the corners run counter-clockwise as seen. */
    const bool keeps_front = scene->cull == RT_CULL_BACK;
    const bool front_is_ccw = scene->winding == RT_WINDING_CCW;
    return keeps_front == front_is_ccw ? 1 : -1;
}
