/* Spheres, triangles and meshes. */
#include "scene_text/mesh_statement.h"
#include "scene_text/parser.h"

bool rt_scene_apply_sphere(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { CENTER, RADIUS, SURFACE };
    const float *center = l->values[CENTER].number;
    const int32_t material = rt_scene_find_material(p, src, &l->values[SURFACE].word);
    const rt_sphere sphere = {center[0], center[1], center[2], l->values[RADIUS].number[0]};
    return material >= 0 && rt_scene_add_sphere(p->scene, &sphere, material, p->status);
}

/* Counts triangles without area; the warning names the first statement that has one. */
static void note_degenerate(rt_parser *p, const rt_source *src, size_t count)
{
    if (count > 0 && p->degenerate_count == 0)
        p->degenerate_place = rt_source_place(src);
    p->degenerate_count += count;
}

/* Fields of `triangle` in the grammar's order. */
enum field { A, B, C, MATERIAL, NA, NB, NC, TA, TB, TC };

/* Copies three values of so many numbers each to a record. *given tells whether they are there;
 * false where some are and some are not. */
static bool read_record(const rt_value *values, int numbers, float *record, bool *given)
{
    *given = values[0].given && values[1].given && values[2].given;
    for (int i = 0; *given && i < 3 * numbers; ++i)
        record[i] = values[i / numbers].number[i % numbers];
    return *given || !(values[0].given || values[1].given || values[2].given);
}

bool rt_scene_apply_triangle(rt_parser *p, rt_source *src, const rt_line *l)
{
    const float *a = l->values[A].number, *b = l->values[B].number, *c = l->values[C].number;
    float normals[RT_NORMAL_COMPONENTS], uvs[RT_UV_COMPONENTS];
    bool has_normals, has_uvs;
    if (!read_record(&l->values[NA], 3, normals, &has_normals))
        return RT_FAIL_AT(src, l->start, "%s",
                          "'na', 'nb' and 'nc' of 'triangle' go together; give all or none");
    if (!read_record(&l->values[TA], 2, uvs, &has_uvs))
        return RT_FAIL_AT(src, l->start, "%s",
                          "'ta', 'tb' and 'tc' of 'triangle' go together; give all or none");
    const int32_t material = rt_scene_find_material(p, src, &l->values[MATERIAL].word);
    if (material < 0)
        return false;
    rt_triangle t = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
    const bool has_area = rt_triangle_settle(&t, has_normals ? normals : NULL);
    note_degenerate(p, src, has_area ? 0 : 1);
    if (has_normals && !p->scene->smooth_place.line)
        p->scene->smooth_place = rt_source_place(src);
    return rt_scene_add_triangle(p->scene, &t, has_normals ? normals : NULL, material, p->status) &&
           (!has_uvs || rt_scene_set_uvs(p->scene, uvs, p->status));
}

bool rt_scene_apply_mesh(rt_parser *p, rt_source *src, const rt_line *l)
{
    enum { PATH, SURFACE };
    const rt_value *material = &l->values[SURFACE];
    const int32_t index = material->given ? rt_scene_find_material(p, src, &material->word) : -1;
    size_t degenerate_count = 0;
    if ((material->given && index < 0) ||
        !rt_scene_mesh_add(p->scene, src, l, index, &degenerate_count))
        return false;
    note_degenerate(p, src, degenerate_count);
    return true;
}
