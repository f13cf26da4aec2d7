/* A study as tables: comma-separated values for programs, Markdown for readers. */
#ifndef RT_STUDY_TABLE_H
#define RT_STUDY_TABLE_H

#include "common/file.h"
#include "study/result.h"

bool rt_study_write_csv(const rt_study *study, rt_output *output, rt_status *status);
/* `plot` is the name of the picture to show, or NULL. */
bool rt_study_write_md(const rt_study *study, const char *plot, rt_output *output,
                       rt_status *status);

#endif
