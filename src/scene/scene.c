#include "scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/array.h"

void rt_scene_init(rt_scene *scene)
{
    *scene = (rt_scene){0};
    scene->width = scene->height = 512;
    scene->accuracy = RT_ACCURACY_STANDARD;
    scene->camera.at = (rt_vec3){0.0f, 0.0f, -1.0f};
    scene->camera.up = (rt_vec3){0.0f, 1.0f, 0.0f};
    scene->camera.vfov = 90.0f;
    scene->samples = 1;
    scene->depth = 5;
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
    free(scene->spheres);
    free(scene->sphere_materials);
    free(scene->triangles);
    free(scene->triangle_materials);
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
    scene->light_places[scene->light_count] = scene->here;
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
    scene->material_places[scene->material_count] = scene->here;
    scene->materials[scene->material_count++] = *material;
    return true;
}

static bool has_free_indices(const rt_scene *scene, size_t count, rt_status *status)
{
    if (count <= INT32_MAX - scene->sphere_count - scene->triangle_count)
        return true;
    return rt_status_fail(status, RT_ERROR_SCENE, "rt: more than %d primitives", INT32_MAX);
}

bool rt_scene_add_sphere(rt_scene *scene, const rt_sphere *sphere, int32_t material,
                         rt_status *status)
{
    if (!has_free_indices(scene, 1, status))
        return false;
    /* Two arrays grow in step: the capacity moves once both have. */
    size_t capacity = scene->sphere_capacity;
    if (!RT_ARRAY_GROW(scene->spheres, scene->sphere_count, &capacity))
        return rt_status_no_memory(status, "spheres");
    capacity = scene->sphere_capacity;
    if (!RT_ARRAY_GROW(scene->sphere_materials, scene->sphere_count, &capacity))
        return rt_status_no_memory(status, "spheres");
    scene->sphere_capacity = capacity;
    scene->spheres[scene->sphere_count] = *sphere;
    scene->sphere_materials[scene->sphere_count++] = material;
    return true;
}

bool rt_scene_reserve_triangles(rt_scene *scene, size_t triangles, size_t normals,
                                rt_status *status)
{
    if (!has_free_indices(scene, triangles, status))
        return false;
    /* Four arrays grow in step: the capacity moves once all have. */
    const size_t needed = scene->triangle_count + triangles;
    size_t capacity = scene->triangle_capacity;
    bool grown = rt_array_reserve(&scene->triangles, needed, &capacity, sizeof *scene->triangles);
    capacity = scene->triangle_capacity;
    grown = grown && rt_array_reserve(&scene->triangle_materials, needed, &capacity,
                                      sizeof *scene->triangle_materials);
    capacity = scene->triangle_capacity;
    grown = grown && rt_array_reserve(&scene->triangle_normals, needed, &capacity,
                                      sizeof *scene->triangle_normals);
    capacity = scene->triangle_capacity;
    grown = grown &&
            rt_array_reserve(&scene->triangle_uvs, needed, &capacity, sizeof *scene->triangle_uvs);
    if (grown)
        scene->triangle_capacity = capacity;
    grown =
        grown && rt_array_reserve(&scene->normals, scene->normal_count + normals,
                                  &scene->normal_capacity, RT_NORMAL_COMPONENTS * sizeof(float));
    return grown || rt_status_no_memory(status, "triangles");
}

