#include "bench/rays.h"

#include <math.h>
#include <stdlib.h>

#include "bench/meshes.h"
#include "scene/camera.h"

/* Far above the rounding of a hit point near 1 (1e-7), so that no tracer's answer depends on it. */
#define BENCH_OFFSET 1e-4

static const rt_ray dead_ray = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, 0.0f, -1.0f};

/* Where a ray hits, and the unit normal turned toward its origin. */
typedef struct surface {
    double point[3], normal[3];
} surface;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void make_unit(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; ++i)
        v[i] /= length;
}

static bool allocate(bench_rays *rays, size_t count, rt_status *status)
{
    rays->count = count;
    rays->rays = malloc(count * sizeof *rays->rays);
    return rays->rays || rt_status_no_memory(status, "rays");
}

void bench_rays_clear(bench_rays *rays)
{
    free(rays->rays);
    *rays = (bench_rays){NULL, 0};
}

bool bench_rays_primary(bench_rays *rays, const rt_scene *scene, rt_status *status)
{
    const rt_view view = rt_scene_view(scene);
    const size_t columns = (size_t)scene->width / RT_BLOCK_SIDE;
    if (!allocate(rays, (size_t)scene->width * (size_t)scene->height, status))
        return false;
    for (size_t i = 0; i < rays->count; ++i) {
        const size_t block = i / RT_BLOCK_RAYS, within = i % RT_BLOCK_RAYS;
        const double x = (double)(block % columns * RT_BLOCK_SIDE + RT_BLOCK_COLUMN(within));
        const double y = (double)(block / columns * RT_BLOCK_SIDE + RT_BLOCK_ROW(within));
        double d[3];
        for (int k = 0; k < 3; ++k)
            d[k] = view.right[k] * (2.0 * x + 1.0 - scene->width) +
                   view.up[k] * (scene->height - 1.0 - 2.0 * y) + view.forward[k];
        make_unit(d);
        rt_ray *ray = &rays->rays[i];
        for (int k = 0; k < 3; ++k) {
            ray->origin[k] = (float)view.origin[k];
            ray->direction[k] = (float)d[k];
        }
        ray->tmin = 0.0f;
        ray->tmax = INFINITY;
    }
    return true;
}

static void triangle_normal(const rt_triangle *t, double normal[3])
{
    const double e1[3] = {(double)t->bx - (double)t->ax, (double)t->by - (double)t->ay,
                          (double)t->bz - (double)t->az};
    const double e2[3] = {(double)t->cx - (double)t->ax, (double)t->cy - (double)t->ay,
                          (double)t->cz - (double)t->az};
    for (int k = 0; k < 3; ++k)
        normal[k] = e1[(k + 1) % 3] * e2[(k + 2) % 3] - e1[(k + 2) % 3] * e2[(k + 1) % 3];
}

static surface surface_of(const rt_scene *scene, const rt_ray *ray, const rt_hit *hit)
{
    surface s;
    const double d[3] = {(double)ray->direction[0], (double)ray->direction[1],
                         (double)ray->direction[2]};
    for (int k = 0; k < 3; ++k)
        s.point[k] = (double)ray->origin[k] + (double)hit->t * d[k];
    const size_t index = (size_t)hit->primitive;
    if (index < scene->sphere_count) {
        const rt_sphere *sphere = &scene->spheres[index];
        s.normal[0] = s.point[0] - (double)sphere->cx;
        s.normal[1] = s.point[1] - (double)sphere->cy;
        s.normal[2] = s.point[2] - (double)sphere->cz;
    } else {
        triangle_normal(&scene->triangles[index - scene->sphere_count], s.normal);
    }
    make_unit(s.normal);
    if (dot(s.normal, d) > 0.0)
        for (int k = 0; k < 3; ++k)
            s.normal[k] = -s.normal[k];
    for (int k = 0; k < 3; ++k)
        s.point[k] += BENCH_OFFSET * s.normal[k];
    return s;
}

bool bench_rays_shadow(bench_rays *rays, const rt_scene *scene, const bench_rays *primary,
                       const rt_hit *hits, bool from_light, rt_status *status)
{
    const float light[3] = {BENCH_LIGHT_X, BENCH_LIGHT_Y, BENCH_LIGHT_Z};
    if (!allocate(rays, primary->count, status))
        return false;
    for (size_t i = 0; i < rays->count; ++i) {
        rt_ray *ray = &rays->rays[i];
        *ray = dead_ray;
        if (hits[i].primitive == RT_MISS)
            continue;
        const surface s = surface_of(scene, &primary->rays[i], &hits[i]);
        for (int k = 0; k < 3; ++k) {
            const float point = (float)s.point[k];
            ray->origin[k] = from_light ? light[k] : point;
            ray->direction[k] = from_light ? point - light[k] : light[k] - point;
        }
        ray->tmax = 1.0f;
    }
    return true;
}

bool bench_rays_bounce(bench_rays *rays, const rt_scene *scene, const bench_rays *primary,
                       const rt_hit *hits, rt_status *status)
{
    const double pi = 3.14159265358979323846;
    if (!allocate(rays, primary->count, status))
        return false;
    for (size_t i = 0; i < rays->count; ++i) {
        rt_ray *ray = &rays->rays[i];
        *ray = dead_ray;
        if (hits[i].primitive == RT_MISS)
            continue;
        const surface s = surface_of(scene, &primary->rays[i], &hits[i]);
        /* Normal plus a point of the unit sphere: directions by the cosine of their angle. */
        const double z = 2.0 * bench_random(i, 4) - 1.0, angle = 2.0 * pi * bench_random(i, 5);
        const double across = sqrt(1.0 - z * z);
        double d[3] = {s.normal[0] + across * cos(angle), s.normal[1] + across * sin(angle),
                       s.normal[2] + z};
        if (dot(d, d) < 1e-12)
            d[0] = s.normal[0], d[1] = s.normal[1], d[2] = s.normal[2];
        make_unit(d);
        for (int k = 0; k < 3; ++k) {
            ray->origin[k] = (float)s.point[k];
            ray->direction[k] = (float)d[k];
        }
        ray->tmax = INFINITY;
    }
    return true;
}
