/* Stage 3: from hits to colours, by Phong's formula as it was written (Phong 1975):
 *
 *     I = Ia ka + sum over lights of Ip (kd max(0, N.L) + ks max(0, R.V)^n)
 *
 * with R the mirror of L about N and V toward the eye, all unit. The sign of N.L does not gate the
 * highlight. Few branches: runtimes then vectorise across work-items. */

/* x to a whole power by repeated squaring, lowest bit first: the same bits on every device. A
 * library's pow takes longer than tracing the ray. 0 to the power of 0 is 1. */
INLINE float power_whole(float x, int exponent)
{
    float result = 1.0f;
#pragma unroll
    for (int bit = 0; bit < RT_SHININESS_BITS; ++bit) {
        result = (exponent >> bit) & 1 ? result * x : result;
        x = x * x;
    }
    return result;
}

INLINE float highlight(float cosine, int exponent, float shininess)
{
    const float whole = power_whole(cosine, exponent);
#if RT_SHININESS_FRACTION
    /* 3 ulp each for log2 and exp2: at most 1e-5 of the result wherever it is above 1e-6. */
    return exponent >= 0 ? whole : exp2(shininess * log2(cosine));
#else
    return whole;
#endif
}

__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_shade(const int stride, __global const number *rays, __global const int *hit_index,
         __global const int *hit_slot, __global const number *hit_array,
         __global const rt_sphere_block *spheres, const int sphere_count,
         __global const rt_triangle_block *triangles, __global const int *material_of,
         __global const int *normals_of, __global const float *normals,
         __global const rt_material *materials, __global const rt_light *lights,
         const int light_count, const rt_surround surround, __global float *colors)
{
    const size_t i = get_global_id(0);
    const size_t step = (size_t)stride;
    vec3 color = {surround.background_r, surround.background_g, surround.background_b};

#if RT_SPHERES || RT_TRIANGLES
    const int index = hit_index[i];
    if (index != RT_MISS) {
        const int slot = hit_slot[i];
        const vec3 origin = LOAD3(rays, stride, i);
        const vec3 direction = LOAD3(rays + RT_RAY_DX * step, stride, i);
        const number t = hit_array[RT_HIT_T * step + i];
        const int place = slot % RT_BLOCK_PRIMITIVES;
        surface s;
        s.point = (vec3){fma(t, direction.x, origin.x), fma(t, direction.y, origin.y),
                         fma(t, direction.z, origin.z)};
#if RT_SPHERES
        if (index < sphere_count)
            sphere_surface(spheres + slot / RT_BLOCK_PRIMITIVES, place, direction, &s);
#endif
#if RT_SPHERES && RT_TRIANGLES
        else
#endif
#if RT_TRIANGLES
        {
            const number u = hit_array[RT_HIT_U * step + i];
            const number v = hit_array[RT_HIT_V * step + i];
            triangle_surface(triangles + slot / RT_BLOCK_PRIMITIVES, place, u, v, direction, &s);
#if RT_SMOOTH
            const int record = normals_of[index - sphere_count];
            if (record >= 0)
                smooth_normal(normals + (size_t)record * RT_NORMAL_COMPONENTS, u, v, &s.normal);
#endif
        }
#endif
        const vec3 point = s.point, normal = s.normal;
        const rt_material m = materials[material_of[index]];
        color = (vec3){surround.ambient_r * m.ka_r, surround.ambient_g * m.ka_g,
                       surround.ambient_b * m.ka_b};
        for (int k = 0; k < light_count; ++k) {
            const rt_light light = lights[k];
            vec3 l = {fma(-light.w, point.x, light.x), fma(-light.w, point.y, light.y),
                      fma(-light.w, point.z, light.z)};
            make_unit(&l);
            /* A light exactly at the point has no direction and gives nothing. */
            const float lit = isfinite(l.x) ? 1.0f : 0.0f;
            const number n_dot_l = DOT(normal, l);
            const number twice = 2.0f * n_dot_l;
            const vec3 mirrored = {fma(twice, normal.x, -l.x), fma(twice, normal.y, -l.y),
                                   fma(twice, normal.z, -l.z)};
            const number r_dot_v = -DOT(mirrored, direction);
            const float diffuse = lit * (n_dot_l > 0.0f ? n_dot_l : 0.0f);
            const float specular =
                lit * highlight(r_dot_v > 0.0f ? r_dot_v : 0.0f, m.exponent, m.shininess);
            color.x = fma(light.r, fma(m.ks_r, specular, m.kd_r * diffuse), color.x);
            color.y = fma(light.g, fma(m.ks_g, specular, m.kd_g * diffuse), color.y);
            color.z = fma(light.b, fma(m.ks_b, specular, m.kd_b * diffuse), color.z);
        }
    }
#endif
    colors[i] = color.x;
    colors[step + i] = color.y;
    colors[2 * step + i] = color.z;
}
