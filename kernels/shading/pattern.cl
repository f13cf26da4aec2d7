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

/* The texel in column x and row y, counted from the lower left; the picture repeats. */
INLINE void texel_at(const pictures *p, const rt_texture t, int x, int y, vec3 *color)
{
    const int column = (x % t.width + t.width) % t.width;
    const int row = t.height - 1 - (y % t.height + t.height) % t.height;
    const uint texel = p->texels[(size_t)t.first + (size_t)row * (size_t)t.width + (size_t)column];
    const number step = 1.0f / 255.0f;
    color->x = (number)(int)(texel & 255) * step;
    color->y = (number)(int)(texel >> 8 & 255) * step;
    color->z = (number)(int)(texel >> 16 & 255) * step;
}

/* In the file of each kind: where on a picture a surface is, of which surface.cl tells the rest. */
#define DECLARE_PICTURE_POINT(name, names, NAMES)                                                  \
    INLINE void name##_picture_point(const pictures *p, int index, number u, number v,             \
                                     const surface *s, number *x, number *y);
RT_KINDS(DECLARE_PICTURE_POINT)

/* Where on a picture a hit is. */
INLINE void picture_point(const pictures *p, const traced *w, size_t i, int index, const surface *s,
                          number *x, number *y)
{
    const number u = w->hit_array[RT_HIT_U * w->step + i];
    const number v = w->hit_array[RT_HIT_V * w->step + i];
    *x = *y = 0.0f;
#define PICTURE_POINT(name, names, NAMES)                                                          \
    if (RT_IS_LAST(NAMES) || (RT_##NAMES && index < w->name##_count)) {                            \
        name##_picture_point(p, index, u, v, s, x, y);                                             \
        return;                                                                                    \
    }                                                                                              \
    index -= RT_##NAMES ? w->name##_count : 0;
    RT_KINDS(PICTURE_POINT)
}

/* A picture's colour at (x, y), once round the picture from 0 to 1. */
INLINE void picture_color(const pictures *p, const rt_texture t, int nearest, number x, number y,
                          vec3 *color)
{
    const number across = (x - floor(x)) * (number)t.width;
    const number up = (y - floor(y)) * (number)t.height;
    if (nearest) {
        texel_at(p, t, (int)floor(across), (int)floor(up), color);
        return;
    }
    const number left = floor(across - (number)0.5f), low = floor(up - (number)0.5f);
    const number f = across - (number)0.5f - left, g = up - (number)0.5f - low;
    vec3 c00, c10, c01, c11;
    texel_at(p, t, (int)left, (int)low, &c00);
    texel_at(p, t, (int)left + 1, (int)low, &c10);
    texel_at(p, t, (int)left, (int)low + 1, &c01);
    texel_at(p, t, (int)left + 1, (int)low + 1, &c11);
    const vec3 d0 = SUB(vec3, c10, c00), d1 = SUB(vec3, c11, c01);
    const vec3 below = ADD_SCALED(d0, f, c00), above = ADD_SCALED(d1, f, c01);
    const vec3 d = SUB(vec3, above, below);
    *color = ADD_SCALED(d, g, below);
}
