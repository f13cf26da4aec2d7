#include "common/ray.h"

void rt_ray_counts_add(rt_ray_counts *sum, const rt_ray_counts *more)
{
    sum->primary += more->primary;
    sum->shadow += more->shadow;
    sum->occlusion += more->occlusion;
    sum->reflection += more->reflection;
    sum->refraction += more->refraction;
    sum->ended += more->ended;
    sum->cut += more->cut;
    sum->cut_light += more->cut_light;
}

size_t rt_ray_counts_total(const rt_ray_counts *counts)
{
    return counts->primary + counts->shadow + counts->occlusion + counts->reflection +
           counts->refraction;
}

double rt_ray_counts_cut_part(const rt_ray_counts *counts)
{
    return counts->primary ? counts->cut_light / (double)counts->primary : 0.0;
}
