/* The surfaces of the scalar reference: what is known of the point that a ray hits, and where the
 * rays start that go on from there.
 *
 * A start comes from the primitive, since t would bring in the error of the whole way, and stands
 * off it by what rounding can do at most: a multiple of half an ulp of the numbers that went in
 * (kernels/shading/surface.cl says which roundings those are). */
#include "reference/effects.h"

void NAME(face)(surface *s, vec outward, vec direction)
{
    s->from_outside = !(dot(outward, direction) > 0);
    s->facing = s->from_outside ? outward : times(outward, -1);
    s->normal = s->facing;
}

static real limited(real x, real least, real most)
{
    const real high = x > least ? x : least;
    return high < most ? high : most;
}

vec NAME(into_box)(vec point, vec lo, vec hi)
{
    return (vec){limited(point.x, lo.x, hi.x), limited(point.y, lo.y, hi.y),
                 limited(point.z, lo.z, hi.z)};
}

real NAME(lift_for)(real bound, vec sizes, vec normal)
{
    return bound * dot(sizes, magnitudes(normal));
}

surface NAME(surface_at)(const rt_scene *scene, const ray *r, const hit *h)
{
    surface s = {.material = NULL};
    size_t i = (size_t)h->primitive;
    const enum rt_kind kind = rt_scene_kind_of(scene, &i);
    switch (kind) {
#define SURFACE_OF(name, names, NAMES)                                                             \
    case RT_KIND_##NAMES:                                                                          \
        s = NAME(surface_of_##name)(scene, r, i, h);                                               \
        break;
        RT_KINDS(SURFACE_OF)
    case RT_KIND_COUNT:
        break;
    }
    s.material_index = scene->kinds[kind].materials[i];
    s.material = &scene->materials[s.material_index];
    return s;
}

vec NAME(start)(const surface *s, vec side)
{
    const bool is_above = dot(s->facing, side) > 0;
    return add_scaled(s->facing, is_above ? s->lift : -s->lift, s->foot);
}
