#define _GNU_SOURCE
#include "study/plot.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "study/report_text.h"
#include "study/verdict.h"

/* Colours that people of any colour vision tell apart (Okabe and Ito 2008), paler ones of each, and
 * gnuplot's marks. */
static const struct {
    const char *color, *pale;
    int mark;
} looks[RT_ACCURACY_COUNT] = {[RT_ACCURACY_FAST] = {"#D55E00", "#F0C4A4", 9},
                              [RT_ACCURACY_STANDARD] = {"#0072B2", "#A6CCE2", 7},
                              [RT_ACCURACY_ROBUST] = {"#009E73", "#A3DACA", 5},
                              [RT_ACCURACY_DOUBLE] = {"#CC79A7", "#EBCBDC", 13}};

/* Root mean square of what rounding to whole steps adds: an error below it does not show in a file
 * of 8 bits. */
#define ROUNDING_RMS 0.2887

/* A line of the title holds so many letters. */
#define TITLE_WIDTH 84

enum panel_kind { PANEL_SEEN, PANEL_EDGES, PANEL_COUNT };

/* One of the plot's parts, side by side. */
typedef struct panel {
    enum panel_kind kind;
    double floor; /* where errors of 0 are drawn, which have no logarithm; 0 without any */
    double low, high;
} panel;

static const struct {
    const char *title, *axis;
} captions[PANEL_COUNT] = {
    [PANEL_SEEN] = {"How good a picture is for its time", "how far off, in steps of 256"},
    [PANEL_EDGES] = {"The edges of a closed mesh", "rays in a million that go wrong"}};

static double per_million(const rt_study_entry *e)
{
    return e->edge_rays ? 1e6 * (double)(e->leaks + e->double_hits) / (double)e->edge_rays : 0.0;
}

/* Leaks do not depend on the count of samples: they are drawn once, at the lowest. */
static size_t points_of(const rt_study *study, enum panel_kind kind)
{
    return kind == PANEL_EDGES ? 1 : study->plan.sample_count;
}

static double error_of(const rt_study *study, enum panel_kind kind, size_t sample, size_t entry)
{
    return kind == PANEL_EDGES ? per_million(&study->entries[entry])
                               : rt_study_cell_at(study, sample, entry)->seen.rms;
}

