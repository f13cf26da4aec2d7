/* A recursive-descent parser without recursion in its grammar: lines of tokens, checked against the
 * table of grammar.c, then applied to the scene. After an error the rest of the line is skipped and
 * reading goes on, so that one run shows many mistakes. */
#define _GNU_SOURCE
#include "scene_text.h"

#include <math.h>
#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "array.h"
#include "file.h"
#include "grammar.h"
#include "number.h"

#define INCLUDE_DEPTH_MAX 16
/* Characters of a token that a message shows. */
#define SHOWN_CHARACTERS 40
#define EXPECTATION_SIZE 160
/* Bytes of a path that cannot be read that a message shows. */
#define PATH_SHOWN 200

typedef struct token {
    const char *text; /* into the source; quotes not included */
    size_t length;
    bool quoted;
} token;

/* One file being read. */
typedef struct source {
    const char *name;
    const char *end; /* one past the last byte; *end is a terminator */
    const char *line_start, *cursor;
    int line;
    const struct source *includer;
} source;

typedef struct material_name {
    char *text;
    int32_t index;
} material_name;

typedef struct parser {
    rt_scene *scene;
    rt_status *status;
    void *names; /* tsearch tree of material_name */
    const material_name *last_name;
    bool has_version;
    rt_place seen[RT_STATEMENT_COUNT]; /* where a statement that comes once has come */
    size_t degenerate_count;
    rt_place degenerate_place;
} parser;

/* The values of one statement, by field. */
typedef struct value {
    float number[3];
    int64_t count;
    int choice;
    token word;
    bool given;
} value;

typedef struct line {
    const rt_statement *statement;
    const char *start; /* of the keyword */
    value values[RT_FIELDS_MAX];
} line;

static int column_of(const source *src, const char *at)
{
    int column = 1;
    for (const char *p = src->line_start; p < at; ++p)
        column += ((unsigned char)*p & 0xc0U) != 0x80U;
    return column;
}

/* Prefix of every message: "file:line:column: error: ". Always returns false. */
#define FAIL_AT(parser_, src_, at_, format_, ...)                                                  \
    rt_status_fail((parser_)->status, RT_ERROR_SCENE, "%s:%d:%d: error: " format_, (src_)->name,   \
                   (src_)->line, column_of(src_, at_), __VA_ARGS__)

/* A token as it stands in the file, quotes and all: where it begins, and the three arguments of
 * "%.*s%s" that show it, cut where it is long. */
static const char *start_of(const token *tok)
{
    return tok->text - tok->quoted;
}

static size_t span_of(const token *tok)
{
    return tok->length + 2 * (size_t)tok->quoted;
}

static int shown_length(const token *tok)
{
    return span_of(tok) > SHOWN_CHARACTERS ? SHOWN_CHARACTERS : (int)span_of(tok);
}

static const char *ellipsis(const token *tok)
{
    return span_of(tok) > SHOWN_CHARACTERS ? "..." : "";
}

#define SHOWN(tok) shown_length(tok), start_of(tok), ellipsis(tok)

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

static bool is_line_end(const source *src, const char *p)
{
    return p >= src->end || *p == '\n' || *p == '#';
}

static void skip_blanks(source *src)
{
    while (src->cursor < src->end && is_blank(*src->cursor))
        ++src->cursor;
}

static void next_line(source *src)
{
    const char *newline = memchr(src->cursor, '\n', (size_t)(src->end - src->cursor));
    src->cursor = newline ? newline + 1 : src->end;
    src->line_start = src->cursor;
    ++src->line;
}

static bool fail_nul(parser *p, source *src, const char *at)
{
    return FAIL_AT(p, src, at, "%s", "a NUL byte: this is not a text file");
}

