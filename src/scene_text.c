/* What the statements do to the scene. After an error the rest of the line is skipped and reading
 * goes on, so that one run shows many mistakes. */
#define _GNU_SOURCE
#include "scene_text.h"

#include <math.h>
#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "array.h"
#include "file.h"
#include "scene_line.h"
#include "scene_mesh.h"

#define INCLUDE_DEPTH_MAX 16

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
    rt_place seen[RT_STATEMENT_COUNT]; /* where a statement first came */
    size_t degenerate_count;
    rt_place degenerate_place;
} parser;

static rt_vec3 vector_of(const rt_value *v, rt_vec3 fallback)
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

static bool define_material(parser *p, rt_source *src, const rt_word *word, int32_t index)
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
    return RT_FAIL_AT(src, rt_word_start(word), "material '%.*s%s' is defined above already",
                      RT_SHOWN(word));
}

/* The index of the material that a token names, or -1 after an error. Primitives mostly come in
 * runs of one material, so the last answer is tried first. */
static int32_t find_material(parser *p, rt_source *src, const rt_word *word)
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
    RT_FAIL_AT(src, rt_word_start(word),
               "found '%.*s%s'; 'material' takes the name of a material defined above",
               RT_SHOWN(word));
    return -1;
}

static bool apply_image(parser *p, rt_source *src, const rt_line *l)
{
    const rt_value *width = &l->values[0], *height = &l->values[1];
    if (width->given)
        p->scene->width = (int)width->count;
    if (height->given)
        p->scene->height = (int)height->count;
    if ((int64_t)p->scene->width * p->scene->height > RT_IMAGE_PIXELS_MAX)
        return RT_FAIL_AT(src, l->start, "the picture has %lld pixels; %lld are the most",
                          (long long)p->scene->width * p->scene->height,
                          (long long)RT_IMAGE_PIXELS_MAX);
    return true;
}

static bool apply_camera(parser *p, rt_source *src, const rt_line *l)
{
    rt_camera *camera = &p->scene->camera;
    camera->from = vector_of(&l->values[0], camera->from);
    camera->at = vector_of(&l->values[1], camera->at);
    camera->up = vector_of(&l->values[2], camera->up);
    if (l->values[3].given)
        camera->vfov = l->values[3].number[0];
    if (camera->from.x == camera->at.x && camera->from.y == camera->at.y &&
        camera->from.z == camera->at.z)
        return RT_FAIL_AT(src, l->start, "%s",
                          "'from' and 'at' of 'camera' are the same point as floats");
    return true;
}

static bool apply_light(parser *p, const rt_line *l, bool is_point)
{
    const rt_vec3 place = vector_of(&l->values[0], (rt_vec3){0.0f, 0.0f, 0.0f});
    const rt_vec3 color = vector_of(&l->values[1], (rt_vec3){1.0f, 1.0f, 1.0f});
    rt_light light = {.x = place.x,
                      .y = place.y,
                      .z = place.z,
                      .w = 1.0f,
                      .r = color.x,
                      .g = color.y,
                      .b = color.z,
                      .samples = 1};
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

static bool apply_material(parser *p, rt_source *src, const rt_line *l)
{
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const rt_value *v = l->values;
    const rt_material material =
        rt_material_make(v[1].given ? v[1].number : zero, v[2].given ? v[2].number : zero,
                         v[3].given ? v[3].number : zero, v[4].given ? v[4].number[0] : 1.0f);
    return define_material(p, src, &v[0].word, (int32_t)p->scene->material_count) &&
           rt_scene_add_material(p->scene, &material, p->status);
}

static bool apply_sphere(parser *p, rt_source *src, const rt_line *l)
{
    const rt_value *v = l->values;
    const int32_t material = find_material(p, src, &v[2].word);
    const rt_sphere sphere = {v[0].number[0], v[0].number[1], v[0].number[2], v[1].number[0]};
    return material >= 0 && rt_scene_add_sphere(p->scene, &sphere, material, p->status);
}

/* Counts triangles without area; the warning names the first statement that has one. */
static void note_degenerate(parser *p, const rt_source *src, size_t count)
{
    if (count > 0 && p->degenerate_count == 0)
        p->degenerate_place = (rt_place){src->name, src->line};
    p->degenerate_count += count;
}

static bool apply_triangle(parser *p, rt_source *src, const rt_line *l)
{
    const rt_value *a = &l->values[0], *b = &l->values[1], *c = &l->values[2];
    const rt_value *normals = &l->values[4];
    const int given = normals[0].given + normals[1].given + normals[2].given;
    if (given != 0 && given != 3)
        return RT_FAIL_AT(src, l->start, "%s",
                          "'na', 'nb' and 'nc' of 'triangle' go together; give all or none");
    const int32_t material = find_material(p, src, &l->values[3].word);
    if (material < 0)
        return false;
    rt_triangle t = {a->number[0], a->number[1], a->number[2], b->number[0], b->number[1],
                     b->number[2], c->number[0], c->number[1], c->number[2]};
    float record[RT_NORMAL_COMPONENTS];
    for (int i = 0; given && i < RT_NORMAL_COMPONENTS; ++i)
        record[i] = normals[i / 3].number[i % 3];
    note_degenerate(p, src, rt_triangle_settle(&t, given ? record : NULL) ? 0 : 1);
    if (given && !p->scene->smooth_place.line)
        p->scene->smooth_place = (rt_place){src->name, src->line};
    return rt_scene_add_triangle(p->scene, &t, given ? record : NULL, material, p->status);
}

static bool apply_mesh(parser *p, rt_source *src, const rt_line *l)
{
    const rt_value *material = &l->values[1];
    const int32_t index = material->given ? find_material(p, src, &material->word) : -1;
    size_t degenerate_count = 0;
    if ((material->given && index < 0) ||
        !rt_scene_mesh_add(p->scene, src, l, index, &degenerate_count))
        return false;
    note_degenerate(p, src, degenerate_count);
    return true;
}

static bool apply_cull(parser *p, rt_source *src, const rt_line *l)
{
    p->scene->cull = l->values[0].choice == 0 ? RT_CULL_BACK : RT_CULL_FRONT;
    p->scene->winding =
        l->values[1].given && l->values[1].choice == 1 ? RT_WINDING_CW : RT_WINDING_CCW;
    p->scene->cull_place = (rt_place){src->name, src->line};
    return true;
}

/* `at` is where the includer names the file; both are NULL for the scene itself. */
static bool read_file(parser *p, const char *path, rt_source *includer, const char *at);

/* Opens `word` relative to the file that names it. */
static bool apply_include(parser *p, rt_source *src, const rt_line *l)
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
    const bool done = read_file(p, path, src, rt_word_start(word));
    free(path);
    return done;
}

