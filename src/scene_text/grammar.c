#include "scene_text/grammar.h"

#include <float.h>
#include <stdio.h>

#include "scene/scene.h"
#include "scene_text/parser.h"

#define NUMBER(name, low, high, is_open, fallback, meaning)                                        \
    {                                                                                              \
        name, RT_VALUE_NUMBER, low, high, is_open, NULL, fallback, meaning                         \
    }
#define COUNT(name, low, high, fallback, meaning)                                                  \
    {                                                                                              \
        name, RT_VALUE_COUNT, low, high, 0, NULL, fallback, meaning                                \
    }
#define PAIR(name, meaning)                                                                        \
    {                                                                                              \
        name, RT_VALUE_PAIR, -FLT_MAX, FLT_MAX, 0, NULL, "none", meaning                           \
    }
#define POINT(name, fallback, meaning)                                                             \
    {                                                                                              \
        name, RT_VALUE_POINT, -FLT_MAX, FLT_MAX, 0, NULL, fallback, meaning                        \
    }
#define DIRECTION(name, fallback, meaning)                                                         \
    {                                                                                              \
        name, RT_VALUE_DIRECTION, -FLT_MAX, FLT_MAX, 0, NULL, fallback, meaning                    \
    }
#define LIGHT_COLOR(name, fallback, meaning)                                                       \
    {                                                                                              \
        name, RT_VALUE_COLOR, 0.0, FLT_MAX, 0, NULL, fallback, meaning                             \
    }
#define REFLECTANCE(name, fallback, meaning)                                                       \
    {                                                                                              \
        name, RT_VALUE_COLOR, 0.0, 1.0, 0, NULL, fallback, meaning                                 \
    }
#define CHOICE(name, choices, fallback, meaning)                                                   \
    {                                                                                              \
        name, RT_VALUE_CHOICE, 0, 0, 0, choices, fallback, meaning                                 \
    }
#define MATERIAL(fallback, meaning)                                                                \
    {                                                                                              \
        "material", RT_VALUE_MATERIAL, 0, 0, 0, NULL, fallback, meaning                            \
    }
#define SHADOW                                                                                     \
    CHOICE("shadow", "on|off", "as `shadows`", "whether primitives keep its light from others")
#define PICTURE(name, meaning)                                                                     \
    {                                                                                              \
        name, RT_VALUE_PATH, 0, 0, 0, NULL, "none", meaning                                        \
    }
#define PLAIN(name, kind, meaning)                                                                 \
    {                                                                                              \
        name, kind, 0, 0, 0, NULL, NULL, meaning                                                   \
    }

#define ONCE 1
#define OFTEN 0
#define STATEMENT(name, keyword, variant, once, meaning, ...)                                      \
    {keyword, variant, once, meaning, rt_scene_apply_##name, __VA_ARGS__},

const rt_statement rt_statements[] = {
#include "scene_text/statements.def"
    {0},
};

size_t rt_statement_field_count(const rt_statement *statement)
{
    size_t count = 0;
    while (count < RT_FIELDS_MAX && statement->fields[count].meaning)
        ++count;
    return count;
}

static void expect_range(const rt_field *field, const char *what, char *text, size_t size)
{
    const char *open = field->open ? "above" : "from";
    if (field->max >= (double)FLT_MAX && field->min <= -(double)FLT_MAX)
        snprintf(text, size, "%s", what);
    else if (field->max >= (double)FLT_MAX)
        snprintf(text, size, "%s %s %.10g%s", what, open, field->min, field->open ? "" : " up");
    else
        snprintf(text, size, "%s %s %.10g %s %.10g", what, open, field->min,
                 field->open ? "and below" : "to", field->max);
}

void rt_field_expectation(const rt_field *field, char *text, size_t size)
{
    switch (field->kind) {
    case RT_VALUE_NUMBER:
        expect_range(field, "a number", text, size);
        break;
    case RT_VALUE_COUNT:
        if (field->min == field->max)
            snprintf(text, size, "%.0f", field->min);
        else
            expect_range(field, "a whole number", text, size);
        break;
    case RT_VALUE_PAIR:
        snprintf(text, size, "two finite numbers");
        break;
    case RT_VALUE_POINT:
        snprintf(text, size, "three finite numbers");
        break;
    case RT_VALUE_DIRECTION:
        snprintf(text, size, "three finite numbers, not all 0");
        break;
    case RT_VALUE_COLOR:
        expect_range(field, "three numbers", text, size);
        break;
    case RT_VALUE_CHOICE: {
        size_t length = 0;
        for (const char *c = field->choices; *c && length + 5 < size; ++c)
            length += (size_t)snprintf(text + length, size - length, *c == '|' ? " or " : "%c", *c);
        break;
    }
    case RT_VALUE_NAME:
        snprintf(text, size, "a name");
        break;
    case RT_VALUE_MATERIAL:
        snprintf(text, size, "the name of a material defined above");
        break;
    case RT_VALUE_PATH:
        snprintf(text, size, "a file name in double quotes");
        break;
    }
}

void rt_grammar_print(FILE *out)
{
    fprintf(out, "| statement | name | value | default | meaning |\n|---|---|---|---|---|\n");
    for (const rt_statement *s = rt_statements; s->keyword; ++s) {
        fprintf(out, "| `%s%s%s` | | | | %s%s |\n", s->keyword, s->variant ? " " : "",
                s->variant ? s->variant : "", s->meaning, s->once ? "; at most once" : "");
        for (size_t i = 0; i < rt_statement_field_count(s); ++i) {
            const rt_field *field = &s->fields[i];
            char expected[160];
            rt_field_expectation(field, expected, sizeof expected);
            fprintf(out, "| | %s%s%s | %s | %s | %s |\n", field->name ? "`" : "",
                    field->name ? field->name : "(first)", field->name ? "`" : "", expected,
                    field->fallback ? field->fallback : "required", field->meaning);
        }
    }
}
