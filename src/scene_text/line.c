#define _GNU_SOURCE
#include "scene_text/line.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/number.h"

/* Room for what a message expects or lists. */
#define EXPECTATION_SIZE 200

/* "keyword 'name'" or "keyword" for messages about a value. */
static void name_field(const rt_statement *statement, const rt_field *field, char *text,
                       size_t size)
{
    if (field->name)
        snprintf(text, size, "'%s' of '%s'", field->name, statement->keyword);
    else
        snprintf(text, size, "'%s'", statement->keyword);
}

/* Says where a number is something else, or nothing, as a float: without it a message such as
 * "found '1e-50'; 'radius' takes a number above 0" would seem wrong. */
static const char *rounding_note(const rt_word *word, const rt_field *field, char *text,
                                 size_t size)
{
    float rounded = 0.0f;
    const enum rt_number_result result = word->quoted || field->kind == RT_VALUE_COUNT
                                             ? RT_NUMBER_SYNTAX
                                             : rt_number_float(word->text, word->length, &rounded);
    text[0] = '\0';
    if (result == RT_NUMBER_RANGE)
        snprintf(text, size, " (too large for a float)");
    else if (result == RT_NUMBER_OK && (double)rounded != strtod(word->text, NULL))
        snprintf(text, size, " (%.9g as a float)", (double)rounded);
    return text;
}

static bool fail_value(rt_source *source, const rt_line *l, const rt_field *field,
                       const rt_word *found)
{
    char expected[EXPECTATION_SIZE], name[EXPECTATION_SIZE], note[EXPECTATION_SIZE];
    rt_field_expectation(field, expected, sizeof expected);
    name_field(l->statement, field, name, sizeof name);
    if (rt_word_is_end(found))
        return RT_FAIL_AT(source, rt_word_start(found), "the line ends; %s takes %s", name,
                          expected);
    return RT_FAIL_AT(source, rt_word_start(found), "found '%.*s%s'%s; %s takes %s",
                      RT_SHOWN(found), rounding_note(found, field, note, sizeof note), name,
                      expected);
}

static bool is_in_range(const rt_field *field, double x)
{
    return field->open ? x > field->min && x < field->max : x >= field->min && x <= field->max;
}

/* One number of a field that takes `index` of them already. */
static bool read_float(rt_source *source, const rt_line *l, const rt_field *field, float *out)
{
    rt_word word;
    if (!rt_source_word(source, &word))
        return false;
    if (rt_word_is_end(&word) || word.quoted ||
        rt_number_float(word.text, word.length, out) != RT_NUMBER_OK ||
        !is_in_range(field, (double)*out))
        return fail_value(source, l, field, &word);
    return true;
}

static bool read_count(rt_source *source, const rt_line *l, const rt_field *field, rt_value *v)
{
    rt_word word;
    if (!rt_source_word(source, &word))
        return false;
    if (rt_word_is_end(&word) || word.quoted ||
        rt_number_int(word.text, word.length, &v->count) != RT_NUMBER_OK ||
        !is_in_range(field, (double)v->count))
        return fail_value(source, l, field, &word);
    return true;
}

static bool read_numbers(rt_source *source, const rt_line *l, const rt_field *field, rt_value *v)
{
    const int count = field->kind == RT_VALUE_PAIR ? 2 : 3;
    rt_source_skip_blanks(source);
    const char *start = source->cursor;
    for (int i = 0; i < count; ++i)
        if (!read_float(source, l, field, &v->number[i]))
            return false;
    if (field->kind == RT_VALUE_DIRECTION && v->number[0] == 0.0f && v->number[1] == 0.0f &&
        v->number[2] == 0.0f) {
        const rt_word all = {start, (size_t)(source->cursor - start), false};
        return fail_value(source, l, field, &all);
    }
    return true;
}

static bool read_choice(rt_source *source, const rt_line *l, const rt_field *field, rt_value *v)
{
    rt_word word;
    if (!rt_source_word(source, &word))
        return false;
    const char *choice = field->choices;
    for (v->choice = 0; !rt_word_is_end(&word) && !word.quoted; ++v->choice) {
        const char *bar = strchrnul(choice, '|');
        if ((size_t)(bar - choice) == word.length && memcmp(choice, word.text, word.length) == 0)
            return true;
        if (!*bar)
            break;
        choice = bar + 1;
    }
    return fail_value(source, l, field, &word);
}

static bool read_word(rt_source *source, const rt_line *l, const rt_field *field, rt_value *v)
{
    if (!rt_source_word(source, &v->word))
        return false;
    const bool wants_quotes = field->kind == RT_VALUE_PATH;
    if (v->word.length == 0 || (wants_quotes && !v->word.quoted))
        return fail_value(source, l, field, &v->word);
    return true;
}

static bool read_value(rt_source *source, rt_line *l, size_t index)
{
    const rt_field *field = &l->statement->fields[index];
    rt_value *v = &l->values[index];
    v->given = true;
    switch (field->kind) {
    case RT_VALUE_NUMBER:
        return read_float(source, l, field, &v->number[0]);
    case RT_VALUE_COUNT:
        return read_count(source, l, field, v);
    case RT_VALUE_PAIR:
    case RT_VALUE_POINT:
    case RT_VALUE_DIRECTION:
    case RT_VALUE_COLOR:
        return read_numbers(source, l, field, v);
    case RT_VALUE_CHOICE:
        return read_choice(source, l, field, v);
    case RT_VALUE_NAME:
    case RT_VALUE_MATERIAL:
    case RT_VALUE_PATH:
        return read_word(source, l, field, v);
    }
    return false;
}

