/* Compiled twice: as it is for float, with RT_SCALAR_DOUBLE for double. Every multiply-add is a
 * written fma and contraction is off, so the float version's bits are the same everywhere. */
#include "scalar.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

#ifdef RT_SCALAR_DOUBLE
typedef double real;
#define NAME(verb) rt_scalar_double_##verb
#define FMA fma
#define SQRT sqrt
#define POW pow
#define FABS fabs
#define FMAX fmax
#define FMIN fmin
#define REAL_MAX DBL_MAX
#define LDEXP ldexp
#define ILOGB ilogb
#else
typedef float real;
#define NAME(verb) rt_scalar_float_##verb
#define FMA fmaf
#define SQRT sqrtf
#define POW powf
#define FABS fabsf
#define FMAX fmaxf
#define FMIN fminf
#define REAL_MAX FLT_MAX
#define LDEXP ldexpf
#define ILOGB ilogbf
#endif

typedef struct vec {
    real x, y, z;
} vec;

typedef struct ray {
    vec origin, direction;
    real tmin, tmax;
} ray;

typedef struct hit {
    int primitive;
    real t, u, v;
} hit;

/* The camera at this precision. */
typedef struct eye {
    vec origin, right, up, forward;
} eye;

static vec vec_of(float x, float y, float z)
{
    return (vec){(real)x, (real)y, (real)z};
}

static real dot(vec a, vec b)
{
    return FMA(a.x, b.x, FMA(a.y, b.y, a.z * b.z));
}

