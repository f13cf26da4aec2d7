#include "scene/backdrop.h"

#include <math.h>

#include "scene/camera.h"
#include "scene/places.h"

/* What a ray that hits nothing brings, as the pixel's place has it. */
typedef struct backdrop {
    vec3 bottom, rise;         /* the rise is what is added on the way from below to above */
    vec3 up;                   /* unit */
    vec3 right, down, forward; /* of the pixel's direction, not unit: right and down for half one */
    int width, height;
    double tolerance[3];
} backdrop;

static double hundredth(double component, double rise, double reach)
{
    return 0.01 * (component + fabs(rise)) + fabs(rise) * reach;
}

static backdrop backdrop_of(const rt_scene *scene)
{
    const rt_view v = rt_scene_view(scene);
    backdrop b = {.bottom = vec3_of_scene(scene->background),
                  .up = vec3_unit(vec3_of_scene(scene->camera.up)),
                  .right = {v.right[0], v.right[1], v.right[2]},
                  .down = {-v.up[0], -v.up[1], -v.up[2]},
                  .forward = {v.forward[0], v.forward[1], v.forward[2]},
                  .width = scene->width,
                  .height = scene->height};
    if (scene->has_gradient)
        b.rise = vec3_plus(vec3_of_scene(scene->background_top), -1.0, b.bottom);
    if (scene->fog_density > 0.0f) {
        b.bottom = vec3_of_scene(scene->fog);
        b.rise = (vec3){0.0, 0.0, 0.0};
    }
    /* Samples are up to a pixel to each side, and the lens turns directions too. */
    const double reach =
        2.0 * sqrt(vec3_dot(b.right, b.right)) + 0.5 * (double)scene->camera.aperture / v.focus;
    b.tolerance[0] = hundredth(b.bottom.x, b.rise.x, reach);
    b.tolerance[1] = hundredth(b.bottom.y, b.rise.y, reach);
    b.tolerance[2] = hundredth(b.bottom.z, b.rise.z, reach);
    return b;
}

/* A NaN is nothing's colour. */
static bool is_near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance;
}

static bool is_backdrop_pixel(const void *context, int x, int y, const float rgb[3])
{
    const backdrop *b = context;
    vec3 d = vec3_plus(b->forward, 2.0 * x + 1.0 - b->width, b->right);
    d = vec3_plus(d, 2.0 * y + 1.0 - b->height, b->down);
    const double part = 0.5 + 0.5 * vec3_dot(vec3_unit(d), b->up);
    const vec3 c = vec3_plus(b->bottom, part, b->rise);
    return is_near((double)rgb[0], c.x, b->tolerance[0]) &&
           is_near((double)rgb[1], c.y, b->tolerance[1]) &&
           is_near((double)rgb[2], c.z, b->tolerance[2]);
}

bool rt_scene_is_backdrop(const rt_scene *scene, const rt_image *image)
{
    const backdrop b = backdrop_of(scene);
    return rt_image_every(image, is_backdrop_pixel, &b);
}

static bool is_below(const void *context, int x, int y, const float rgb[3])
{
    const float most = *(const float *)context;
    (void)x;
    (void)y;
    return rgb[0] < most && rgb[1] < most && rgb[2] < most;
}

bool rt_scene_is_black(const rt_scene *scene, const rt_image *image)
{
    const rt_encoding *e = &scene->encoding;
    /* The curve's slope at black. */
    const float slope = e->transfer == RT_TRANSFER_SRGB ? 12.92f : 1.0f;
    const float most = 0.5f / 255.0f / (slope * exp2f(e->exposure));
    return rt_image_every(image, is_below, &most);
}
