/* From rays to their nearest hits over all primitives: the one place that decides the order in
 * which primitives are offered. The result does not depend on that order (least t, then lowest
 * index), so a tree can stand here without a change anywhere else. */

void closest_hit(const rays *r, hits *h, __global const rt_sphere *spheres, int sphere_count,
                 __global const rt_triangle *triangles, int triangle_count)
{
#if RT_SPHERES
    for (int i = 0; i < sphere_count; ++i)
        hit_sphere(r, h, spheres[i], i);
#endif
#if RT_TRIANGLES
    for (int i = 0; i < triangle_count; ++i)
        hit_triangle(r, h, triangles[i], sphere_count + i);
#endif
}
