/* The report's tables of figures. */
#ifndef RT_STUDY_REPORT_TABLES_H
#define RT_STUDY_REPORT_TABLES_H

#include "study/doc.h"
#include "study/result.h"

/* Pictures, the same rays and times, under a heading each. */
void rt_report_tables(const rt_study *study, rt_doc *doc);

#endif