/* The next token of the line; length 0 and not quoted at its end. False after an error. */
static bool next_token(parser *p, source *src, token *tok)
{
    skip_blanks(src);
    *tok = (token){src->cursor, 0, false};
    if (is_line_end(src, src->cursor))
        return true;
    if (*src->cursor == '"') {
        tok->text = ++src->cursor;
        tok->quoted = true;
        while (src->cursor < src->end && *src->cursor != '"' && *src->cursor != '\n')
            ++src->cursor;
        if (src->cursor >= src->end || *src->cursor != '"')
            return FAIL_AT(p, src, tok->text - 1, "%s", "a quote is opened and not closed");
        tok->length = (size_t)(src->cursor++ - tok->text);
        const char *nul = memchr(tok->text, '\0', tok->length);
        if (nul)
            return fail_nul(p, src, nul);
        return true;
    }
    while (!is_line_end(src, src->cursor) && !is_blank(*src->cursor) && *src->cursor != '"') {
        if (*src->cursor == '\0')
            return fail_nul(p, src, src->cursor);
        ++src->cursor;
    }
    tok->length = (size_t)(src->cursor - tok->text);
    return true;
}

static bool is_end(const token *tok)
{
    return tok->length == 0 && !tok->quoted;
}

static bool equals(const token *tok, const char *word)
{
    return !tok->quoted && strncmp(tok->text, word, tok->length) == 0 && word[tok->length] == '\0';
}

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
static const char *rounding_note(const token *tok, const rt_field *field, char *text, size_t size)
{
    float rounded = 0.0f;
    const enum rt_number_result result = tok->quoted || field->kind == RT_VALUE_COUNT
                                             ? RT_NUMBER_SYNTAX
                                             : rt_number_float(tok->text, tok->length, &rounded);
    text[0] = '\0';
    if (result == RT_NUMBER_RANGE)
        snprintf(text, size, " (too large for a float)");
    else if (result == RT_NUMBER_OK && (double)rounded != strtod(tok->text, NULL))
        snprintf(text, size, " (%.9g as a float)", (double)rounded);
    return text;
}

static bool fail_value(parser *p, source *src, const line *l, const rt_field *field,
                       const token *found)
{
    char expected[EXPECTATION_SIZE], name[EXPECTATION_SIZE], note[EXPECTATION_SIZE];
    rt_field_expectation(field, expected, sizeof expected);
    name_field(l->statement, field, name, sizeof name);
    if (is_end(found))
        return FAIL_AT(p, src, start_of(found), "the line ends; %s takes %s", name, expected);
    return FAIL_AT(p, src, start_of(found), "found '%.*s%s'%s; %s takes %s", SHOWN(found),
                   rounding_note(found, field, note, sizeof note), name, expected);
}

static bool is_in_range(const rt_field *field, double x)
{
    return field->open ? x > field->min && x < field->max : x >= field->min && x <= field->max;
}

/* One number of a field that takes `index` of them already. */
static bool read_float(parser *p, source *src, const line *l, const rt_field *field, float *out)
{
    token tok;
    if (!next_token(p, src, &tok))
        return false;
    if (is_end(&tok) || tok.quoted || rt_number_float(tok.text, tok.length, out) != RT_NUMBER_OK ||
        !is_in_range(field, (double)*out))
        return fail_value(p, src, l, field, &tok);
    return true;
}

static bool read_count(parser *p, source *src, const line *l, const rt_field *field, value *v)
{
    token tok;
    if (!next_token(p, src, &tok))
        return false;
    if (is_end(&tok) || tok.quoted ||
        rt_number_int(tok.text, tok.length, &v->count) != RT_NUMBER_OK ||
        !is_in_range(field, (double)v->count))
        return fail_value(p, src, l, field, &tok);
    return true;
}

static bool read_triple(parser *p, source *src, const line *l, const rt_field *field, value *v)
{
    skip_blanks(src);
    const char *start = src->cursor;
    for (int i = 0; i < 3; ++i)
        if (!read_float(p, src, l, field, &v->number[i]))
            return false;
    if (field->kind == RT_VALUE_DIRECTION && v->number[0] == 0.0f && v->number[1] == 0.0f &&
        v->number[2] == 0.0f) {
        const token all = {start, (size_t)(src->cursor - start), false};
        return fail_value(p, src, l, field, &all);
    }
    return true;
}

static bool read_choice(parser *p, source *src, const line *l, const rt_field *field, value *v)
{
    token tok;
    if (!next_token(p, src, &tok))
        return false;
    const char *word = field->choices;
    for (v->choice = 0; !is_end(&tok) && !tok.quoted; ++v->choice) {
        const char *bar = strchrnul(word, '|');
        if ((size_t)(bar - word) == tok.length && memcmp(word, tok.text, tok.length) == 0)
            return true;
        if (!*bar)
            break;
        word = bar + 1;
    }
    return fail_value(p, src, l, field, &tok);
}

