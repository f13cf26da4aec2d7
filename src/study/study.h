/* What accuracy costs: a scene at every level, on one device or on several, and at several counts
 * of samples a pixel, held against the reference, and timed. */
#ifndef RT_STUDY_STUDY_H
#define RT_STUDY_STUDY_H

#include "common/watch.h"
#include "scene/scene.h"
#include "study/result.h"
#include "study/strip.h"

/* Measures. The caller clears `study`, which holds nothing after a failure, and `strip`, which gets
 * the pictures to be shown. */
bool rt_study_run(rt_study *study, rt_study_strip *strip, const rt_scene *scene,
                  const char *scene_name, const rt_study_plan *plan, const rt_study_how *how,
                  const rt_watch *watch, rt_status *status);

#endif