bool rt_scene_add_triangle(rt_scene *scene, const rt_triangle *triangle, const float *normals,
                           int32_t material, rt_status *status)
{
    const size_t count = scene->triangle_count;
    const bool has_room = count < scene->triangle_capacity &&
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

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double length(const double v[3])
{
    return hypot(hypot(v[0], v[1]), v[2]);
}

static void scale(double v[3], double factor)
{
    for (int i = 0; i < 3; ++i)
        v[i] *= factor;
}

static void difference(double out[3], rt_vec3 a, rt_vec3 b)
{
    out[0] = (double)a.x - (double)b.x;
    out[1] = (double)a.y - (double)b.y;
    out[2] = (double)a.z - (double)b.z;
}

rt_view rt_scene_view(const rt_scene *scene)
{
    const rt_camera *camera = &scene->camera;
    rt_view view = {
        .origin = {(double)camera->from.x, (double)camera->from.y, (double)camera->from.z}};
    difference(view.forward, camera->at, camera->from);
    view.focus = camera->focus > 0.0f ? (double)camera->focus : length(view.forward);
    scale(view.forward, 1.0 / length(view.forward));

    double up[3];
    difference(up, camera->up, (rt_vec3){0.0f, 0.0f, 0.0f});
    scale(up, 1.0 / length(up));
    cross(view.right, view.forward, up);
    /* Two fp32 vectors that are meant to be parallel differ by rounding of about 1e-7. */
    if (length(view.right) < 1e-6) {
        int least = 0;
        for (int i = 1; i < 3; ++i)
            if (fabs(view.forward[i]) < fabs(view.forward[least]))
                least = i;
        for (int i = 0; i < 3; ++i)
            up[i] = i == least;
        cross(view.right, view.forward, up);
    }
    scale(view.right, 1.0 / length(view.right));
    cross(view.up, view.right, view.forward);

    const double radius = 0.5 * (double)camera->aperture;
    for (int i = 0; i < 3; ++i) {
        view.lens_right[i] = radius * view.right[i];
        view.lens_up[i] = radius * view.up[i];
    }

    /* Half a pixel: the image plane at distance 1 is 2 tan(vfov / 2) high, pixels are square. */
    const double pi = 3.14159265358979323846;
    const double half_pixel = tan((double)camera->vfov * pi / 360.0) / scene->height;
    scale(view.right, half_pixel);
    scale(view.up, half_pixel);
    return view;
}

rt_gradient rt_scene_gradient(const rt_scene *scene)
{
    double up[3];
    difference(up, scene->camera.up, (rt_vec3){0.0f, 0.0f, 0.0f});
    scale(up, 1.0 / length(up));
    return (rt_gradient){scene->background_top.x,
                         scene->background_top.y,
                         scene->background_top.z,
                         (float)up[0],
                         (float)up[1],
                         (float)up[2]};
}

/* Both kinds of frame have the same fields. */
#define FRAME(type, number, v, scene)                                                              \
    (type)                                                                                         \
    {                                                                                              \
        .ox = (number)(v).origin[0], .oy = (number)(v).origin[1], .oz = (number)(v).origin[2],     \
        .right_x = (number)(v).right[0], .right_y = (number)(v).right[1],                          \
        .right_z = (number)(v).right[2], .up_x = (number)(v).up[0], .up_y = (number)(v).up[1],     \
        .up_z = (number)(v).up[2], .forward_x = (number)(v).forward[0],                            \
        .forward_y = (number)(v).forward[1], .forward_z = (number)(v).forward[2],                  \
        .lens_right_x = (number)(v).lens_right[0], .lens_right_y = (number)(v).lens_right[1],      \
        .lens_right_z = (number)(v).lens_right[2], .lens_up_x = (number)(v).lens_up[0],            \
        .lens_up_y = (number)(v).lens_up[1], .lens_up_z = (number)(v).lens_up[2],                  \
        .focus = (number)(v).focus, .width = (scene)->width, .height = (scene)->height             \
    }

rt_frame rt_scene_frame(const rt_scene *scene)
{
    const rt_view view = rt_scene_view(scene);
    return FRAME(rt_frame, float, view, scene);
}

rt_frame_double rt_scene_frame_double(const rt_scene *scene)
{
    const rt_view view = rt_scene_view(scene);
    return FRAME(rt_frame_double, double, view, scene);
}

bool rt_triangle_is_degenerate(const rt_triangle *t)
{
    const rt_vec3 a = {t->ax, t->ay, t->az};
    double e1[3], e2[3], normal[3];
    difference(e1, (rt_vec3){t->bx, t->by, t->bz}, a);
    difference(e2, (rt_vec3){t->cx, t->cy, t->cz}, a);
    /* Products of two 25-bit differences are exact in double, so zero means zero, as long as the
     * corners' magnitudes are within 2^28 of each other. */
    cross(normal, e1, e2);
    return normal[0] == 0.0 && normal[1] == 0.0 && normal[2] == 0.0;
}

bool rt_triangle_settle(rt_triangle *t, float *normals)
{
    float largest = 0.0f;
    for (int i = 0; normals && i < RT_NORMAL_COMPONENTS; ++i)
        largest = fmaxf(largest, fabsf(normals[i]));
    /* In double, since the factor may be outside fp32. */
    const double factor = largest > 0.0f ? ldexp(1.0, -ilogbf(largest)) : 1.0;
    for (int i = 0; normals && i < RT_NORMAL_COMPONENTS; ++i)
        normals[i] = (float)(factor * (double)normals[i]);
    if (!rt_triangle_is_degenerate(t))
        return true;
    *t = (rt_triangle){t->ax, t->ay, t->az, t->ax, t->ay, t->az, t->ax, t->ay, t->az};
    return false;
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
