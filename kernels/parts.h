/* The programs that the kernels are built as, so that what many scenes have in common is compiled
 * for all of them once: the walks depend on level, lanes, tree, kinds of primitives and sides
 * alone. */
#ifndef RT_PARTS_H
#define RT_PARTS_H

#define RT_PART_ALL 0     /* one program of all kernels, for measurements and tests */
#define RT_PART_TRACE 1   /* the nearest hits */
#define RT_PART_OCCLUDE 2 /* any hit */
#define RT_PART_STAGES 3  /* the stages beside them */
#define RT_PART_COUNT 4

#endif
