/* What a study finds. */
#ifndef RT_STUDY_RESULT_H
#define RT_STUDY_RESULT_H

#include <stdbool.h>
#include <stddef.h>

#include "opencl/device.h"
#include "study/figures.h"
#include "study/plan.h"

/* A level traces the same fp32 rays as every other, and its own next rays. */
typedef struct rt_study_level {
    enum rt_accuracy level;
    size_t rays, hits;    /* of the reference */
    size_t disagreements; /* rays whose primitive is not the reference's */
    double t_p50, t_p99,
        t_max; /* ulp of the float t, where the primitive is the same; NaN for no hit */
    size_t next_rays, self_hits; /* rays that start on what is hit; those that meet it at once */
    size_t edge_rays, leaks, double_hits; /* all 0 where there is no closed mesh */
} rt_study_level;

/* A level at a count of samples. Seconds; `kernel` and `readback` are by the device's clock, or
 * wall time where it has none. */
typedef struct rt_study_cell {
    enum rt_accuracy level;
    int samples;
    double program, upload;
    rt_spread kernel, readback, wall;
    rt_spread ratio;              /* of kernel time to the base level's, round by round */
    size_t rays;                  /* of one picture, all kinds */
    rt_study_error arithmetic;    /* against the reference at as many samples */
    rt_study_error seen;          /* against the converged reference */
    size_t changed;               /* pixels off by more than one step from the base level's */
    bool arithmetic_is_dominated; /* among all cells */
    bool seen_is_dominated;
} rt_study_cell;

typedef struct rt_study {
    const char *scene; /* the caller's, as `device` */
    const rt_device *device;
    int width, height;
    rt_study_plan plan;            /* without the levels that the device lacks */
    bool lacks[RT_ACCURACY_COUNT]; /* levels that were asked for and that the device lacks */
    enum rt_accuracy base;         /* what others are held against: standard where it takes part */
    bool kernel_is_wall;           /* the device has no clock */
    bool reference_is_scalar; /* else the pictures' reference is the device at reference_level */
    enum rt_accuracy reference_level;
    double reference_seconds; /* that one sample a pixel takes, or would take, on the scalar path */
    int converged_samples;
    rt_study_error sampling[RT_STUDY_SAMPLES_LISTED]; /* the reference against the converged one */
    rt_study_level levels[RT_ACCURACY_COUNT];
    size_t level_count;
    rt_study_cell *cells; /* owned: by samples, then by level */
    size_t cell_count;
    const char *no_edges;  /* why there are no edge-aimed rays, or NULL; needs no release */
    size_t edge_triangles; /* of the closed mesh whose edges are aimed at */
} rt_study;

/* Cell of the level_index-th level at the sample_index-th count. */
const rt_study_cell *rt_study_cell_at(const rt_study *study, size_t sample_index,
                                      size_t level_index);

/* Index of the base level. */
size_t rt_study_base_index(const rt_study *study);

/* Releases what the study holds, and leaves an empty one. */
void rt_study_clear(rt_study *study);

#endif
