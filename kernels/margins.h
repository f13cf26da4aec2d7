/* How much room rounding is given, and what is too little to follow for sure. The tree is made with
 * the box's margin too; the reference has constants of its own (src/reference/margins.h), so that
 * it notices where one of these is wrong. */
#ifndef RT_MARGINS_H
#define RT_MARGINS_H

/* A primitive's box is widened by this part of |lo| + |hi|: so the rounding of a sphere's corners
 * cannot cut it, and a ray that runs along a face of the exact box is inside. At robust and double,
 * and in the tree, which serves all levels, it is widened on every side by what that is on the axis
 * where it is the most: the watertight test moves a hit across the ray by up to two half ulps of
 * the triangle's size, also along axes where the triangle is thin. */
#define RT_BOX_MARGIN 0x1p-22f
/* The far end of a slab interval grows by a few ulp, so that rounding cannot empty the interval of
 * a box that is met at a corner (Ize 2013). At robust and double it must not be emptied where the
 * watertight test says hit, whose shear adds two half ulps of its own on either side: 16 half ulps.
 */
#define RT_SLAB_MARGIN 1.0000005f
#define RT_SLAB_MARGIN_ROBUST 0x1.00001p0f

/* What is below a border of the checker's cells by less than this part of its way from 0 counts as
 * on it, and with it to the cell above: decimal numbers of which one is a half of a whole multiple
 * of the other are rounded to floats that are off by three half ulps at most. */
#define RT_CELL_MARGIN 0x1p-22f
/* On a sphere patterns end below the upper faces of its box by this part of them, which is more: a
 * sphere that touches a border from below has nothing above it. */
#define RT_SPHERE_CELL_MARGIN 0x1p-20f

/* A part of white that cannot be seen: less than half of an 8-bit step. A ray that would bring less
 * lives on by chance, and then brings so much (Arvo and Kirk 1990). */
#define RT_WEIGHT_LEAST (1.0f / 512.0f)
/* Where light splits, a part that weighs less than this is followed by chance, and then weighs so
 * much. It doubles every four bounces, up to all of the light, so that what is followed stays few:
 * at 36 bounces it is one ray. */
#define RT_QUANTUM(bounce) (RT_WEIGHT_LEAST * (float)(1 << ((bounce) < 36 ? (bounce) / 4 : 9)))

#endif
