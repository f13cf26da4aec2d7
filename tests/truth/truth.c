#define _GNU_SOURCE
#include "truth/truth.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reference/scalar.h"
#include "truth/bias.h"
#include "truth/worlds.h"

/* The noise is fixed, since random numbers are a hash of pixel and sample: what holds once holds
 * always. Each gate is what noise alone would break in one table of a hundred: of its some 15,000
 * biases of a single count, and of its 200 of all counts together, at two sides each. At 3 standard
 * errors noise would break dozens; what is between is made up for by pixels, 1024 a picture. */
#define GATE_BIAS 5.0
#define GATE_ALL 4.0
/* The error of independent samples falls as n^-0.5; a slope that comes from a thousand pixels is
 * off by 0.01 or so. */
#define GATE_SLOPE (-0.5 + 0.03)
/* An RMS error of less at the first count is no noise to speak of. */
#define NOISE 1e-3

#define DEGREE (3.14159265358979323846 / 180.0)

/* ---- Counts ---- */

static const char *table_file(void)
{
    const char *name = getenv("RT_TRUTH_TABLE");
    return name && *name ? name : NULL;
}

bool truth_is_long(void)
{
    return table_file() != NULL;
}

bool truth_is_wanted(const truth_row *row)
{
    const char *part = getenv("RT_TRUTH_ROWS");
    return truth_is_long() ? !part || strstr(row->name, part) : row->in_short;
}

/* The count after one, 0 after the last. A few have all that can go wrong: 2^k samples, one more,
 * and those that leave a grid unfilled. */
static int next_count(int count)
{
    static const int few[] = {2, 3, 8, 32, 50, 128, 0};
    int i = 0;
    if (truth_is_long())
        return count < 64     ? count + 1
               : count < 100  ? 100
               : count < 256  ? 256
               : count < 1000 ? 1000
               : count < 4096 ? 4096
                              : 0;
    while (few[i] && few[i] <= count)
        ++i;
    return few[i];
}

/* 4096 is there for the slope alone. */
static bool is_for_bias(int count)
{
    return count <= 1000;
}

static bool is_for_slope(int count)
{
    return count >= 4 && (count >= 64 || (count & (count - 1)) == 0);
}

/* ---- Pictures ---- */

void truth_draw_device(const rt_scene *scene, rt_image *image)
{
    const rt_render_options options = {0};
    rt_status status = RT_STATUS_INIT;
    rt_renderer *renderer = test_renderer(scene, &options);
    assert_good(rt_renderer_draw(renderer, image, NULL, &status), &status);
    rt_renderer_free(renderer);
}

void truth_draw_reference(const rt_scene *scene, rt_image *image)
{
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_scalar_float_render(scene, image, NULL, &status), &status);
}

/* Writes a text with a number in the place of each word N. */
static void put_count(FILE *out, const char *text, int count)
{
    for (size_t i = 0; text[i]; ++i) {
        if (text[i] == 'N' && i > 0 && isspace((unsigned char)text[i - 1]) &&
            isspace((unsigned char)text[i + 1]))
            fprintf(out, "%d", count);
        else
            fputc(text[i], out);
    }
}

static void read_scene(const truth_row *row, double angle, int count, rt_scene *scene)
{
    char *text = NULL, *counted = NULL;
    size_t length = 0;
    truth_text t = {open_memstream(&text, &length), row, angle};
    assert_non_null(t.out);
    truth_begin(&t);
    if (row->add)
        row->add(&t);
    assert_int_equal(fclose(t.out), 0);
    FILE *out = open_memstream(&counted, &length);
    assert_non_null(out);
    put_count(out, text, count);
    assert_int_equal(fclose(out), 0);
    test_write_text(test_path("truth.txt"), counted);
    test_scene_file(scene, test_path("truth.txt"));
    free(text);
    free(counted);
}

/* ---- Figures ---- */

/* Sums for the line through the logarithms of count and RMS error. */
typedef struct line {
    double n, x, y, xx, xy;
    double first; /* RMS error */
} line;

static void add_to_line(line *l, int count, double rms)
{
    const double x = log(count), y = log(fmax(rms, 1e-9));
    l->first = l->n > 0.0 ? l->first : rms;
    l->n += 1.0;
    l->x += x;
    l->y += y;
    l->xx += x * x;
    l->xy += x * y;
}

static double slope_of(const line *l)
{
    if (l->n < 2.0 || l->first < NOISE)
        return NAN;
    return (l->n * l->xy - l->x * l->y) / (l->n * l->xx - l->x * l->x);
}

/* Written so that NaN is the worst. */
static void keep_worst(double *worst, double figure)
{
    if (!(figure <= *worst) && !isnan(*worst))
        *worst = figure;
}

static void take_biases(truth_tally *t, int count, bool is_middle, const double *errors,
                        truth_figures *f)
{
    const double before = f->bias;
    keep_worst(&f->bias, truth_bias(t, count, TRUTH_MEAN, errors));
    if (!is_middle)
        keep_worst(&f->bias, truth_bias(t, count, TRUTH_TILT, errors));
    if (f->bias != before && !isnan(before))
        f->bias_count = count;
}

