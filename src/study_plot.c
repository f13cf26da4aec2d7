#define _GNU_SOURCE
#include "study_plot.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "study_verdict.h"

extern char **environ;

/* Colours that people of any colour vision tell apart (Okabe and Ito 2008), and gnuplot's marks. */
static const struct {
    const char *color;
    int mark;
} looks[RT_ACCURACY_COUNT] = {[RT_ACCURACY_FAST] = {"#D55E00", 9},
                              [RT_ACCURACY_STANDARD] = {"#0072B2", 7},
                              [RT_ACCURACY_ROBUST] = {"#009E73", 5},
                              [RT_ACCURACY_DOUBLE] = {"#CC79A7", 13}};

/* Root mean square of what rounding to whole steps adds: an error below it does not show in a file
 * of 8 bits. */
#define ROUNDING_RMS 0.2887

/* What one half of the plot shows. */
typedef struct panel {
    const char *title;
    bool is_seen; /* to the converged reference, else arithmetic alone */
    double floor; /* where errors of 0 are drawn, which have no logarithm; 0 without any */
    double low, high;
} panel;

static double error_of(const rt_study_cell *cell, bool is_seen)
{
    return is_seen ? cell->seen.rms : cell->arithmetic.rms;
}

static panel make_panel(const rt_study *study, const char *title, bool is_seen)
{
    double low = INFINITY, high = 0.0;
    bool has_zero = false;
    for (size_t i = 0; i < study->cell_count; ++i) {
        const double e = error_of(&study->cells[i], is_seen);
        has_zero = has_zero || !(e > 0.0);
        low = e > 0.0 && e < low ? e : low;
        high = e > high ? e : high;
    }
    if (!(high > 0.0))
        low = high = 1e-6;
    /* The line of rounding is part of the view. */
    high = high < 1.0 ? 1.0 : high;
    low = low > 0.1 ? 0.1 : low;
    const double decade = pow(10.0, floor(log10(low)));
    return (panel){title, is_seen, has_zero ? 0.1 * decade : 0.0,
                   has_zero ? 0.04 * decade : 0.6 * decade, 2.0 * high};
}

/* A string in single quotes, in which only a quote has a meaning. */
static void print_quoted(const char *text, FILE *out)
{
    fputc('\'', out);
    for (; *text; ++text) {
        if (*text == '\'')
            fputc('\'', out);
        fputc((unsigned char)*text < 0x20 ? '?' : *text, out);
    }
    fputc('\'', out);
}

static const char *name_at(const rt_study *study, size_t level_index)
{
    return rt_accuracy_name(study->levels[level_index].level);
}

/* A block a level: samples; median and quartiles of ms; error and whether it is dominated. */
static void print_data(const rt_study *study, const panel *p, FILE *out)
{
    for (size_t k = 0; k < study->level_count; ++k) {
        fprintf(out, "$%s_%d << END\n", name_at(study, k), p->is_seen);
        for (size_t i = 0; i < study->plan.sample_count; ++i) {
            const rt_study_cell *c = rt_study_cell_at(study, i, k);
            const double e = error_of(c, p->is_seen);
            fprintf(out, "%d %.9g %.9g %.9g %.9g %d\n", c->samples, 1e3 * c->kernel.median,
                    1e3 * c->kernel.low, 1e3 * c->kernel.high, e > 0.0 ? e : p->floor,
                    p->is_seen ? c->seen_is_dominated : c->arithmetic_is_dominated);
        }
        fputs("END\n", out);
    }
}

/* What stands in the key: the level, and what it costs. */
static void print_entry(const rt_study *study, size_t level_index, FILE *out)
{
    const rt_spread *r = &rt_study_cell_at(study, study->plan.sample_count - 1, level_index)->ratio;
    const enum rt_accuracy level = study->levels[level_index].level;
    if (level == study->base)
        fprintf(out, "\"%s\"", rt_accuracy_name(level));
    else if (rt_study_is_free(r))
        fprintf(out, "\"%s: no measurable cost\"", rt_accuracy_name(level));
    else
        fprintf(out, "\"%s: %.2f times %s\"", rt_accuracy_name(level), r->median,
                rt_accuracy_name(study->base));
}