static bool read_word(parser *p, source *src, const line *l, const rt_field *field, value *v)
{
    if (!next_token(p, src, &v->word))
        return false;
    const bool wants_quotes = field->kind == RT_VALUE_PATH;
    if (v->word.length == 0 || (wants_quotes && !v->word.quoted))
        return fail_value(p, src, l, field, &v->word);
    return true;
}

static bool read_value(parser *p, source *src, line *l, size_t index)
{
    const rt_field *field = &l->statement->fields[index];
    value *v = &l->values[index];
    v->given = true;
    switch (field->kind) {
    case RT_VALUE_NUMBER:
        return read_float(p, src, l, field, &v->number[0]);
    case RT_VALUE_COUNT:
        return read_count(p, src, l, field, v);
    case RT_VALUE_POINT:
    case RT_VALUE_DIRECTION:
    case RT_VALUE_COLOR:
        return read_triple(p, src, l, field, v);
    case RT_VALUE_CHOICE:
        return read_choice(p, src, l, field, v);
    case RT_VALUE_NAME:
    case RT_VALUE_MATERIAL:
    case RT_VALUE_PATH:
        return read_word(p, src, l, field, v);
    }
    return false;
}

/* Appends "a, b, c" of the names that `name_at` gives until it returns NULL. */
static void list_names(char *text, size_t size, const char *const *names, size_t count)
{
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; i < count && length < size; ++i)
        length += (size_t)snprintf(text + length, size - length, "%s%s", i ? ", " : "", names[i]);
}

static bool fail_unknown_name(parser *p, source *src, const line *l, const token *tok)
{
    const char *names[RT_FIELDS_MAX];
    size_t count = 0;
    for (size_t i = 0; i < rt_statement_field_count(l->statement); ++i)
        if (l->statement->fields[i].name)
            names[count++] = l->statement->fields[i].name;
    char list[EXPECTATION_SIZE];
    list_names(list, sizeof list, names, count);
    if (count == 0)
        return FAIL_AT(p, src, start_of(tok),
                       "found '%.*s%s' after '%s'; the statement is complete", SHOWN(tok),
                       l->statement->keyword);
    return FAIL_AT(p, src, start_of(tok), "found '%.*s%s'; '%s' has the names %s", SHOWN(tok),
                   l->statement->keyword, list);
}

/* The field that a token names. Pairs mostly come in the table's order, so the search starts after
 * the last one found. */
static size_t find_field(const line *l, const token *tok, size_t start, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        const size_t index = (start + i) % count;
        const rt_field *field = &l->statement->fields[index];
        if (field->name && equals(tok, field->name))
            return index;
    }
    return count;
}

static bool read_fields(parser *p, source *src, line *l)
{
    const size_t count = rt_statement_field_count(l->statement);
    size_t next = 0;
    if (!l->statement->fields[0].name && !read_value(p, src, l, next++))
        return false;
    for (;;) {
        token tok;
        if (!next_token(p, src, &tok))
            return false;
        if (is_end(&tok))
            break;
        const size_t index = find_field(l, &tok, next, count);
        if (index == count)
            return fail_unknown_name(p, src, l, &tok);
        if (l->values[index].given)
            return FAIL_AT(p, src, start_of(&tok), "'%s' is given twice",
                           l->statement->fields[index].name);
        if (!read_value(p, src, l, index))
            return false;
        next = index + 1;
    }
    for (size_t i = 0; i < count; ++i)
        if (!l->values[i].given && !l->statement->fields[i].fallback) {
            char expected[EXPECTATION_SIZE];
            rt_field_expectation(&l->statement->fields[i], expected, sizeof expected);
            return FAIL_AT(p, src, l->start, "'%s' lacks '%s', %s", l->statement->keyword,
                           l->statement->fields[i].name, expected);
        }
    return true;
}

static rt_vec3 vector_of(const value *v, rt_vec3 fallback)
{
    return v->given ? (rt_vec3){v->number[0], v->number[1], v->number[2]} : fallback;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(((const material_name *)a)->text, ((const material_name *)b)->text);
}

