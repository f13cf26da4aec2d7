/* Every build option of the kernels, with its default. src/program.c is the only place that sets
 * them; a value that no kernel knows stops the build here, not in the middle of a stage. */

/* The level of accuracy: 0 fast, 1 standard, 2 robust, 3 double (src/accuracy.h). */
#ifndef RT_ACCURACY
#define RT_ACCURACY 1
#endif
#if RT_ACCURACY < 0 || RT_ACCURACY > 3
#error "RT_ACCURACY must be from 0 to 3"
#endif

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

/* Whether there is a kernel for any hit beside that for the nearest. */
#ifndef RT_OCCLUSION
#define RT_OCCLUSION 0
#endif
#if RT_OCCLUSION != 0 && RT_OCCLUSION != 1
#error "RT_OCCLUSION must be 0 or 1"
#endif

/* Whether the scene has spheres, and whether it has triangles. */
#ifndef RT_SPHERES
#define RT_SPHERES 1
#endif
#ifndef RT_TRIANGLES
#define RT_TRIANGLES 1
#endif
#if (RT_SPHERES != 0 && RT_SPHERES != 1) || (RT_TRIANGLES != 0 && RT_TRIANGLES != 1)
#error "RT_SPHERES and RT_TRIANGLES must be 0 or 1"
#endif

/* Which triangles are hit: 0 both sides, 1 those with a positive determinant (seen
 * counter-clockwise), -1 those with a negative one. */
#ifndef RT_CULL
#define RT_CULL 0
#endif
#if RT_CULL < -1 || RT_CULL > 1
#error "RT_CULL must be -1, 0 or 1"
#endif

/* Whether some triangle has vertex normals. */
#ifndef RT_SMOOTH
#define RT_SMOOTH 0
#endif
#if RT_SMOOTH != 0 && RT_SMOOTH != 1
#error "RT_SMOOTH must be 0 or 1"
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
