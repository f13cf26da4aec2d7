/* The pictures of the scalar reference: rays from the camera, and what they carry back. */
#include "scalar_real.h"

/* The camera at this precision. */
typedef struct eye {
    vec origin, right, up, forward;
} eye;

static vec turned_toward(vec normal, vec direction)
{
    return dot(normal, direction) > 0 ? times(normal, -1) : normal;
}

static vec triangle_normal(const rt_triangle *triangle)
{
    const vec a = vec_of(triangle->ax, triangle->ay, triangle->az);
    const vec b = vec_of(triangle->bx, triangle->by, triangle->bz);
    const vec c = vec_of(triangle->cx, triangle->cy, triangle->cz);
    return unit(cross(moderate(minus(b, a)), moderate(minus(c, a))));
}

/* The vertex normals weighed by u and v, on the side of the geometric normal `facing`. */
static vec interpolated_normal(const float *n, real u, real v, vec facing)
{
    const vec na = vec_of(n[0], n[1], n[2]);
    const vec nb = vec_of(n[3], n[4], n[5]);
    const vec nc = vec_of(n[6], n[7], n[8]);
    const vec sum = add_scaled(nc, v, add_scaled(nb, u, times(na, (real)1 - u - v)));
    const vec normal = unit(sum);
    const real side = dot(normal, facing);
    if (!isfinite(side))
        return facing;
    return side < 0 ? times(normal, -1) : normal;
}

static vec normal_at(const rt_scene *scene, const ray *r, const hit *h, vec point)
{
    if (h->primitive < (int)scene->sphere_count) {
        const rt_sphere *sphere = &scene->spheres[h->primitive];
        const vec center = vec_of(sphere->cx, sphere->cy, sphere->cz);
        return turned_toward(unit(minus(point, center)), r->direction);
    }
    const int triangle = h->primitive - (int)scene->sphere_count;
    const vec facing = turned_toward(triangle_normal(&scene->triangles[triangle]), r->direction);
    const int record = scene->triangle_normals[triangle];
    if (record < 0)
        return facing;
    return interpolated_normal(scene->normals + (size_t)record * RT_NORMAL_COMPONENTS, h->u, h->v,
                               facing);
}

static real power(real x, const rt_material *material)
{
    if (material->exponent < 0)
        return POW(x, (real)material->shininess);
    real result = 1;
    for (int n = material->exponent; n > 0; n >>= 1) {
        if (n & 1)
            result = result * x;
        x = x * x;
    }
    return result;
}

static vec add_light(vec color, const rt_light *light, const rt_material *m, vec point, vec normal,
                     vec direction)
{
    const vec place = vec_of(light->x, light->y, light->z);
    const vec to_light = light->w != 0.0f ? minus(place, point) : place;
    const vec l = unit(to_light);
    if (!isfinite(l.x))
        return color; /* a light exactly at the point has no direction */
    const real n_dot_l = dot(normal, l);
    const vec mirrored = add_scaled(normal, 2 * n_dot_l, times(l, -1));
    const real r_dot_v = -dot(mirrored, direction);
    const real diffuse = n_dot_l > 0 ? n_dot_l : 0;
    const real specular = power(r_dot_v > 0 ? r_dot_v : 0, m);
    return (vec){
        FMA((real)light->r, FMA((real)m->ks_r, specular, (real)m->kd_r * diffuse), color.x),
        FMA((real)light->g, FMA((real)m->ks_g, specular, (real)m->kd_g * diffuse), color.y),
        FMA((real)light->b, FMA((real)m->ks_b, specular, (real)m->kd_b * diffuse), color.z)};
}

static vec shade(const rt_scene *scene, const ray *r, const hit *h)
{
    if (h->primitive == RT_MISS)
        return vec_of(scene->background.x, scene->background.y, scene->background.z);
    const bool is_sphere = h->primitive < (int)scene->sphere_count;
    const int material = is_sphere
                             ? scene->sphere_materials[h->primitive]
                             : scene->triangle_materials[h->primitive - (int)scene->sphere_count];
    const rt_material *m = &scene->materials[material];
    const vec point = add_scaled(r->direction, h->t, r->origin);
    const vec normal = normal_at(scene, r, h, point);
    vec color = {(real)scene->ambient.x * (real)m->ka_r, (real)scene->ambient.y * (real)m->ka_g,
                 (real)scene->ambient.z * (real)m->ka_b};
    for (size_t i = 0; i < scene->light_count; ++i)
        color = add_light(color, &scene->lights[i], m, point, normal, r->direction);
    return color;
}

static eye eye_of(const rt_scene *scene)
{
#ifdef RT_SCALAR_DOUBLE
    const rt_view v = rt_scene_view(scene);
    return (eye){{v.origin[0], v.origin[1], v.origin[2]},
                 {v.right[0], v.right[1], v.right[2]},
                 {v.up[0], v.up[1], v.up[2]},
                 {v.forward[0], v.forward[1], v.forward[2]}};
#else
    const rt_frame f = rt_scene_frame(scene);
    return (eye){{f.ox, f.oy, f.oz},
                 {f.right_x, f.right_y, f.right_z},
                 {f.up_x, f.up_y, f.up_z},
                 {f.forward_x, f.forward_y, f.forward_z}};
#endif
}

static ray primary_ray(const eye *e, int x, int y, int width, int height)
{
    const vec upward = add_scaled(e->up, (real)(height - 1 - 2 * y), e->forward);
    const vec through = add_scaled(e->right, (real)(2 * x + 1 - width), upward);
    return (ray){e->origin, unit(through), 0, INFINITY};
}

bool NAME(render)(const rt_scene *scene, rt_image *image, const rt_watch *watch, rt_status *status)
{
    const eye e = eye_of(scene);
    for (int y = 0; y < image->height; ++y) {
        if (!rt_watch_tick(watch, (double)y / image->height))
            return rt_status_fail(status, RT_INTERRUPTED, "rt: interrupted");
        for (int x = 0; x < image->width; ++x) {
            const size_t i = (size_t)y * (size_t)image->width + (size_t)x;
            const ray r = primary_ray(&e, x, y, image->width, image->height);
            const hit h = NAME(closest)(scene, &r);
            const vec color = shade(scene, &r, &h);
            image->rgb[3 * i] = (float)color.x;
            image->rgb[3 * i + 1] = (float)color.y;
            image->rgb[3 * i + 2] = (float)color.z;
            if (image->hits)
                image->hits[i] = (rt_hit){h.primitive, (float)h.t, (float)h.u, (float)h.v};
        }
    }
    return true;
}
