#include "study/html.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "study/judge.h"
#include "study/report_text.h"
#include "study/strip.h"

static const char style[] =
    "body{font:16px/1.45 system-ui,sans-serif;color:#222;background:#fff;max-width:66em;"
    "margin:1.2em auto;padding:0 1em}\n"
    "h1{font-size:1.6em;line-height:1.25;margin:.1em 0 .6em}\n"
    "h2{font-size:1.2em;margin:1.8em 0 .4em}\n"
    ".of{color:#666;margin:0}\n"
    "figure{margin:0 0 1em}\nfigure img,figure svg{width:100%;height:auto;display:block}\n"
    ".three{display:grid;grid-template-columns:repeat(3,1fr);margin:.3em 0}\n"
    ".heat{display:flex;flex-wrap:wrap;gap:.3em 1em;font-size:.85em;color:#444;"
    "justify-content:flex-end}\n"
    ".heat i{display:inline-block;width:1.1em;height:1.1em;margin-right:.35em;"
    "vertical-align:-.2em;border:1px solid #888}\n"
    "table{border-collapse:collapse;margin:.6em 0;font-size:.95em}\n"
    "td,th{padding:.2em .7em .2em 0;text-align:left;vertical-align:top;"
    "border-bottom:1px solid #ddd}\n"
    "th{font-weight:600;color:#444}\n.n{text-align:right}td.n{white-space:nowrap}\n"
    ".rest table{font-size:.8em}\n";

void rt_print_base64(const char *bytes, size_t length, FILE *out)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < length; i += 3) {
        const size_t left = length - i;
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < left ? (uint8_t)bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; ++k)
            fputc(k <= left ? digits[group >> (18 - 6 * k) & 63] : '=', out);
    }
}

static void print_legend(FILE *out)
{
    fputs("<div class=\"heat\">", out);
    for (int i = 0; i < RT_HEAT_COUNT; ++i) {
        const rt_heat *h = &rt_heats[i];
        fprintf(out, "<span><i style=\"background:#%02x%02x%02x\"></i>%d", h->color[0], h->color[1],
                h->color[2], h->from);
        if (i + 1 == RT_HEAT_COUNT)
            fputs(" steps and more", out);
        else if (h->to > h->from)
            fprintf(out, " to %d", h->to);
        fputs("</span>", out);
    }
    fputs("</div>\n", out);
}

/* What stands below a picture. */
static void print_caption(const rt_study *study, int which, FILE *out)
{
    const enum rt_accuracy level = study->shown[which];
    fprintf(out, "<span><b>%s</b>", rt_study_shown_name(study, which));
    if (level < RT_ACCURACY_COUNT)
        fputs(rt_study_is_wrong(study, rt_study_find(study, 0, level))
                  ? ": visibly wrong"
                  : ": right, as far as you can see",
              out);
    fputs("</span>", out);
}

static void print_pictures(const rt_study *study, const rt_file_text *strip, FILE *out)
{
    if (strip->length == 0) {
        fputs("<p>The pictures are not here: their file was not beside the figures.</p>\n", out);
        return;
    }
    fprintf(out, "<figure><img alt=\"The scene at %s, at %s, and their difference\" src=\"",
            rt_study_shown_name(study, 0), rt_study_shown_name(study, 1));
    fputs("data:image/png;base64,", out);
    rt_print_base64(strip->bytes, strip->length, out);
    fprintf(out, "\">\n<figcaption><div class=\"three\" style=\"column-gap:%.3g%%\">",
            rt_study_strip_gap(study));
    print_caption(study, 0, out);
    print_caption(study, 1, out);
    fputs("<span><b>where they differ</b>, in steps of the 256 that a file has</span></div>\n",
          out);
    print_legend(out);
    fputs("</figcaption></figure>\n", out);
}

/* The SVG from its root on: a page has no place for what stands before it in a file. */
static void print_plot(const rt_file_text *plot, FILE *out)
{
    const char *svg = plot->length ? strstr(plot->bytes, "<svg") : NULL;
    if (svg)
        fprintf(out, "<figure>%s</figure>\n", svg);
    else
        fputs("<p>There is no plot: gnuplot was not there to draw it. <code>rt --plot</code> with "
              "the JSON file of this report draws it later.</p>\n",
              out);
}

void rt_study_print_html(const rt_study *study, const rt_file_text *strip, const rt_file_text *plot,
                         FILE *out)
{
    char *headline = rt_study_headline(study);
    rt_doc doc = {.out = out, .is_html = true};
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width\">\n<title>What accuracy costs: ",
          out);
    rt_doc_escape(study->scene, out);
    fprintf(out,
            "</title>\n<style>\n%s</style>\n</head>\n<body>\n<p class=\"of\">What accuracy "
            "costs: ",
            style);
    rt_doc_escape(study->scene, out);
    fputs("</p>\n<h1>", out);
    rt_doc_escape(headline ? headline : "", out);
    fputs("</h1>\n", out);
    print_pictures(study, strip, out);
    rt_report_first(study, &doc);
    print_plot(plot, out);
    fputs("<div class=\"rest\">\n", out);
    rt_report_rest(study, &doc);
    fputs("</div>\n</body>\n</html>\n", out);
    free(headline);
}
