/* Statements about the picture, the eye and what surrounds the scene. Each names its fields in the
 * order of its row. */
#include "scene_text/parser.h"

bool rt_scene_apply_image(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { WIDTH, HEIGHT, SAMPLES, FILTER, SEED, ENCODING, EXPOSURE };
    rt_scene *scene = p->scene;
    scene->width = rt_value_count(&l->values[WIDTH], scene->width);
    scene->height = rt_value_count(&l->values[HEIGHT], scene->height);
    scene->samples = rt_value_count(&l->values[SAMPLES], scene->samples);
    if (l->values[FILTER].given)
        scene->filter = l->values[FILTER].choice == 0 ? RT_FILTER_BOX : RT_FILTER_TENT;
    scene->seed = (uint32_t)rt_value_count(&l->values[SEED], (int)scene->seed);
    if (l->values[ENCODING].given)
        scene->encoding.transfer =
            l->values[ENCODING].choice == 0 ? RT_TRANSFER_LINEAR : RT_TRANSFER_SRGB;
    scene->encoding.exposure = rt_value_number(&l->values[EXPOSURE], scene->encoding.exposure);
    scene->image_place = rt_source_place(src);
    const long long pixels = (long long)scene->width * scene->height;
    return pixels <= RT_IMAGE_PIXELS_MAX ||
           RT_FAIL_AT(src, l->start, "the picture has %lld pixels; %lld are the most", pixels,
                      (long long)RT_IMAGE_PIXELS_MAX);
}

bool rt_scene_apply_camera(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { FROM, AT, UP, VFOV, APERTURE, FOCUS };
    rt_camera *camera = &p->scene->camera;
    camera->from = rt_value_vector(&l->values[FROM], camera->from);
    camera->at = rt_value_vector(&l->values[AT], camera->at);
    camera->up = rt_value_vector(&l->values[UP], camera->up);
    camera->vfov = rt_value_number(&l->values[VFOV], camera->vfov);
    camera->aperture = rt_value_number(&l->values[APERTURE], camera->aperture);
    camera->focus = rt_value_number(&l->values[FOCUS], camera->focus);
    p->scene->camera_place = rt_source_place(src);
    return camera->from.x != camera->at.x || camera->from.y != camera->at.y ||
           camera->from.z != camera->at.z ||
           RT_FAIL_AT(src, l->start, "%s",
                      "'from' and 'at' of 'camera' are the same point as floats");
}

bool rt_scene_apply_background(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { BOTTOM, TOP };
    rt_scene *scene = p->scene;
    scene->background = rt_value_vector(&l->values[BOTTOM], scene->background);
    scene->background_top = rt_value_vector(&l->values[TOP], scene->background);
    scene->has_gradient = l->values[TOP].given;
    scene->background_place = rt_source_place(src);
    return true;
}

bool rt_scene_apply_ambient(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { COLOR };
    (void)src;
    p->scene->ambient = rt_value_vector(&l->values[COLOR], p->scene->ambient);
    return true;
}

bool rt_scene_apply_fog(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { COLOR, DENSITY };
    p->scene->fog = rt_value_vector(&l->values[COLOR], p->scene->fog);
    p->scene->fog_density = l->values[DENSITY].number[0];
    p->scene->fog_place = rt_source_place(src);
    return true;
}

bool rt_scene_apply_occlusion(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { SAMPLES, DISTANCE };
    p->scene->occlusion_samples = rt_value_count(&l->values[SAMPLES], 16);
    p->scene->occlusion_distance = l->values[DISTANCE].number[0];
    p->scene->occlusion_place = rt_source_place(src);
    return true;
}

bool rt_scene_apply_depth(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { DEPTH };
    (void)src;
    p->scene->depth = (int)l->values[DEPTH].count;
    return true;
}

bool rt_scene_apply_cull(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { SIDE, WINDING };
    p->scene->cull = l->values[SIDE].choice == 0 ? RT_CULL_BACK : RT_CULL_FRONT;
    p->scene->winding =
        l->values[WINDING].given && l->values[WINDING].choice == 1 ? RT_WINDING_CW : RT_WINDING_CCW;
    p->scene->cull_place = rt_source_place(src);
    return true;
}

bool rt_scene_apply_accuracy(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { LEVEL };
    (void)src;
    p->scene->accuracy = (enum rt_accuracy)l->values[LEVEL].choice;
    return true;
}
