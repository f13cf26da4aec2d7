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

const rt_statement rt_statements[] = {
    {"rt",
     NULL,
     0,
     "the first statement: the version of the format",
     NULL,
     {COUNT(NULL, 1, 1, NULL, "version")}},
    {"include",
     NULL,
     0,
     "reads another file's statements here",
     rt_scene_apply_include,
     {PLAIN(NULL, RT_VALUE_PATH, "path, relative to the including file")}},
    {"image",
     NULL,
     1,
     "the size of the picture",
     rt_scene_apply_image,
     {COUNT("width", 1, RT_IMAGE_SIDE_MAX, "512", "pixels"),
      COUNT("height", 1, RT_IMAGE_SIDE_MAX, "512", "pixels"),
      COUNT("samples", 1, RT_SAMPLES_MAX, "1", "rays a pixel"),
      CHOICE("filter", "box|tent", "box", "how samples make a pixel")}},
    {"camera",
     NULL,
     1,
     "where the picture is taken from",
     rt_scene_apply_camera,
     {POINT("from", "0 0 0", "the eye"), POINT("at", "0 0 -1", "a point on the view's axis"),
      DIRECTION("up", "0 1 0", "the direction that is up in the picture"),
      NUMBER("vfov", 0.0, 180.0, 1, "90", "degrees from bottom to top"),
      NUMBER("aperture", 0.0, FLT_MAX, 0, "0", "diameter of the lens"),
      NUMBER("focus", 0.0, FLT_MAX, 1, "that of `at`",
             "distance, along the view, of what is sharp")}},
    {"background",
     NULL,
     1,
     "the light where no primitive is hit",
     rt_scene_apply_background,
     {LIGHT_COLOR(NULL, NULL, "colour; black if not given"),
      LIGHT_COLOR("top", "the same", "colour along the camera's `up`; the first is opposite")}},
    {"ambient",
     NULL,
     1,
     "the ambient light",
     rt_scene_apply_ambient,
     {LIGHT_COLOR(NULL, NULL, "colour; black if not given")}},
    {"fog",
     NULL,
     1,
     "fills all space outside of what transmits",
     rt_scene_apply_fog,
     {LIGHT_COLOR(NULL, NULL, "colour"),
      NUMBER("density", 0.0, FLT_MAX, 1, NULL, "per unit of length")}},
    {"occlusion",
     NULL,
     1,
     "lets primitives near a point keep ambient light from it",
     rt_scene_apply_occlusion,
     {COUNT("samples", 1, RT_SAMPLES_MAX, "16", "rays a point"),
      NUMBER("distance", 0.0, FLT_MAX, 1, NULL, "how far they go")}},
    {"shadows",
     NULL,
     1,
     "for all lights that do not say otherwise, wherever it stands",
     rt_scene_apply_shadows,
     {CHOICE(NULL, "on|off", NULL, "off if not given")}},
    {"depth",
     NULL,
     1,
     "mirror and refracted rays in a row, at most",
     rt_scene_apply_depth,
     {COUNT(NULL, 0, RT_DEPTH_MAX, NULL, "5 if not given")}},
    {"light",
     "point",
     0,
     "a light at a point, not weakened by distance",
     rt_scene_apply_light_point,
     {POINT("at", NULL, "its place"), LIGHT_COLOR("color", "1 1 1", "its colour"), SHADOW,
      NUMBER("radius", 0.0, FLT_MAX, 0, "0", "its size; above 0, shadows are soft"),
      COUNT("samples", 1, RT_SAMPLES_MAX, "16", "shadow rays a point where they are soft")}},
    {"light",
     "directional",
     0,
     "a light from infinitely far away",
     rt_scene_apply_light_directional,
     {DIRECTION("direction", NULL, "the way the light travels"),
      LIGHT_COLOR("color", "1 1 1", "its colour"), SHADOW}},
    {"material",
     NULL,
     0,
     "a surface for the primitives below it",
     rt_scene_apply_material,
     {PLAIN(NULL, RT_VALUE_NAME, "its name"), REFLECTANCE("ka", "0 0 0", "ambient reflectance"),
      REFLECTANCE("kd", "0 0 0", "diffuse reflectance"),
      REFLECTANCE("ks", "0 0 0", "specular reflectance"),
      NUMBER("shininess", 0.0, RT_SHININESS_MAX, 0, "1", "Phong's exponent n"),
      NUMBER("reflect", 0.0, 1.0, 0, "0", "weight of the mirror ray"),
      NUMBER("transmit", 0.0, 1.0, 0, "0",
             "weight of the refracted ray and its reflection; 1 with `reflect` at most"),
      NUMBER("ior", 0.0, FLT_MAX, 1, "1.5", "index of refraction against the outside"),
      LIGHT_COLOR("absorb", "0 0 0",
                  "light that goes a length t inside is multiplied by exp(-absorb t)"),
      REFLECTANCE("checker", "none", "ka and kd in every second cell are multiplied by it"),
      NUMBER("cell", 0.0, FLT_MAX, 1, "1", "side of a cell of the checker"),
      PICTURE("texture", "png, jpg or bmp that ka and kd are multiplied by"),
      CHOICE("filter", "nearest|bilinear", "bilinear", "how the texture is read")}},
    {"sphere",
     NULL,
     0,
     "a sphere",
     rt_scene_apply_sphere,
     {POINT("center", NULL, "its centre"), NUMBER("radius", 0.0, FLT_MAX, 1, NULL, "its radius"),
      MATERIAL(NULL, "its surface")}},
    {"triangle",
     NULL,
     0,
     "a triangle; smooth with `na`, `nb`, `nc`, which go together, as `ta`, `tb`, `tc` do",
     rt_scene_apply_triangle,
     {POINT("a", NULL, "first corner"), POINT("b", NULL, "second corner"),
      POINT("c", NULL, "third corner"), MATERIAL(NULL, "its surface"),
      POINT("na", "none", "normal at a, of any length"), POINT("nb", "none", "normal at b"),
      POINT("nc", "none", "normal at c"),
      PAIR("ta", "texture's u v at a; 0 0 is its lower left, 1 1 its upper right"),
      PAIR("tb", "texture's u v at b"), PAIR("tc", "texture's u v at c")}},
    {"mesh",
     NULL,
     0,
     "the triangles of an OBJ, PLY or STL file",
     rt_scene_apply_mesh,
     {PLAIN(NULL, RT_VALUE_PATH, "path, relative to the file that names it"),
      MATERIAL("the file's own", "surface of all its triangles"),
      NUMBER("scale", 0.0, FLT_MAX, 1, "1", "its size; comes first"),
      POINT("rotate", "0 0 0", "degrees about x, then y, then z"),
      POINT("translate", "0 0 0", "the way it is moved; comes last")}},
    {"cull",
     NULL,
     1,
     "drops one side of every triangle; spheres stay whole",
     rt_scene_apply_cull,
     {CHOICE(NULL, "back|front", NULL, "the side that is not seen"),
      CHOICE("winding", "ccw|cw", "ccw", "how a front's corners run as seen from the eye")}},
    {"accuracy",
     NULL,
     1,
     "the level of accuracy; --accuracy wins",
     rt_scene_apply_accuracy,
     {CHOICE(NULL, "fast|standard|robust|double", NULL, "standard if not given")}},
    {0},
};
_Static_assert(sizeof rt_statements / sizeof *rt_statements <= RT_STATEMENTS_MAX + 1,
               "RT_STATEMENTS_MAX is less than there are");

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
