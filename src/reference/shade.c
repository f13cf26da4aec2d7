/* The local light of the scalar reference: Phong's formula, what stands in the way of each light,
 * and how open the surroundings are. */
#include "reference/effects.h"

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

/* Unit, from the surface to the light's centre; not finite for a light exactly at the point. */
static vec way_to(const rt_light *light, const surface *s)
{
    const vec place = vec_of(light->x, light->y, light->z);
    return unit(light->w != 0.0f ? minus(place, s->point) : place);
}

/* Whether anything keeps a light's rays from a surface. */
static bool in_the_way(const scalar_world *world, const ray *shadow)
{
    if (world->counts)
        world->counts->shadow += shadow->tmax > 0;
    return NAME(occluded)(world, shadow);
}

/* Whether something is between `from` and the point `to` of a light. */
static bool is_hidden(const scalar_world *world, const rt_light *light, vec from, vec to)
{
    const vec way = minus(to, from);
    const vec direction = unit(way);
    const ray shadow = {from, direction, 0, dot(way, direction) * (1 - (real)light->gap)};
    return in_the_way(world, &shadow);
}

/* The part of the light number `index` that reaches the surface, 0 to 1. */
static real visibility(const scalar_world *world, int index, const surface *s, vec to_light,
                       const stream *samples)
{
    const rt_light *light = &world->scene->lights[index];
    if (!light->shadow)
        return 1;
    const vec from = NAME(start)(s, to_light);
    if (light->w == 0.0f) {
        const ray shadow = {from, to_light, 0, INFINITY};
        return in_the_way(world, &shadow) ? 0 : 1;
    }
    const vec center = vec_of(light->x, light->y, light->z);
    if (!(light->radius > 0.0f))
        return is_hidden(world, light, from, center) ? 0 : 1;
    /* The ball is seen as a disk at right angles to the way there. */
    vec t1, t2;
    NAME(axes_about)(to_light, &t1, &t2);
    const uint32_t count = (uint32_t)light->samples;
    const uint32_t purpose = FOR_LIGHT + (uint32_t)index, first = samples->sample * count;
    uint32_t open = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const pair p = NAME(disk)(NAME(sample_point)(samples, purpose, first + i));
        const vec across = add_scaled(t1, (real)light->radius * p.x, center);
        const vec target = add_scaled(t2, (real)light->radius * p.y, across);
        open += !is_hidden(world, light, from, target);
    }
    return (real)open / (real)count;
}

/* The part of the surroundings, weighed by the cosine, from which ambient light can come. */
static real openness(const scalar_world *world, const surface *s, const stream *samples)
{
    const rt_scene *scene = world->scene;
    if (scene->occlusion_samples == 0)
        return 1;
    const uint32_t count = (uint32_t)scene->occlusion_samples;
    const uint32_t first = samples->sample * count;
    const vec from = NAME(start)(s, s->facing);
    uint32_t open = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const pair square = NAME(sample_point)(samples, FOR_OCCLUSION, first + i);
        const vec direction = NAME(hemisphere)(square, s->normal);
        if (!(dot(direction, s->facing) > 0))
            continue; /* a smooth normal leans over: this way lies the surface itself */
        const ray probe = {from, direction, 0, (real)scene->occlusion_distance};
        if (world->counts)
            ++world->counts->occlusion;
        open += !NAME(occluded)(world, &probe);
    }
    return (real)open / (real)count;
}

/* What a light of the strength 1 adds in each channel. */
static vec phong(const rt_material *m, vec pattern, vec normal, vec to_light, vec direction)
{
    const real n_dot_l = dot(normal, to_light);
    const vec mirrored = add_scaled(normal, 2 * n_dot_l, times(to_light, -1));
    const real r_dot_v = -dot(mirrored, direction);
    const real diffuse = n_dot_l > 0 ? n_dot_l : 0;
    const real specular = power(r_dot_v > 0 ? r_dot_v : 0, m);
    const vec kd = product(vec_of(m->kd_r, m->kd_g, m->kd_b), pattern);
    return add_scaled(vec_of(m->ks_r, m->ks_g, m->ks_b), specular, times(kd, diffuse));
}

vec NAME(local_color)(const scalar_world *world, const surface *s, vec direction,
                      const stream *samples)
{
    const rt_scene *scene = world->scene;
    const rt_material *m = s->material;
    const vec pattern = NAME(pattern)(scene, s);
    const vec ambient = vec_of(scene->ambient.x, scene->ambient.y, scene->ambient.z);
    const vec ka = product(vec_of(m->ka_r, m->ka_g, m->ka_b), pattern);
    vec color = times(product(ambient, ka), openness(world, s, samples));
    for (int i = 0; i < (int)scene->light_count; ++i) {
        const rt_light *light = &scene->lights[i];
        const vec to_light = way_to(light, s);
        if (!isfinite(to_light.x))
            continue;
        const vec seen =
            times(vec_of(light->r, light->g, light->b), visibility(world, i, s, to_light, samples));
        const vec part = phong(m, pattern, s->normal, to_light, direction);
        color = (vec){FMA(seen.x, part.x, color.x), FMA(seen.y, part.y, color.y),
                      FMA(seen.z, part.z, color.z)};
    }
    return color;
}
