/* What the kernels may ask for, by the names of their parameters. */
#ifndef RT_RENDER_ARGUMENTS_H
#define RT_RENDER_ARGUMENTS_H

#include "render/renderer.h"

/* Gives all kernels of the renderer their arguments; of those that change from launch to launch
 * it notes the places. */
bool rt_renderer_set_arguments(rt_renderer *renderer, const rt_scene *scene, rt_status *status);

#endif