static void free_name(void *node)
{
    material_name *name = node;
    free(name->text);
    free(name);
}

static bool define_material(parser *p, source *src, const token *word, int32_t index)
{
    material_name *name = malloc(sizeof *name);
    char *text = strndup(word->text, word->length);
    if (!name || !text) {
        free(name);
        free(text);
        return rt_status_no_memory(p->status, "a material");
    }
    *name = (material_name){text, index};
    void *node = tsearch(name, &p->names, compare_names);
    if (node && *(material_name **)node == name)
        return true;
    free_name(name);
    if (!node)
        return rt_status_no_memory(p->status, "a material");
    return FAIL_AT(p, src, start_of(word), "material '%.*s%s' is defined above already",
                   SHOWN(word));
}

/* The index of the material that a token names, or -1 after an error. Primitives mostly come in
 * runs of one material, so the last answer is tried first. */
static int32_t find_material(parser *p, source *src, const token *word)
{
    const material_name *last = p->last_name;
    if (last && strncmp(last->text, word->text, word->length) == 0 &&
        last->text[word->length] == '\0')
        return last->index;
    char *text = strndup(word->text, word->length);
    if (!text) {
        rt_status_no_memory(p->status, "a material");
        return -1;
    }
    const material_name wanted = {text, 0};
    void *node = tfind(&wanted, &p->names, compare_names);
    free(text);
    if (node) {
        p->last_name = *(material_name **)node;
        return p->last_name->index;
    }
    FAIL_AT(p, src, start_of(word),
            "found '%.*s%s'; 'material' takes the name of a material defined above", SHOWN(word));
    return -1;
}

static bool apply_image(parser *p, source *src, const line *l)
{
    const value *width = &l->values[0], *height = &l->values[1];
    if (width->given)
        p->scene->width = (int)width->count;
    if (height->given)
        p->scene->height = (int)height->count;
    if ((int64_t)p->scene->width * p->scene->height > RT_IMAGE_PIXELS_MAX)
        return FAIL_AT(p, src, l->start, "the picture has %lld pixels; %lld are the most",
                       (long long)p->scene->width * p->scene->height,
                       (long long)RT_IMAGE_PIXELS_MAX);
    return true;
}

static bool apply_camera(parser *p, source *src, const line *l)
{
    rt_camera *camera = &p->scene->camera;
    camera->from = vector_of(&l->values[0], camera->from);
    camera->at = vector_of(&l->values[1], camera->at);
    camera->up = vector_of(&l->values[2], camera->up);
    if (l->values[3].given)
        camera->vfov = l->values[3].number[0];
    if (camera->from.x == camera->at.x && camera->from.y == camera->at.y &&
        camera->from.z == camera->at.z)
        return FAIL_AT(p, src, l->start, "%s",
                       "'from' and 'at' of 'camera' are the same point as floats");
    return true;
}

static bool apply_light(parser *p, const line *l, bool is_point)
{
    const rt_vec3 place = vector_of(&l->values[0], (rt_vec3){0.0f, 0.0f, 0.0f});
    const rt_vec3 color = vector_of(&l->values[1], (rt_vec3){1.0f, 1.0f, 1.0f});
    rt_light light = {place.x, place.y, place.z, 1.0f, color.x, color.y, color.z, 0};
    if (!is_point) {
        const double x = (double)place.x, y = (double)place.y, z = (double)place.z;
        const double inverse = -1.0 / hypot(hypot(x, y), z);
        light.x = (float)(x * inverse);
        light.y = (float)(y * inverse);
        light.z = (float)(z * inverse);
        light.w = 0.0f;
    }
    return rt_scene_add_light(p->scene, &light, p->status);
}

static bool apply_material(parser *p, source *src, const line *l)
{
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const value *v = l->values;
    const rt_material material =
        rt_material_make(v[1].given ? v[1].number : zero, v[2].given ? v[2].number : zero,
                         v[3].given ? v[3].number : zero, v[4].given ? v[4].number[0] : 1.0f);
    return define_material(p, src, &v[0].word, (int32_t)p->scene->material_count) &&
           rt_scene_add_material(p->scene, &material, p->status);
}

