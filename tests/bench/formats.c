#include "bench/formats.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/accuracy.h"

/* Nine digits tell every float from its neighbours. */
#define XYZ "%.9g %.9g %.9g"
#define VECTOR "<%.9g,%.9g,%.9g>"
#define THREE(x, y, z) (double)(x), (double)(y), (double)(z)

typedef void write_body(const rt_scene *scene, FILE *out);

static bool write_file(const rt_scene *scene, const char *path, write_body *body, rt_status *status)
{
    FILE *out = fopen(path, "w");
    if (!out)
        return rt_status_fail(status, RT_ERROR_OUTPUT, "bench: cannot write '%s': %s", path,
                              strerror(errno));
    body(scene, out);
    const bool is_whole = !ferror(out);
    return (fclose(out) == 0 && is_whole) ||
           rt_status_fail(status, RT_ERROR_OUTPUT, "bench: cannot write '%s'", path);
}

static void rt_body(const rt_scene *s, FILE *out)
{
    const rt_camera *c = &s->camera;
    const rt_material *m = &s->materials[0];
    fprintf(out,
            "rt 1\naccuracy %s\nimage width %d height %d\ncamera from " XYZ " at " XYZ " up " XYZ
            " vfov %.9g\nambient " XYZ "\n",
            rt_accuracy_name(s->accuracy), s->width, s->height,
            THREE(c->from.x, c->from.y, c->from.z), THREE(c->at.x, c->at.y, c->at.z),
            THREE(c->up.x, c->up.y, c->up.z), (double)c->vfov,
            THREE(s->ambient.x, s->ambient.y, s->ambient.z));
    for (size_t i = 0; i < s->light_count; ++i) {
        const rt_light *l = &s->lights[i];
        fprintf(out, "light point at " XYZ " color " XYZ "\n", THREE(l->x, l->y, l->z),
                THREE(l->r, l->g, l->b));
    }
    fprintf(out, "material m ka " XYZ " kd " XYZ " ks " XYZ " shininess %.9g\n",
            THREE(m->ka_r, m->ka_g, m->ka_b), THREE(m->kd_r, m->kd_g, m->kd_b),
            THREE(m->ks_r, m->ks_g, m->ks_b), (double)m->shininess);
    for (size_t i = 0; i < s->sphere_count; ++i) {
        const rt_sphere *p = &s->spheres[i];
        fprintf(out, "sphere center " XYZ " radius %.9g material m\n", THREE(p->cx, p->cy, p->cz),
                (double)p->radius);
    }
    for (size_t i = 0; i < s->triangle_count; ++i) {
        const rt_triangle *t = &s->triangles[i];
        fprintf(out, "triangle a " XYZ " b " XYZ " c " XYZ " material m\n",
                THREE(t->ax, t->ay, t->az), THREE(t->bx, t->by, t->bz), THREE(t->cx, t->cy, t->cz));
    }
}

bool bench_write_rt(const rt_scene *scene, const char *path, rt_status *status)
{
    return write_file(scene, path, rt_body, status);
}

/* Half the picture's height at distance 1. */
static double half_height(const rt_scene *s)
{
    return tan((double)s->camera.vfov * 3.14159265358979323846 / 360.0);
}

/* Tachyon 0.99's own language. Its picture is one unit divided by the zoom high at distance 1, it
 * has a coefficient where rt has a colour, and it looks from the left-handed side, so z turns
 * round. Shadows are left out by the option -mediumshade. */
