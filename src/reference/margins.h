/* The reference's own margins, in half ulps of 1 in float: boxes are made of floats in double too.
 */
#ifndef RT_REFERENCE_MARGINS_H
#define RT_REFERENCE_MARGINS_H

#define FLOAT_HALF_ULP 0x1p-24f

/* Of |lo| + |hi|. A sphere's centre plus or minus its radius is off by one of them; a ray that runs
 * along a face of the box wants to be inside, and the robust triangle test moves a hit by two. */
#define BOX_MARGIN (4 * FLOAT_HALF_ULP)

/* What the far end of a slab's interval is multiplied by. Each end is off by three of them, for a
 * difference, a reciprocal and a product, so that two that meet in a corner can be six apart. The
 * shear of the robust triangle test is off by two more on either side, and the margin must hold
 * what that test takes for a hit: twice as much. */
#define SLAB_MARGIN (1 + 8 * FLOAT_HALF_ULP)
#define SLAB_MARGIN_ROBUST (1 + 16 * FLOAT_HALF_ULP)

/* A border of cells reaches down by so much of its place: 1 each for two decimal numbers and their
 * quotient, and one more. Spheres end lower still. */
#define CELL_MARGIN (4 * FLOAT_HALF_ULP)
#define SPHERE_CELL_MARGIN (4 * CELL_MARGIN)

#endif
