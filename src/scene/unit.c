/* A scene's unit of length: a power of two that brings its coordinates to where products of three
 * of them neither overflow nor vanish. Multiplying by it is exact, so nothing else changes. */
#include <math.h>

#include "scene/scene.h"

/* Exponents of the largest coordinate that are left as they are: three differences of numbers below
 * 2^38 multiply to 2^117 at most, and differences of 2^-48 still have exact products. */
#define EXPONENT_MIN (-10)
#define EXPONENT_MAX 37
/* What lies outside of the primitives and the eye may be far away: it ends here. A length that is
 * as good as none ends at the inverse, for what is there does not vanish. */
#define EXPONENT_FAR 120

static float largest_of(float a, float b, float c)
{
    return fmaxf(fabsf(a), fmaxf(fabsf(b), fabsf(c)));
}

static float largest_coordinate(const rt_scene *scene)
{
    const rt_vec3 from = scene->camera.from;
    float most = largest_of(from.x, from.y, from.z);
    for (int kind = 0; kind < RT_KIND_COUNT; ++kind)
        most = fmaxf(most, rt_primitives_largest(&scene->kinds[kind], (enum rt_kind)kind));
    return most;
}

static void scale(float *x, float *y, float *z, int exponent)
{
    *x = ldexpf(*x, exponent);
    *y = ldexpf(*y, exponent);
    *z = ldexpf(*z, exponent);
}

/* A point that only gives a direction, as seen from the scene: where it would leave the range of
 * numbers it stays on its line from the origin. */
static void scale_far(float *x, float *y, float *z, int exponent)
{
    const float most = largest_of(*x, *y, *z);
    const int room = most > 0.0f ? EXPONENT_FAR - ilogbf(most) : 0;
    scale(x, y, z, exponent < room ? exponent : room);
}

/* A length, or what is per length. */
static float scaled(float value, int exponent)
{
    const float least = value > 0.0f ? ldexpf(1.0f, -EXPONENT_FAR) : 0.0f;
    return fmaxf(least, fminf(ldexpf(value, exponent), ldexpf(1.0f, EXPONENT_FAR)));
}

/* All but the primitives, also by 1, so that nothing is too far away. */
static void scale_surroundings(rt_scene *scene, int exponent)
{
    rt_camera *c = &scene->camera;
    scale(&c->from.x, &c->from.y, &c->from.z, exponent);
    scale_far(&c->at.x, &c->at.y, &c->at.z, exponent);
    c->aperture = scaled(c->aperture, exponent);
    c->focus = scaled(c->focus, exponent);
    scene->fog_density = scaled(scene->fog_density, -exponent);
    scene->occlusion_distance = scaled(scene->occlusion_distance, exponent);
    for (size_t i = 0; i < scene->light_count; ++i) {
        rt_light *l = &scene->lights[i];
        if (l->w != 0.0f)
            scale_far(&l->x, &l->y, &l->z, exponent);
        l->radius = scaled(l->radius, exponent);
    }
    for (size_t i = 0; i < scene->material_count; ++i) {
        rt_material *m = &scene->materials[i];
        m->cell = scaled(m->cell, exponent);
        m->absorb_r = scaled(m->absorb_r, -exponent);
        m->absorb_g = scaled(m->absorb_g, -exponent);
        m->absorb_b = scaled(m->absorb_b, -exponent);
    }
}

void rt_scene_choose_unit(rt_scene *scene)
{
    const float most = largest_coordinate(scene);
    const int exponent = most > 0.0f ? ilogbf(most) : 0;
    const int by = exponent > EXPONENT_MAX   ? EXPONENT_MAX - exponent
                   : exponent < EXPONENT_MIN ? -exponent
                                             : 0;
    scale_surroundings(scene, by);
    for (int kind = 0; kind < RT_KIND_COUNT && by != 0; ++kind)
        rt_primitives_scale(&scene->kinds[kind], (enum rt_kind)kind, by);
    scene->unit_exponent += by;
}