static bool apply_sphere(parser *p, source *src, const line *l)
{
    const value *v = l->values;
    const int32_t material = find_material(p, src, &v[2].word);
    const rt_sphere sphere = {v[0].number[0], v[0].number[1], v[0].number[2], v[1].number[0]};
    return material >= 0 && rt_scene_add_sphere(p->scene, &sphere, material, p->status);
}

/* The vertex normals by a common power of two, which is exact and keeps their weights, so that sums
 * of them neither overflow nor vanish. */
static void gather_normals(const value *normals, float record[RT_NORMAL_COMPONENTS])
{
    float largest = 0.0f;
    for (int i = 0; i < RT_NORMAL_COMPONENTS; ++i) {
        record[i] = normals[i / 3].number[i % 3];
        largest = fmaxf(largest, fabsf(record[i]));
    }
    for (int i = 0; largest > 0.0f && i < RT_NORMAL_COMPONENTS; ++i)
        record[i] = ldexpf(record[i], -ilogbf(largest));
}

static bool apply_triangle(parser *p, source *src, const line *l)
{
    const value *a = &l->values[0], *b = &l->values[1], *c = &l->values[2];
    const value *normals = &l->values[4];
    const int given = normals[0].given + normals[1].given + normals[2].given;
    if (given != 0 && given != 3)
        return FAIL_AT(p, src, l->start, "%s",
                       "'na', 'nb' and 'nc' of 'triangle' go together; give all or none");
    const int32_t material = find_material(p, src, &l->values[3].word);
    if (material < 0)
        return false;
    rt_triangle t = {a->number[0], a->number[1], a->number[2], b->number[0], b->number[1],
                     b->number[2], c->number[0], c->number[1], c->number[2]};
    if (rt_triangle_is_degenerate(&t)) {
        /* It keeps its index; as a single point its determinant is 0 for every ray. */
        t = (rt_triangle){t.ax, t.ay, t.az, t.ax, t.ay, t.az, t.ax, t.ay, t.az};
        if (p->degenerate_count++ == 0)
            p->degenerate_place = (rt_place){src->name, src->line};
    }
    float record[RT_NORMAL_COMPONENTS];
    gather_normals(normals, record);
    if (given && !p->scene->smooth_place.line)
        p->scene->smooth_place = (rt_place){src->name, src->line};
    return rt_scene_add_triangle(p->scene, &t, given ? record : NULL, material, p->status);
}

static bool apply_cull(parser *p, source *src, const line *l)
{
    p->scene->cull = l->values[0].choice == 0 ? RT_CULL_BACK : RT_CULL_FRONT;
    p->scene->winding =
        l->values[1].given && l->values[1].choice == 1 ? RT_WINDING_CW : RT_WINDING_CCW;
    p->scene->cull_place = (rt_place){src->name, src->line};
    return true;
}

/* `at` is where the includer names the file; both are NULL for the scene itself. */
static bool read_file(parser *p, const char *path, source *includer, const char *at);

/* Opens `word` relative to the file that names it. */
static bool apply_include(parser *p, source *src, const line *l)
{
    const token *word = &l->values[0].word;
    const char *slash = strrchr(src->name, '/');
    const int folder = word->text[0] == '/' || !slash ? 0 : (int)(slash + 1 - src->name);
    char *path = NULL;
    if (asprintf(&path, "%.*s%.*s", folder, src->name, (int)word->length, word->text) < 0)
        return rt_status_no_memory(p->status, "a path");
    int depth = 1;
    for (const source *s = src; s; s = s->includer, ++depth)
        if (strcmp(s->name, path) == 0 || depth > INCLUDE_DEPTH_MAX) {
            if (depth > INCLUDE_DEPTH_MAX)
                FAIL_AT(p, src, start_of(word), "%d files deep in includes", INCLUDE_DEPTH_MAX);
            else
                FAIL_AT(p, src, start_of(word), "'%s' includes itself", path);
            free(path);
            return false;
        }
    const bool done = read_file(p, path, src, start_of(word));
    free(path);
    return done;
}

