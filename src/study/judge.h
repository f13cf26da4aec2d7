/* From a study's figures to what they say: which levels are wrong where one can see it, what the
 * times are worth, which level to take. verdict.h puts it into words. */
#ifndef RT_STUDY_JUDGE_H
#define RT_STUDY_JUDGE_H

#include "study/result.h"

/* Fewer repeats have no quartiles worth the name. */
#define RT_STUDY_ROUNDS_LEAST 5

/* Fills in what follows from the measurements: which cells are dominated, whose pictures to show.
 */
void rt_study_conclude(rt_study *study);

/* Whether arithmetic puts more than one in ten thousand of an entry's pixels off where one can see
 * it, at that count of samples. */
bool rt_study_is_off(const rt_study *study, size_t sample_index, size_t entry_index);
/* At some count. */
bool rt_study_is_wrong(const rt_study *study, size_t entry_index);
/* The finest of those counts; sample_count for none. */
size_t rt_study_worst_count(const rt_study *study, size_t entry_index);
/* On some device. */
bool rt_study_level_is_wrong(const rt_study *study, enum rt_accuracy level);

/* Whether the quartiles of a ratio of times are near enough to each other to say something. */
bool rt_study_is_narrow(const rt_spread *ratio);
/* Whether there is no measurable difference: the quartiles have 1, to two digits, between them, or
 * the median is nearer to 1 than they are to each other. */
bool rt_study_is_free(const rt_spread *ratio);

/* Why the times of a device say nothing. */
enum rt_doubt {
    RT_DOUBT_NONE,
    RT_DOUBT_FEW,       /* too few repeats */
    RT_DOUBT_BUSY,      /* other programs held the processors */
    RT_DOUBT_NO_GROWTH, /* more samples do not take accordingly more */
    RT_DOUBT_UNEVEN     /* the quartiles are wide */
};

typedef struct rt_study_doubt {
    enum rt_doubt kind;
    size_t entry, sample_index; /* where it shows */
} rt_study_doubt;

/* Of a device, by the finest pictures, whose times are the surest. */
rt_study_doubt rt_study_doubt_of(const rt_study *study, size_t device);

/* The entry to take on a device, or entry_count where none is right: of those that are right the
 * one of the least time, or a more accurate one that takes no measurably longer. Where times say
 * nothing, the first that is right. */
size_t rt_study_recommended(const rt_study *study, size_t device);

#endif
