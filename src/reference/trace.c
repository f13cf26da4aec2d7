/* The geometry of the scalar reference: rays against primitives. */
#include "reference/margins.h"
#include "reference/real.h"

/* Where the ray is within an axis's slab, and no longer; a direction of 0 counts as the smallest.
 */
static void slab(real origin, real direction, real lo, real hi, real *enter, real *leave)
{
    real inverse = (real)1 / direction;
    if (inverse > REAL_MAX)
        inverse = REAL_MAX;
    if (inverse < -REAL_MAX)
        inverse = -REAL_MAX;
    const real t0 = (lo - origin) * inverse, t1 = (hi - origin) * inverse;
    const real near = t0 < t1 ? t0 : t1, far = t0 < t1 ? t1 : t0;
    *enter = near > *enter ? near : *enter;
    *leave = far < *leave ? far : *leave;
}

void NAME(part_in_box)(const rt_scene *scene, const ray *r, vec lo, vec hi, real *enter,
                       real *leave)
{
    *enter = -INFINITY;
    *leave = INFINITY;
    slab(r->origin.x, r->direction.x, lo.x, hi.x, enter, leave);
    slab(r->origin.y, r->direction.y, lo.y, hi.y, enter, leave);
    slab(r->origin.z, r->direction.z, lo.z, hi.z, enter, leave);
    *leave = *leave * (real)(is_robust(scene) ? SLAB_MARGIN_ROBUST : SLAB_MARGIN);
}

/* In float also where the rest is in double: that is what primitives are made of. */
void NAME(box)(const rt_scene *scene, int primitive, vec *lo, vec *hi)
{
    float low[3] = {0}, high[3] = {0}, margin[3];
    size_t i = (size_t)primitive;
    switch (rt_scene_kind_of(scene, &i)) {
#define BOX_OF(name, names, NAMES)                                                                 \
    case RT_KIND_##NAMES:                                                                          \
        NAME(box_of_##name)(&scene->names[i], low, high);                                          \
        break;
        RT_KINDS(BOX_OF)
    case RT_KIND_COUNT:
        break;
    }
    for (int k = 0; k < 3; ++k)
        margin[k] = (fabsf(low[k]) + fabsf(high[k])) * BOX_MARGIN;
    if (is_robust(scene))
        margin[0] = margin[1] = margin[2] = fmaxf(margin[0], fmaxf(margin[1], margin[2]));
    *lo = vec_of(low[0] - margin[0], low[1] - margin[1], low[2] - margin[2]);
    *hi = vec_of(high[0] + margin[0], high[1] + margin[1], high[2] + margin[2]);
}

/* Takes a hit if it is nearer than the best, or as near and of a lower index. Rounding can put t
 * outside of the primitive, far outside for slivers and grazing rays: it is kept within the ray's
 * part in the primitive's box, and a ray that does not meet the box does not meet the primitive. */
static void take(const rt_scene *scene, const ray *r, hit candidate, hit *best)
{
    vec lo, hi;
    real enter, leave;
    NAME(box)(scene, candidate.primitive, &lo, &hi);
    NAME(part_in_box)(scene, r, lo, hi, &enter, &leave);
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

void NAME(meet)(const rt_scene *scene, const ray *r, int primitive, hit *best)
{
    hit h = {primitive, 0, 0, 0};
    bool is_met = false;
    size_t i = (size_t)primitive;
    switch (rt_scene_kind_of(scene, &i)) {
#define MEET(name, names, NAMES)                                                                   \
    case RT_KIND_##NAMES:                                                                          \
        is_met = NAME(meet_##name)(scene, r, i, &h);                                               \
        break;
        RT_KINDS(MEET)
    case RT_KIND_COUNT:
        break;
    }
    if (is_met)
        take(scene, r, h, best);
}
