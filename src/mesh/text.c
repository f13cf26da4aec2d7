#include "mesh/text.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "common/number.h"

/* Characters of a token that a message shows. */
#define SHOWN_CHARACTERS 40

rt_token rt_text_rest(rt_text *text)
{
    const char *p = text->cursor;
    while (rt_text_is_blank(*p))
        ++p;
    const char *newline = memchr(p, '\n', (size_t)(text->end - p));
    const char *end = newline ? newline : text->end;
    text->cursor = end;
    while (end > p && rt_text_is_blank(end[-1]))
        --end;
    return (rt_token){p, (size_t)(end - p)};
}

void rt_text_next_line(rt_text *text)
{
    const char *newline = memchr(text->cursor, '\n', (size_t)(text->end - text->cursor));
    text->cursor = newline ? newline + 1 : text->end;
}

bool rt_token_equals(rt_token token, const char *word)
{
    return strlen(word) == token.length && memcmp(token.text, word, token.length) == 0;
}

bool rt_token_resembles(rt_token token, const char *word)
{
    return strlen(word) == token.length && strncasecmp(token.text, word, token.length) == 0;
}

bool rt_text_float(rt_text *text, rt_token token, const char *taker, float *value)
{
    return rt_number_float(token.text, token.length, value) == RT_NUMBER_OK ||
           rt_text_fail_found(text, token, "%s", taker);
}

/* Line and column, in characters of UTF-8, both from 1. */
static void find_place(const rt_text *text, const char *at, size_t *line, size_t *column)
{
    *line = *column = 1;
    for (const char *p = text->start; p < at; ++p)
        if (*p == '\n') {
            ++*line;
            *column = 1;
        } else {
            *column += ((unsigned char)*p & 0xc0U) != 0x80U;
        }
}

void rt_message_format(char message[RT_MESSAGE_SIZE], const char *format, va_list arguments)
{
    /* clang-tidy 14 loses track of a va_list that is handed on. */
    // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized)
    vsnprintf(message, RT_MESSAGE_SIZE, format, arguments);
    for (char *p = message; *p; ++p)
        if ((unsigned char)*p < ' ' || *p == 0x7f)
            *p = '?';
}

bool rt_text_fail(const rt_text *text, const char *at, const char *format, ...)
{
    char message[RT_MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    rt_message_format(message, format, arguments);
    va_end(arguments);
    size_t line, column;
    find_place(text, at, &line, &column);
    return rt_status_fail(text->status, RT_ERROR_SCENE, "%s:%zu:%zu: error: %s", text->name, line,
                          column, message);
}

/* Writes "found 'x'; " or what stands for it. */
static void show(const rt_text *text, rt_token token, char *shown, size_t size)
{
    const bool is_long = token.length > SHOWN_CHARACTERS;
    if (token.length == 0)
        snprintf(shown, size, "the %s ends", token.text >= text->end ? "file" : "line");
    else
        snprintf(shown, size, "found '%.*s%s'", is_long ? SHOWN_CHARACTERS : (int)token.length,
                 token.text, is_long ? "..." : "");
}

bool rt_text_fail_found(const rt_text *text, rt_token token, const char *format, ...)
{
    char message[RT_MESSAGE_SIZE], shown[SHOWN_CHARACTERS + 16];
    va_list arguments;
    va_start(arguments, format);
    rt_message_format(message, format, arguments);
    va_end(arguments);
    show(text, token, shown, sizeof shown);
    return rt_text_fail(text, token.text, "%s; %s", shown, message);
}

void rt_text_warn_found(const rt_text *text, rt_token token, const char *format, ...)
{
    char message[RT_MESSAGE_SIZE], shown[SHOWN_CHARACTERS + 16];
    va_list arguments;
    va_start(arguments, format);
    rt_message_format(message, format, arguments);
    va_end(arguments);
    show(text, token, shown, sizeof shown);
    size_t line, column;
    find_place(text, token.text, &line, &column);
    rt_status_warn(text->status, "%s:%zu:%zu: warning: %s; %s", text->name, line, column, shown,
                   message);
}
