/* Material libraries of OBJ (MTL): Ka, Kd, Ks, Ns and map_Kd of each material. What such a file
 * says beyond that (illumination models, transparency, other textures) is passed over. */
#include "mesh/build.h"

#include <stdlib.h>

#include "scene/scene.h"

static float clamp(float value, float most)
{
    return value < 0.0f ? 0.0f : value > most ? most : value;
}

/* r g b, or r alone for a grey. Programs write reflectances above 1, which no surface has. */
static bool read_color(rt_text *text, const char *taker, float color[3])
{
    for (int i = 0; i < 3; ++i) {
        const rt_token token = rt_text_token(text);
        if (token.length == 0 && i == 1) {
            color[1] = color[2] = color[0];
            return true;
        }
        if (!rt_text_float(text, token, taker, &color[i]))
            return false;
        color[i] = clamp(color[i], 1.0f);
    }
    return true;
}

/* Reads a statement about the material defined last. */
static bool read_statement(rt_text *text, rt_token keyword, rt_material *m)
{
    float ka[3] = {m->ka_r, m->ka_g, m->ka_b};
    float kd[3] = {m->kd_r, m->kd_g, m->kd_b};
    float ks[3] = {m->ks_r, m->ks_g, m->ks_b};
    float shininess = m->shininess;
    bool good = true;
    if (rt_token_equals(keyword, "Ka")) {
        good = read_color(text, "'Ka' takes three numbers from 0 to 1", ka);
    } else if (rt_token_equals(keyword, "Kd")) {
        good = read_color(text, "'Kd' takes three numbers from 0 to 1", kd);
    } else if (rt_token_equals(keyword, "Ks")) {
        good = read_color(text, "'Ks' takes three numbers from 0 to 1", ks);
    } else if (rt_token_equals(keyword, "Ns")) {
        good =
            rt_text_float(text, rt_text_token(text), "'Ns' takes a number from 0 up", &shininess);
        shininess = clamp(shininess, RT_SHININESS_MAX);
    }
    if (good)
        *m = rt_material_make(ka, kd, ks, shininess);
    return good;
}

/* `map_Kd`: a file name, which may have blanks in it, or options and then a name that has none. */
static bool read_texture(rt_text *text, const char *path, rt_mesh_material *material)
{
    rt_token name = rt_text_rest(text);
    if (name.length == 0)
        return rt_text_fail_found(text, name, "'map_Kd' takes a file name");
    for (size_t i = name.length; name.text[0] == '-' && i > 0; --i)
        if (rt_text_is_blank(name.text[i - 1])) {
            name = (rt_token){name.text + i, name.length - i};
            break;
        }
    free(material->texture);
    material->texture = rt_file_beside(path, name.text, name.length);
    return material->texture || rt_status_no_memory(text->status, "a path");
}

bool rt_mesh_read_mtl(rt_mesh *mesh, const char *path, const rt_file_text *bytes, rt_status *status)
{
    const rt_mesh_source source = {path, bytes->bytes, bytes->length};
    rt_text text = rt_mesh_text(&source, status);
    const char *nul = memchr(source.bytes, '\0', source.length);
    if (nul)
        return rt_text_fail(&text, nul, "found a NUL byte; a material library is text");
    const size_t first = mesh->material_count;
    for (; text.cursor < text.end; rt_text_next_line(&text)) {
        const rt_token keyword = rt_text_token(&text);
        if (rt_token_equals(keyword, "newmtl")) {
            const rt_token name = rt_text_rest(&text);
            if (name.length == 0)
                return rt_text_fail_found(&text, name, "'newmtl' takes a name");
            if (!rt_mesh_add_material(mesh, name.text, name.length, status))
                return false;
        } else if (mesh->material_count > first) {
            rt_mesh_material *material = &mesh->material_list[mesh->material_count - 1];
            if (!(rt_token_equals(keyword, "map_Kd")
                      ? read_texture(&text, path, material)
                      : read_statement(&text, keyword, &material->material)))
                return false;
        }
    }
    return true;
}
