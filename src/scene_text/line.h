/* One statement of a scene file, read by the grammar's table. */
#ifndef RT_SCENE_TEXT_LINE_H
#define RT_SCENE_TEXT_LINE_H

#include <stdint.h>

#include "scene_text/grammar.h"
#include "scene_text/source.h"

/* What a field was given; which member counts follows from the field's kind, and none does where
 * `given` is false. */
typedef struct rt_value {
    float number[3];
    int64_t count;
    int choice; /* index among the field's choices */
    rt_word word;
    bool given;
} rt_value;

typedef struct rt_line {
    const rt_statement *statement;
    const char *start;              /* of the keyword */
    rt_value values[RT_FIELDS_MAX]; /* by field */
} rt_line;

/* Finds the statement that a line's first word, and for some the second, stand for. False, after a
 * message that lists what there is, for none. */
bool rt_line_begin(rt_source *source, const rt_word *keyword, rt_line *line);

/* Reads the rest of the line into line->values: each field once, of its kind, in its range, and
 * none missing that has no fallback. */
bool rt_line_read(rt_source *source, rt_line *line);

/* Whether a word begins some statement. */
bool rt_line_is_keyword(const rt_word *word);

#endif
