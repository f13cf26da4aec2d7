/* What a study says, in the sentences that a user takes away; judge.h decides what they say. */
#ifndef RT_STUDY_VERDICT_H
#define RT_STUDY_VERDICT_H

#include <stdio.h>

#include "study/judge.h"

/* All of these write plain text, without a newline at the end. */

/* The whole in one or two sentences: which level to take and why, or why that cannot be told. */
void rt_study_say_headline(const rt_study *study, FILE *out);

/* Why the times of a device say nothing, where they do. */
void rt_study_say_doubt(const rt_study *study, size_t device, FILE *out);

/* Whether an entry is right, and what it takes. */
void rt_study_say_entry(const rt_study *study, size_t entry_index, FILE *out);
/* The same in a few words, for the key of the plot. */
void rt_study_say_briefly(const rt_study *study, size_t entry_index, FILE *out);
/* Whether it is right, in words for a table, and its time against the base level's. */
void rt_study_say_right(const rt_study *study, size_t entry_index, FILE *out);
void rt_study_say_cost(const rt_study *study, size_t entry_index, FILE *out);

/* Which is faster, a device or the first one, and by how much. */
void rt_study_say_devices(const rt_study *study, size_t device, FILE *out);

/* How one takes the level of the headline, on a device; nothing where it names none. */
void rt_study_say_how(const rt_study *study, size_t device, FILE *out);

/* All of it, a paragraph each, with an empty line between; ends in a newline. */
void rt_study_say_all(const rt_study *study, FILE *out);

#endif
