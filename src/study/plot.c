#define _GNU_SOURCE
#include "study/plot.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "study/verdict.h"

extern char **environ;

/* Colours that people of any colour vision tell apart (Okabe and Ito 2008), and gnuplot's marks. */
static const struct {
    const char *color;
    int mark;
} looks[RT_ACCURACY_COUNT] = {[RT_ACCURACY_FAST] = {"#D55E00", 9},
                              [RT_ACCURACY_STANDARD] = {"#0072B2", 7},
                              [RT_ACCURACY_ROBUST] = {"#009E73", 5},
                              [RT_ACCURACY_DOUBLE] = {"#CC79A7", 13}};

#define GREY "#BBBBBB"

/* Root mean square of what rounding to whole steps adds: an error below it does not show in a file
 * of 8 bits. */
#define ROUNDING_RMS 0.2887

enum panel_kind { PANEL_SEEN, PANEL_ARITHMETIC, PANEL_EDGES, PANEL_COUNT };

/* One of the plot's parts, side by side. */
typedef struct panel {
    enum panel_kind kind;
    double floor; /* where errors of 0 are drawn, which have no logarithm; 0 without any */
    double low, high;
} panel;

static const struct {
    const char *title, *axis;
} captions[PANEL_COUNT] = {
    [PANEL_SEEN] = {"What you see\\n{/=11 error to the converged picture}",
                    "RMS error, 8-bit steps"},
    [PANEL_ARITHMETIC] = {"Arithmetic alone\\n{/=11 error to the exact picture of as many samples}",
                          "RMS error, 8-bit steps"},
    [PANEL_EDGES] = {"A closed mesh\\n{/=11 leaks and double hits}",
                     "per million rays aimed at its edges"}};

static double per_million(const rt_study_level *l)
{
    return l->edge_rays ? 1e6 * (double)(l->leaks + l->double_hits) / (double)l->edge_rays : 0.0;
}

/* Leaks do not depend on the count of samples: they are drawn once, at the lowest. */
static size_t points_of(const rt_study *study, enum panel_kind kind)
{
    return kind == PANEL_EDGES ? 1 : study->plan.sample_count;
}

static double error_of(const rt_study *study, enum panel_kind kind, size_t sample, size_t level)
{
    const rt_study_cell *cell = rt_study_cell_at(study, sample, level);
    switch (kind) {
    case PANEL_SEEN:
        return cell->seen.rms;
    case PANEL_ARITHMETIC:
        /* What is the reference itself has no error to show. */
        return !study->reference_is_scalar && cell->level == study->reference_level
                   ? NAN
                   : cell->arithmetic.rms;
    default:
        return per_million(&study->levels[level]);
    }
}

static bool is_dominated(const rt_study *study, enum panel_kind kind, size_t sample, size_t level)
{
    rt_study_point points[RT_ACCURACY_COUNT];
    switch (kind) {
    case PANEL_SEEN:
        return rt_study_cell_at(study, sample, level)->seen_is_dominated;
    case PANEL_ARITHMETIC:
        return rt_study_cell_at(study, sample, level)->arithmetic_is_dominated;
    default:
        for (size_t i = 0; i < study->level_count; ++i)
            points[i] = (rt_study_point){rt_study_cell_at(study, sample, i)->kernel,
                                         per_million(&study->levels[i])};
        return rt_study_is_dominated(points, study->level_count, level);
    }
}

