/* Text of mesh files as tokens. A line is counted only when a message needs its number, so that
 * reading keeps no account of lines. */
#ifndef RT_MESH_TEXT_H
#define RT_MESH_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"

typedef struct rt_text {
    const char *name;        /* of the file */
    const char *start, *end; /* *end is a NUL */
    const char *cursor;
    rt_status *status;
} rt_text;

/* Into the text; length 0 at the end of the line or file. */
typedef struct rt_token {
    const char *text;
    size_t length;
} rt_token;

static inline bool rt_text_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* True for what a token is made of; tested on every character, hence the order. */
static inline bool rt_text_is_ordinary(char c)
{
    return (unsigned char)c > ' ' || !(c == '\n' || c == '\0' || rt_text_is_blank(c));
}

/* The start of the next line if `p` is a backslash that ends its line, else NULL. */
static inline const char *rt_text_continued(const char *p)
{
    if (*p != '\\')
        return NULL;
    p += p[1] == '\r' ? 2 : 1;
    return *p == '\n' ? p + 1 : NULL;
}

/* The next token of the line. A backslash at the end of a line joins the next one to it, and "#"
 * where a token would begin ends it. */
static inline rt_token rt_text_token(rt_text *text)
{
    const char *p = text->cursor, *after;
    for (;;) {
        while (rt_text_is_blank(*p))
            ++p;
        after = rt_text_continued(p);
        if (!after)
            break;
        p = after;
    }
    const char *start = p;
    if (*p != '#')
        while (rt_text_is_ordinary(*p) && !rt_text_continued(p))
            ++p;
    text->cursor = p;
    return (rt_token){start, (size_t)(p - start)};
}

/* The next token, on this line or a later one. */
static inline rt_token rt_text_word(rt_text *text)
{
    const char *p = text->cursor;
    while (*p == '\n' || rt_text_is_blank(*p))
        ++p;
    const char *start = p;
    while (rt_text_is_ordinary(*p))
        ++p;
    text->cursor = p;
    return (rt_token){start, (size_t)(p - start)};
}

/* What is left of the line, without the blanks around it; the cursor stays on the line. */
rt_token rt_text_rest(rt_text *text);

/* Goes to the start of the next line, or to the end. */
void rt_text_next_line(rt_text *text);

bool rt_token_equals(rt_token token, const char *word);
/* Likewise for ASCII letters of either case. */
bool rt_token_resembles(rt_token token, const char *word);

/* Reads a finite float, or fails with what `taker` takes, such as "'v' takes three numbers". */
bool rt_text_float(rt_text *text, rt_token token, const char *taker, float *value);

/* Adds "name:line:column: error: " and the message; returns false. */
bool rt_text_fail(const rt_text *text, const char *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Likewise, with "found 'x'; " or "the line ends; " or "the file ends; " before the message. */
bool rt_text_fail_found(const rt_text *text, rt_token token, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same as a warning. */
void rt_text_warn_found(const rt_text *text, rt_token token, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#define RT_MESSAGE_SIZE 512
/* Formats a message that quotes a file: control characters, which a terminal would obey, become
 * "?". */
void rt_message_format(char message[RT_MESSAGE_SIZE], const char *format, va_list arguments);

#endif
