/* What a study finds. All that reports say is made of it, and report.json holds it whole. */
#ifndef RT_STUDY_RESULT_H
#define RT_STUDY_RESULT_H

#include <stdbool.h>
#include <stddef.h>

#include "opencl/device.h"
#include "study/figures.h"
#include "study/plan.h"

#define RT_STUDY_ENTRIES_MOST (RT_STUDY_DEVICES_MOST * RT_ACCURACY_COUNT)

typedef struct rt_study_device {
    char *name, *platform, *driver; /* owned */
    bool lacks[RT_ACCURACY_COUNT];  /* levels that were asked for and that it does not have */
    bool kernel_is_wall;            /* it has no clock */
    double held; /* part of the time, 0 to 1, in which other programs held the processors that the
                    pictures were to be rendered on; 0 for what is no CPU */
} rt_study_device;

/* An entry is a level on a device. All trace the same fp32 rays, and their own next rays. */
typedef struct rt_study_entry {
    size_t device;
    enum rt_accuracy level;
    size_t rays, hits;    /* of the reference */
    size_t disagreements; /* rays whose primitive is not the reference's */
    double t_p50, t_p99,
        t_max; /* ulp of the float t, where the primitive is the same; NaN for no hit */
    size_t next_rays, self_hits; /* rays that start on what is hit; those that meet it at once */
    size_t edge_rays, leaks, double_hits; /* all 0 where there is no closed mesh */
} rt_study_entry;

/* An entry at a count of samples. Seconds; `kernel` and `readback` are by the device's clock, or
 * wall time where it has none. */
typedef struct rt_study_cell {
    double program, upload;
    rt_spread kernel, readback, wall;
    rt_spread ratio;          /* of kernel time to the base level's on the same device, round by
                                 round */
    rt_spread ratio_to_first; /* to the same level's on the first device; NaN where that has none */
    size_t rays;              /* of one picture, all kinds */
    rt_study_error arithmetic;    /* against the reference at as many samples */
    rt_study_error seen;          /* against the converged reference */
    size_t visible;               /* pixels that one can see to be off by arithmetic */
    bool arithmetic_is_dominated; /* among those of the same count and device */
    bool seen_is_dominated;       /* among all of the device */
} rt_study_cell;

/* Whether rays were aimed at the edges of a closed mesh, or why not. */
enum rt_study_edges {
    RT_EDGES_TRACED,
    RT_EDGES_NO_TRIANGLES,
    RT_EDGES_NOT_CLOSED,
    RT_EDGES_NO_WAY_IN,
    RT_EDGES_COUNT
};

typedef struct rt_study {
    char *scene;              /* owned: its path as it was given */
    rt_study_device *devices; /* owned */
    size_t device_count;
    int width, height;
    rt_study_plan plan;
    enum rt_accuracy base;    /* what times are held against: standard where it takes part */
    bool reference_is_scalar; /* else the pictures' reference is a device's most accurate level */
    size_t reference_device;
    enum rt_accuracy reference_level;
    double reference_seconds; /* that one sample a pixel takes, or would take, on the scalar path */
    int converged_samples;
    rt_study_error sampling[RT_STUDY_SAMPLES_LISTED]; /* the reference against the converged one */
    int rounds[RT_STUDY_SAMPLES_LISTED];              /* how often pictures were timed */
    rt_study_entry entries[RT_STUDY_ENTRIES_MOST];    /* device by device, by rising level */
    size_t entry_count;
    rt_study_cell *cells; /* owned: by samples, then by entry */
    /* Whose pictures are shown, of the first device at the finest count; RT_ACCURACY_COUNT is the
     * converged reference. */
    enum rt_accuracy shown[2];
    enum rt_study_edges edges;
    size_t edge_triangles; /* of the closed mesh whose edges are aimed at */
} rt_study;

/* Why no rays were aimed at edges, as text that needs no release; NULL where they were. */
const char *rt_study_no_edges(enum rt_study_edges edges);

/* Room for the cells, whose plan and entries are there. */
bool rt_study_make_cells(rt_study *study, rt_status *status);
size_t rt_study_cell_count(const rt_study *study);

/* Cell of the entry_index-th entry at the sample_index-th count. */
rt_study_cell *rt_study_cell_at(const rt_study *study, size_t sample_index, size_t entry_index);

/* Index of the entry of a device at a level, or entry_count where there is none. */
size_t rt_study_find(const rt_study *study, size_t device, enum rt_accuracy level);
/* Index of the entry that an entry's times are held against: its device's base level. */
size_t rt_study_base_of(const rt_study *study, size_t entry_index);

/* "robust", and with several devices "robust, device 1": text[0..RT_STUDY_NAME_SIZE). */
#define RT_STUDY_NAME_SIZE 40
const char *rt_study_entry_name(const rt_study *study, size_t entry_index,
                                char text[RT_STUDY_NAME_SIZE]);

/* Releases what the study holds, and leaves an empty one. */
void rt_study_clear(rt_study *study);

#endif
