/* Stage 3, after the probes where there are some: from hits to colours, by Phong's formula as it
 * was written (Phong 1975):
 *
 *     I = Ia ka + sum over lights of Ip (kd max(0, N.L) + ks max(0, R.V)^n)
 *
 * with R the mirror of L about N and V toward the eye, all unit. The sign of N.L does not gate the
 * highlight. Few branches: runtimes then vectorise across work-items. */

/* x to a whole power by repeated squaring, lowest bit first: the same bits on every device. A
 * library's pow takes longer than tracing the ray. 0 to the power of 0 is 1. */
INLINE number power_whole(number x, int exponent)
{
    number result = 1.0f;
#pragma unroll
    for (int bit = 0; bit < RT_SHININESS_BITS; ++bit) {
        result = (exponent >> bit) & 1 ? result * x : result;
        x = x * x;
    }
    return result;
}

INLINE number highlight(number cosine, int exponent, number shininess)
{
    const number whole = power_whole(cosine, exponent);
#if RT_SHININESS_FRACTION
    /* 3 ulp each for log2 and exp2: at most 1e-5 of the result wherever it is above 1e-6. */
    return exponent >= 0 ? whole : exp2(shininess * log2(cosine));
#else
    return whole;
#endif
}

#if RT_SPHERES || RT_TRIANGLES
/* What one light adds at a surface of a material whose kd is given; `open` is the part of it that
 * is not in shadow. */
INLINE void add_light(const rt_light light, const rt_material m, vec3 kd, const surface *s,
                      vec3 direction, number open, vec3 *color)
{
    const vec3 normal = s->normal;
    const number w = -light.w;
    const vec3 place = {light.x, light.y, light.z};
    vec3 l = ADD_SCALED(s->point, w, place);
    make_unit(&l);
    /* A light exactly at the point has no direction and gives nothing. */
    const number lit = isfinite(l.x) ? 1.0f : 0.0f;
    const number n_dot_l = DOT(normal, l);
    const number twice = 2.0f * n_dot_l;
    const vec3 mirrored = {fma(twice, normal.x, -l.x), fma(twice, normal.y, -l.y),
                           fma(twice, normal.z, -l.z)};
    const number r_dot_v = -DOT(mirrored, direction);
    const number diffuse = lit * (n_dot_l > 0.0f ? n_dot_l : 0.0f);
    const number specular =
        lit * highlight(r_dot_v > 0.0f ? r_dot_v : 0.0f, m.exponent, m.shininess);
    color->x = fma((number)light.r * open, fma((number)m.ks_r, specular, kd.x * diffuse), color->x);
    color->y = fma((number)light.g * open, fma((number)m.ks_g, specular, kd.y * diffuse), color->y);
    color->z = fma((number)light.b * open, fma((number)m.ks_b, specular, kd.z * diffuse), color->z);
}
#endif

