/* What ka and kd are multiplied by where a material has a checker or a picture. */

/* Whether x is in a cell of odd number along an axis, where cells of side `cell` lie about the
 * whole multiples of it, so that a floor at one is within cells and not on their border; a border
 * belongs to the cell above it. The parity of a number of any size is exact; an infinite one is
 * even. */
INLINE int is_in_odd(number x, number cell)
{
    const number half_ = 0.5f;
    const number place = DIVIDE_1(x, cell);
    const number along = floor(fma(fabs(place), (number)RT_CELL_MARGIN, place) + half_);
    return along - (number)2.0f * floor(along * half_) > half_;
}

/* Whether a point is in one of every two cells of a lattice of cubes. By its address: by value it
 * would come as small vectors, which end vectorising. */
INLINE int in_odd_cell(const vec3 *p, number cell)
{
    return is_in_odd(p->x, cell) ^ is_in_odd(p->y, cell) ^ is_in_odd(p->z, cell);
}

/* Pictures and what says where on them a point is. */
typedef struct pictures {
    __global const int *uvs_of; /* record of each triangle in `uvs`, -1 for none */
    __global const float *uvs;
    __global const rt_texture *textures;
    __global const uint *texels;
} pictures;

/* Where on a picture a surface is: (0, 0) is its lower left, (1, 1) its upper right; whether it is
 * repeated beyond them or ends. */
typedef struct texture_place {
    number x, y;
    int repeats_x, repeats_y;
} texture_place;

/* A coordinate of a picture, from 0 to 1; of an infinite one 0 or what is at that end. */
INLINE number on_picture(number x, int repeats)
{
    const number one = 1.0f, zero = 0.0f;
    const number part = x - floor(x);
    return repeats ? (part >= zero ? part : zero) : BETWEEN(x, zero, one);
}

/* A column or row of `count`, from -1 to one too many: that at the other side or the outermost. */
INLINE int in_picture(int i, int count, int repeats)
{
    const int below = repeats ? count - 1 : 0, above = repeats ? 0 : count - 1;
    return i < 0 ? below : i >= count ? above : i;
}

/* The texel in column x and row y, counted from the lower left. */
INLINE void texel_at(const pictures *p, const rt_texture t, int x, int y, vec3 *color)
{
    const size_t row = (size_t)(t.height - 1 - y);
    const uint texel = p->texels[(size_t)t.first + row * (size_t)t.width + (size_t)x];
    const number step = 1.0f / 255.0f;
    color->x = (number)(int)(texel & 255) * step;
    color->y = (number)(int)(texel >> 8 & 255) * step;
    color->z = (number)(int)(texel >> 16 & 255) * step;
}

/* In the file of each kind: where on a picture a surface is, of which surface.cl tells the rest; it
 * is repeated or not as the material says, unless the kind knows better. */
#define DECLARE_PICTURE_POINT(name, names, NAMES)                                                  \
    INLINE void name##_picture_point(const pictures *p, int index, number u, number v,             \
                                     const surface *s, texture_place *at);
RT_KINDS(DECLARE_PICTURE_POINT)

/* Where on a picture a hit is. */
INLINE void picture_point(const pictures *p, const traced *w, size_t i, int index, const surface *s,
                          int repeats, texture_place *at)
{
    const number u = w->hit_array[RT_HIT_U * w->step + i];
    const number v = w->hit_array[RT_HIT_V * w->step + i];
    at->x = at->y = 0.0f;
    at->repeats_x = at->repeats_y = repeats;
#define PICTURE_POINT(name, names, NAMES)                                                          \
    if (RT_IS_LAST(NAMES) || (RT_##NAMES && index < w->name##_count)) {                            \
        name##_picture_point(p, index, u, v, s, at);                                               \
        return;                                                                                    \
    }                                                                                              \
    index -= RT_##NAMES ? w->name##_count : 0;
    RT_KINDS(PICTURE_POINT)
}

/* A picture's colour at a place. */
INLINE void picture_color(const pictures *p, const rt_texture t, int nearest,
                          const texture_place *at, vec3 *color)
{
    const number across = on_picture(at->x, at->repeats_x) * (number)t.width;
    const number up = on_picture(at->y, at->repeats_y) * (number)t.height;
    const number half_ = nearest ? 0.0f : 0.5f;
    const number left = floor(across - half_), low = floor(up - half_);
    const int x0 = in_picture((int)left, t.width, at->repeats_x);
    const int y0 = in_picture((int)low, t.height, at->repeats_y);
    vec3 c00, c10, c01, c11;
    texel_at(p, t, x0, y0, &c00);
    if (nearest) {
        *color = c00;
        return;
    }
    const int x1 = in_picture((int)left + 1, t.width, at->repeats_x);
    const int y1 = in_picture((int)low + 1, t.height, at->repeats_y);
    texel_at(p, t, x1, y0, &c10);
    texel_at(p, t, x0, y1, &c01);
    texel_at(p, t, x1, y1, &c11);
    const number f = across - half_ - left, g = up - half_ - low;
    const vec3 d0 = SUB(vec3, c10, c00), d1 = SUB(vec3, c11, c01);
    const vec3 below = ADD_SCALED(d0, f, c00), above = ADD_SCALED(d1, f, c01);
    const vec3 d = SUB(vec3, above, below);
    *color = ADD_SCALED(d, g, below);
}
