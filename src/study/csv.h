/* A study's figures as comma-separated values, a row an entry and count of samples (RFC 4180). */
#ifndef RT_STUDY_CSV_H
#define RT_STUDY_CSV_H

#include <stdio.h>

#include "study/result.h"

void rt_study_print_csv(const rt_study *study, FILE *out);

#endif
