/* A study as JSON, whole: what is written can be read back and reported again. */
#ifndef RT_STUDY_STUDY_JSON_H
#define RT_STUDY_STUDY_JSON_H

#include "common/file.h"
#include "study/result.h"

bool rt_study_write_json(const rt_study *study, rt_output *output, rt_status *status);

/* Reads a file that the above has written. On failure (code RT_ERROR_SCENE) the study holds
 * nothing. */
bool rt_study_read_json(rt_study *study, const char *path, rt_status *status);

#endif
