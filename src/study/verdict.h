/* From a study's figures to the sentences that a user takes away. */
#ifndef RT_STUDY_VERDICT_H
#define RT_STUDY_VERDICT_H

#include <stdio.h>

#include "study/result.h"

/* Fills in what follows from the measurements: which cells are dominated. */
void rt_study_conclude(rt_study *study);

/* Whether the level changes something that one can see at that count: it changes pixels by more
 * than one step from the base level, and more than one for every hundred that too few samples make
 * wrong by more than one step anyway. */
bool rt_study_can_be_seen(const rt_study *study, size_t sample_index, size_t level_index);

/* Whether at some count arithmetic alone puts so many pixels of the level off from the reference.
 */
bool rt_study_errs_visibly(const rt_study *study, size_t level_index);

/* Whether the quartiles of the ratio have 1, to two digits, between them: no measurable cost. */
bool rt_study_is_free(const rt_spread *ratio);

/* What to take away, a sentence or two a paragraph, with an empty line between paragraphs; the
 * caller frees it. NULL without memory. */
char *rt_study_verdict(const rt_study *study);

/* The same of one level in a few words, for the key of the plot. */
void rt_study_say_briefly(const rt_study *study, size_t level_index, FILE *out);

#endif
