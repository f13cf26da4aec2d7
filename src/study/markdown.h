/* The report as text, which shows its pictures from the files beside it. */
#ifndef RT_STUDY_MARKDOWN_H
#define RT_STUDY_MARKDOWN_H

#include <stdbool.h>
#include <stdio.h>

#include "study/result.h"

/* `name` is what the files' names begin with, without their folder. */
void rt_study_print_markdown(const rt_study *study, const char *name, bool has_pictures,
                             bool has_plot, FILE *out);

#endif
