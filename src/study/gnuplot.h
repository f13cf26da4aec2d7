/* gnuplot as a child process, found by PATH. */
#ifndef RT_STUDY_GNUPLOT_H
#define RT_STUDY_GNUPLOT_H

#include <stdio.h>

enum rt_plot_result { RT_PLOT_DRAWN, RT_PLOT_NO_GNUPLOT, RT_PLOT_FAILED };

/* Runs it over a script, which is read from its beginning. */
enum rt_plot_result rt_gnuplot_run(FILE *script);

/* Whether it is there and does what it is needed for: tens of milliseconds. */
enum rt_plot_result rt_gnuplot_try(void);

#endif
