#define _GNU_SOURCE
#include "study/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/verdict.h"

/* Text written by `print` to an output. */
static bool write_text(const rt_study *study, const char *plot,
                       void (*print)(const rt_study *study, const char *plot, FILE *out),
                       rt_output *output, rt_status *status)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out)
        print(study, plot, out);
    const bool good = (out && fclose(out) == 0) || rt_status_no_memory(status, "--study");
    const bool written = good && rt_output_write(output, text, length, status);
    free(text);
    return written;
}

/* A field of RFC 4180. */
static void print_field(const char *text, FILE *out)
{
    fputc('"', out);
    for (; *text; ++text) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

/* An empty field where there is no number. */
static void print_number(double value, FILE *out)
{
    fputc(',', out);
    if (isfinite(value))
        fprintf(out, "%.9g", value);
}

static void print_spread(const rt_spread *s, FILE *out)
{
    print_number(s->low, out);
    print_number(s->median, out);
    print_number(s->high, out);
}

static void print_error(const rt_study_error *e, FILE *out)
{
    fprintf(out, ",%zu,%zu,%zu,%d", e->over_0, e->over_1, e->over_8, e->max_step);
    print_number(e->rms, out);
    fprintf(out, ",%zu", e->non_finite);
}

static void print_csv(const rt_study *study, const char *plot, FILE *out)
{
    (void)plot;
    fputs("scene,device,width,height,level,samples,program_s,upload_s,kernel_q1_s,kernel_s,"
          "kernel_q3_s,readback_q1_s,readback_s,readback_q3_s,wall_q1_s,wall_s,wall_q3_s,"
          "ratio_q1,ratio,ratio_q3,rays,same_over_0,same_over_1,same_over_8,same_max_steps,"
          "same_rms_steps,non_finite,converged_over_0,converged_over_1,converged_over_8,"
          "converged_max_steps,converged_rms_steps,converged_non_finite,changed,dominated_same,"
          "dominated_converged,trace_rays,trace_hits,disagreements,t_ulp_p50,t_ulp_p99,t_ulp_max,"
          "next_rays,self_hits,edge_rays,leaks,double_hits\r\n",
          out);
    for (size_t i = 0; i < study->cell_count; ++i) {
        const rt_study_cell *c = &study->cells[i];
        const rt_study_level *l = &study->levels[i % study->level_count];
        print_field(study->scene, out);
        fputc(',', out);
        print_field(study->device->name, out);
        fprintf(out, ",%d,%d,%s,%d", study->width, study->height, rt_accuracy_name(c->level),
                c->samples);
        print_number(c->program, out);
        print_number(c->upload, out);
        print_spread(&c->kernel, out);
        print_spread(&c->readback, out);
        print_spread(&c->wall, out);
        print_spread(&c->ratio, out);
        fprintf(out, ",%zu", c->rays);
        print_error(&c->arithmetic, out);
        print_error(&c->seen, out);
        fprintf(out, ",%zu,%d,%d,%zu,%zu,%zu", c->changed, c->arithmetic_is_dominated,
                c->seen_is_dominated, l->rays, l->hits, l->disagreements);
        print_number(l->t_p50, out);
        print_number(l->t_p99, out);
        print_number(l->t_max, out);
        fprintf(out, ",%zu,%zu", l->next_rays, l->self_hits);
        if (study->no_edges)
            fputs(",,,\r\n", out);
        else
            fprintf(out, ",%zu,%zu,%zu\r\n", l->edge_rays, l->leaks, l->double_hits);
    }
}

bool rt_study_write_csv(const rt_study *study, rt_output *output, rt_status *status)
{
    return write_text(study, NULL, print_csv, output, status);
}

static void print_pictures(const rt_study *study, FILE *out)
{
    const char *base = rt_accuracy_name(study->base);
    fprintf(out,
            "| samples | level | kernel, ms | times %s | RMS to converged | pixels off | RMS "
            "of arithmetic | pixels off by > 0, 1, 8 steps | worst, steps |\n"
            "|---:|---|---:|---|---:|---:|---:|---:|---:|\n",
            base);
    for (size_t i = 0; i < study->cell_count; ++i) {
        const rt_study_cell *c = &study->cells[i];
        fprintf(out, "| %d | %s | %.4g | ", c->samples, rt_accuracy_name(c->level),
                1e3 * c->kernel.median);
        if (c->level == study->base)
            fputs("1", out);
        else if (rt_study_is_free(&c->ratio))
            fprintf(out, "no measurable cost (%.2f to %.2f)", c->ratio.low, c->ratio.high);
        else
            fprintf(out, "%.2f (%.2f to %.2f)", c->ratio.median, c->ratio.low, c->ratio.high);
        fprintf(out, " | %.3g | %zu | ", c->seen.rms, c->seen.over_1);
        if (!study->reference_is_scalar && c->level == study->reference_level)
            fputs("the reference | | |\n", out);
        else
            fprintf(out, "%.2g | %zu, %zu, %zu | %d |\n", c->arithmetic.rms, c->arithmetic.over_0,
                    c->arithmetic.over_1, c->arithmetic.over_8, c->arithmetic.max_step);
        if (i % study->level_count + 1 == study->level_count) {
            const rt_study_error *e = &study->sampling[i / study->level_count];
            fprintf(out, "| %d | *reference* | | | %.3g | %zu | 0 | | |\n", c->samples, e->rms,
                    e->over_1);
        }
    }
}

static void print_per_million(size_t count, size_t of, FILE *out)
{
    if (of == 0)
        fputs(" | -", out);
    else
        fprintf(out, " | %.3g", 1e6 * (double)count / (double)of);
}

static void print_rays(const rt_study *study, FILE *out)
{
    fputs("| level | other primitive, per M rays | t off, ulp: median | 99 % | worst | self-hits, "
          "per M next rays |",
          out);
    fputs(study->no_edges ? "\n|---|---:|---:|---:|---:|---:|\n"
                          : " leaks, per M rays at edges | double hits |\n"
                            "|---|---:|---:|---:|---:|---:|---:|---:|\n",
          out);
    for (size_t i = 0; i < study->level_count; ++i) {
        const rt_study_level *l = &study->levels[i];
        fprintf(out, "| %s", rt_accuracy_name(l->level));
        print_per_million(l->disagreements, l->rays, out);
        if (isnan(l->t_p50))
            fputs(" | - | - | -", out);
        else
            fprintf(out, " | %.0f | %.0f | %.0f", l->t_p50, l->t_p99, l->t_max);
        print_per_million(l->self_hits, l->next_rays, out);
        if (!study->no_edges) {
            print_per_million(l->leaks, l->edge_rays, out);
            print_per_million(l->double_hits, l->edge_rays, out);
        }
        fputs(" |\n", out);
    }
}

static void print_times(const rt_study *study, FILE *out)
{
    fputs("| samples | level | program, ms | upload, ms | kernel, ms: quartiles | read-back, ms | "
          "wall, ms: quartiles | rays |\n"
          "|---:|---|---:|---:|---:|---:|---:|---:|\n",
          out);
    for (size_t i = 0; i < study->cell_count; ++i) {
        const rt_study_cell *c = &study->cells[i];
        fprintf(out, "| %d | %s | %.3g | %.3g | %.4g to %.4g | %.3g | %.4g to %.4g | %zu |\n",
                c->samples, rt_accuracy_name(c->level), 1e3 * c->program, 1e3 * c->upload,
                1e3 * c->kernel.low, 1e3 * c->kernel.high, 1e3 * c->readback.median,
                1e3 * c->wall.low, 1e3 * c->wall.high, c->rays);
    }
}

static size_t non_finite(const rt_study *study)
{
    size_t sum = 0;
    for (size_t i = 0; i < study->cell_count; ++i)
        sum += study->cells[i].seen.non_finite;
    return sum;
}

static void print_notes(const rt_study *study, FILE *out)
{
    const rt_study_level *l = &study->levels[0];
    const size_t pixels = (size_t)study->width * (size_t)study->height;
    if (study->reference_is_scalar)
        fprintf(out,
                "- The reference of the pictures is the scalar path in double, at %d samples a "
                "pixel where it counts as converged.\n",
                study->converged_samples);
    else
        fprintf(out,
                "- The scalar path in double would take %.3g s for one sample a pixel, so the "
                "reference of the pictures is the device at %s, at %d samples a pixel where it "
                "counts as converged. Its rays are held against the scalar path above.\n",
                study->reference_seconds, rt_accuracy_name(study->reference_level),
                study->converged_samples);
    fprintf(out,
            "- Same rays: %zu primary rays in fp32, %s, against the scalar path in double; %zu "
            "of them hit. Next rays are handed to each level as fp32 rays too.\n",
            l->rays, l->rays == pixels ? "one a pixel" : "evenly spread over the picture", l->hits);
    if (study->no_edges)
        fprintf(out, "- Leaks and double hits: not applicable, %s.\n", study->no_edges);
    else
        fprintf(out,
                "- Leaks and double hits: %zu rays from inside the largest closed mesh (%zu "
                "triangles) at its edges.\n",
                l->edge_rays, study->edge_triangles);
    fprintf(out, "- Pixels that are not finite: %zu.\n", non_finite(study));
    fprintf(out,
            "- Times: %d after one that does not count, level by level there and back; "
            "medians, and quartiles where two numbers stand; pictures of less than 25 ms are "
            "rendered several times a repeat. Ratios are taken round by round; "
            "where the quartiles of a ratio have 1 between them, there is no measurable "
            "cost.%s Building the program counts what the driver had to do: less where it "
            "keeps programs from earlier runs.\n",
            study->plan.repeats,
            study->kernel_is_wall ? " This device has no clock: kernel times are wall times." : "");
    fputs("- A pixel is off where a component differs by more than one 8-bit step. A level changes "
          "something that one can see where it puts pixels off from the base level's, more than "
          "one for every hundred that too few samples put off anyway.\n",
          out);
}

static void print_md(const rt_study *study, const char *plot, FILE *out)
{
    char *verdict = rt_study_verdict(study);
    fprintf(out, "# What accuracy costs: %s\n\n%s\n", study->scene, verdict ? verdict : "");
    free(verdict);
    if (plot)
        fprintf(out, "![time against error, by level](%s)\n\n", plot);
    fprintf(out, "%dx%d pixels on %s (%s %s).\n", study->width, study->height, study->device->name,
            study->device->platform_name, study->device->driver);
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i)
        if (study->lacks[i])
            fprintf(out, "This device does not have the level %s.\n",
                    rt_accuracy_name((enum rt_accuracy)i));
    fputs("\n## Pictures\n\nErrors in 8-bit steps: to the converged reference, which is what a "
          "viewer "
          "sees, and to the reference at as many samples, which is arithmetic alone.\n\n",
          out);
    print_pictures(study, out);
    fputs("\n## The same rays\n\n", out);
    print_rays(study, out);
    fputs("\n## Times\n\n", out);
    print_times(study, out);
    fputs("\n## How it was measured\n\n", out);
    print_notes(study, out);
}

bool rt_study_write_md(const rt_study *study, const char *plot, rt_output *output,
                       rt_status *status)
{
    return write_text(study, plot, print_md, output, status);
}
