/* The kinds of primitives, shared by host and kernels: what there is of every kind is a row here,
 * or is made from the rows. What a kind is by itself is in src/bvh/box.c, in a file of its own in
 * this folder and in one of src/reference, and is found missing by the compiler. */
#ifndef RT_KINDS_H
#define RT_KINDS_H

/* kind(name, names, NAMES) for each, in the order of primitive indices: those of the first kind
 * come first, in file order, then those of the next. One row a line, which
 * src/opencl/kernel_text.awk reads too. */
/* clang-format off */
#define RT_KINDS(kind) \
    kind(sphere, spheres, SPHERES) \
    kind(triangle, triangles, TRIANGLES)
/* clang-format on */

/* What a primitive of each kind is made of: floats, all of them coordinates or lengths, so that
 * they change together with the scene's unit of length. */
#define RT_FIELDS_sphere(field) field(cx) field(cy) field(cz) field(radius)
#define RT_FIELDS_triangle(field)                                                                  \
    field(ax) field(ay) field(az) field(bx) field(by) field(bz) field(cx) field(cy) field(cz)

#ifdef __OPENCL_C_VERSION__
/* Which kinds the scene has: options like those of kernels/options.h. */
#ifndef RT_SPHERES
#define RT_SPHERES 1
#endif
#ifndef RT_TRIANGLES
#define RT_TRIANGLES 1
#endif
#define RT_IS_NEITHER(name, names, NAMES) || (RT_##NAMES != 0 && RT_##NAMES != 1)
#if 0 RT_KINDS(RT_IS_NEITHER)
#error "RT_SPHERES, RT_TRIANGLES and so on must be 0 or 1"
#endif
/* Whether it has any. */
#define RT_OR_THESE(name, names, NAMES) || RT_##NAMES
#define RT_PRIMITIVES (0 RT_KINDS(RT_OR_THESE))
/* Code that there is only where the scene has the kind; no commas but in parentheses. */
#define RT_WHERE(NAMES, code) RT_PASTE(RT_WHERE_, RT_##NAMES)(code)
#define RT_WHERE_0(code)
#define RT_WHERE_1(code) code
#endif

#define RT_KIND_NUMBER(name, names, NAMES) RT_KIND_##NAMES,
enum rt_kind { RT_KINDS(RT_KIND_NUMBER) RT_KIND_COUNT };

#ifdef __OPENCL_C_VERSION__
/* A bit for each kind that the scene has. */
#define RT_BIT_OF_KIND(name, names, NAMES) | RT_##NAMES << RT_KIND_##NAMES
enum { RT_KINDS_HERE = 0 RT_KINDS(RT_BIT_OF_KIND) };
/* Whether it is the last that it has: of that one nothing needs asking. */
#define RT_IS_LAST(NAMES) (RT_KINDS_HERE >> RT_KIND_##NAMES == 1)
/* Whether `kind`, which the scene has, is this one. */
#define RT_IS_OF(NAMES, kind) (RT_IS_LAST(NAMES) || (kind) == RT_KIND_##NAMES)
#endif

/* Primitives go to the device in blocks of four of a kind, field by field, so that one ray can be
 * held against a whole block; rays are held against each of its primitives in turn. Slot 4 i + k is
 * place k of block i. A place that is not filled has zeros, which nothing hits. Each array of
 * blocks has one more at its end than there are, since vectors may load beyond the last. */
#define RT_BLOCK_PRIMITIVES 4
#define RT_ORDER_PADDING 16

#define RT_ONE_OF(field) float field;
#define RT_FOUR_OF(field) float field[RT_BLOCK_PRIMITIVES];
#define RT_KIND_TYPES(name, names, NAMES)                                                          \
    typedef struct rt_##name {                                                                     \
        RT_FIELDS_##name(RT_ONE_OF)                                                                \
    } rt_##name;                                                                                   \
    typedef struct rt_##name##_block {                                                             \
        RT_FIELDS_##name(RT_FOUR_OF)                                                               \
    } rt_##name##_block;
RT_KINDS(RT_KIND_TYPES)

/* The code of a leaf in a node of the tree: the sign bit, the kind in as many bits as it takes, and
 * the number of a block of that kind. */
#define RT_LEAF ((int)0x80000000)
#define RT_LEAF_KIND_BITS (RT_KIND_COUNT > 4 ? 3 : RT_KIND_COUNT > 2 ? 2 : 1)
#define RT_LEAF_BLOCK_BITS (31 - RT_LEAF_KIND_BITS)
#define RT_LEAF_BLOCKS (1 << RT_LEAF_BLOCK_BITS)
#define RT_LEAF_OF(kind, block) (RT_LEAF | (int)(kind) << RT_LEAF_BLOCK_BITS | (int)(block))
#define RT_LEAF_KIND(leaf)                                                                         \
    ((int)((unsigned)(leaf) >> RT_LEAF_BLOCK_BITS) & ((1 << RT_LEAF_KIND_BITS) - 1))
#define RT_LEAF_BLOCK(leaf) ((leaf) & (RT_LEAF_BLOCKS - 1))

#endif
