/* The paths of the scalar reference: what a ray brings back from what it hits, and from the mirror
 * and refracted rays that leave from there. */
#include "reference/effects.h"

/* A next ray that weighs less cannot be seen: half of an 8-bit step of white is 1/510. */
#define LEAST_WEIGHT ((real)1 / 512)

/* A ray on its way, and what is left of the light that comes along it. */
typedef struct branch {
    ray r;
    real weight;    /* what reflect, transmit and Fresnel leave */
    vec tint;       /* what fog and absorption leave */
    int medium;     /* the material that the ray runs in, -1 outside of all */
    stream samples; /* its step counts the rays before this one */
} branch;

static void add(vec *sum, const branch *b, vec color)
{
    sum->x = FMA(b->weight * b->tint.x, color.x, sum->x);
    sum->y = FMA(b->weight * b->tint.y, color.y, sum->y);
    sum->z = FMA(b->weight * b->tint.z, color.z, sum->z);
}

/* Beer's law. Without absorption nothing is lost on an endless way either. */
static real left_after(real density, real way)
{
    return density > 0 ? EXP(-density * way) : 1;
}

/* What happens on the way of length t, which may be infinite. */
static void pass(const rt_scene *scene, branch *b, real t, vec *sum)
{
    vec left;
    if (b->medium >= 0) {
        const rt_material *m = &scene->materials[b->medium];
        left = (vec){left_after((real)m->absorb_r, t), left_after((real)m->absorb_g, t),
                     left_after((real)m->absorb_b, t)};
    } else {
        const real clear = left_after((real)scene->fog_density, t);
        add(sum, b, times(vec_of(scene->fog.x, scene->fog.y, scene->fog.z), 1 - clear));
        left = (vec){clear, clear, clear};
    }
    b->tint = product(b->tint, left);
}

/* The unit vector is made in double, as the device gets it. */
static vec camera_up(const rt_scene *scene)
{
    const rt_vec3 up = scene->camera.up;
    const double x = (double)up.x, y = (double)up.y, z = (double)up.z;
    const double length = hypot(hypot(x, y), z);
    return (vec){(real)(x / length), (real)(y / length), (real)(z / length)};
}

static vec background(const rt_scene *scene, vec direction)
{
    const vec bottom = vec_of(scene->background.x, scene->background.y, scene->background.z);
    if (!scene->has_gradient)
        return bottom;
    const rt_vec3 end = scene->background_top;
    const real part = (real)0.5 * (1 + dot(direction, camera_up(scene)));
    return add_scaled(minus(vec_of(end.x, end.y, end.z), bottom), part, bottom);
}

/* The mirror ray's direction, about the geometric normal where the shading normal would send it
 * into the surface. */
static vec mirrored(const surface *s, vec d)
{
    const vec about_normal = add_scaled(s->normal, -2 * dot(d, s->normal), d);
    if (dot(about_normal, s->facing) > 0)
        return about_normal;
    return add_scaled(s->facing, -2 * dot(d, s->facing), d);
}

/* The squared sine of the refracted ray's angle, by Snell's law. */
static real refracted_sine2(real eta, real c1)
{
    return eta * eta * FMA(-c1, c1, 1);
}

real NAME(fresnel)(real eta, real c1)
{
    const real s2 = refracted_sine2(eta, c1);
    if (!(s2 < 1))
        return 1;
    const real c2 = SQRT(1 - s2);
    const real rs = FMA(eta, c1, -c2) / FMA(eta, c1, c2);
    const real rp = FMA(-eta, c2, c1) / FMA(eta, c2, c1);
    return (real)0.5 * FMA(rs, rs, rp * rp);
}

/* The direction d behind a boundary with the normal n; only where the reflection is not total. */
static vec bent(vec d, vec n, real eta)
{
    const real c1 = -dot(d, n);
    const real c2 = SQRT(1 - refracted_sine2(eta, c1));
    return unit(add_scaled(n, FMA(eta, c1, -c2), times(d, eta)));
}

/* The part that is mirrored, and the direction of the rest. A shading normal that the ray comes to
 * from behind, or that would leave the refracted ray on this side, gives way to the geometric. */
static real split(const surface *s, vec d, real eta, vec *refracted)
{
    vec n = dot(d, s->normal) < 0 ? s->normal : s->facing;
    real part = NAME(fresnel)(eta, -dot(d, n));
    if (!(part < 1))
        return 1;
    *refracted = bent(d, n, eta);
    if (dot(*refracted, s->facing) < 0)
        return part;
    n = s->facing;
    part = NAME(fresnel)(eta, -dot(d, n));
    if (part < 1)
        *refracted = bent(d, n, eta);
    return part;
}

static void arrive(const scalar_world *world, branch b, const hit *h, vec *sum);

static void follow(const scalar_world *world, const branch *b, vec *sum)
{
    const hit h = NAME(closest)(world, &b->r);
    arrive(world, *b, &h, sum);
}

/* The refracted ray with all that comes of it, then the mirror ray. */
static void go_on(const scalar_world *world, const branch *b, const surface *s, vec *sum)
{
    const rt_material *m = s->material;
    const vec d = b->r.direction;
    real mirror_weight = (real)m->reflect;
    branch next = *b;
    ++next.samples.step;
    if (m->transmit > 0.0f) {
        const real eta = s->from_outside ? 1 / (real)m->ior : (real)m->ior;
        vec refracted;
        const real part = split(s, d, eta, &refracted);
        next.weight = b->weight * ((real)m->transmit * (1 - part));
        if (next.weight >= LEAST_WEIGHT) {
            next.medium = s->from_outside ? s->material_index : -1;
            next.r = (ray){NAME(start)(s, times(s->facing, -1)), refracted, 0, INFINITY};
            follow(world, &next, sum);
        }
        mirror_weight = FMA((real)m->transmit, part, (real)m->reflect);
    }
    next.weight = b->weight * mirror_weight;
    if (next.weight >= LEAST_WEIGHT) {
        next.medium = b->medium;
        next.r = (ray){NAME(start)(s, s->facing), mirrored(s, d), 0, INFINITY};
        follow(world, &next, sum);
    }
}

static void arrive(const scalar_world *world, branch b, const hit *h, vec *sum)
{
    const rt_scene *scene = world->scene;
    pass(scene, &b, h->t, sum);
    if (h->primitive == RT_MISS) {
        add(sum, &b, background(scene, b.r.direction));
        return;
    }
    const surface s = NAME(surface_at)(scene, &b.r, h);
    add(sum, &b, NAME(local_color)(world, &s, b.r.direction, &b.samples));
    if (b.samples.step < (uint32_t)scene->depth)
        go_on(world, &b, &s, sum);
}

vec NAME(radiance)(const scalar_world *world, const ray *r, const hit *h, const stream *samples)
{
    vec sum = {0, 0, 0};
    const branch b = {*r, 1, {1, 1, 1}, -1, *samples};
    arrive(world, b, h, &sum);
    return sum;
}
