/* What the host and the kernels share: the layout of every array that goes to a device. Scalar
 * fields only and padding spelled out, so that each compiler lays them out alike. */
#ifndef RT_LAYOUT_H
#define RT_LAYOUT_H

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

/* A node of the tree: the boxes of up to 16 children side by side, empty ones with lo > hi. A child
 * is the index of a node, or a leaf (kernels/primitives/kinds.h). */
#define RT_WIDTH 16

typedef struct rt_node {
    float lo_x[RT_WIDTH], hi_x[RT_WIDTH];
    float lo_y[RT_WIDTH], hi_y[RT_WIDTH];
    float lo_z[RT_WIDTH], hi_z[RT_WIDTH];
    int child[RT_WIDTH];
} rt_node;

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
    int clamp;   /* 1: on triangles the picture's border goes on beyond it, 0: it is repeated */
    int padding_0, padding_1;
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
    float gap;    /* part of the way to it that shadow rays leave out: 0, or more where a primitive
                   * passes through its place */
    int padding;
} rt_light;

/* The direction of pixel (x, y) before it is made unit:
 * right * (2x + 1 - width) + up * (height - 1 - 2y) + forward. The lens is the disk that lens_right
 * and lens_up span about the origin; what is at `focus` along the view is sharp. */
#define RT_FRAME(number)                                                                           \
    {                                                                                              \
        number ox, oy, oz;                                                                         \
        number right_x, right_y, right_z;                                                          \
        number up_x, up_y, up_z;                                                                   \
        number forward_x, forward_y, forward_z;                                                    \
        number lens_right_x, lens_right_y, lens_right_z;                                           \
        number lens_up_x, lens_up_y, lens_up_z;                                                    \
        number focus;                                                                              \
        int width, height;                                                                         \
    }
#ifdef __OPENCL_C_VERSION__
#if RT_ACCURACY == RT_DOUBLE
typedef struct rt_frame RT_FRAME(double) rt_frame;
#else
typedef struct rt_frame RT_FRAME(float) rt_frame;
#endif
#else
typedef struct rt_frame RT_FRAME(float) rt_frame;
typedef struct rt_frame_double RT_FRAME(double) rt_frame_double;
#endif

/* The part of the picture that one round of launches computes, in pixels; row 0 is the top. */
typedef struct rt_tile {
    int x, y, width, height;
} rt_tile;

/* The light that comes from nowhere in particular. */
typedef struct rt_surround {
    float background_r, background_g, background_b;
    float ambient_r, ambient_g, ambient_b;
} rt_surround;

/* The background's colour straight along the unit vector `up`; rt_surround's is the opposite. */
typedef struct rt_gradient {
    float top_r, top_g, top_b;
    float up_x, up_y, up_z;
} rt_gradient;

/* A part exp(-density * t) of the light gets through t of fog, which adds its colour for the rest.
 */
typedef struct rt_fog {
    float r, g, b;
    float density;
} rt_fog;

/* Ambient light that is hindered by what is nearer than `distance`, by `samples` rays. */
typedef struct rt_crevice {
    float distance;
    int samples;
} rt_crevice;

/* Which of the launches of a stage over one tile this is. */
typedef struct rt_turn {
    int sample;       /* of each pixel */
    int begin;        /* the first of the samples that are drawn now; those before are summed up */
    int divisor;      /* of the sums: the number of samples, or 1 where more are to come */
    int light;        /* whose shadow; the number of lights where ambient light is meant */
    int from, rays;   /* the rays that the probes are for, multiples of RT_BLOCK_RAYS */
    int first, count; /* of the light's samples, those that the probes are for */
} rt_turn;

/* What random numbers are for: light k's shadow rays are RT_PURPOSE_LIGHT + k. */
#define RT_PURPOSE_PIXEL 0u
#define RT_PURPOSE_LENS 1u
#define RT_PURPOSE_ROUTE 2u
#define RT_PURPOSE_AMBIENT 3u
#define RT_PURPOSE_LIGHT 4u

/* What fills the inside of bodies: the index of refraction, and the part of the light lost per unit
 * of length (Beer). Number 0 of the scene's media is the open. */
typedef struct rt_medium {
    float ior;
    float absorb_r, absorb_g, absorb_b;
} rt_medium;

/* The media of the bodies that a ray is inside of, the innermost in the lowest bits, as many as go
 * into 64 bits (kernels/shading/media.cl). */
#ifdef __OPENCL_C_VERSION__
#define RT_64_BITS ulong
#else
#include <stdint.h>
#define RT_64_BITS uint64_t
#endif
typedef struct rt_nesting {
    RT_64_BITS eye;  /* of what the eye is inside */
    RT_64_BITS ones; /* the lowest bit of each place */
    int bits;        /* of a place */
    int padding;
} rt_nesting;

/* What a ray on its way brings to a pixel: components of an array of numbers, of one of integers.
 * `weight` is what mirrors and surfaces let through, `tint` what fog and absorption do. The bounce
 * counts the rays before. */
#define RT_PATH_WEIGHT 0
#define RT_PATH_TINT_R 1
#define RT_PATH_TINT_G 2
#define RT_PATH_TINT_B 3
#define RT_PATH_COMPONENTS 4
#define RT_MARK_BOUNCE 0
#define RT_MARK_INSIDE_LOW 1 /* of what: rt_nesting */
#define RT_MARK_INSIDE_HIGH 2
#define RT_MARK_IS_REFRACTED 3
#define RT_MARK_WAITING 4 /* mirror rays that wait */
#define RT_MARK_COMPONENTS 5

/* A mirror ray that waits until the refracted ray of the same hit, and all that comes of it, is
 * through. */
#define RT_WAITING_OX 0
#define RT_WAITING_DX 3
#define RT_WAITING_WEIGHT 6
#define RT_WAITING_TINT_R 7
#define RT_WAITING_COMPONENTS 10
#define RT_WAITING_BOUNCE 0
#define RT_WAITING_INSIDE_LOW 1
#define RT_WAITING_INSIDE_HIGH 2
#define RT_WAITING_MARKS 3

/* Mirror rays that a path has waiting at most: one a bounce, each of a quantum's weight or more
 * (RT_QUANTUM of margins.h), and all of a path's rays together weigh 1: after 28 bounces that is
 * used up. */
#define RT_WAITING_MOST 28

/* What is counted of each slot's rays, in 64 bits each: probes cast for shadows and for ambient
 * light, rays that end because they may not go on farther and the part of their pixel's light that
 * they would have brought, in RT_CUT_UNIT of white, and rays that Russian roulette ended. */
#define RT_TALLY_SHADOW 0
#define RT_TALLY_AMBIENT 1
#define RT_TALLY_CUT 2
#define RT_TALLY_CUT_PART 3
#define RT_TALLY_ENDED 4
#define RT_TALLY_COMPONENTS 5
#define RT_CUT_UNIT 0x1p-24f

/* What rt_count tells of each block of next rays. */
#define RT_COUNT_ALL 0
#define RT_COUNT_REFRACTED 1
#define RT_COUNT_COMPONENTS 2

#endif
