/* The floor as stairs of light. */
#include "truth/worlds.h"

#include <math.h>

#include "truth/forms.h"

/* The width of a step: seldom more than one edge in a pixel, and all phases. */
#define STEP 3.1

static double edge_at(int k)
{
    return (k - 0.5 * TRUTH_STAIRS + 0.37) * STEP;
}

static void add_stripe(truth_text *text, double low, double high, const char *material)
{
    const truth_vec a = {low, -50, 0}, b = {high, -50, 0}, c = {high, 50, 0}, d = {low, 50, 0};
    truth_triangle(text, a, b, c, material);
    truth_triangle(text, a, c, d, material);
}

void truth_add_stairs(truth_text *text)
{
    for (int k = 0; k < TRUTH_STAIRS; ++k) {
        char name[16];
        const double grey = (k + 1.0) / TRUTH_STAIRS;
        const char *what = text->row->lamp ? "kd" : "ka";
        snprintf(name, sizeof name, "grey%d", k);
        fprintf(text->out, "material %s %s %.9g %.9g %.9g\n", name, what, grey, grey, grey);
        add_stripe(text, edge_at(k), edge_at(k + 1), name);
    }
}

/* The part of a pixel's rays that are beyond an edge at the distance t from its middle. The pixel's
 * filter is a sum of numbers uniform along its sides; of what the lens adds, a disk, one component
 * alone counts, whose density is half an ellipse: Gauss's and Chebyshev's rule of the second
 * kind. */
static double part_beyond(const double widths[4], int count, double blur, double t)
{
    const int nodes = 200;
    double sum = 0.0;
    if (fabs(t) > blur + 2.0 * (widths[0] + widths[1]))
        return t < 0.0;
    if (blur == 0.0)
        return truth_sum_below(widths, count, -t);
    for (int i = 1; i <= nodes; ++i) {
        const double turn = 3.14159265358979323846 * i / (nodes + 1), s = sin(turn);
        sum += 2.0 / (nodes + 1) * s * s * truth_sum_below(widths, count, blur * cos(turn) - t);
    }
    return sum;
}

double truth_stairs_mean(const truth_picture *p, double x, double y)
{
    const rt_camera *camera = &p->scene->camera;
    const double c = cos(p->angle), s = sin(p->angle), along = x * c - y * s;
    const double widths[4] = {fabs(c), fabs(s), fabs(c), fabs(s)};
    const bool has_lens = camera->aperture > 0.0f;
    const double blur =
        has_lens ? 0.5 * (double)camera->aperture * fabs(1.0 - TRUTH_EYE / (double)camera->focus)
                 : 0.0;
    double sum = 0.0;
    for (int k = 0; k < TRUTH_STAIRS; ++k)
        sum += part_beyond(widths, p->scene->filter == RT_FILTER_BOX ? 2 : 4, blur,
                           edge_at(k) - along);
    return sum;
}

double truth_stairs_at(truth_vec at)
{
    double sum = 0.0;
    for (int k = 0; k < TRUTH_STAIRS; ++k)
        sum += at.x > edge_at(k);
    return sum;
}
