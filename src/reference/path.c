/* The paths of the scalar reference: what a ray brings back from what it hits, and from the mirror
 * and refracted rays that leave from there. */
#include <string.h>

#include "reference/effects.h"

/* What weighs less cannot be seen: half of an 8-bit step of white is 1/510. */
#define LEAST_WEIGHT ((real)1 / 512)

/* A ray on its way, and what is left of the light that comes along it. */
typedef struct branch {
    ray r;
    real weight;    /* what reflect, transmit and Fresnel leave */
    vec tint;       /* what fog and absorption leave */
    stream samples; /* its step counts the rays before this one */
    int depth;      /* bodies that the ray is inside of, and their media, innermost last */
    int32_t inside[RT_NESTING_MOST];
} branch;

static void add(vec *sum, const branch *b, vec color)
{
    sum->x = FMA(b->weight * b->tint.x, color.x, sum->x);
    sum->y = FMA(b->weight * b->tint.y, color.y, sum->y);
    sum->z = FMA(b->weight * b->tint.z, color.z, sum->z);
}

/* The medium that the ray runs in, 0 for the open. */
static int32_t medium_of(const branch *b)
{
    return b->depth > 0 ? b->inside[b->depth - 1] : 0;
}

/* Where there is no room the outermost body is forgotten. */
static void enter(const scalar_world *world, branch *b, int32_t medium)
{
    if (b->depth == world->media.nesting) {
        --b->depth;
        memmove(b->inside, b->inside + 1, (size_t)b->depth * sizeof *b->inside);
    }
    b->inside[b->depth++] = medium;
}

/* Forgets the innermost body of a medium; false where the ray is in none. */
static bool leave(branch *b, int32_t medium)
{
    int i = b->depth - 1;
    while (i >= 0 && b->inside[i] != medium)
        --i;
    if (i < 0)
        return false;
    --b->depth;
    memmove(b->inside + i, b->inside + i + 1, (size_t)(b->depth - i) * sizeof *b->inside);
    return true;
}

/* Beer's law. Without absorption nothing is lost on an endless way either. */
static real left_after(real density, real way)
{
    return density > 0 ? EXP(-density * way) : 1;
}

