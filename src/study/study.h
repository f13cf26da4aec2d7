/* What accuracy costs: a scene at every level and at several counts of samples a pixel, held
 * against the reference, and timed. */
#ifndef RT_STUDY_STUDY_H
#define RT_STUDY_STUDY_H

#include "common/watch.h"
#include "scene/scene.h"
#include "study/result.h"

/* Measures. The caller clears `study`, which holds nothing after a failure. */
bool rt_study_run(rt_study *study, const rt_scene *scene, const char *scene_name,
                  const rt_study_plan *plan, const rt_study_how *how, const rt_watch *watch,
                  rt_status *status);

#endif
