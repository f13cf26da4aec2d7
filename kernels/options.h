/* Every build option of the kernels but those of the kinds of primitives (primitives/kinds.h), with
 * its default where it has one. src/render/variant.c is the only place that sets them; a value that
 * no kernel knows stops the build here, not in the middle of a stage. */

/* Which kernels there are: a part of parts.h. */
#ifndef RT_PART
#define RT_PART RT_PART_ALL
#endif
#if RT_PART < 0 || RT_PART >= RT_PART_COUNT
#error "RT_PART must be from 0 to 4"
#endif
#define RT_HAS_TRACE (RT_PART == RT_PART_ALL || RT_PART == RT_PART_TRACE)
#define RT_HAS_OCCLUDE (RT_PART == RT_PART_ALL || RT_PART == RT_PART_OCCLUDE)
#define RT_HAS_STAGES (RT_PART == RT_PART_ALL || RT_PART == RT_PART_STAGES)
#define RT_HAS_SECONDARY (RT_PART == RT_PART_ALL || RT_PART == RT_PART_SECONDARY)

/* The level of accuracy: 0 fast, 1 standard, 2 robust, 3 double (src/common/accuracy.h). */
#ifndef RT_ACCURACY
#define RT_ACCURACY 2
#endif
#if RT_ACCURACY < 0 || RT_ACCURACY > 3
#error "RT_ACCURACY must be from 0 to 3"
#endif
#define RT_FAST 0
#define RT_STANDARD 1
#define RT_ROBUST 2
#define RT_DOUBLE 3

/* Rays that one work-item of the trace stage carries, each in its own lane of a vector type. */
#ifndef RT_LANES
#define RT_LANES 1
#endif
#if RT_LANES != 1 && RT_LANES != 4 && RT_LANES != 8 && RT_LANES != 16
#error "RT_LANES must be 1, 4, 8 or 16"
#endif

/* Rays that one work-item of the trace stage walks the tree with: whole vectors of lanes. */
#ifndef RT_PACKET
#define RT_PACKET RT_LANES
#endif
#if RT_PACKET < RT_LANES || RT_PACKET > 64 || RT_PACKET % RT_LANES != 0 || 64 % RT_PACKET != 0
#error "RT_PACKET must be a multiple of RT_LANES that divides 64"
#endif

/* Whether there is a tree, and the entries that a walk's stack needs at most. */
#ifndef RT_TREE
#define RT_TREE 1
#endif
#if RT_TREE != 0 && RT_TREE != 1
#error "RT_TREE must be 0 or 1"
#endif
#ifndef RT_STACK
#define RT_STACK 256
#endif
#if RT_STACK < 16 || RT_STACK > 4096
#error "RT_STACK must be from 16 to 4096"
#endif

/* What the scene calls for: an option for each effect of effects.def, 1 where it is on; what is 0
 * is not compiled. They have no defaults: whoever builds says them all. RT_CULL is -1 or 1 where
 * triangles have one side, the sign of the determinant of those that are hit: seen
 * counter-clockwise it is positive. */
#define RT_SQUARE(word, name) | RT_##word *RT_##word
#if (0 RT_EFFECTS(RT_SQUARE)) & ~1
#error "an effect must be 0 or 1, or -1 for RT_CULL"
#endif
/* An option that is missing is 0 above, but not here. */
enum { RT_EFFECTS_ARE_GIVEN = 0 RT_EFFECTS(RT_SQUARE) };
#undef RT_SQUARE
#if RT_ABSORB && !RT_REFRACT
#error "RT_ABSORB needs RT_REFRACT"
#endif

/* Effects that are compiled in are switched by bits of an argument `flags`, RT_FLAG of effects.def;
 * without RT_SWITCHED what is compiled in is on, and ON() is a constant: of an `if` the compiler's
 * first look leaves one branch. */
#ifndef RT_SWITCHED
#define RT_SWITCHED 0
#endif
#if RT_SWITCHED != 0 && RT_SWITCHED != 1
#error "RT_SWITCHED must be 0 or 1"
#endif
#define ON(effect) (RT_##effect && (!RT_SWITCHED || (flags & RT_FLAG(RT_EFFECT_##effect)) != 0))

/* Rays that a work-item of the stages beside trace looks after: a block where vectors are wide. */
#define RT_ITEM_RAYS (RT_LANES > 1 ? RT_BLOCK_RAYS : 1)

/* What follows from the effects: shadows of either kind, rays that go on from where others end,
 * colours that are sums, rays that ask whether the way is free. */
#define RT_SHADOWS (RT_HARD_SHADOWS || RT_SOFT_SHADOWS)
#define RT_NEXT (RT_REFLECT || RT_REFRACT)
#define RT_SUM (RT_ANTIALIAS || RT_NEXT)
#define RT_PROBES (RT_SHADOWS || RT_AMBIENT_OCCLUSION)

/* The number of lights where they are few, so that the loop over them is none; -1: an argument. */
#ifndef RT_LIGHTS
#define RT_LIGHTS -1
#endif
#if RT_LIGHTS < -1 || RT_LIGHTS > 4
#error "RT_LIGHTS must be from -1 to 4"
#endif

#if RT_SMOOTH && !RT_TRIANGLES
#error "RT_SMOOTH needs RT_TRIANGLES"
#endif

/* Bits of the largest whole shininess, and whether some shininess is not whole. */
#ifndef RT_SHININESS_BITS
#define RT_SHININESS_BITS 20
#endif
#if RT_SHININESS_BITS != 8 && RT_SHININESS_BITS != 20
#error "RT_SHININESS_BITS must be 8 or 20"
#endif
#ifndef RT_SHININESS_FRACTION
#define RT_SHININESS_FRACTION 0
#endif
#if RT_SHININESS_FRACTION != 0 && RT_SHININESS_FRACTION != 1
#error "RT_SHININESS_FRACTION must be 0 or 1"
#endif

/* How division and square root come out correctly rounded: 0 the device's own are, 1 by way of
 * double, 2 by a correction with fma. */
#ifndef RT_ROUNDING
#define RT_ROUNDING 0
#endif
#if RT_ROUNDING < 0 || RT_ROUNDING > 2
#error "RT_ROUNDING must be 0, 1 or 2"
#endif

#if RT_ACCURACY == RT_DOUBLE || RT_ROUNDING == 1
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
