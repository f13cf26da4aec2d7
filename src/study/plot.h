/* The plot of a study: time against error. */
#ifndef RT_STUDY_PLOT_H
#define RT_STUDY_PLOT_H

#include <stdio.h>

#include "study/gnuplot.h"
#include "study/result.h"

/* Writes a gnuplot script that draws the study to the files `svg` and `png`. */
void rt_study_plot_script(const rt_study *study, const char *svg, const char *png, FILE *out);

/* Runs gnuplot over it. */
enum rt_plot_result rt_study_plot(const rt_study *study, const char *svg, const char *png);

#endif
