/* Materials and their names. */
#define _GNU_SOURCE
#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "common/file.h"
#include "scene/texture.h"
#include "scene_text/parser.h"

/* Fields of `material` in the grammar's order. */
enum field {
    NAME,
    KA,
    KD,
    KS,
    SHININESS,
    REFLECT,
    TRANSMIT,
    IOR,
    ABSORB,
    CHECKER,
    CELL,
    TEXTURE,
    FILTER,
    WRAP
};

static int compare_names(const void *a, const void *b)
{
    return strcmp(((const rt_material_name *)a)->text, ((const rt_material_name *)b)->text);
}

static void free_name(void *node)
{
    rt_material_name *name = node;
    free(name->text);
    free(name);
}

void rt_scene_forget_materials(rt_parser *p)
{
    tdestroy(p->names, free_name);
    p->names = NULL;
    p->last_name = NULL;
}

static bool define_material(rt_parser *p, rt_source *src, const rt_word *word, int32_t index)
{
    rt_material_name *name = malloc(sizeof *name);
    char *text = strndup(word->text, word->length);
    if (!name || !text) {
        free(name);
        free(text);
        return rt_status_no_memory(p->status, "a material");
    }
    *name = (rt_material_name){text, index};
    void *node = tsearch(name, &p->names, compare_names);
    if (node && *(rt_material_name **)node == name)
        return true;
    free_name(name);
    if (!node)
        return rt_status_no_memory(p->status, "a material");
    return RT_FAIL_AT(src, rt_word_start(word), "material '%.*s%s' is defined above already",
                      RT_SHOWN(word));
}

/* Primitives mostly come in runs of one material, so the last answer is tried first. */
int32_t rt_scene_find_material(rt_parser *p, rt_source *src, const rt_word *word)
{
    const rt_material_name *last = p->last_name;
    if (last && strncmp(last->text, word->text, word->length) == 0 &&
        last->text[word->length] == '\0')
        return last->index;
    char *text = strndup(word->text, word->length);
    if (!text) {
        rt_status_no_memory(p->status, "a material");
        return -1;
    }
    const rt_material_name wanted = {text, 0};
    void *node = tfind(&wanted, &p->names, compare_names);
    free(text);
    if (node) {
        p->last_name = *(rt_material_name **)node;
        return p->last_name->index;
    }
    RT_FAIL_AT(src, rt_word_start(word),
               "found '%.*s%s'; 'material' takes the name of a material defined above",
               RT_SHOWN(word));
    return -1;
}

static rt_material read_phong(const rt_value *v)
{
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    return rt_material_make(v[KA].given ? v[KA].number : zero, v[KD].given ? v[KD].number : zero,
                            v[KS].given ? v[KS].number : zero,
                            rt_value_number(&v[SHININESS], 1.0f));
}

static bool read_mirror_and_glass(const rt_value *v, rt_source *src, const rt_line *l,
                                  rt_material *m)
{
    const rt_vec3 absorb = rt_value_vector(&v[ABSORB], (rt_vec3){0.0f, 0.0f, 0.0f});
    m->reflect = rt_value_number(&v[REFLECT], 0.0f);
    m->transmit = rt_value_number(&v[TRANSMIT], 0.0f);
    m->ior = rt_value_number(&v[IOR], m->ior);
    m->absorb_r = absorb.x;
    m->absorb_g = absorb.y;
    m->absorb_b = absorb.z;
    /* In float, so that 0.9 and 0.1 are 1 together. */
    return m->reflect + m->transmit <= 1.0f ||
           RT_FAIL_AT(src, l->start,
                      "'reflect' and 'transmit' of 'material' are %.9g together; 1 is the most",
                      (double)m->reflect + (double)m->transmit);
}

static bool read_checker(const rt_value *v, rt_source *src, const rt_line *l, rt_material *m)
{
    if (v[CELL].given && !v[CHECKER].given)
        return RT_FAIL_AT(src, l->start, "%s",
                          "'cell' of 'material' is that of a checker; give 'checker' too");
    const rt_vec3 checker = rt_value_vector(&v[CHECKER], (rt_vec3){0.0f, 0.0f, 0.0f});
    m->checker_r = checker.x;
    m->checker_g = checker.y;
    m->checker_b = checker.z;
    m->cell = v[CHECKER].given ? rt_value_number(&v[CELL], 1.0f) : 0.0f;
    return true;
}

static bool read_texture(rt_parser *p, rt_source *src, const rt_line *l, rt_material *m)
{
    const rt_value *texture = &l->values[TEXTURE];
    const rt_value *filter = &l->values[FILTER], *wrap = &l->values[WRAP];
    if ((filter->given || wrap->given) && !texture->given)
        return RT_FAIL_AT(src, l->start,
                          "'%s' of 'material' is that of a texture; give 'texture' too",
                          filter->given ? "filter" : "wrap");
    m->nearest = filter->given && filter->choice == 0;
    m->clamp = wrap->given && wrap->choice == 1;
    if (!texture->given)
        return true;
    const rt_word *word = &texture->word;
    char *path = rt_file_beside(src->name, word->text, word->length);
    if (!path)
        return rt_status_no_memory(p->status, "a path");
    int32_t index = -1;
    char reason[RT_TEXTURE_REASON_SIZE];
    const bool good = rt_texture_load(p->scene, path, &index, reason) ||
                      RT_FAIL_AT(src, rt_word_start(word), "cannot take the texture '%.*s': %s",
                                 RT_PATH_SHOWN, path, reason);
    free(path);
    m->texture = index;
    return good;
}

bool rt_scene_place_material(rt_scene *scene, const rt_material *material, const rt_source *source)
{
    if (!rt_scene_add_material(scene, material, source->status))
        return false;
    scene->material_places[scene->material_count - 1] = rt_source_place(source);
    return true;
}

bool rt_scene_apply_material(rt_parser *p, rt_source *src, const rt_line *l)
{
    const rt_value *v = l->values;
    rt_material material = read_phong(v);
    /* The name is known after a mistake too, so that its uses are not mistakes. */
    const bool is_defined =
        define_material(p, src, &v[NAME].word, (int32_t)p->scene->material_count);
    const bool is_good = is_defined && read_mirror_and_glass(v, src, l, &material) &&
                         read_checker(v, src, l, &material) && read_texture(p, src, l, &material);
    return rt_scene_place_material(p->scene, &material, src) && is_good;
}

void rt_scene_define_broken(rt_parser *p, rt_source *src, const rt_word *name)
{
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const rt_material material = rt_material_make(zero, zero, zero, 1.0f);
    if (define_material(p, src, name, (int32_t)p->scene->material_count))
        rt_scene_place_material(p->scene, &material, src);
}
