#include "source.h"

#include <string.h>

/* Characters of a word that a message shows. */
#define SHOWN_CHARACTERS 40

int rt_source_column(const rt_source *source, const char *at)
{
    int column = 1;
    for (const char *p = source->line_start; p < at; ++p)
        column += ((unsigned char)*p & 0xc0U) != 0x80U;
    return column;
}

const char *rt_word_start(const rt_word *word)
{
    return word->text - word->quoted;
}

static size_t span_of(const rt_word *word)
{
    return word->length + 2 * (size_t)word->quoted;
}

int rt_word_shown_length(const rt_word *word)
{
    return span_of(word) > SHOWN_CHARACTERS ? SHOWN_CHARACTERS : (int)span_of(word);
}

const char *rt_word_ellipsis(const rt_word *word)
{
    return span_of(word) > SHOWN_CHARACTERS ? "..." : "";
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

static bool is_line_end(const rt_source *source, const char *p)
{
    return p >= source->end || *p == '\n' || *p == '#';
}

void rt_source_skip_blanks(rt_source *source)
{
    while (source->cursor < source->end && is_blank(*source->cursor))
        ++source->cursor;
}

void rt_source_next_line(rt_source *source)
{
    const char *newline = memchr(source->cursor, '\n', (size_t)(source->end - source->cursor));
    source->cursor = newline ? newline + 1 : source->end;
    source->line_start = source->cursor;
    ++source->line;
}

static bool fail_nul(rt_source *source, const char *at)
{
    return RT_FAIL_AT(source, at, "%s", "a NUL byte: this is not a text file");
}

bool rt_source_word(rt_source *source, rt_word *word)
{
    rt_source_skip_blanks(source);
    *word = (rt_word){source->cursor, 0, false};
    if (is_line_end(source, source->cursor))
        return true;
    if (*source->cursor == '"') {
        word->text = ++source->cursor;
        word->quoted = true;
        while (source->cursor < source->end && *source->cursor != '"' && *source->cursor != '\n')
            ++source->cursor;
        if (source->cursor >= source->end || *source->cursor != '"')
            return RT_FAIL_AT(source, word->text - 1, "%s", "a quote is opened and not closed");
        word->length = (size_t)(source->cursor++ - word->text);
        const char *nul = memchr(word->text, '\0', word->length);
        if (nul)
            return fail_nul(source, nul);
        return true;
    }
    while (!is_line_end(source, source->cursor) && !is_blank(*source->cursor) &&
           *source->cursor != '"') {
        if (*source->cursor == '\0')
            return fail_nul(source, source->cursor);
        ++source->cursor;
    }
    word->length = (size_t)(source->cursor - word->text);
    return true;
}

bool rt_word_is_end(const rt_word *word)
{
    return word->length == 0 && !word->quoted;
}

bool rt_word_equals(const rt_word *word, const char *text)
{
    return !word->quoted && strncmp(word->text, text, word->length) == 0 &&
           text[word->length] == '\0';
}
