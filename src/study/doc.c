#define _GNU_SOURCE
#include "study/doc.h"

#include <stdarg.h>
#include <stdlib.h>

void rt_doc_escape(const char *text, FILE *out)
{
    for (; *text; ++text)
        switch (*text) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        default:
            fputc(*text, out);
        }
}

/* What would begin something in Markdown, or end a table's cell. */
static void escape_markdown(const char *text, FILE *out)
{
    for (; *text; ++text) {
        if (*text == '|' || *text == '*' || *text == '_' || *text == '`' || *text == '<' ||
            *text == '[' || *text == '\\')
            fputc('\\', out);
        fputc(*text, out);
    }
}

static void print_text(rt_doc *doc, const char *format, va_list arguments)
{
    char *text = NULL;
    if (vasprintf(&text, format, arguments) < 0)
        return; /* without memory the stream, which needs some too, fails as a whole */
    if (doc->is_html)
        rt_doc_escape(text, doc->out);
    else
        escape_markdown(text, doc->out);
    free(text);
}

/* Text between what stands before it and behind it in either format. */
#define PRINT_BETWEEN(before_html, behind_html, before, behind)                                    \
    do {                                                                                           \
        va_list arguments;                                                                         \
        va_start(arguments, format);                                                               \
        fputs(doc->is_html ? (before_html) : (before), doc->out);                                  \
        print_text(doc, format, arguments);                                                        \
        fputs(doc->is_html ? (behind_html) : (behind), doc->out);                                  \
        va_end(arguments);                                                                         \
    } while (0)

static void between(rt_doc *doc, const char *const marks[4], const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void between(rt_doc *doc, const char *const marks[4], const char *format, ...)
{
    PRINT_BETWEEN(marks[0], marks[1], marks[2], marks[3]);
}

void rt_doc_heading(rt_doc *doc, const char *text)
{
    static const char *const marks[4] = {"<h2>", "</h2>\n", "## ", "\n\n"};
    between(doc, marks, "%s", text);
}

void rt_doc_paragraph(rt_doc *doc, const char *format, ...)
{
    PRINT_BETWEEN("<p>", "</p>\n", "", "\n\n");
}

void rt_doc_list_begin(rt_doc *doc)
{
    fputs(doc->is_html ? "<ul>\n" : "", doc->out);
}

void rt_doc_item(rt_doc *doc, const char *format, ...)
{
    PRINT_BETWEEN("<li>", "</li>\n", "- ", "\n");
}

void rt_doc_list_end(rt_doc *doc)
{
    fputs(doc->is_html ? "</ul>\n" : "\n", doc->out);
}

void rt_doc_table_begin(rt_doc *doc, const char *const *columns)
{
    static const char *const word[4] = {"<th>", "</th>", " ", " |"};
    static const char *const number[4] = {"<th class=\"n\">", "</th>", " ", " |"};
    doc->columns = columns;
    doc->column = 0;
    fputs(doc->is_html ? "<table>\n<tr>" : "|", doc->out);
    for (const char *const *c = columns; *c; ++c)
        between(doc, **c == '>' ? number : word, "%s", **c == '>' ? *c + 1 : *c);
    fputs(doc->is_html ? "</tr>\n" : "\n|", doc->out);
    for (const char *const *c = columns; *c && !doc->is_html; ++c)
        fputs(**c == '>' ? "---:|" : "---|", doc->out);
    fputs(doc->is_html ? "" : "\n", doc->out);
}

void rt_doc_cell(rt_doc *doc, const char *format, ...)
{
    if (doc->column == 0)
        fputs(doc->is_html ? "<tr>" : "|", doc->out);
    const bool is_number = doc->columns[doc->column++][0] == '>';
    PRINT_BETWEEN(is_number ? "<td class=\"n\">" : "<td>", "</td>", " ", " |");
}

void rt_doc_row_end(rt_doc *doc)
{
    doc->column = 0;
    fputs(doc->is_html ? "</tr>\n" : "\n", doc->out);
}

void rt_doc_table_end(rt_doc *doc)
{
    fputs(doc->is_html ? "</table>\n" : "\n", doc->out);
}