static panel make_panel(const rt_study *study, enum panel_kind kind)
{
    double low = INFINITY, high = 0.0;
    bool has_zero = false;
    for (size_t i = 0; i < points_of(study, kind); ++i)
        for (size_t k = 0; k < study->level_count; ++k) {
            const double e = error_of(study, kind, i, k);
            has_zero = has_zero || e <= 0.0;
            low = e > 0.0 && e < low ? e : low;
            high = e > high ? e : high;
        }
    if (!(high > 0.0))
        low = high = kind == PANEL_EDGES ? 1.0 : 1e-6;
    if (kind != PANEL_EDGES) { /* the line of rounding is part of the view */
        high = high < 1.0 ? 1.0 : high;
        low = low > 0.1 ? 0.1 : low;
    }
    const double decade = pow(10.0, floor(log10(low)));
    return (panel){kind, has_zero ? 0.1 * decade : 0.0,
                   has_zero                   ? 0.02 * decade
                   : kind == PANEL_ARITHMETIC ? 0.15 * decade
                                              : 0.6 * decade,
                   3.0 * high};
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

/* A block a level and panel: samples; median and quartiles of ms; error; whether it is dominated.
 */
static void print_data(const rt_study *study, const panel *p, FILE *out)
{
    for (size_t k = 0; k < study->level_count; ++k) {
        fprintf(out, "$%s_%d << END\n", rt_accuracy_name(study->levels[k].level), (int)p->kind);
        for (size_t i = 0; i < points_of(study, p->kind); ++i) {
            const rt_study_cell *c = rt_study_cell_at(study, i, k);
            const double e = error_of(study, p->kind, i, k);
            fprintf(out, "%d %.9g %.9g %.9g %.9g %d\n", c->samples, 1e3 * c->kernel.median,
                    1e3 * c->kernel.low, 1e3 * c->kernel.high, e <= 0.0 ? p->floor : e,
                    is_dominated(study, p->kind, i, k));
        }
        fputs("END\n", out);
    }
}

/* The lines, then in grey what is not worth its time, then the rest on top of it. */
static void print_curves(const rt_study *study, const panel *p, FILE *out)
{
    fputs("plot ", out);
    for (size_t k = 0; k < study->level_count; ++k) {
        const enum rt_accuracy level = study->levels[k].level;
        fprintf(out,
                "$%s_%d using 2:5 with lines lw 2 lc rgb '%s' notitle, "
                "'' using 2:5:3:4 with xerrorbars lw 2 lc rgb '%s' pt 0 notitle, ",
                rt_accuracy_name(level), (int)p->kind, looks[level].color, looks[level].color);
    }
    for (int is_dominated = 1; is_dominated >= 0; --is_dominated)
        for (size_t k = 0; k < study->level_count; ++k) {
            const enum rt_accuracy level = study->levels[k].level;
            fprintf(out,
                    "$%s_%d using ($6 == %d ? $2 : NaN):5 with points pt %d ps 1.6 lc rgb '%s' "
                    "notitle, ",
                    rt_accuracy_name(level), (int)p->kind, is_dominated, looks[level].mark,
                    is_dominated ? GREY : looks[level].color);
        }
}

/* The key is that of all panels, and stands below the first. */
static void print_key(const rt_study *study, FILE *out)
{
    for (size_t k = 0; k < study->level_count; ++k) {
        const enum rt_accuracy level = study->levels[k].level;
        fprintf(out, "NaN with linespoints lw 2 pt %d ps 1.6 lc rgb '%s' title \"",
                looks[level].mark, looks[level].color);
        rt_study_say_briefly(study, k, out);
        fputs("\", ", out);
    }
    fputs("NaN with points pt 7 ps 1.6 lc rgb '" GREY "' title \"grey: another is as good in less "
          "time, or better in as much\"\n",
          out);
}

static void print_panel(const rt_study *study, const panel *p, double left, double right, FILE *out)
{
    fprintf(out,
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set title \"%s\" font ',14'\nset ylabel \"%s\" offset 0.3,0\n"
            "set yrange [%.9g:%.9g]\nset ytics nomirror format \"10^{%%T}\"\n",
            left, right, captions[p->kind].title, captions[p->kind].axis, p->low, p->high);
    if (p->floor > 0.0)
        fprintf(out, "set ytics add (\"0\" %.9g)\n", p->floor);
    if (p->kind != PANEL_EDGES)
        fprintf(out,
                "set object 1 rectangle from graph 0, first %.9g to graph 1, first %g behind "
                "fillcolor rgb '#EFEFEF' fillstyle solid noborder\n"
                "set label 1 \"less than what rounding to 8 bits does\" at graph 0.02, graph 0.03 "
                "textcolor rgb '#707070' font ',10'\n",
                p->low, ROUNDING_RMS);
    print_curves(study, p, out);
    if (p->kind != PANEL_EDGES)
        fprintf(out,
                "$%s_%d using 2:5:1 with labels offset -0.7,-1 textcolor rgb '#404040' notitle, ",
                rt_accuracy_name(study->base), (int)p->kind);
    if (p->kind == PANEL_SEEN)
        print_key(study, out);
    else
        fputs("NaN notitle\n", out);
    fputs("unset ytics\nunset object 1\nunset label 1\n", out);
}

static void print_page(const rt_study *study, const panel *panels, size_t count, FILE *out)
{
    /* A panel of one point a level needs less room than one with curves. */
    static const double edges[2][PANEL_COUNT][2] = {{{0.07, 0.49}, {0.57, 0.98}, {0, 0}},
                                                    {{0.06, 0.37}, {0.44, 0.71}, {0.80, 0.98}}};
    fputs("set multiplot title ", out);
    print_quoted(study->scene, out);
    fprintf(out,
            " noenhanced font ',16' offset 0,-0.3\n"
            "set tmargin at screen 0.84\nset bmargin at screen 0.37\n"
            "set logscale xy\n"
            "set border 3 lc rgb '#404040'\n"
            "set grid lt 1 lc rgb '#DDDDDD' lw 1\n"
            "set xtics nomirror out rotate by 0\n"
            "set offsets graph 0.08, graph 0.08, 0, 0\n"
            "set key at screen 0.06, screen 0.22 left top Left reverse samplen 2 spacing 1.15 "
            "maxcols 1\n"
            "set xlabel \"%s of a picture, ms\"\n"
            "set label 9 \"Numbers at points: samples a pixel. Bars: quartiles of the time. "
            "%dx%d pixels.\" at screen 0.06, screen 0.245 textcolor rgb '#404040'\n",
            study->kernel_is_wall ? "wall time" : "kernel time", study->width, study->height);
    for (size_t i = 0; i < count; ++i) {
        print_panel(study, &panels[i], edges[count == PANEL_COUNT][i][0],
                    edges[count == PANEL_COUNT][i][1], out);
        fputs("unset label 9\nset key off\n", out);
    }
    fputs("unset multiplot\nreset\n", out);
}

void rt_study_plot_script(const rt_study *study, const char *svg, const char *png, FILE *out)
{
    panel panels[PANEL_COUNT];
    const size_t count = study->no_edges ? PANEL_EDGES : PANEL_COUNT;
    for (size_t i = 0; i < count; ++i) {
        panels[i] = make_panel(study, (enum panel_kind)i);
        print_data(study, &panels[i], out);
    }
    fputs("set terminal svg size 1200,660 dynamic enhanced background '#FFFFFF' font 'Sans,12'\n"
          "set output ",
          out);
    print_quoted(svg, out);
    fputc('\n', out);
    print_page(study, panels, count, out);
    /* The one terminal draws better letters, the other is part of every gnuplot. */
    fputs(
        "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {\n"
        "set terminal pngcairo size 1800,990 enhanced font 'Sans,12' fontscale 1.35 linewidth 1.5 "
        "pointscale 1.4\n"
        "} else {\n"
        "set terminal png size 1800,990 enhanced\n"
        "}\n"
        "set output ",
        out);
    print_quoted(png, out);
    fputc('\n', out);
    print_page(study, panels, count, out);
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