static bool apply(parser *p, rt_source *src, const rt_line *l)
{
    const rt_vec3 black = {0.0f, 0.0f, 0.0f};
    p->scene->here = (rt_place){src->name, src->line};
    switch (l->id) {
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
    case RT_STATEMENT_MESH:
        return apply_mesh(p, src, l);
    case RT_STATEMENT_CULL:
        return apply_cull(p, src, l);
    case RT_STATEMENT_ACCURACY:
        p->scene->accuracy = (enum rt_accuracy)l->values[0].choice;
        return true;
    case RT_STATEMENT_COUNT:
        break;
    }
    return false;
}

static bool check_order(parser *p, rt_source *src, const rt_line *l)
{
    rt_place *seen = &p->seen[l->id];
    if (l->statement->once && seen->line)
        return RT_FAIL_AT(src, l->start, "'%s' is given already at %s:%d", l->statement->keyword,
                          seen->file, seen->line);
    if (!seen->line)
        *seen = (rt_place){src->name, src->line};
    return true;
}

/* One line that has a token. False after an error; the rest of the line is then skipped. */
static bool read_line(parser *p, rt_source *src, const rt_word *keyword)
{
    rt_line l; /* set by rt_line_begin */
    const bool in_order = p->has_version || rt_word_equals(keyword, "rt");
    if (!in_order) {
        p->has_version = true; /* said once */
        RT_FAIL_AT(src, rt_word_start(keyword), "found '%.*s%s'; a scene begins with 'rt 1'",
                   RT_SHOWN(keyword));
        if (!rt_line_is_keyword(keyword))
            return false;
    }
    if (!rt_line_begin(src, keyword, &l) || !check_order(p, src, &l))
        return false;
    if (!rt_line_read(src, &l)) {
        /* The name counts as defined, so that its uses are not errors too. */
        const rt_value *name = &l.values[0];
        if (l.id == RT_STATEMENT_RT)
            p->has_version = true;
        if (l.id == RT_STATEMENT_MATERIAL && name->given && name->word.length > 0)
            apply_material(p, src, &l);
        return false;
    }
    return apply(p, src, &l) && in_order;
}

static bool read_text(parser *p, rt_source *src)
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

static bool read_file(parser *p, const char *path, rt_source *includer, const char *at)
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
        return RT_FAIL_AT(includer, at, "cannot read '%.*s': %s", RT_PATH_SHOWN, path, reason);
    if (reason)
        return rt_status_fail(p->status, RT_ERROR_SCENE, "rt: cannot read '%s': %s", path, reason);
    rt_source src = {name,     text.bytes + text.length, text.bytes, text.bytes, 1, includer,
                     p->status};
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
