/* Stage 2: from a ray array to a hit array, RT_LANES rays a work-item. Rendering, tests and
 * benchmarks all launch this kernel: what is tested is what renders. */

__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_LANES, 1, 1))) void
rt_trace(const int stride, __global const float *ray_array, __global const rt_sphere *spheres,
         const int sphere_count, __global const rt_triangle *triangles, const int triangle_count,
         __global int *hit_index, __global float *hit_array)
{
    const size_t step = (size_t)stride;
    const size_t first = get_global_id(0) * RT_LANES;
    __global const float *source = ray_array + first;
    rays r;
    r.origin.x = LOAD_REAL(source + RT_RAY_OX * step);
    r.origin.y = LOAD_REAL(source + RT_RAY_OY * step);
    r.origin.z = LOAD_REAL(source + RT_RAY_OZ * step);
    r.direction.x = LOAD_REAL(source + RT_RAY_DX * step);
    r.direction.y = LOAD_REAL(source + RT_RAY_DY * step);
    r.direction.z = LOAD_REAL(source + RT_RAY_DZ * step);
    r.tmin = LOAD_REAL(source + RT_RAY_TMIN * step);
    r.dd = DOT(r.direction, r.direction);
    r.inv_dd = DIVIDE((real)1.0f, r.dd);

    const real tmax = LOAD_REAL(source + RT_RAY_TMAX * step);
    hits h;
    h.index = (mask)RT_MISS;
    h.t = tmax;
    h.u = (real)0.0f;
    h.v = (real)0.0f;
    closest_hit(&r, &h, spheres, sphere_count, triangles, triangle_count);

    /* A miss has an infinite t, whatever tmax was. */
    const real t = SELECT(h.t, (real)INFINITY, MASK(h.index == (mask)RT_MISS));
    STORE_MASK(h.index, hit_index + first);
    STORE_REAL(t, hit_array + first + RT_HIT_T * step);
    STORE_REAL(h.u, hit_array + first + RT_HIT_U * step);
    STORE_REAL(h.v, hit_array + first + RT_HIT_V * step);
}
