/* The report as one page of HTML that needs no other file. */
#ifndef RT_STUDY_HTML_H
#define RT_STUDY_HTML_H

#include "common/file.h"
#include "study/result.h"

/* `strip` is a PNG and `plot` an SVG; either may be empty, and the page says so. */
void rt_study_print_html(const rt_study *study, const rt_file_text *strip, const rt_file_text *plot,
                         FILE *out);

/* Base64 (RFC 4648), without line breaks. */
void rt_print_base64(const char *bytes, size_t length, FILE *out);

#endif
