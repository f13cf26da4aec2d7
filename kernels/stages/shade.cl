/* Stage 3, after the probes where there are some: from hits to colours, by Phong's formula as it
 * was written (Phong 1975):
 *
 *     I = Ia ka + sum over lights of Ip (kd max(0, N.L) + ks max(0, R.V)^n)
 *
 * with R the mirror of L about N and V toward the eye, all unit. The sign of N.L does not gate the
 * highlight.
 *
 * A work-item shades a block of rays where vectors are wide, step by step: compilers turn the loop
 * over the rays into vectors where nothing in it branches or calls, so that pictures and fog, which
 * do, have loops of their own. A block that hits nothing is passed over. Where a ray is a
 * work-item, it branches. */

/* x to a whole power by repeated squaring, lowest bit first: the same bits on every device. A
 * library's pow takes longer than tracing the ray. 0 to the power of 0 is 1. */
INLINE number power_whole(number x, int exponent)
{
    number result = 1.0f;
    float left = exponent;
#pragma unroll
    for (int bit = 0; bit < RT_SHININESS_BITS; ++bit) {
        /* Bits by halving in float: bit tests, which do not depend on each other, make LLVM put
         * them into one small vector, and that keeps it from the large ones across rays. */
        const float half_ = left * 0.5f;
        left = floor(half_);
        result = left != half_ ? result * x : result;
        x = x * x;
    }
    return result;
}

INLINE number highlight(number cosine, int exponent, number shininess)
{
    const number whole = power_whole(cosine, exponent);
    /* 3 ulp each for log2 and exp2: at most 1e-5 of the result wherever it is above 1e-6. Not by
     * way of an infinite logarithm, of which relaxed math takes for granted that there is none. */
    const number power = cosine > (number)0.0f ? exp2(shininess * log2(cosine)) : (number)0.0f;
    return !RT_SHININESS_FRACTION || exponent >= 0 ? whole : power;
}

/* What shading works on, and where it writes to. */
typedef struct shading {
    traced hits;
    __global const int *material_of;
    __global const rt_material *materials;
    __global const rt_light *lights;
    int light_count;
    rt_surround surround;
    __global float *colors;
    rt_gradient gradient;
    rt_fog fog;
    pictures pictures;
    __global const int *open; /* a row a light; ambient light's comes after them */
    rt_crevice crevice;
    __global const int *home;
    __global number *paths;
    __global const int *marks;
    __global const rt_medium *media;
    rt_nesting nesting;
    int flags;
} shading;

/* Of a kernel that has these, for ON(). */
#define FLAGS_OF(w) const int flags = (w)->flags

/* The background as seen along ray i. */
INLINE void sky(const shading *w, size_t i, vec3 *color)
{
    *color = (vec3){w->surround.background_r, w->surround.background_g, w->surround.background_b};
    FLAGS_OF(w);
    if (ON(GRADIENT)) {
        const size_t step = w->hits.step;
        const rt_gradient *g = &w->gradient;
        const vec3 d = LOAD3(w->hits.rays + RT_RAY_DX * step, step, i);
        const vec3 up = {g->up_x, g->up_y, g->up_z};
        const vec3 top = {g->top_r, g->top_g, g->top_b};
        const number rise = fma((number)0.5f, DOT(d, up), (number)0.5f);
        const vec3 difference = SUB(vec3, top, *color);
        *color = ADD_SCALED(difference, rise, *color);
    }
}

/* The vector toward a light, unit. Returns 0 for a light exactly at the point, which has none. */
INLINE int toward_light(__global const rt_light *light, vec3 point, vec3 *l)
{
    const vec3 place = {light->x, light->y, light->z};
    const number w = -light->w;
    *l = ADD_SCALED(point, w, place);
    return make_unit_if_any(l);
}

/* What one light adds at a surface of a material whose kd is given; `free` is the part of it that
 * is not in shadow. */
