/* The files of a study: REPORT.json and .csv with every figure, REPORT.md for the reader,
 * REPORT.svg and .png for the eye. */
#ifndef RT_STUDY_REPORT_H
#define RT_STUDY_REPORT_H

#include "common/file.h"
#include "common/watch.h"
#include "study/result.h"

typedef struct rt_study_files {
    rt_output json, csv, md, svg, png;
    char *name; /* owned: REPORT without its folder */
} rt_study_files;

#define RT_STUDY_FILES_INIT                                                                        \
    ((rt_study_files){RT_OUTPUT_INIT, RT_OUTPUT_INIT, RT_OUTPUT_INIT, RT_OUTPUT_INIT,              \
                      RT_OUTPUT_INIT, NULL})

/* Opens all before the work, so that a folder that cannot be written to is known at once. */
bool rt_study_files_open(rt_study_files *files, const char *report, rt_status *status);
/* Writes and puts them all in place. Without gnuplot there is no plot, and a warning says what to
 * install. What stops the watch while gnuplot runs stops the rest too. */
bool rt_study_files_write(rt_study_files *files, const rt_study *study, const rt_watch *watch,
                          rt_status *status);
/* Removes what has not been put in place. */
void rt_study_files_discard(rt_study_files *files);

bool rt_study_write_json(const rt_study *study, rt_output *output, rt_status *status);

#endif