static void print_panel(const rt_study *study, const panel *p, FILE *out)
{
    fprintf(out,
            "set title \"%s\"\n"
            "set yrange [%.9g:%.9g]\n"
            "set ytics nomirror format \"10^{%%T}\"\n"
            "set object 1 rectangle from graph 0, first %.9g to graph 1, first %g behind "
            "fillcolor rgb '#F0F0F0' fillstyle solid noborder\n"
            "set label 1 \"below the rounding of an 8-bit file\" at graph 0.02, first %g offset "
            "0,-0.7 textcolor rgb '#808080' font ',0.8'\n",
            p->title, p->low, p->high, p->low, ROUNDING_RMS, ROUNDING_RMS);
    if (p->floor > 0.0)
        fprintf(out, "set ytics add (\"0\" %.9g)\n", p->floor);
    fputs("plot ", out);
    for (size_t k = 0; k < study->level_count; ++k) {
        const char *name = name_at(study, k), *color = looks[study->levels[k].level].color;
        const int mark = looks[study->levels[k].level].mark;
        fprintf(out,
                "$%s_%d using 2:5 with lines lw 2 lc rgb '%s' notitle, "
                "'' using 2:5:3:4 with xerrorbars lw 2 lc rgb '%s' pt 0 notitle, "
                "'' using 2:5 with points pt %d ps 1.7 lc rgb '%s' notitle, "
                "'' using ($6 > 0 ? $2 : NaN):5 with points pt %d ps 1.7 lc rgb '#BBBBBB' notitle, "
                "NaN with linespoints lw 2 pt %d ps 1.7 lc rgb '%s' title ",
                name, p->is_seen, color, color, mark, color, mark, mark, color);
        print_entry(study, k, out);
        fputs(", ", out);
    }
    fprintf(out,
            "$%s_%d using 2:5:1 with labels offset 0,1.1 textcolor rgb '#404040' notitle, "
            "NaN with points pt 7 ps 1.7 lc rgb '#BBBBBB' title \"grey: another does as well in "
            "less time\"\n",
            rt_accuracy_name(study->base), p->is_seen);
    if (p->floor > 0.0)
        fputs("unset ytics\n", out);
}

static void print_page(const rt_study *study, const panel panels[2], FILE *out)
{
    const char *clock = study->kernel_is_wall ? "wall time" : "kernel time";
    fputs("set multiplot layout 1,2 title ", out);
    print_quoted(study->scene, out);
    fprintf(out,
            " noenhanced font ',1.2'\n"
            "set logscale xy\n"
            "set border 3 lc rgb '#404040'\n"
            "set grid lc rgb '#E0E0E0' lw 1\n"
            "set tics nomirror out\n"
            "set key below left Left reverse samplen 2 maxrows 3\n"
            "set offsets graph 0.1, graph 0.1, 0, 0\n"
            "set xlabel \"%s of a picture, ms (numbers: samples a pixel)\"\n"
            "set ylabel \"RMS error, 8-bit steps\"\n",
            clock);
    print_panel(study, &panels[0], out);
    print_panel(study, &panels[1], out);
    fputs("unset multiplot\nreset\n", out);
}

void rt_study_plot_script(const rt_study *study, const char *svg, const char *png, FILE *out)
{
    const panel panels[2] = {
        make_panel(study, "What you see: error to the converged picture", true),
        make_panel(study, "Arithmetic alone: error to the reference at as many samples", false)};
    print_data(study, &panels[0], out);
    print_data(study, &panels[1], out);
    fputs("set terminal svg size 1200,600 dynamic enhanced background '#FFFFFF' font 'Sans,14'\n"
          "set output ",
          out);
    print_quoted(svg, out);
    fputc('\n', out);
    print_page(study, panels, out);
    /* The one terminal is part of every gnuplot, the other draws better letters. */
    fputs("if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {\n"
          "set terminal pngcairo size 1800,900 enhanced font 'Sans,16'\n"
          "} else {\n"
          "set terminal png size 1800,900 enhanced\n"
          "}\n"
          "set output ",
          out);
    print_quoted(png, out);
    fputc('\n', out);
    print_page(study, panels, out);
    fputs("set output\n", out);
}

static enum rt_plot_result run_gnuplot(int script)
{
    posix_spawn_file_actions_t actions;
    pid_t child = 0;
    int code = 0;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return RT_PLOT_FAILED;
    char name[] = "gnuplot";
    char *const arguments[] = {name, NULL};
    bool started =
        posix_spawn_file_actions_adddup2(&actions, script, STDIN_FILENO) == 0 &&
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0) == 0 &&
        posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO) == 0;
    const int error =
        started ? posix_spawnp(&child, name, &actions, NULL, arguments, environ) : EINVAL;
    posix_spawn_file_actions_destroy(&actions);
    if (error)
        return error == ENOENT ? RT_PLOT_NO_GNUPLOT : RT_PLOT_FAILED;
    while (waitpid(child, &code, 0) < 0)
        if (errno != EINTR)
            return RT_PLOT_FAILED;
    return WIFEXITED(code) && WEXITSTATUS(code) == 0 ? RT_PLOT_DRAWN : RT_PLOT_FAILED;
}

enum rt_plot_result rt_study_plot(const rt_study *study, const char *svg, const char *png)
{
    FILE *script = tmpfile();
    if (!script)
        return RT_PLOT_FAILED;
    rt_study_plot_script(study, svg, png, script);
    rewind(script); /* flushes; the child reads from the beginning */
    const enum rt_plot_result result =
        ferror(script) ? RT_PLOT_FAILED : run_gnuplot(fileno(script));
    fclose(script);
    return result;
}