/* What happens on the way of length t, which may be infinite. */
static void pass(const scalar_world *world, branch *b, real t, vec *sum)
{
    vec left = {1, 1, 1};
    if (b->depth > 0) {
        const rt_medium *m = &world->media.list[medium_of(b)];
        left = (vec){left_after((real)m->absorb_r, t), left_after((real)m->absorb_g, t),
                     left_after((real)m->absorb_b, t)};
    } else {
        const rt_scene *scene = world->scene;
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

/* Which rays are followed of those that leave a hit, and how much they bring. */
typedef struct route {
    real mirrored, refracted;
} route;

/* At `step` rays from the camera, a part of light that weighs less than this is followed by
 * chance, and then weighs so much. */
static real quantum(uint32_t step)
{
    const real doubled = LDEXP(LEAST_WEIGHT, (int)(step < 100 ? step : 100) / 4);
    return doubled < 1 ? doubled : 1;
}

/* One of both, as likely as its part of them is, with the weight `all`. */
static route one_of(route r, real all, real random)
{
    if (random * (r.mirrored + r.refracted) < r.mirrored)
        return (route){all, 0};
    return (route){0, all};
}

/* Russian roulette and splitting. `most` is the most that is left of any colour of the light on
 * its way; weights times that are what can be seen. What is lost on average is nothing, and where
 * all of the light goes on, all of it does in each single case. */
static route chosen(route r, real most, uint32_t step, pair random)
{
    const real all = r.mirrored + r.refracted, seen = all * most;
    const real q = quantum(step), chance = random.x + (real)0x1p-25;
    if (seen < LEAST_WEIGHT)
        return chance * LEAST_WEIGHT < seen ? one_of(r, LEAST_WEIGHT / most, random.y)
                                            : (route){0, 0};
    const real a = r.mirrored * most, b = r.refracted * most;
    if (seen < 2 * q || a == 0 || b == 0)
        return one_of(r, all, random.y);
    if (a >= q && b >= q)
        return r;
    const real follow = chance * q < (a < b ? a : b) ? q / most : 0;
    return a < b ? (route){follow, all - follow} : (route){all - follow, follow};
}

/* The ray that leaves a surface on the side that `side` points to. */
static branch sent(const branch *b, const surface *s, vec side, vec direction, real weight)
{
    branch next = *b;
    ++next.samples.step;
    next.weight = weight;
    next.r = (ray){NAME(start)(s, side), direction, 0, INFINITY};
    return next;
}

/* How many rays go on from a surface, the refracted one first, 0 to 2. */
static int go_on(const scalar_world *world, const branch *b, const surface *s, branch next[2])
{
    const rt_material *m = s->material;
    const vec d = b->r.direction;
    rt_ray_counts *counts = world->counts;
    branch behind = *b;
    vec refracted = d;
    route r = {b->weight * (real)m->reflect, 0};
    if (m->transmit > 0.0f) {
        const rt_medium *media = world->media.list;
        const int32_t medium = world->media.of[s->material_index];
        int32_t here = medium_of(b);
        if (s->from_outside)
            enter(world, &behind, medium);
        else if (!leave(&behind, medium))
            here = medium; /* nobody came in by this surface */
        const real eta = (real)media[here].ior / (real)media[medium_of(&behind)].ior;
        const real part = eta == 1 ? 0 : split(s, d, eta, &refracted);
        r.refracted = b->weight * ((real)m->transmit * (1 - part));
        r.mirrored = b->weight * FMA((real)m->transmit, part, (real)m->reflect);
    }
    const real most = FMAX(b->tint.x, FMAX(b->tint.y, b->tint.z));
    const real all = r.mirrored + r.refracted;
    if (!(all > 0))
        return 0;
    if (b->samples.step >= (uint32_t)world->scene->depth) {
        if (counts) {
            ++counts->cut;
            counts->cut_light += (double)(all * most);
        }
        return 0;
    }
    const pair random = NAME(sample_point)(&b->samples, FOR_ROUTE, b->samples.sample);
    r = chosen(r, most, b->samples.step, random);
    int count = 0;
    if (counts) {
        counts->ended += !(r.mirrored + r.refracted > 0);
        counts->refraction += r.refracted > 0;
        counts->reflection += r.mirrored > 0;
    }
    if (r.refracted > 0)
        next[count++] = sent(&behind, s, times(s->facing, -1), refracted, r.refracted);
    if (r.mirrored > 0)
        next[count++] = sent(b, s, s->facing, mirrored(s, d), r.mirrored);
    return count;
}

/* All that comes of a branch that meets `h`. */
static void follow(const scalar_world *world, branch b, hit h, vec *sum)
{
    for (;;) {
        pass(world, &b, h.t, sum);
        if (h.primitive == RT_MISS) {
            add(sum, &b, background(world->scene, b.r.direction));
            return;
        }
        const surface s = NAME(surface_at)(world->scene, &b.r, &h);
        add(sum, &b, NAME(local_color)(world, &s, b.r.direction, &b.samples));
        branch next[2];
        const int count = go_on(world, &b, &s, next);
        if (count == 0)
            return;
        if (count == 2)
            follow(world, next[0], NAME(closest)(world, &next[0].r), sum);
        b = next[count - 1];
        h = NAME(closest)(world, &b.r);
    }
}

vec NAME(radiance)(const scalar_world *world, const ray *r, const hit *h, const stream *samples)
{
    vec sum = {0, 0, 0};
    branch b = {.r = *r, .weight = 1, .tint = {1, 1, 1}, .samples = *samples};
    b.depth = world->media.eye_count;
    memcpy(b.inside, world->media.eye, sizeof b.inside);
    follow(world, b, *h, &sum);
    return sum;
}