INLINE void add_light(__global const rt_light *light, __global const rt_material *m, vec3 kd,
                      const surface *s, vec3 direction, number free, vec3 *color)
{
    const vec3 normal = s->normal;
    vec3 l;
    const int has_direction = toward_light(light, s->point, &l);
    const number lit = has_direction ? 1.0f : 0.0f; /* without one it gives nothing */
    const number n_dot_l = DOT(normal, l);
    const number twice = 2.0f * n_dot_l;
    const vec3 mirrored = {fma(twice, normal.x, -l.x), fma(twice, normal.y, -l.y),
                           fma(twice, normal.z, -l.z)};
    const number r_dot_v = -DOT(mirrored, direction);
    const number diffuse = lit * (n_dot_l > 0.0f ? n_dot_l : 0.0f);
    const number specular =
        lit * highlight(r_dot_v > 0.0f ? r_dot_v : 0.0f, m->exponent, m->shininess);
    color->x = fma(light->r * free, fma((number)m->ks_r, specular, kd.x * diffuse), color->x);
    color->y = fma(light->g * free, fma((number)m->ks_g, specular, kd.y * diffuse), color->y);
    color->z = fma(light->b * free, fma((number)m->ks_b, specular, kd.z * diffuse), color->z);
}

/* What the steps of a work-item's shading hand on. `tone` is what ka and kd are multiplied by; of a
 * ray that misses, all is of primitive 0 and is dropped in the end. */
typedef struct shade_item {
    number point[ITEM_VECTORS], normal[ITEM_VECTORS], facing[ITEM_VECTORS], tone[ITEM_VECTORS],
        color[ITEM_VECTORS];
    int outside[RT_ITEM_RAYS];
} shade_item;

INLINE int index_or_first(const shading *w, size_t i)
{
    const int index = w->hits.hit_index[i];
    return index != RT_MISS ? index : 0;
}

INLINE void find_surface(const shading *w, size_t i, shade_item *item, size_t k)
{
    FLAGS_OF(w);
    const size_t step = w->hits.step;
    const int index = index_or_first(w, i);
    const vec3 direction = LOAD3(w->hits.rays + RT_RAY_DX * step, step, i);
    surface s;
    surface_of(&w->hits, i, index, direction, &s);
    STORE_ITEM_VECTOR(s.point, item->point, k);
    STORE_ITEM_VECTOR(s.normal, item->normal, k);
    if (RT_TEXTURE) {
        STORE_ITEM_VECTOR(s.facing, item->facing, k);
        item->outside[k] = s.outside;
    }
    vec3 tone = {1.0f, 1.0f, 1.0f};
    if (ON(CHECKER)) {
        /* Loads and cells of all rays: what only some rays need would be taken ray by ray. */
        __global const rt_material *m = w->materials + w->material_of[index];
        const vec3 other = {m->checker_r, m->checker_g, m->checker_b};
        const int is_odd = (m->cell > 0.0f) & in_odd_cell(&s.within, (number)m->cell);
        tone.x = is_odd ? other.x : (number)1.0f;
        tone.y = is_odd ? other.y : (number)1.0f;
        tone.z = is_odd ? other.z : (number)1.0f;
    }
    STORE_ITEM_VECTOR(tone, item->tone, k);
}

INLINE void paint(const shading *w, size_t i, shade_item *item, size_t k)
{
    const int index = w->hits.hit_index[i];
    if (index == RT_MISS)
        return;
    __global const rt_material *m = w->materials + w->material_of[index];
    if (m->texture < 0)
        return;
    surface s;
    s.facing = ITEM_VECTOR(item->facing, k);
    s.outside = item->outside[k];
    texture_place at;
    vec3 picture;
    picture_point(&w->pictures, &w->hits, i, index, &s, !m->clamp, &at);
    picture_color(&w->pictures, w->pictures.textures[m->texture], m->nearest, &at, &picture);
    const vec3 tone = ITEM_VECTOR(item->tone, k);
    STORE_ITEM_VECTOR(MULTIPLY(tone, picture), item->tone, k);
}

