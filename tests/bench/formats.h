/* One scene in the languages of the programs that are measured whole. Phong shading, one light, no
 * shadows: what all of them are asked to do. */
#ifndef BENCH_FORMATS_H
#define BENCH_FORMATS_H

#include <stdbool.h>

#include "common/status.h"
#include "scene/scene.h"

/* Each writes the scene's first material, all its lights and primitives, and its camera, which
 * stands on the z axis, looks at the origin and has a square picture. */
bool bench_write_rt(const rt_scene *scene, const char *path, rt_status *status);
bool bench_write_tachyon(const rt_scene *scene, const char *path, rt_status *status);
bool bench_write_povray(const rt_scene *scene, const char *path, rt_status *status);

#endif