/* A picture at a count: its errors join the figures. Returns their RMS. */
static double take_picture(const truth_row *row, truth_draw *draw, double angle, int count,
                           truth_tally *t, truth_figures *f)
{
    rt_scene scene;
    rt_image image;
    rt_status status = RT_STATUS_INIT;
    double errors[TRUTH_PIXELS] = {0.0}, squares = 0.0, most = 0.0;
    read_scene(row, angle, count, &scene);
    assert_good(rt_image_init(&image, scene.width, scene.height, false, &status), &status);
    draw(&scene, &image);
    for (size_t k = 0; k < t->pixel_count; ++k) {
        const size_t i = t->pixels[k];
        errors[i] = (double)image.rgb[3 * i] - t->truth[i];
        squares += errors[i] * errors[i];
        keep_worst(&most, 255.0 * fabs(errors[i]));
    }
    /* A single ray goes through its pixel's middle: right on average over many edges, and in no
     * single pixel. */
    if (is_for_bias(count))
        take_biases(t, count, t->has_pixels && scene.samples == 1, errors, f);
    if (count <= 256) {
        f->steps = count > f->steps_count ? 0.0 : f->steps;
        f->steps_count = count;
        keep_worst(&f->steps, most);
    }
    rt_image_clear(&image);
    rt_scene_clear(&scene);
    return sqrt(squares / (double)t->pixel_count);
}

static void expect(const truth_row *row, double angle, truth_tally *t)
{
    rt_scene scene;
    read_scene(row, angle, 2, &scene);
    const truth_picture picture = {row, angle, &scene};
    truth_expect(t, &picture);
    rt_scene_clear(&scene);
}

void truth_measure(const truth_row *row, truth_draw *draw, truth_figures *figures)
{
    static truth_tally tallies[TRUTH_ANGLES];
    const int pictures = row->pictures ? row->pictures : 1;
    line errors = {0};
    *figures = (truth_figures){0};
    for (int k = 0; k < pictures; ++k)
        expect(row, row->angles[k] * DEGREE, &tallies[k]);
    for (int n = next_count(0); n; n = next_count(n)) {
        if (row->most && (n > row->most || (n & (n - 1)) != 0))
            continue;
        /* The slope is the first picture's. */
        for (int k = 0; k < (is_for_bias(n) ? pictures : 1); ++k) {
            const double angle = row->angles[k] * DEGREE;
            const double rms = take_picture(row, draw, angle, n, &tallies[k], figures);
            if (k == 0 && is_for_slope(n))
                add_to_line(&errors, n, rms);
        }
    }
    for (int k = 0; k < pictures; ++k)
        for (int weight = 0; weight < TRUTH_WEIGHTS; ++weight)
            keep_worst(&figures->all, truth_bias_of_all(&tallies[k], (enum truth_weight)weight));
    figures->slope = slope_of(&errors);
}

/* ---- What holds ---- */

static bool is_steep(double slope)
{
    return isnan(slope) || slope <= GATE_SLOPE;
}

static bool is_near(const truth_row *row, double steps)
{
    return row->steps == 0.0 || steps <= row->steps;
}

bool truth_holds(const truth_row *row, const truth_figures *f)
{
    return f->bias <= GATE_BIAS && f->all <= GATE_ALL && is_steep(f->slope) &&
           is_near(row, f->steps);
}

static const char *bold(bool holds)
{
    return holds ? "" : "**";
}

static void tell_figures(FILE *out, const truth_row *row, const truth_figures *f)
{
    const char *b = bold(f->bias <= GATE_BIAS), *a = bold(f->all <= GATE_ALL);
    const char *s = bold(is_steep(f->slope)), *w = bold(is_near(row, f->steps));
    if (f->bias_count)
        fprintf(out, " %s%.1f at %d%s |", b, f->bias, f->bias_count, b);
    else
        fprintf(out, " 0 |");
    fprintf(out, " %s%.1f%s |", a, f->all, a);
    if (isnan(f->slope))
        fprintf(out, " no noise |");
    else
        fprintf(out, " %s%.2f%s |", s, f->slope, s);
    fprintf(out, " %s%.1f%s |", w, f->steps, w);
}

static void tell(FILE *out, const truth_row *row, const truth_figures *device,
                 const truth_figures *reference)
{
    fprintf(out, "| %s | ", row->name);
    if (row->most)
        fprintf(out, "powers of 2 to %d |", row->most);
    else
        fprintf(out, "all |");
    if (device)
        tell_figures(out, row, device);
    tell_figures(out, row, reference);
    fprintf(out, "\n");
}

void truth_tell(const truth_row *row, const truth_figures *device, const truth_figures *reference)
{
    tell(stdout, row, device, reference);
    fflush(stdout);
    if (!truth_is_long())
        return;
    FILE *file = fopen(table_file(), "a");
    assert_non_null(file);
    tell(file, row, device, reference);
    assert_int_equal(fclose(file), 0);
}