/* ambient light's row in `open` comes after the lights'. */
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS, 1, 1))) void
rt_shade(TRACED_PARAMETERS, __global const int *material_of, __global const rt_material *materials,
         __global const rt_light *lights, const int light_count, const rt_surround surround,
         __global float *colors
#if RT_GRADIENT
         ,
         const rt_gradient gradient
#endif
#if RT_FOG
         ,
         const rt_fog fog
#endif
#if RT_TEXTURE
         ,
         __global const int *uvs_of, __global const float *uvs, __global const rt_texture *textures,
         __global const uint *texels
#endif
#if RT_PROBES
         ,
         __global const int *open
#endif
#if RT_AMBIENT_OCCLUSION
         ,
         const rt_crevice crevice
#endif
#if RT_NEXT
         ,
         const int depth, __global const int *home, __global number *paths, __global int *marks,
         __global number *next_rays, __global int *next_home
#endif
#if RT_REFRACT
         ,
         __global number *waiting, __global int *waiting_marks
#endif
#if RT_SWITCHED
         ,
         const int flags
#endif
)
{
    const size_t i = get_global_id(0);
    const size_t step = (size_t)stride;
#if RT_NEXT
    if (!(rays[RT_RAY_TMIN * step + i] < rays[RT_RAY_TMAX * step + i])) {
        next_rays[RT_RAY_TMIN * step + i] = 0.0f;
        next_rays[RT_RAY_TMAX * step + i] = -1.0f;
        return;
    }
#endif
#if RT_NEXT
    const int slot = home[i];
    next_ray from;
    from.weight = paths[RT_PATH_WEIGHT * step + (size_t)slot];
    from.tint = LOAD3(paths + RT_PATH_TINT_R * step, step, (size_t)slot);
    from.bounce = marks[RT_MARK_BOUNCE * step + (size_t)slot];
    from.medium = RT_REFRACT ? marks[RT_MARK_MEDIUM * step + (size_t)slot] : RT_OUTSIDE;
#endif
    vec3 color = {surround.background_r, surround.background_g, surround.background_b};
#if RT_GRADIENT
    if (ON(GRADIENT)) {
        const vec3 d = LOAD3(rays + RT_RAY_DX * step, step, i);
        const vec3 up = {gradient.up_x, gradient.up_y, gradient.up_z};
        const number rise = fma((number)0.5f, DOT(d, up), (number)0.5f);
        const vec3 top = {gradient.top_r, gradient.top_g, gradient.top_b};
        const vec3 difference = SUB(vec3, top, color);
        color = ADD_SCALED(difference, rise, color);
    }
#endif
    int index = RT_MISS;
#if RT_SPHERES || RT_TRIANGLES
    index = hit_index[i];
    surface s;
    vec3 direction;
    rt_material m;
    int material = 0;
    if (index != RT_MISS) {
        const traced w = TRACED;
        direction = LOAD3(rays + RT_RAY_DX * step, step, i);
        surface_of(&w, i, index, direction, &s);
        material = material_of[index];
        m = materials[material];
        vec3 ka = {m.ka_r, m.ka_g, m.ka_b};
        vec3 kd = {m.kd_r, m.kd_g, m.kd_b};
#if RT_CHECKER
        if (ON(CHECKER) && m.cell > 0.0f && in_odd_cell(s.point, (number)m.cell)) {
            const vec3 tone = {m.checker_r, m.checker_g, m.checker_b};
            ka = MULTIPLY(ka, tone);
            kd = MULTIPLY(kd, tone);
        }
#endif
#if RT_TEXTURE
        if (ON(TEXTURE) && m.texture >= 0) {
            const pictures p = {uvs_of, uvs, textures, texels};
            number x, y;
            vec3 tone;
            picture_point(&p, &w, i, index, &s, &x, &y);
            picture_color(&p, textures[m.texture], m.nearest, x, y, &tone);
            ka = MULTIPLY(ka, tone);
            kd = MULTIPLY(kd, tone);
        }
#endif
        const vec3 ambient = {surround.ambient_r, surround.ambient_g, surround.ambient_b};
        color = MULTIPLY(ambient, ka);
#if RT_AMBIENT_OCCLUSION
        if (ON(AMBIENT_OCCLUSION)) {
            const number part = (number)open[(size_t)light_count * step + i];
            color = SCALE(color, part / (number)crevice.samples);
        }
#endif
        for (int k = 0; k < light_count; ++k) {
            const rt_light light = lights[k];
            number free = 1.0f;
#if RT_SHADOWS
            if (ON(SHADOWS) && light.shadow)
                free = (number)open[(size_t)k * step + i] / (number)light.samples;
#endif
            add_light(light, m, kd, &s, direction, free, &color);
        }
    }
#endif
#if RT_ABSORB
    if (ON(ABSORB) && from.medium != RT_OUTSIDE) {
        const rt_material in = materials[from.medium];
        const number t = hit_array[RT_HIT_T * step + i];
        from.tint.x *= in.absorb_r > 0.0f ? exp((number)-in.absorb_r * t) : (number)1.0f;
        from.tint.y *= in.absorb_g > 0.0f ? exp((number)-in.absorb_g * t) : (number)1.0f;
        from.tint.z *= in.absorb_b > 0.0f ? exp((number)-in.absorb_b * t) : (number)1.0f;
    }
#endif
#if RT_FOG
    number clear = 1.0f; /* the part that the fog on the ray's way lets through */
#if RT_NEXT
    if (ON(FOG) && from.medium == RT_OUTSIDE)
#else
    if (ON(FOG))
#endif
    {
        const number t = hit_array[RT_HIT_T * step + i];
        clear = index == RT_MISS ? (number)0.0f : exp((number)-fog.density * t);
        const vec3 veil = {fog.r, fog.g, fog.b};
        const vec3 thin = SCALE(veil, (number)1.0f - clear);
        color = ADD_SCALED(color, clear, thin);
    }
#endif
#if RT_NEXT
    const vec3 part = SCALE(from.tint, from.weight);
    const vec3 sum = LOAD3(colors, step, (size_t)slot);
    color = (vec3){fma(part.x, color.x, sum.x), fma(part.y, color.y, sum.y),
                   fma(part.z, color.z, sum.z)};
    STORE3(color, colors, step, (size_t)slot);
    if (!ON(NEXT))
        return;
#if RT_FOG
    from.tint = SCALE(from.tint, clear);
#endif
    next_ray r;
    int has = 0;
#if RT_SPHERES || RT_TRIANGLES
    if (index != RT_MISS && from.bounce < depth) {
        number reflected_part = m.reflect;
#if RT_REFRACT
        next_ray aside;
        has = send_refracted(direction, &s, m, material, &from, &r, &reflected_part);
        if (send_mirrored(direction, &s, reflected_part, &from, has ? &aside : &r)) {
            if (has)
                push_waiting(waiting, waiting_marks, marks, step, slot, &aside);
            has = 1;
        }
#else
        has = send_mirrored(direction, &s, reflected_part, &from, &r);
#endif
    }
#endif
#if RT_REFRACT
    if (!has)
        has = pop_waiting(waiting, waiting_marks, marks, step, slot, &r);
#endif
    if (has) {
        store_next(next_rays, next_home, step, i, slot, paths, marks, &r);
    } else {
        next_rays[RT_RAY_TMIN * step + i] = 0.0f;
        next_rays[RT_RAY_TMAX * step + i] = -1.0f;
    }
#elif RT_SUM
    const vec3 sum = LOAD3(colors, step, i);
    color = (vec3){color.x + sum.x, color.y + sum.y, color.z + sum.z};
    STORE3(color, colors, step, i);
#else
    STORE3(color, colors, step, i);
#endif
}