static vec minus(vec a, vec b)
{
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static vec times(vec a, real s)
{
    return (vec){a.x * s, a.y * s, a.z * s};
}

/* a * s + b */
static vec add_scaled(vec a, real s, vec b)
{
    return (vec){FMA(a.x, s, b.x), FMA(a.y, s, b.y), FMA(a.z, s, b.z)};
}

static vec cross(vec a, vec b)
{
    return (vec){FMA(a.y, b.z, -(a.z * b.y)), FMA(a.z, b.x, -(a.x * b.z)),
                 FMA(a.x, b.y, -(a.y * b.x))};
}

/* `a` times the power of two that brings its largest component to [1, 2): exact, and products of
 * what comes out neither overflow nor vanish. */
static vec moderate(vec a)
{
    const real largest = FMAX(FABS(a.x), FMAX(FABS(a.y), FABS(a.z)));
    if (!(largest > 0 && isfinite(largest)))
        return a;
    const int k = -ILOGB(largest);
    return (vec){LDEXP(a.x, k), LDEXP(a.y, k), LDEXP(a.z, k)};
}

/* NaN for the zero vector. */
static vec unit(vec a)
{
    const vec m = moderate(a);
    return times(m, (real)1 / SQRT(dot(m, m)));
}

/* The roots of |origin + t direction - center| = radius, the nearer first; false without any. */
static bool sphere_roots(const ray *r, vec center, real radius, real *near, real *far)
{
    const vec f = minus(r->origin, center);
    const real dd = dot(r->direction, r->direction);
    const real b = -dot(f, r->direction);
    /* From the centre to the ray's closest approach. */
    const vec l = add_scaled(r->direction, b * ((real)1 / dd), f);
    const real discriminant = FMA(radius, radius, -dot(l, l));
    if (!(discriminant >= 0))
        return false;
    const real root = SQRT(dd * discriminant);
    const real c = FMA(-radius, radius, dot(f, f));
    /* Adding numbers of like sign cancels nothing; the product of the roots gives the other. */
    if (b >= 0) {
        const real q = b + root;
        *near = c / q;
        *far = q / dd;
    } else {
        const real q = b - root;
        *near = q / dd;
        *far = c / q;
    }
    return true;
}

/* Where the ray is within an axis's slab, and no longer; a direction of 0 counts as the smallest.
 */
static void slab(real origin, real direction, real lo, real hi, real *enter, real *leave)
{
    const real margin = (FABS(lo) + FABS(hi)) * (real)RT_BOX_MARGIN;
    real inverse = (real)1 / direction;
    if (inverse > REAL_MAX)
        inverse = REAL_MAX;
    if (inverse < -REAL_MAX)
        inverse = -REAL_MAX;
    const real t0 = ((lo - margin) - origin) * inverse, t1 = ((hi + margin) - origin) * inverse;
    const real near = t0 < t1 ? t0 : t1, far = t0 < t1 ? t1 : t0;
    *enter = near > *enter ? near : *enter;
    *leave = far < *leave ? far : *leave;
}

/* Takes a hit if it is nearer than the best, or as near and of a lower index. Rounding can put t
 * outside of the primitive, far outside for slivers and grazing rays: it is kept within the ray's
 * part in the primitive's box, and a ray that does not meet the box does not meet the primitive. */
static void take(const ray *r, hit candidate, vec lo, vec hi, hit *best)
{
    real enter = -INFINITY, leave = INFINITY;
    slab(r->origin.x, r->direction.x, lo.x, hi.x, &enter, &leave);
    slab(r->origin.y, r->direction.y, lo.y, hi.y, &enter, &leave);
    slab(r->origin.z, r->direction.z, lo.z, hi.z, &enter, &leave);
    leave = leave * (real)RT_SLAB_MARGIN;
    if (!(enter <= leave))
        return;
    if (!(candidate.t > enter))
        candidate.t = enter;
    if (!(candidate.t < leave))
        candidate.t = leave;
    const bool nearer =
        candidate.t < best->t || (candidate.t == best->t && candidate.primitive < best->primitive);
    if (candidate.t > r->tmin && nearer)
        *best = candidate;
}

static void intersect_sphere(const ray *r, const rt_sphere *sphere, int primitive, hit *best)
{
    real near, far;
    const vec center = vec_of(sphere->cx, sphere->cy, sphere->cz);
    if (!sphere_roots(r, center, (real)sphere->radius, &near, &far))
        return;
    const real t = near > r->tmin ? near : far;
    const vec reach = {(real)sphere->radius, (real)sphere->radius, (real)sphere->radius};
    const vec lo = minus(center, reach), hi = minus(center, times(reach, -1));
    take(r, (hit){primitive, t, 0, 0}, lo, hi, best);
}

/* Moller and Trumbore 1997; `cull` as rt_scene_cull_sign. */
static void intersect_triangle(const ray *r, const rt_triangle *triangle, int primitive, int cull,
                               hit *best)
{
    const vec a = vec_of(triangle->ax, triangle->ay, triangle->az);
    const vec e1 = minus(vec_of(triangle->bx, triangle->by, triangle->bz), a);
    const vec e2 = minus(vec_of(triangle->cx, triangle->cy, triangle->cz), a);
    const vec p = cross(r->direction, e2);
    const vec s = minus(r->origin, a);
    const vec q = cross(s, e1);
    real det = dot(e1, p);
    real u = dot(s, p);
    real v = dot(r->direction, q);
    real t = dot(e2, q);
    if ((cull > 0 && !(det > 0)) || (cull < 0 && !(det < 0)))
        return;
    if (det < 0) {
        det = -det;
        u = -u;
        v = -v;
        t = -t;
    }
    if (!(det > 0 && u >= 0 && v >= 0 && u + v <= det))
        return;
    const vec b = vec_of(triangle->bx, triangle->by, triangle->bz);
    const vec c = vec_of(triangle->cx, triangle->cy, triangle->cz);
    const vec lo = {FMIN(a.x, FMIN(b.x, c.x)), FMIN(a.y, FMIN(b.y, c.y)),
                    FMIN(a.z, FMIN(b.z, c.z))};
    const vec hi = {FMAX(a.x, FMAX(b.x, c.x)), FMAX(a.y, FMAX(b.y, c.y)),
                    FMAX(a.z, FMAX(b.z, c.z))};
    take(r, (hit){primitive, t / det, u / det, v / det}, lo, hi, best);
}

/* A ray with a component that is not finite hits nothing. */
static bool is_lawful(const ray *r)
{
    const vec o = r->origin, d = r->direction;
    return isfinite(o.x) && isfinite(o.y) && isfinite(o.z) && isfinite(d.x) && isfinite(d.y) &&
           isfinite(d.z) && r->tmax > r->tmin;
}

static hit closest_hit(const rt_scene *scene, const ray *r)
{
    hit best = {RT_MISS, is_lawful(r) ? r->tmax : -INFINITY, 0, 0};
    const int spheres = (int)scene->sphere_count;
    const int cull = rt_scene_cull_sign(scene);
    for (int i = 0; i < spheres; ++i)
        intersect_sphere(r, &scene->spheres[i], i, &best);
    for (int i = 0; i < (int)scene->triangle_count; ++i)
        intersect_triangle(r, &scene->triangles[i], spheres + i, cull, &best);
    if (best.primitive == RT_MISS)
        best.t = INFINITY;
    return best;
}

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

static rt_hit record_of(const hit *h)
{
    return (rt_hit){h->primitive, (float)h->t, (float)h->u, (float)h->v};
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
            const hit h = closest_hit(scene, &r);
            const vec color = shade(scene, &r, &h);
            image->rgb[3 * i] = (float)color.x;
            image->rgb[3 * i + 1] = (float)color.y;
            image->rgb[3 * i + 2] = (float)color.z;
            if (image->hits)
                image->hits[i] = record_of(&h);
        }
    }
    return true;
}

void NAME(trace)(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    for (size_t i = 0; i < count; ++i) {
        const float *o = rays[i].origin, *d = rays[i].direction;
        const ray r = {vec_of(o[0], o[1], o[2]), vec_of(d[0], d[1], d[2]), (real)rays[i].tmin,
                       (real)rays[i].tmax};
        const hit h = closest_hit(scene, &r);
        hits[i] = record_of(&h);
    }
}
