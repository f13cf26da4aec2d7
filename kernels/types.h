/* What the host and the kernels share: the layout of every array that goes to a device. Scalar
 * fields only and padding spelled out, so that each compiler lays them out alike. */
#ifndef RT_TYPES_H
#define RT_TYPES_H

/* Rays of a tile lie in blocks of 8x8 pixels, so that neighbours in the array are neighbours in
 * the picture. One block is one work-group at every lane width. */
#define RT_BLOCK_SIDE 8
#define RT_BLOCK_RAYS (RT_BLOCK_SIDE * RT_BLOCK_SIDE)

/* Within a block, rays go through its four quadrants of 4x4: a vector of 16 is then as compact as
 * can be. Column and row of the block's ray i. */
#define RT_BLOCK_COLUMN(i) (((i)&3) | ((i) >> 2 & 4))
#define RT_BLOCK_ROW(i) (((i) >> 2 & 3) | ((i) >> 3 & 4))

/* Components of a ray array: component c of ray i lies at [c * stride + i]. */
#define RT_RAY_OX 0
#define RT_RAY_OY 1
#define RT_RAY_OZ 2
#define RT_RAY_DX 3
#define RT_RAY_DY 4
#define RT_RAY_DZ 5
#define RT_RAY_TMIN 6
#define RT_RAY_TMAX 7
#define RT_RAY_COMPONENTS 8

/* Components of a hit array, laid out likewise; the primitive index is in an int array beside it.
 * t is in units of the ray's direction; u and v weigh the vertices b and c, 0 for a sphere. */
#define RT_HIT_T 0
#define RT_HIT_U 1
#define RT_HIT_V 2
#define RT_HIT_COMPONENTS 3
#define RT_MISS (-1)

/* Components of a vertex-normal record and of a colour array. */
#define RT_NORMAL_COMPONENTS 9
#define RT_COLOR_COMPONENTS 3

/* A record of texture coordinates: u, v at a, b, c; (0, 0) is the lower left of a picture. */
#define RT_UV_COMPONENTS 6

/* Primitives go to the device in blocks of four, component by component, so that one ray can be
 * held against a whole block; rays are held against each of its primitives in turn. Slot 4 i + k is
 * place k of block i. A place that is not filled has zeros, which nothing hits. */
#define RT_BLOCK_PRIMITIVES 4
#define RT_ORDER_PADDING 16

typedef struct rt_sphere_block {
    float cx[RT_BLOCK_PRIMITIVES], cy[RT_BLOCK_PRIMITIVES], cz[RT_BLOCK_PRIMITIVES];
    float radius[RT_BLOCK_PRIMITIVES];
} rt_sphere_block;

typedef struct rt_triangle_block {
    float ax[RT_BLOCK_PRIMITIVES], ay[RT_BLOCK_PRIMITIVES], az[RT_BLOCK_PRIMITIVES];
    float bx[RT_BLOCK_PRIMITIVES], by[RT_BLOCK_PRIMITIVES], bz[RT_BLOCK_PRIMITIVES];
    float cx[RT_BLOCK_PRIMITIVES], cy[RT_BLOCK_PRIMITIVES], cz[RT_BLOCK_PRIMITIVES];
} rt_triangle_block;

/* A node of the tree: the boxes of up to 16 children side by side, empty ones with lo > hi. A child
 * is the index of a node, or a leaf: RT_LEAF, RT_LEAF_SPHERES for spheres, and the block. */
#define RT_WIDTH 16
#define RT_LEAF ((int)0x80000000)
#define RT_LEAF_SPHERES 0x40000000

typedef struct rt_node {
    float lo_x[RT_WIDTH], hi_x[RT_WIDTH];
    float lo_y[RT_WIDTH], hi_y[RT_WIDTH];
    float lo_z[RT_WIDTH], hi_z[RT_WIDTH];
    int child[RT_WIDTH];
} rt_node;

/* A primitive's box is widened by this part of |lo| + |hi|: so the rounding of a sphere's corners
 * cannot cut it, and a ray that runs along a face of the exact box is inside. */
#define RT_BOX_MARGIN 0x1p-22f
/* The far end of a slab interval grows by a few ulp, so that rounding cannot empty the interval of
 * a box that is met at a corner (Ize 2013). */
#define RT_SLAB_MARGIN 1.0000005f

/* Phong's coefficients, and what a surface does beside them.
 *
 * `exponent` is the shininess where it is whole, else -1. `reflect` and `transmit` weigh what a
 * mirror ray and a refracted ray bring, each from 0 to 1 and 1 at most together; `ior` is the index
 * of refraction against the outside, `absorb` the part of the light lost per unit of length inside
 * (Beer). In every second cell of a lattice of cubes of side `cell`, 0 for none, ka and kd are
 * multiplied by `checker`. `texture`, -1 for none, is the picture that they are multiplied by. */
typedef struct rt_material {
    float ka_r, ka_g, ka_b;
    float kd_r, kd_g, kd_b;
    float ks_r, ks_g, ks_b;
    float shininess;
    int exponent;
    float reflect, transmit, ior;
    float absorb_r, absorb_g, absorb_b;
    float checker_r, checker_g, checker_b, cell;
    int texture;
    int nearest; /* 1: the texel that holds (u, v), 0: bilinear */
    int padding;
} rt_material;

/* A picture: width * height texels from texel `first` on, row by row from the top, 8 bits each of
 * red (lowest), green, blue, 8 bits unused. */
typedef struct rt_texture {
    int first, width, height;
    int padding;
} rt_texture;

/* (x, y, z) is the position of a point light (w = 1) or the unit vector toward a directional one
 * (w = 0), so that xyz - w * point is the vector toward the light for both. */
typedef struct rt_light {
    float x, y, z, w;
    float r, g, b;
    float radius; /* of a ball that gives the light; 0 for a point */
    int shadow;   /* 1: what is between casts a shadow */
    int samples;  /* shadow rays a point where radius > 0, else 1 */
    int padding_0, padding_1;
} rt_light;

/* The direction of pixel (x, y) before it is made unit:
 * right * (2x + 1 - width) + up * (height - 1 - 2y) + forward. */
typedef struct rt_frame {
    float ox, oy, oz;
    float right_x, right_y, right_z;
    float up_x, up_y, up_z;
    float forward_x, forward_y, forward_z;
    int width, height;
} rt_frame;

/* The part of the picture that one round of launches computes, in pixels; row 0 is the top. */
typedef struct rt_tile {
    int x, y, width, height;
} rt_tile;

/* The light that comes from nowhere in particular. */
typedef struct rt_surround {
    float background_r, background_g, background_b;
    float ambient_r, ambient_g, ambient_b;
} rt_surround;

#endif
