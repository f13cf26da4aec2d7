#include "scene_text/source.h"

#include <limits.h>
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

/* What a character is to a line; every other one makes words. */
enum character { ORDINARY, BLANK, LINE_END, QUOTE, NUL };

static const unsigned char characters[UCHAR_MAX + 1] = {
    [' '] = BLANK,     ['\t'] = BLANK,   ['\r'] = BLANK, ['\v'] = BLANK, ['\f'] = BLANK,
    ['\n'] = LINE_END, ['#'] = LINE_END, ['"'] = QUOTE,  ['\0'] = NUL};

static enum character class_of(char c)
{
    return (enum character)characters[(unsigned char)c];
}

/* The first place from `p` on that is of another class. The text's terminator is a NUL, so blanks
 * and words end there at the latest. */
static const char *skip(const char *p, enum character c)
{
    while (class_of(*p) == c)
        ++p;
    return p;
}

void rt_source_skip_blanks(rt_source *source)
{
    source->cursor = skip(source->cursor, BLANK);
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

static bool read_quoted(rt_source *source, rt_word *word)
{
    word->text = ++source->cursor;
    word->quoted = true;
    while (source->cursor < source->end && *source->cursor != '"' && *source->cursor != '\n')
        ++source->cursor;
    if (source->cursor >= source->end || *source->cursor != '"')
        return RT_FAIL_AT(source, word->text - 1, "%s", "a quote is opened and not closed");
    word->length = (size_t)(source->cursor++ - word->text);
    const char *nul = memchr(word->text, '\0', word->length);
    return !nul || fail_nul(source, nul);
}

bool rt_source_word(rt_source *source, rt_word *word)
{
    const char *start = skip(source->cursor, BLANK);
    source->cursor = start;
    *word = (rt_word){start, 0, false};
    if (class_of(*start) == QUOTE && start < source->end)
        return read_quoted(source, word);
    const char *end = skip(start, ORDINARY);
    if (class_of(*end) == NUL && end < source->end)
        return fail_nul(source, end);
    source->cursor = end;
    word->length = (size_t)(end - start);
    return true;
}