/* Writes "a, b, c" of the names, cut where there is no room. */
static void list_names(char *text, size_t size, const char *const *names, size_t count)
{
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; i < count && length < size; ++i)
        length += (size_t)snprintf(text + length, size - length, "%s%s", i ? ", " : "", names[i]);
}

static bool fail_unknown_name(rt_source *source, const rt_line *l, const rt_word *word)
{
    const char *names[RT_FIELDS_MAX];
    size_t count = 0;
    for (size_t i = 0; i < rt_statement_field_count(l->statement); ++i)
        if (l->statement->fields[i].name)
            names[count++] = l->statement->fields[i].name;
    char list[EXPECTATION_SIZE];
    list_names(list, sizeof list, names, count);
    if (count == 0)
        return RT_FAIL_AT(source, rt_word_start(word),
                          "found '%.*s%s' after '%s'; the statement is complete", RT_SHOWN(word),
                          l->statement->keyword);
    return RT_FAIL_AT(source, rt_word_start(word), "found '%.*s%s'; '%s' has the name%s %s",
                      RT_SHOWN(word), l->statement->keyword, count > 1 ? "s" : "", list);
}

/* The field that a token names, or `count`. Pairs mostly come in the table's order, so the search
 * starts after the last one found. */
static size_t find_field(const rt_line *l, const rt_word *word, size_t start, size_t count)
{
    size_t index = start;
    for (size_t i = 0; i < count; ++i, ++index) {
        if (index >= count)
            index = 0;
        const rt_field *field = &l->statement->fields[index];
        if (field->name && rt_word_equals(word, field->name))
            return index;
    }
    return count;
}

bool rt_line_read(rt_source *source, rt_line *l)
{
    const size_t count = rt_statement_field_count(l->statement);
    size_t next = 0;
    if (!l->statement->fields[0].name && !read_value(source, l, next++))
        return false;
    for (;;) {
        rt_word word;
        if (!rt_source_word(source, &word))
            return false;
        if (rt_word_is_end(&word))
            break;
        const size_t index = find_field(l, &word, next, count);
        if (index == count)
            return fail_unknown_name(source, l, &word);
        if (l->values[index].given)
            return RT_FAIL_AT(source, rt_word_start(&word), "'%s' is given twice",
                              l->statement->fields[index].name);
        if (!read_value(source, l, index))
            return false;
        next = index + 1;
    }
    for (size_t i = 0; i < count; ++i)
        if (!l->values[i].given && !l->statement->fields[i].fallback) {
            char expected[EXPECTATION_SIZE];
            rt_field_expectation(&l->statement->fields[i], expected, sizeof expected);
            return RT_FAIL_AT(source, l->start, "'%s' lacks '%s', %s", l->statement->keyword,
                              l->statement->fields[i].name, expected);
        }
    return true;
}

static bool fail_unknown_statement(rt_source *source, const rt_word *word)
{
    const char *names[RT_STATEMENT_COUNT] = {NULL};
    size_t count = 0;
    for (const rt_statement *s = rt_statements; s->keyword; ++s)
        if (count == 0 || strcmp(names[count - 1], s->keyword) != 0)
            names[count++] = s->keyword;
    char list[EXPECTATION_SIZE];
    list_names(list, sizeof list, names, count);
    return RT_FAIL_AT(source, rt_word_start(word), "found '%.*s%s'; a line begins with one of %s",
                      RT_SHOWN(word), list);
}

bool rt_line_is_keyword(const rt_word *word)
{
    for (const rt_statement *s = rt_statements; s->keyword; ++s)
        if (rt_word_equals(word, s->keyword))
            return true;
    return false;
}

static bool fail_unknown_variant(rt_source *source, const rt_word *keyword, const rt_word *found)
{
    const char *names[RT_STATEMENT_COUNT], *first = NULL;
    size_t count = 0;
    for (const rt_statement *s = rt_statements; s->keyword; ++s)
        if (s->variant && rt_word_equals(keyword, s->keyword)) {
            first = s->keyword;
            names[count++] = s->variant;
        }
    char list[EXPECTATION_SIZE];
    list_names(list, sizeof list, names, count);
    if (rt_word_is_end(found))
        return RT_FAIL_AT(source, rt_word_start(found), "the line ends; '%s' takes one of %s",
                          first, list);
    return RT_FAIL_AT(source, rt_word_start(found), "found '%.*s%s'; '%s' takes one of %s",
                      RT_SHOWN(found), first, list);
}

bool rt_line_begin(rt_source *source, const rt_word *keyword, rt_line *l)
{
    rt_word second = {source->cursor, 0, false};
    bool is_variant = false;
    for (const rt_statement *s = rt_statements; s->keyword; ++s) {
        if (keyword->text[0] != s->keyword[0] || !rt_word_equals(keyword, s->keyword))
            continue;
        if (s->variant && !is_variant) {
            is_variant = true;
            if (!rt_source_word(source, &second))
                return false;
        }
        if (!s->variant || rt_word_equals(&second, s->variant)) {
            l->statement = s;
            l->start = keyword->text;
            for (size_t k = 0; k < RT_FIELDS_MAX; ++k)
                l->values[k].given = false;
            return true;
        }
    }
    return is_variant ? fail_unknown_variant(source, keyword, &second)
                      : fail_unknown_statement(source, keyword);
}
