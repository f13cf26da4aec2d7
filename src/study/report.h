/* The files of a study. REPORT stands for what their names begin with. */
#ifndef RT_STUDY_REPORT_H
#define RT_STUDY_REPORT_H

#include "common/file.h"
#include "common/watch.h"
#include "study/result.h"
#include "study/strip.h"

enum rt_study_file {
    RT_STUDY_HTML,     /* the whole report in one file */
    RT_STUDY_MD,       /* the same as text, beside its pictures */
    RT_STUDY_SVG,      /* the plot, ... */
    RT_STUDY_PNG,      /* ... and as pixels */
    RT_STUDY_CSV,      /* every figure, ... */
    RT_STUDY_JSON,     /* ... and all that the others are made of */
    RT_STUDY_PICTURES, /* the scene at two levels, and their difference */
    RT_STUDY_FILES
};

typedef struct rt_study_report {
    char *report; /* owned: REPORT */
    rt_output files[RT_STUDY_FILES];
    bool with_plot;           /* whether gnuplot is there */
    bool is_redrawn;          /* JSON and pictures stay as they are */
    bool has[RT_STUDY_FILES]; /* written and in place */
} rt_study_report;

/* Holds nothing. */
void rt_study_report_init(rt_study_report *report);

/* Opens all before the work, so that a folder that cannot be written to is known at once; and
 * whether there is a gnuplot, of which a warning tells where there is none. Where `is_redrawn`, all
 * is made of what an earlier study has left, and without gnuplot it fails. */
bool rt_study_report_open(rt_study_report *report, const char *name, bool is_redrawn,
                          rt_status *status);
/* Writes and puts them all in place. The strip is not asked for where the report is redrawn. What
 * stops the watch while gnuplot runs stops the rest too. */
bool rt_study_report_write(rt_study_report *report, const rt_study *study,
                           const rt_study_strip *strip, const rt_watch *watch, rt_status *status);
/* Tells the verdict and the names of the files. */
void rt_study_report_tell(const rt_study_report *report, const rt_study *study, FILE *out);
/* Removes what has not been put in place, and releases the rest. */
void rt_study_report_clear(rt_study_report *report);

#endif
