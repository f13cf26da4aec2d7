/* A study as somebody might have measured it. */
#ifndef RT_TESTS_SUPPORT_MADE_UP_H
#define RT_TESTS_SUPPORT_MADE_UP_H

#include "study/result.h"

/* Standard and robust at 1, 4 and 16 samples of 100x100 pixels, on one device or on several, each
 * of which takes twice the time of the one before. Times grow with the samples, robust takes 1.5
 * times that of standard, quartiles are a hundredth off, and no pixel is visibly off. Cleared by
 * rt_study_clear. */
void test_make_up_study(rt_study *study, size_t devices);

/* The cell of a level on the first device, at the i-th count of samples. */
rt_study_cell *test_cell(const rt_study *study, enum rt_accuracy level, size_t sample_index);

#endif
