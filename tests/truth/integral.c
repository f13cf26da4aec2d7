/* The integrator: the mean of what comes along rays through a pixel and the lens, by a camera and
 * sample points of its own. */
#include "truth/truth.h"

#include <math.h>

#define POINTS 8192

/* Roberts's sequence of four dimensions (2018): multiples of the powers of the root of
 * x^5 = x + 1, shifted by another vector for each pixel, so that errors of pixels are independent:
 * they are in the standard errors like the picture's own. */
static void next_point(double point[4])
{
    double step = 1.0;
    for (int i = 0; i < 4; ++i) {
        step /= 1.1673039782614187;
        point[i] += step;
        point[i] -= floor(point[i]);
    }
}

/* From [0, 1) to the pixel's filter. */
static double filtered(const rt_scene *scene, double u)
{
    if (scene->samples == 1)
        return 0.0;
    if (scene->filter == RT_FILTER_BOX)
        return u - 0.5;
    return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * u);
}

/* The ray through pixel (x, y), counted from the middle, for a point of the unit cube. */
static truth_ray ray_through(const truth_picture *p, double x, double y, const double point[4])
{
    const rt_camera *camera = &p->scene->camera;
    const double radius = 0.5 * (double)camera->aperture * sqrt(point[2]);
    const double turn = 6.28318530717958647692 * point[3];
    const double focus = camera->focus > 0.0f ? (double)camera->focus : TRUTH_EYE;
    const double c = focus / TRUTH_EYE * cos(p->angle), s = focus / TRUTH_EYE * sin(p->angle);
    const double right = x + filtered(p->scene, point[0]), up = y + filtered(p->scene, point[1]);
    const truth_vec origin = {radius * cos(turn), radius * sin(turn), TRUTH_EYE};
    return (truth_ray){origin,
                       {c * right - s * up - origin.x, s * right + c * up - origin.y, -focus}};
}

static double pixel_mean(const truth_picture *p, double x, double y, test_random *random)
{
    const bool is_random = p->scene->samples > 1 || p->scene->camera.aperture > 0.0f;
    const int count = is_random ? POINTS : 1;
    double point[4], sum = 0.0;
    for (int i = 0; i < 4; ++i)
        point[i] = (double)test_random_float(random, 0.0f, 1.0f);
    for (int i = 0; i < count; ++i) {
        const truth_ray ray = ray_through(p, x, y, point);
        sum += p->row->light(p, &ray);
        next_point(point);
    }
    return sum / count;
}

void truth_integrate(const truth_picture *picture, double *means)
{
    const truth_row *row = picture->row;
    test_random random = {1};
    for (int i = 0; i < TRUTH_PIXELS; ++i) {
        const double x = i % TRUTH_SIDE + 0.5 * (1 - TRUTH_SIDE);
        const double y = 0.5 * (TRUTH_SIDE - 1) - i / TRUTH_SIDE;
        means[i] = row->mean ? row->mean(picture, x, y) : pixel_mean(picture, x, y, &random);
        if (row->mirror > 0.0)
            means[i] *= row->mirror;
    }
}
