/* The programs that the kernels are built as: what many scenes have in common is compiled for all
 * of them once, and what is not, side by side. The walks depend on level, lanes, tree, kinds of
 * primitives and sides alone; of the others each depends on the effects that it is about. */
#ifndef RT_PARTS_H
#define RT_PARTS_H

#define RT_PART_ALL 0       /* one program of all kernels, for measurements and tests */
#define RT_PART_TRACE 1     /* the nearest hits */
#define RT_PART_OCCLUDE 2   /* any hit */
#define RT_PART_STAGES 3    /* what every picture takes beside them: camera, shade, resolve */
#define RT_PART_SECONDARY 4 /* rays that begin at hits: shadow, ambient, mirror, refracted rays */
#define RT_PART_COUNT 5

#endif
