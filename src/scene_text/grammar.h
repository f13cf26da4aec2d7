/* The statements of the native scene format as a table: what the parser accepts, what its messages
 * expect, and what scenes/README.md prints are one and the same. */
#ifndef RT_SCENE_TEXT_GRAMMAR_H
#define RT_SCENE_TEXT_GRAMMAR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum rt_value_kind {
    RT_VALUE_NUMBER,    /* one float within [min, max], or (min, max) if `open` */
    RT_VALUE_COUNT,     /* one whole number within [min, max] */
    RT_VALUE_PAIR,      /* two finite floats */
    RT_VALUE_POINT,     /* three finite floats */
    RT_VALUE_DIRECTION, /* three finite floats, not all zero */
    RT_VALUE_COLOR,     /* three floats within [min, max] */
    RT_VALUE_CHOICE,    /* one of the words in `choices`, separated by '|' */
    RT_VALUE_NAME,      /* a new material name */
    RT_VALUE_MATERIAL,  /* the name of a material defined above */
    RT_VALUE_PATH       /* a quoted file name */
};

/* Most fields that a statement has. */
#define RT_FIELDS_MAX 14

typedef struct rt_field {
    const char *name; /* NULL: positional, straight after the keyword */
    enum rt_value_kind kind;
    double min, max;
    int open;
    const char *choices;
    const char *fallback; /* as text for the table; NULL: the field must be given */
    const char *meaning;
} rt_field;

struct rt_parser;
struct rt_source;
struct rt_line;

/* Does what a statement says, once its line is read by its row. False after a message at it. */
typedef bool rt_statement_apply(struct rt_parser *parser, struct rt_source *source,
                                const struct rt_line *line);

typedef struct rt_statement {
    const char *keyword;
    const char *variant; /* the word that must follow the keyword, or NULL */
    int once;            /* at most one a scene */
    const char *meaning;
    rt_statement_apply *apply;
    rt_field fields[RT_FIELDS_MAX]; /* ended by meaning == NULL */
} rt_statement;

#define STATEMENT(name, ...) +1
enum {
    RT_STATEMENT_COUNT =
#include "scene_text/statements.def"
};
#undef STATEMENT

/* RT_STATEMENT_COUNT rows, ended by keyword == NULL. */
extern const rt_statement rt_statements[];

/* Number of fields of a statement. */
size_t rt_statement_field_count(const rt_statement *statement);

/* Writes what the field's value must be, such as "a number above 0", to text[0..size). */
void rt_field_expectation(const rt_field *field, char *text, size_t size);

/* Prints the grammar as a Markdown table, made from the very table that the parser works by. */
void rt_grammar_print(FILE *out);

#endif