static bool apply(parser *p, source *src, const line *l, enum rt_statement_id id)
{
    const rt_vec3 black = {0.0f, 0.0f, 0.0f};
    switch (id) {
    case RT_STATEMENT_RT:
        p->has_version = true;
        return true;
    case RT_STATEMENT_INCLUDE:
        return apply_include(p, src, l);
    case RT_STATEMENT_IMAGE:
        return apply_image(p, src, l);
    case RT_STATEMENT_CAMERA:
        return apply_camera(p, src, l);
    case RT_STATEMENT_BACKGROUND:
        p->scene->background = vector_of(&l->values[0], black);
        return true;
    case RT_STATEMENT_AMBIENT:
        p->scene->ambient = vector_of(&l->values[0], black);
        return true;
    case RT_STATEMENT_LIGHT_POINT:
        return apply_light(p, l, true);
    case RT_STATEMENT_LIGHT_DIRECTIONAL:
        return apply_light(p, l, false);
    case RT_STATEMENT_MATERIAL:
        return apply_material(p, src, l);
    case RT_STATEMENT_SPHERE:
        return apply_sphere(p, src, l);
    case RT_STATEMENT_TRIANGLE:
        return apply_triangle(p, src, l);
    case RT_STATEMENT_CULL:
        return apply_cull(p, src, l);
    case RT_STATEMENT_COUNT:
        break;
    }
    return false;
}

static bool fail_unknown_statement(parser *p, source *src, const token *tok)
{
    const char *names[RT_STATEMENT_COUNT] = {NULL};
    size_t count = 0;
    for (int id = 0; id < RT_STATEMENT_COUNT; ++id)
        if (count == 0 || strcmp(names[count - 1], rt_statements[id].keyword) != 0)
            names[count++] = rt_statements[id].keyword;
    char list[EXPECTATION_SIZE];
    list_names(list, sizeof list, names, count);
    return FAIL_AT(p, src, start_of(tok), "found '%.*s%s'; a line begins with one of %s",
                   SHOWN(tok), list);
}

static bool is_keyword(const token *tok)
{
    for (int i = 0; i < RT_STATEMENT_COUNT; ++i)
        if (equals(tok, rt_statements[i].keyword))
            return true;
    return false;
}

/* The statement that the line's first word, and for variants the second, stand for. */
static bool find_statement(parser *p, source *src, const token *keyword, enum rt_statement_id *id)
{
    token second = {src->cursor, 0, false};
    bool is_variant = false;
    for (int i = 0; i < RT_STATEMENT_COUNT; ++i) {
        const rt_statement *s = &rt_statements[i];
        if (keyword->text[0] != s->keyword[0] || !equals(keyword, s->keyword))
            continue;
        if (s->variant && !is_variant) {
            is_variant = true;
            if (!next_token(p, src, &second))
                return false;
        }
        if (!s->variant || equals(&second, s->variant)) {
            *id = (enum rt_statement_id)i;
            return true;
        }
    }
    if (!is_variant)
        return fail_unknown_statement(p, src, keyword);
    const char *names[RT_STATEMENT_COUNT], *word = NULL;
    size_t count = 0;
    for (int i = 0; i < RT_STATEMENT_COUNT; ++i)
        if (rt_statements[i].variant && equals(keyword, rt_statements[i].keyword)) {
            word = rt_statements[i].keyword;
            names[count++] = rt_statements[i].variant;
        }
    char list[EXPECTATION_SIZE];
    list_names(list, sizeof list, names, count);
    if (is_end(&second))
        return FAIL_AT(p, src, start_of(&second), "the line ends; '%s' takes one of %s", word,
                       list);
    return FAIL_AT(p, src, start_of(&second), "found '%.*s%s'; '%s' takes one of %s",
                   SHOWN(&second), word, list);
}

static bool check_order(parser *p, source *src, const line *l, enum rt_statement_id id)
{
    rt_place *seen = &p->seen[id];
    if (rt_statements[id].once && seen->line)
        return FAIL_AT(p, src, l->start, "'%s' is given already at %s:%d", l->statement->keyword,
                       seen->file, seen->line);
    if (!seen->line)
        *seen = (rt_place){src->name, src->line};
    return true;
}

