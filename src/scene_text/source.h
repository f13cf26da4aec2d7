/* A scene file as lines of words, and messages that point into it. */
#ifndef RT_SCENE_TEXT_SOURCE_H
#define RT_SCENE_TEXT_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"

/* One file being read; the caller owns name and text. */
typedef struct rt_source {
    const char *name;
    const char *end; /* one past the last byte; *end is a NUL */
    const char *line_start, *cursor;
    int line; /* from 1 */
    const struct rt_source *includer;
    rt_status *status;
} rt_source;

/* A word, or what stands between double quotes. */
typedef struct rt_word {
    const char *text; /* into the source; quotes not included */
    size_t length;
    bool quoted;
} rt_word;

/* The next word of the line, of length 0 and not quoted at its end. False after an error. */
bool rt_source_word(rt_source *source, rt_word *word);
void rt_source_skip_blanks(rt_source *source);
void rt_source_next_line(rt_source *source);

static inline bool rt_word_is_end(const rt_word *word)
{
    return word->length == 0 && !word->quoted;
}

/* True for that word without quotes. Words are short, hence no library call. */
static inline bool rt_word_equals(const rt_word *word, const char *text)
{
    for (size_t i = 0; i < word->length; ++i)
        if (word->text[i] != text[i] || text[i] == '\0')
            return false;
    return text[word->length] == '\0' && !word->quoted;
}

/* A column of the current line, from 1, in characters of UTF-8. */
int rt_source_column(const rt_source *source, const char *at);

/* Bytes of a path of a file that is refused that a message shows. */
#define RT_PATH_SHOWN 200

/* Adds "file:line:column: error: " and the message; always false. */
#define RT_FAIL_AT(source, at, format, ...)                                                        \
    rt_status_fail((source)->status, RT_ERROR_SCENE, "%s:%d:%d: error: " format, (source)->name,   \
                   (source)->line, rt_source_column(source, at), __VA_ARGS__)

/* A word as it stands in the file, quotes and all: where it begins, and the three arguments of
 * "%.*s%s" that show it, cut where it is long. */
const char *rt_word_start(const rt_word *word);
int rt_word_shown_length(const rt_word *word);
const char *rt_word_ellipsis(const rt_word *word);
#define RT_SHOWN(word) rt_word_shown_length(word), rt_word_start(word), rt_word_ellipsis(word)

#endif
