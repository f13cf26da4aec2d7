/* What the parts of the scene reader share: the state of reading, and what each statement does. One
 * file a subject: setting (picture, eye, surroundings), lights, materials, shapes. */
#ifndef RT_SCENE_TEXT_PARSER_H
#define RT_SCENE_TEXT_PARSER_H

#include "common/status.h"
#include "scene/scene.h"
#include "scene_text/line.h"
#include "scene_text/source.h"

/* What a name stands for. */
typedef struct rt_material_name {
    char *text;
    int32_t index;
} rt_material_name;

typedef struct rt_parser {
    rt_scene *scene;
    rt_status *status;
    void *names; /* tsearch tree of rt_material_name */
    const rt_material_name *last_name;
    bool has_version;                  /* or its lack was told of */
    rt_place seen[RT_STATEMENT_COUNT]; /* where a statement first came, by its row */
    bool has_shadows;                  /* what `shadows` says */
    rt_place shadows_place;            /* and where */
    size_t degenerate_count;
    rt_place degenerate_place;
} rt_parser;

/* The statement being read. */
static inline rt_place rt_source_place(const rt_source *source)
{
    return (rt_place){source->name, source->line};
}

static inline rt_vec3 rt_value_vector(const rt_value *v, rt_vec3 fallback)
{
    return v->given ? (rt_vec3){v->number[0], v->number[1], v->number[2]} : fallback;
}

static inline float rt_value_number(const rt_value *v, float fallback)
{
    return v->given ? v->number[0] : fallback;
}

static inline int rt_value_count(const rt_value *v, int fallback)
{
    return v->given ? (int)v->count : fallback;
}

/* What the statements do, each by its row of rt_statements. */
#define STATEMENT(name, ...) rt_statement_apply rt_scene_apply_##name;
#include "scene_text/statements.def"
#undef STATEMENT

/* Lets `shadows` decide for the lights that do not say themselves, once all statements are read. */
void rt_scene_settle_shadows(rt_parser *p);

/* Makes a material known that cannot be read, so that its uses are not errors too. */
void rt_scene_define_broken(rt_parser *p, rt_source *source, const rt_word *name);

/* Adds a material that the statement being read calls for. */
bool rt_scene_place_material(rt_scene *scene, const rt_material *material, const rt_source *source);

/* The index of the material that a word names, or -1 after a message. */
int32_t rt_scene_find_material(rt_parser *p, rt_source *source, const rt_word *word);

/* Forgets the names. */
void rt_scene_forget_materials(rt_parser *p);

#endif