/* The light that the surface sends back along ray i. */
INLINE void light_surface(const shading *w, size_t i, shade_item *item, size_t k)
{
    FLAGS_OF(w);
    const size_t step = w->hits.step;
    const vec3 direction = LOAD3(w->hits.rays + RT_RAY_DX * step, step, i);
    __global const rt_material *m = w->materials + w->material_of[index_or_first(w, i)];
    surface s;
    s.point = ITEM_VECTOR(item->point, k);
    s.normal = ITEM_VECTOR(item->normal, k);
    vec3 ka = {m->ka_r, m->ka_g, m->ka_b};
    vec3 kd = {m->kd_r, m->kd_g, m->kd_b};
    if (RT_CHECKER || RT_TEXTURE) {
        const vec3 tone = ITEM_VECTOR(item->tone, k);
        ka = MULTIPLY(ka, tone);
        kd = MULTIPLY(kd, tone);
    }
    const vec3 ambient = {w->surround.ambient_r, w->surround.ambient_g, w->surround.ambient_b};
    vec3 sum = MULTIPLY(ambient, ka);
    if (ON(AMBIENT_OCCLUSION)) {
        const number part = (number)w->open[(size_t)w->light_count * step + i];
        sum = SCALE(sum, part / (number)w->crevice.samples);
    }
#if RT_LIGHTS >= 0
#pragma unroll
    for (int light_index = 0; light_index < RT_LIGHTS; ++light_index) {
#else
    for (int light_index = 0; light_index < w->light_count; ++light_index) {
#endif
        __global const rt_light *light = w->lights + light_index;
        number free = 1.0f;
        if ((ON(HARD_SHADOWS) || ON(SOFT_SHADOWS)) && light->shadow)
            free = (number)w->open[(size_t)light_index * step + i] / (number)light->samples;
        add_light(light, m, kd, &s, direction, free, &sum);
    }
    STORE_ITEM_VECTOR(sum, item->color, k);
}

/* What fog on a way of length t, infinite for a miss, leaves of a colour; `clear` is the part. */
INLINE void veil(const rt_fog *fog, number t, vec3 *color, number *clear)
{
    *clear = exp(-(number)fog->density * t);
    const vec3 grey = {fog->r, fog->g, fog->b};
    const vec3 thin = SCALE(grey, (number)1.0f - *clear);
    *color = ADD_SCALED(*color, *clear, thin);
}

/* Beer's law; without absorption nothing is lost on an endless way either. */
INLINE number left_after(number density, number t)
{
    return density > (number)0.0f ? exp(-density * t) : (number)1.0f;
}

/* What a ray on its way adds to its pixel: `part` of a colour. The way's losses are put down for
 * the rays that go on. */
INLINE void add_to_path(const shading *w, size_t i, vec3 color)
{
    FLAGS_OF(w);
    const size_t step = w->hits.step;
    const size_t slot = (size_t)w->home[i];
    vec3 tint = LOAD3(w->paths + RT_PATH_TINT_R * step, step, slot);
    int medium = 0;
    if (RT_REFRACT)
        medium = w->marks[RT_MARK_INSIDE_LOW * step + slot] & ((1 << w->nesting.bits) - 1);
    const number t = w->hits.hit_array[RT_HIT_T * step + i];
    number clear = 1.0f;
    if (ON(ABSORB)) {
        __global const rt_medium *in = w->media + medium;
        tint.x *= left_after(in->absorb_r, t);
        tint.y *= left_after(in->absorb_g, t);
        tint.z *= left_after(in->absorb_b, t);
    }
    if (ON(FOG) && medium == 0)
        veil(&w->fog, t, &color, &clear);
    const vec3 part = SCALE(tint, w->paths[RT_PATH_WEIGHT * step + slot]);
    const vec3 sum = LOAD3(w->colors, step, slot);
    STORE3(((vec3){fma(part.x, color.x, sum.x), fma(part.y, color.y, sum.y),
                   fma(part.z, color.z, sum.z)}),
           w->colors, step, slot);
    if (RT_FOG || RT_ABSORB) {
        tint = SCALE(tint, clear);
        STORE3(tint, w->paths + RT_PATH_TINT_R * step, step, slot);
    }
}

/* What becomes of a ray's colour: in a loop of its own where that takes calls or branches. */
#define RT_CALLS_AT_END (RT_FOG || RT_NEXT)
INLINE void put_color(const shading *w, size_t i, const shade_item *item, size_t k)
{
    FLAGS_OF(w);
    const size_t step = w->hits.step;
    vec3 color = ITEM_VECTOR(item->color, k);
    if (RT_NEXT) {
        /* Not what hangs over the tile's edge or fills up a block. */
        if (w->hits.rays[RT_RAY_TMIN * step + i] < w->hits.rays[RT_RAY_TMAX * step + i])
            add_to_path(w, i, color);
        return;
    }
    number clear;
    if (ON(FOG))
        veil(&w->fog, w->hits.hit_array[RT_HIT_T * step + i], &color, &clear);
    if (RT_SUM) {
        const vec3 sum = LOAD3(w->colors, step, i);
        color = (vec3){color.x + sum.x, color.y + sum.y, color.z + sum.z};
    }
    STORE3(color, w->colors, step, i);
}

/* The background in the place of what has no surface. */
INLINE void put_sky(const shading *w, size_t i, shade_item *item, size_t k, const int may_hit)
{
    vec3 color;
    sky(w, i, &color);
    if (may_hit) {
        const int is_hit = w->hits.hit_index[i] != RT_MISS;
        const vec3 lit = ITEM_VECTOR(item->color, k);
        color.x = is_hit ? lit.x : color.x;
        color.y = is_hit ? lit.y : color.y;
        color.z = is_hit ? lit.z : color.z;
    }
    STORE_ITEM_VECTOR(color, item->color, k);
}

/* All but finding the surface and painting it; `may_hit` is 0 where nothing is known to be hit. */
INLINE void color_ray(const shading *w, size_t i, shade_item *item, size_t k, const int may_hit)
{
    if (may_hit)
        light_surface(w, i, item, k);
    put_sky(w, i, item, k, may_hit);
    if (!RT_CALLS_AT_END)
        put_color(w, i, item, k);
}

#if RT_HAS_STAGES
__kernel __attribute__((reqd_work_group_size(RT_BLOCK_RAYS / RT_ITEM_RAYS, 1, 1))) void
rt_shade(TRACED_PARAMETERS, __global const int *material_of, __global const rt_material *materials,
         __global const rt_light *lights, const int light_count, const rt_surround surround,
         __global float *colors, const rt_gradient gradient, const rt_fog fog,
         __global const int *uvs_of, __global const float *uvs, __global const rt_texture *textures,
         __global const uint *texels, __global const int *open, const rt_crevice crevice,
         __global const int *home, __global number *paths, __global const int *marks,
         __global const rt_medium *media, const rt_nesting nesting, const int flags)
{
    ASSUME_GROUP(RT_BLOCK_RAYS / RT_ITEM_RAYS);
    const shading w = {
        .hits = TRACED,
        .material_of = material_of,
        .materials = materials,
        .lights = lights,
        .light_count = light_count,
        .surround = surround,
        .colors = colors,
        .gradient = gradient,
        .fog = fog,
        .pictures = {uvs_of, uvs, textures, texels},
        .open = open,
        .crevice = crevice,
        .home = home,
        .paths = paths,
        .marks = marks,
        .media = media,
        .nesting = nesting,
        .flags = flags,
    };
    const size_t first = get_global_id(0) * RT_ITEM_RAYS;
    shade_item item;
    if (any_hit(hit_index, first)) {
        EACH_RAY(k)
        {
            find_surface(&w, first + k, &item, k);
            if (!RT_TEXTURE)
                color_ray(&w, first + k, &item, k, 1);
        }
        if (ON(TEXTURE))
            for (size_t k = 0; k < RT_ITEM_RAYS; ++k)
                paint(&w, first + k, &item, k);
        if (RT_TEXTURE)
            EACH_RAY(k)
        color_ray(&w, first + k, &item, k, 1);
    } else {
        EACH_RAY(k)
        color_ray(&w, first + k, &item, k, 0);
    }
    if (RT_CALLS_AT_END)
        EACH_RAY(k)
    put_color(&w, first + k, &item, k);
}
#endif
