/* The report's text: what stands in REPORT.md and in REPORT.html alike. */
#ifndef RT_STUDY_REPORT_TEXT_H
#define RT_STUDY_REPORT_TEXT_H

#include "study/doc.h"
#include "study/result.h"

/* What one of the sentences of verdict.h says, from malloc; NULL without memory. */
char *rt_study_said(void (*say)(const rt_study *, size_t, FILE *), const rt_study *study, size_t i);
char *rt_study_headline(const rt_study *study);

/* What is shown: "fast", "robust", or "the reference". */
const char *rt_study_shown_name(const rt_study *study, int which);

/* What stands below the pictures: which level is right and what it costs, a row each, and what is
 * to be said of devices and of times. */
void rt_report_first(const rt_study *study, rt_doc *doc);
/* All tables, and how it was measured. */
void rt_report_rest(const rt_study *study, rt_doc *doc);

#endif
