/* Files, their lines, and what order statements may come in. After an error the rest of the line is
 * skipped and reading goes on, so that one run shows many mistakes. */
#define _GNU_SOURCE
#include "scene_text/reader.h"

#include <stdlib.h>
#include <string.h>

#include "common/array.h"
#include "common/file.h"
#include "scene_text/parser.h"

#define INCLUDE_DEPTH_MAX 16

/* Reads one file, which another may include; its name is kept for what points to it. */
static bool read_file(rt_parser *p, const char *name, const rt_file_text *text,
                      rt_source *includer);

/* That it is there is known by its keyword, and the one version there is by its row. */
bool rt_scene_apply_version(rt_parser *p, rt_source *src, const rt_line *l)
{
    (void)p;
    (void)src;
    (void)l;
    return true;
}

/* Opens `word` relative to the file that names it. */
bool rt_scene_apply_include(rt_parser *p, rt_source *src, const rt_line *l)
{
    const rt_word *word = &l->values[0].word;
    char *path = rt_file_beside(src->name, word->text, word->length);
    if (!path)
        return rt_status_no_memory(p->status, "a path");
    int depth = 1;
    for (const rt_source *s = src; s; s = s->includer, ++depth)
        if (strcmp(s->name, path) == 0 || depth > INCLUDE_DEPTH_MAX) {
            if (depth > INCLUDE_DEPTH_MAX)
                RT_FAIL_AT(src, rt_word_start(word), "%d files deep in includes",
                           INCLUDE_DEPTH_MAX);
            else
                RT_FAIL_AT(src, rt_word_start(word), "'%s' includes itself", path);
            free(path);
            return false;
        }
    rt_file_text text;
    const char *reason = rt_file_read(path, &text);
    const bool good = reason ? RT_FAIL_AT(src, rt_word_start(word), "cannot read '%.*s': %s",
                                          RT_PATH_SHOWN, path, reason)
                             : read_file(p, path, &text, src);
    rt_file_free(&text);
    free(path);
    return good;
}

static bool check_order(rt_parser *p, rt_source *src, const rt_line *l)
{
    rt_place *seen = &p->seen[l->statement - rt_statements];
    if (l->statement->once && seen->line)
        return RT_FAIL_AT(src, l->start, "'%s' is given already at %s:%d", l->statement->keyword,
                          seen->file, seen->line);
    if (!seen->line)
        *seen = rt_source_place(src);
    return true;
}

/* One line that has a token. False after an error; the rest of the line is then skipped. */
static bool read_line(rt_parser *p, rt_source *src, const rt_word *keyword)
{
    rt_line l; /* set by rt_line_begin */
    const bool in_order = p->has_version || rt_word_equals(keyword, "rt");
    p->has_version = true; /* or this is said once */
    if (!in_order) {
        RT_FAIL_AT(src, rt_word_start(keyword), "found '%.*s%s'; a scene begins with 'rt 1'",
                   RT_SHOWN(keyword));
        if (!rt_line_is_keyword(keyword))
            return false;
    }
    if (!rt_line_begin(src, keyword, &l) || !check_order(p, src, &l))
        return false;
    if (!rt_line_read(src, &l)) {
        /* A name counts as defined, so that its uses are not errors too. */
        const rt_value *name = &l.values[0];
        if (l.statement->fields[0].kind == RT_VALUE_NAME && name->given && name->word.length > 0)
            rt_scene_define_broken(p, src, &name->word);
        return false;
    }
    return l.statement->apply(p, src, &l) && in_order;
}

static bool read_lines(rt_parser *p, rt_source *src)
{
    bool good = true;
    if (src->end - src->cursor >= 3 && memcmp(src->cursor, "\xef\xbb\xbf", 3) == 0)
        src->line_start = src->cursor += 3;
    for (; src->cursor < src->end; rt_source_next_line(src)) {
        rt_word keyword;
        if (!rt_source_word(src, &keyword))
            good = false;
        else if (!rt_word_is_end(&keyword))
            good = read_line(p, src, &keyword) && good;
    }
    return good;
}

static bool read_file(rt_parser *p, const char *name, const rt_file_text *text, rt_source *includer)
{
    rt_scene *scene = p->scene;
    char *kept = strdup(name);
    if (!kept || !RT_ARRAY_GROW(scene->files, scene->file_count, &scene->file_capacity)) {
        free(kept);
        return rt_status_no_memory(p->status, "a file name");
    }
    scene->files[scene->file_count++] = kept;
    rt_source src = {kept,     text->bytes + text->length, text->bytes, text->bytes, 1, includer,
                     p->status};
    return read_lines(p, &src);
}

bool rt_scene_text_read(rt_scene *scene, const char *name, const rt_file_text *text,
                        rt_status *status)
{
    rt_parser p = {.scene = scene, .status = status};
    bool good = read_file(&p, name, text, NULL);
    if (good && !p.has_version)
        good = rt_status_fail(
            status, RT_ERROR_SCENE,
            "%s:1:1: error: the file has no statement; a scene begins with 'rt 1'", name);
    if (p.degenerate_count > 0)
        rt_status_warn(status,
                       "%s:%d:1: warning: the triangle has no area and is never hit (%zu such)",
                       p.degenerate_place.file, p.degenerate_place.line, p.degenerate_count);
    rt_scene_settle_shadows(&p);
    rt_scene_forget_materials(&p);
    return good;
}