static void tachyon_body(const rt_scene *s, FILE *out)
{
    const rt_camera *c = &s->camera;
    const rt_material *m = &s->materials[0];
    fprintf(out,
            "Begin_Scene\nResolution %d %d\nCamera\n  Zoom %.9g\n  Aspectratio 1.0\n"
            "  Antialiasing 0\n  Raydepth 1\n  Center " XYZ "\n  Viewdir 0 0 1\n  Updir 0 1 0\n"
            "End_Camera\nBackground 0 0 0\n",
            s->width, s->height, 0.5 / half_height(s), THREE(c->from.x, c->from.y, -c->from.z));
    for (size_t i = 0; i < s->light_count; ++i) {
        const rt_light *l = &s->lights[i];
        fprintf(out, "Light Center " XYZ " Rad 0.01 Color " XYZ "\n", THREE(l->x, l->y, -l->z),
                THREE(l->r, l->g, l->b));
    }
    fprintf(out,
            "TexDef m Ambient %.9g Diffuse 1 Specular 0 Opacity 1 Phong Plastic %.9g Phong_size "
            "%.9g Color " XYZ " TexFunc 0\n",
            (double)s->ambient.x, (double)m->ks_r, (double)m->shininess,
            THREE(m->kd_r, m->kd_g, m->kd_b));
    for (size_t i = 0; i < s->sphere_count; ++i) {
        const rt_sphere *p = &s->spheres[i];
        fprintf(out, "Sphere Center " XYZ " Rad %.9g m\n", THREE(p->cx, p->cy, -p->cz),
                (double)p->radius);
    }
    for (size_t i = 0; i < s->triangle_count; ++i) {
        const rt_triangle *t = &s->triangles[i];
        fprintf(out, "Tri V0 " XYZ " V1 " XYZ " V2 " XYZ " m\n", THREE(t->ax, t->ay, -t->az),
                THREE(t->bx, t->by, -t->bz), THREE(t->cx, t->cy, -t->cz));
    }
    fputs("End_Scene\n", out);
}

bool bench_write_tachyon(const rt_scene *scene, const char *path, rt_status *status)
{
    return write_file(scene, path, tachyon_body, status);
}

/* POV-Ray is left-handed too, but its camera takes a `right` that points the other way. */
static void povray_body(const rt_scene *s, FILE *out)
{
    const rt_camera *c = &s->camera;
    const rt_material *m = &s->materials[0];
    fprintf(
        out,
        "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 1 }\n"
        "camera { location " VECTOR " right <-1,0,0> up <0,1,0> angle %.9g look_at " VECTOR " }\n",
        THREE(c->from.x, c->from.y, c->from.z), (double)c->vfov, THREE(c->at.x, c->at.y, c->at.z));
    for (size_t i = 0; i < s->light_count; ++i) {
        const rt_light *l = &s->lights[i];
        fprintf(out, "light_source { " VECTOR " color rgb " VECTOR " shadowless }\n",
                THREE(l->x, l->y, l->z), THREE(l->r, l->g, l->b));
    }
    fprintf(out,
            "#declare m = texture { pigment { color rgb " VECTOR
            " } finish { ambient %.9g diffuse 1 phong %.9g phong_size %.9g } };\n",
            THREE(m->kd_r, m->kd_g, m->kd_b), (double)s->ambient.x, (double)m->ks_r,
            (double)m->shininess);
    for (size_t i = 0; i < s->sphere_count; ++i) {
        const rt_sphere *p = &s->spheres[i];
        fprintf(out, "sphere { " VECTOR ", %.9g texture { m } }\n", THREE(p->cx, p->cy, p->cz),
                (double)p->radius);
    }
    if (s->triangle_count == 0)
        return;
    fputs("mesh {\n", out);
    for (size_t i = 0; i < s->triangle_count; ++i) {
        const rt_triangle *t = &s->triangles[i];
        fprintf(out, "triangle { " VECTOR ", " VECTOR ", " VECTOR " }\n",
                THREE(t->ax, t->ay, t->az), THREE(t->bx, t->by, t->bz), THREE(t->cx, t->cy, t->cz));
    }
    fputs("texture { m } }\n", out);
}

bool bench_write_povray(const rt_scene *scene, const char *path, rt_status *status)
{
    return write_file(scene, path, povray_body, status);
}