static panel make_panel(const rt_study *study, enum panel_kind kind)
{
    double low = INFINITY, high = 0.0;
    bool has_zero = false;
    for (size_t i = 0; i < points_of(study, kind); ++i)
        for (size_t k = 0; k < study->entry_count; ++k) {
            const double e = error_of(study, kind, i, k);
            has_zero = has_zero || e <= 0.0;
            low = e > 0.0 && e < low ? e : low;
            high = e > high ? e : high;
        }
    if (!(high > 0.0))
        low = high = 1.0;
    if (kind != PANEL_EDGES) { /* the line of rounding is part of the view */
        high = high < 1.0 ? 1.0 : high;
        low = low > 0.1 ? 0.1 : low;
    }
    const double decade = pow(10.0, floor(log10(low)));
    return (panel){kind, has_zero ? 0.1 * decade : 0.0, has_zero ? 0.04 * decade : 0.8 * decade,
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

/* A block an entry and panel: samples; median and quartiles of ms; error; whether it is dominated.
 */
static void print_data(const rt_study *study, const panel *p, FILE *out)
{
    for (size_t k = 0; k < study->entry_count; ++k) {
        fprintf(out, "$entry%zu_%d << END\n", k, (int)p->kind);
        for (size_t i = 0; i < points_of(study, p->kind); ++i) {
            const rt_study_cell *c = rt_study_cell_at(study, i, k);
            const double e = error_of(study, p->kind, i, k);
            fprintf(out, "%d %.9g %.9g %.9g %.9g %d\n", study->plan.samples[i],
                    1e3 * c->kernel.median, 1e3 * c->kernel.low, 1e3 * c->kernel.high,
                    e <= 0.0 ? p->floor : e, p->kind == PANEL_SEEN && c->seen_is_dominated);
        }
        fputs("END\n", out);
    }
}

/* The lines, those of each device in a dash of its own; then pale what is not worth its time, then
 * the rest on top of it. */
static void print_curves(const rt_study *study, const panel *p, FILE *out)
{
    fputs("plot ", out);
    for (size_t k = 0; k < study->entry_count; ++k) {
        const rt_study_entry *e = &study->entries[k];
        fprintf(out,
                "$entry%zu_%d using 2:5 with lines lw 2 dt %zu lc rgb '%s' notitle, "
                "'' using 2:5:3:4 with xerrorbars lw 2 lc rgb '%s' pt 0 notitle, ",
                k, (int)p->kind, e->device + 1, looks[e->level].color, looks[e->level].color);
    }
    for (int is_dominated = 1; is_dominated >= 0; --is_dominated)
        for (size_t k = 0; k < study->entry_count; ++k) {
            const enum rt_accuracy level = study->entries[k].level;
            fprintf(out,
                    "$entry%zu_%d using ($6 == %d ? $2 : NaN):5 with points pt %d ps 1.6 lc rgb "
                    "'%s' notitle, ",
                    k, (int)p->kind, is_dominated, looks[level].mark,
                    is_dominated ? looks[level].pale : looks[level].color);
        }
}

/* The key is that of all panels, and stands below the first. */
static void print_key(const rt_study *study, FILE *out)
{
    for (size_t k = 0; k < study->entry_count; ++k) {
        const rt_study_entry *e = &study->entries[k];
        char *text = rt_study_said(rt_study_say_briefly, study, k);
        fprintf(out, "NaN with linespoints lw 2 dt %zu pt %d ps 1.6 lc rgb '%s' title ",
                e->device + 1, looks[e->level].mark, looks[e->level].color);
        print_quoted(text ? text : "", out);
        fputs(k + 1 < study->entry_count ? ", " : "\n", out);
        free(text);
    }
}

/* Samples are written at the points of the entry to take, or of the base where there is none. */
static size_t labelled_entry(const rt_study *study)
{
    const size_t taken = rt_study_recommended(study, 0);
    return taken < study->entry_count ? taken : rt_study_find(study, 0, study->base);
}

static void print_panel(const rt_study *study, const panel *p, double left, double right, FILE *out)
{
    fprintf(out,
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set title \"%s\" font ',13'\nset ylabel \"%s\" offset 0.3,0\n"
            "set yrange [%.9g:%.9g]\nset ytics nomirror format \"%s\"\n",
            left, right, captions[p->kind].title, captions[p->kind].axis, p->low, p->high,
            p->kind == PANEL_EDGES ? "%.0f" : "%g");
    if (p->floor > 0.0)
        fprintf(out, "set ytics add (\"0\" %.9g)\n", p->floor);
    if (p->kind == PANEL_SEEN)
        fprintf(out,
                "set object 1 rectangle from graph 0, first %.9g to graph 1, first %g behind "
                "fillcolor rgb '#EFEFEF' fillstyle solid noborder\n"
                "set label 1 \"less than a file of 256 steps can show\" at graph 0.02, graph 0.04 "
                "textcolor rgb '#707070' font ',10'\n",
                p->low, ROUNDING_RMS);
    print_curves(study, p, out);
    if (p->kind == PANEL_SEEN)
        fprintf(out,
                "$entry%zu_%d using 2:5:1 with labels offset -0.7,-1 textcolor rgb '#404040' "
                "notitle, ",
                labelled_entry(study), (int)p->kind);
    if (p->kind == PANEL_SEEN)
        print_key(study, out);
    else
        fputs("NaN notitle\n", out);
    fputs("unset ytics\nunset object 1\nunset label 1\n", out);
}

/* The verdict, in lines that fit. It is made of words alone, of which none has a meaning to
 * gnuplot. */
static void print_title(const rt_study *study, FILE *out)
{
    char *text = rt_study_headline(study);
    size_t line = 0;
    fputc('"', out);
    for (const char *word = text; word && *word;) {
        const size_t length = strcspn(word, " ");
        if (line > 0 && line + 1 + length > TITLE_WIDTH) {
            fputs("\\n", out);
            line = 0;
        }
        line += (size_t)fprintf(out, "%s%.*s", line > 0 ? " " : "", (int)length, word);
        word += length + (word[length] == ' ');
    }
    fputc('"', out);
    free(text);
}

/* The page from top to bottom, at the terminals' common scale. */
#define PAGE_WIDTH 1000
#define TITLE_HEIGHT 105
#define PANEL_HEIGHT 310
#define AXIS_HEIGHT 65
#define NOTE_HEIGHT 30
#define KEY_LINE_HEIGHT 22
#define FOOT_HEIGHT 35

static int key_height(const rt_study *study)
{
    return KEY_LINE_HEIGHT * (int)study->entry_count + FOOT_HEIGHT;
}

static int page_height(const rt_study *study)
{
    return TITLE_HEIGHT + PANEL_HEIGHT + AXIS_HEIGHT + NOTE_HEIGHT + key_height(study);
}

static void print_page(const rt_study *study, const panel *panels, size_t count, FILE *out)
{
    /* A panel of one point a level needs less room than one with curves. */
    static const double edges[2][PANEL_COUNT][2] = {{{0.08, 0.97}, {0, 0}},
                                                    {{0.08, 0.62}, {0.74, 0.97}}};
    const double height = page_height(study), key = key_height(study);
    fputs("set multiplot title ", out);
    print_title(study, out);
    fprintf(
        out,
        " noenhanced font ',16' offset 0,-0.3\n"
        "set tmargin at screen %.4f\nset bmargin at screen %.4f\n"
        "set logscale xy\n"
        "set border 3 lc rgb '#404040'\n"
        "set grid lt 1 lc rgb '#DDDDDD' lw 1\n"
        "set xtics nomirror out rotate by 0 format \"%%g\"\n"
        "set offsets graph 0.08, graph 0.08, 0, 0\n"
        "set key at screen 0.07, screen %.4f left top Left reverse samplen 4 spacing 1.15 "
        "maxcols 1 noenhanced\n"
        "set xlabel \"milliseconds a picture\"\n"
        "set label 9 \"Further down is better, further left is faster. Numbers at points: "
        "samples a pixel. Pale: another point is as good in less time.\" at screen 0.07, screen "
        "%.4f textcolor rgb '#404040' font ',11'\nset label 8 ",
        1.0 - TITLE_HEIGHT / height, (key + NOTE_HEIGHT + AXIS_HEIGHT) / height, key / height,
        (key + 0.5 * NOTE_HEIGHT) / height);
    print_quoted(study->scene, out);
    fputs(" at screen 0.97, screen 0.03 right noenhanced textcolor rgb '#707070' font ',10'\n",
          out);
    for (size_t i = 0; i < count; ++i) {
        print_panel(study, &panels[i], edges[count == PANEL_COUNT][i][0],
                    edges[count == PANEL_COUNT][i][1], out);
        fputs("unset label 8\nunset label 9\nset key off\n", out);
    }
    fputs("unset multiplot\nreset\n", out);
}

void rt_study_plot_script(const rt_study *study, const char *svg, const char *png, FILE *out)
{
    panel panels[PANEL_COUNT];
    const size_t count = study->edges == RT_EDGES_TRACED ? PANEL_COUNT : PANEL_EDGES;
    for (size_t i = 0; i < count; ++i) {
        panels[i] = make_panel(study, (enum panel_kind)i);
        print_data(study, &panels[i], out);
    }
    const int width = 3 * PAGE_WIDTH / 2, height = 3 * page_height(study) / 2;
    fprintf(out,
            "set terminal svg size %d,%d dynamic enhanced background '#FFFFFF' font 'Sans,12'\n"
            "set output ",
            PAGE_WIDTH, page_height(study));
    print_quoted(svg, out);
    fputc('\n', out);
    print_page(study, panels, count, out);
    /* The one terminal draws better letters, the other is part of every gnuplot. */
    fprintf(out,
            "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {\n"
            "set terminal pngcairo size %d,%d enhanced font 'Sans,12' fontscale 1.35 linewidth 1.5 "
            "pointscale 1.4\n"
            "} else {\n"
            "set terminal png size %d,%d enhanced\n"
            "}\n"
            "set output ",
            width, height, width, height);
    print_quoted(png, out);
    fputc('\n', out);
    print_page(study, panels, count, out);
    fputs("set output\n", out);
}

enum rt_plot_result rt_study_plot(const rt_study *study, const char *svg, const char *png)
{
    FILE *script = tmpfile();
    if (!script)
        return RT_PLOT_FAILED;
    rt_study_plot_script(study, svg, png, script);
    const enum rt_plot_result result = rt_gnuplot_run(script);
    fclose(script);
    return result;
}