/* One line that has a token. False after an error; the rest of the line is then skipped. */
static bool read_line(parser *p, source *src, const token *keyword)
{
    line l = {.start = keyword->text};
    enum rt_statement_id id = RT_STATEMENT_COUNT;
    const bool in_order = p->has_version || equals(keyword, "rt");
    if (!in_order) {
        p->has_version = true; /* said once */
        FAIL_AT(p, src, start_of(keyword), "found '%.*s%s'; a scene begins with 'rt 1'",
                SHOWN(keyword));
        if (!is_keyword(keyword))
            return false;
    }
    if (!find_statement(p, src, keyword, &id))
        return false;
    l.statement = &rt_statements[id];
    if (!check_order(p, src, &l, id))
        return false;
    if (!read_fields(p, src, &l)) {
        /* The name counts as defined, so that its uses are not errors too. */
        const value *name = &l.values[0];
        if (id == RT_STATEMENT_RT)
            p->has_version = true;
        if (id == RT_STATEMENT_MATERIAL && name->given && name->word.length > 0)
            apply_material(p, src, &l);
        return false;
    }
    return apply(p, src, &l, id) && in_order;
}

static bool read_text(parser *p, source *src)
{
    bool good = true;
    if (src->end - src->cursor >= 3 && memcmp(src->cursor, "\xef\xbb\xbf", 3) == 0)
        src->line_start = src->cursor += 3;
    for (; src->cursor < src->end; next_line(src)) {
        token keyword;
        if (!next_token(p, src, &keyword))
            good = false;
        else if (!is_end(&keyword))
            good = read_line(p, src, &keyword) && good;
    }
    return good;
}

static bool read_file(parser *p, const char *path, source *includer, const char *at)
{
    rt_scene *scene = p->scene;
    const bool is_stdin = !includer && strcmp(path, "-") == 0;
    char *name = strdup(is_stdin ? "<stdin>" : path);
    if (!name || !RT_ARRAY_GROW(scene->files, scene->file_count, &scene->file_capacity)) {
        free(name);
        return rt_status_no_memory(p->status, "a file name");
    }
    scene->files[scene->file_count++] = name;

    rt_file_text text;
    const char *reason = rt_file_read(is_stdin ? NULL : path, &text);
    if (reason && includer)
        return FAIL_AT(p, includer, at, "cannot read '%.*s': %s", PATH_SHOWN, path, reason);
    if (reason)
        return rt_status_fail(p->status, RT_ERROR_SCENE, "rt: cannot read '%s': %s", path, reason);
    source src = {name, text.bytes + text.length, text.bytes, text.bytes, 1, includer};
    const bool good = read_text(p, &src);
    rt_file_free(&text);
    return good;
}

bool rt_scene_text_read(rt_scene *scene, const char *path, rt_status *status)
{
    parser p = {.scene = scene, .status = status};
    bool good = read_file(&p, path, NULL, NULL);
    if (good && !p.has_version)
        good =
            rt_status_fail(status, RT_ERROR_SCENE,
                           "%s:1:1: error: the file has no statement; a scene begins with 'rt 1'",
                           scene->files[0]);
    if (p.degenerate_count > 0)
        rt_status_warn(status,
                       "%s:%d:1: warning: the triangle has no area and is never hit (%zu such)",
                       p.degenerate_place.file, p.degenerate_place.line, p.degenerate_count);
    tdestroy(p.names, free_name);
    return good;
}

void rt_scene_text_grammar(FILE *out)
{
    fprintf(out, "| statement | name | value | default | meaning |\n|---|---|---|---|---|\n");
    for (int id = 0; id < RT_STATEMENT_COUNT; ++id) {
        const rt_statement *s = &rt_statements[id];
        fprintf(out, "| `%s%s%s` | | | | %s%s |\n", s->keyword, s->variant ? " " : "",
                s->variant ? s->variant : "", s->meaning, s->once ? "; at most once" : "");
        for (size_t i = 0; i < rt_statement_field_count(s); ++i) {
            const rt_field *field = &s->fields[i];
            char expected[EXPECTATION_SIZE];
            rt_field_expectation(field, expected, sizeof expected);
            fprintf(out, "| | %s%s%s | %s | %s | %s |\n", field->name ? "`" : "",
                    field->name ? field->name : "(first)", field->name ? "`" : "", expected,
                    field->fallback ? field->fallback : "required", field->meaning);
        }
    }
}
