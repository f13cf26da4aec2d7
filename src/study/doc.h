/* A text with headings, lists and tables, written as Markdown or as HTML. */
#ifndef RT_STUDY_DOC_H
#define RT_STUDY_DOC_H

#include <stdbool.h>
#include <stdio.h>

typedef struct rt_doc {
    FILE *out;
    bool is_html;
    const char *const *columns; /* of the table that is written */
    int column;
} rt_doc;

/* All texts are plain: what has a meaning in the format is escaped. */
void rt_doc_heading(rt_doc *doc, const char *text);
void rt_doc_paragraph(rt_doc *doc, const char *format, ...) __attribute__((format(printf, 2, 3)));

void rt_doc_list_begin(rt_doc *doc);
void rt_doc_item(rt_doc *doc, const char *format, ...) __attribute__((format(printf, 2, 3)));
void rt_doc_list_end(rt_doc *doc);

/* `columns` are the heads, with a '>' before those whose column is of numbers; NULL ends them. They
 * stay the caller's, until the table's end. */
void rt_doc_table_begin(rt_doc *doc, const char *const *columns);
void rt_doc_cell(rt_doc *doc, const char *format, ...) __attribute__((format(printf, 2, 3)));
void rt_doc_row_end(rt_doc *doc);
void rt_doc_table_end(rt_doc *doc);

/* Writes text that stands in HTML, or in one of its attributes. */
void rt_doc_escape(const char *text, FILE *out);

#endif
