#include "scene/camera.h"

#include <math.h>

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double length(const double v[3])
{
    return hypot(hypot(v[0], v[1]), v[2]);
}

static void scale(double v[3], double factor)
{
    for (int i = 0; i < 3; ++i)
        v[i] *= factor;
}

static void difference(double out[3], rt_vec3 a, rt_vec3 b)
{
    out[0] = (double)a.x - (double)b.x;
    out[1] = (double)a.y - (double)b.y;
    out[2] = (double)a.z - (double)b.z;
}

rt_view rt_scene_view(const rt_scene *scene)
{
    const rt_camera *camera = &scene->camera;
    rt_view view = {
        .origin = {(double)camera->from.x, (double)camera->from.y, (double)camera->from.z}};
    difference(view.forward, camera->at, camera->from);
    view.focus = camera->focus > 0.0f ? (double)camera->focus : length(view.forward);
    scale(view.forward, 1.0 / length(view.forward));

    double up[3];
    difference(up, camera->up, (rt_vec3){0.0f, 0.0f, 0.0f});
    scale(up, 1.0 / length(up));
    cross(view.right, view.forward, up);
    /* Two fp32 vectors that are meant to be parallel differ by rounding of about 1e-7. */
    if (length(view.right) < 1e-6) {
        int least = 0;
        for (int i = 1; i < 3; ++i)
            if (fabs(view.forward[i]) < fabs(view.forward[least]))
                least = i;
        for (int i = 0; i < 3; ++i)
            up[i] = i == least;
        cross(view.right, view.forward, up);
    }
    scale(view.right, 1.0 / length(view.right));
    cross(view.up, view.right, view.forward);

    const double radius = 0.5 * (double)camera->aperture;
    for (int i = 0; i < 3; ++i) {
        view.lens_right[i] = radius * view.right[i];
        view.lens_up[i] = radius * view.up[i];
    }

    /* Half a pixel: the image plane at distance 1 is 2 tan(vfov / 2) high, pixels are square. */
    const double pi = 3.14159265358979323846;
    const double half_pixel = tan((double)camera->vfov * pi / 360.0) / scene->height;
    scale(view.right, half_pixel);
    scale(view.up, half_pixel);
    return view;
}

rt_gradient rt_scene_gradient(const rt_scene *scene)
{
    double up[3];
    difference(up, scene->camera.up, (rt_vec3){0.0f, 0.0f, 0.0f});
    scale(up, 1.0 / length(up));
    return (rt_gradient){scene->background_top.x,
                         scene->background_top.y,
                         scene->background_top.z,
                         (float)up[0],
                         (float)up[1],
                         (float)up[2]};
}

/* Both kinds of frame have the same fields. */
#define FRAME(type, number, v, scene)                                                              \
    (type)                                                                                         \
    {                                                                                              \
        .ox = (number)(v).origin[0], .oy = (number)(v).origin[1], .oz = (number)(v).origin[2],     \
        .right_x = (number)(v).right[0], .right_y = (number)(v).right[1],                          \
        .right_z = (number)(v).right[2], .up_x = (number)(v).up[0], .up_y = (number)(v).up[1],     \
        .up_z = (number)(v).up[2], .forward_x = (number)(v).forward[0],                            \
        .forward_y = (number)(v).forward[1], .forward_z = (number)(v).forward[2],                  \
        .lens_right_x = (number)(v).lens_right[0], .lens_right_y = (number)(v).lens_right[1],      \
        .lens_right_z = (number)(v).lens_right[2], .lens_up_x = (number)(v).lens_up[0],            \
        .lens_up_y = (number)(v).lens_up[1], .lens_up_z = (number)(v).lens_up[2],                  \
        .focus = (number)(v).focus, .width = (scene)->width, .height = (scene)->height             \
    }

rt_frame rt_scene_frame(const rt_scene *scene)
{
    const rt_view view = rt_scene_view(scene);
    return FRAME(rt_frame, float, view, scene);
}

rt_frame_double rt_scene_frame_double(const rt_scene *scene)
{
    const rt_view view = rt_scene_view(scene);
    return FRAME(rt_frame_double, double, view, scene);
}
