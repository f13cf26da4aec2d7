#include "mesh/ply_header.h"

#include <stdlib.h>

#include "common/array.h"
#include "common/number.h"

#define TYPES "char, uchar, short, ushort, int, uint, float, double, or int8 to float64"

static const char *const type_names[][2] = {
    [RT_PLY_INT8] = {"char", "int8"},        [RT_PLY_UINT8] = {"uchar", "uint8"},
    [RT_PLY_INT16] = {"short", "int16"},     [RT_PLY_UINT16] = {"ushort", "uint16"},
    [RT_PLY_INT32] = {"int", "int32"},       [RT_PLY_UINT32] = {"uint", "uint32"},
    [RT_PLY_FLOAT32] = {"float", "float32"}, [RT_PLY_FLOAT64] = {"double", "float64"}};

static bool read_type(rt_text *text, enum rt_ply_type *type)
{
    const rt_token token = rt_text_token(text);
    for (int i = 0; i <= RT_PLY_FLOAT64; ++i)
        if (rt_token_equals(token, type_names[i][0]) || rt_token_equals(token, type_names[i][1])) {
            *type = (enum rt_ply_type)i;
            return true;
        }
    return rt_text_fail_found(text, token, "'property' takes a type of " TYPES);
}

static bool read_name(rt_text *text, const char *keyword, rt_token *name)
{
    *name = rt_text_token(text);
    return name->length > 0 || rt_text_fail_found(text, *name, "'%s' takes a name", keyword);
}

static bool read_format(rt_ply_header *header, rt_text *text)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const rt_token name = rt_text_token(text);
    int format = RT_PLY_ASCII;
    while (format <= RT_PLY_BIG && !rt_token_equals(name, names[format]))
        ++format;
    if (format > RT_PLY_BIG)
        return rt_text_fail_found(
            text, name, "'format' takes ascii, binary_little_endian or binary_big_endian");
    header->format = (enum rt_ply_format)format;
    const rt_token version = rt_text_token(text);
    return rt_token_equals(version, "1.0") ||
           rt_text_fail_found(text, version, "'format' takes the version 1.0 after its name");
}

static bool read_element(rt_ply_header *header, rt_text *text)
{
    rt_ply_element element = {.kind = RT_PLY_OTHER, .first = header->property_count};
    if (!read_name(text, "element", &element.name))
        return false;
    const rt_token count = rt_text_token(text);
    if (rt_number_int(count.text, count.length, &element.count) != RT_NUMBER_OK ||
        element.count < 0)
        return rt_text_fail_found(text, count, "'element' takes a whole number of rows");
    if (rt_token_equals(element.name, "vertex"))
        element.kind = RT_PLY_VERTEX;
    else if (rt_token_equals(element.name, "face"))
        element.kind = RT_PLY_FACE;
    else if (rt_token_equals(element.name, "tristrips"))
        element.kind = RT_PLY_STRIPS;
    for (size_t i = 0; i < header->element_count; ++i)
        if (element.kind == RT_PLY_VERTEX && header->elements[i].kind == RT_PLY_VERTEX)
            return rt_text_fail_found(text, element.name, "this element is declared above already");
    if (element.kind == RT_PLY_VERTEX && element.count > INT32_MAX)
        return rt_text_fail_found(text, count, "a mesh has up to %d vertices", INT32_MAX);
    if (element.kind == RT_PLY_VERTEX)
        header->vertex_count = element.count;
    if (!RT_ARRAY_GROW(header->elements, header->element_count, &header->element_capacity))
        return rt_status_no_memory(text->status, "a header");
    header->elements[header->element_count++] = element;
    return true;
}

static enum rt_ply_role find_role(const rt_ply_element *element, const rt_ply_property *property)
{
    static const char *const names[] = {"x", "y", "z", "nx", "ny", "nz"};
    if (element->kind == RT_PLY_VERTEX && !property->is_list)
        for (int i = RT_PLY_X; i <= RT_PLY_NZ; ++i)
            if (rt_token_equals(property->name, names[i]))
                return (enum rt_ply_role)i;
    const bool has_faces = element->kind == RT_PLY_FACE || element->kind == RT_PLY_STRIPS;
    if (has_faces && property->is_list &&
        (rt_token_equals(property->name, "vertex_indices") ||
         rt_token_equals(property->name, "vertex_index")))
        return RT_PLY_INDICES;
    return RT_PLY_UNUSED;
}

static bool read_property(rt_ply_header *header, rt_text *text)
{
    rt_ply_property property = {.is_list = false};
    const char *start = text->cursor;
    const rt_token first = rt_text_token(text);
    if (header->element_count == 0)
        return rt_text_fail_found(text, first, "'property' comes after an 'element'");
    property.is_list = rt_token_equals(first, "list");
    if (!property.is_list)
        text->cursor = start;
    else if (!read_type(text, &property.count_type))
        return false;
    else if (property.count_type >= RT_PLY_FLOAT32)
        return rt_text_fail_found(text, first, "a list takes a whole type for its count");
    if (!read_type(text, &property.type) || !read_name(text, "property", &property.name))
        return false;
    rt_ply_element *element = &header->elements[header->element_count - 1];
    property.role = find_role(element, &property);
    if (property.role == RT_PLY_INDICES && property.type >= RT_PLY_FLOAT32)
        return rt_text_fail_found(text, property.name, "this list takes a whole type");
    for (size_t i = 0; i < element->property_count; ++i)
        if (property.role != RT_PLY_UNUSED &&
            header->properties[element->first + i].role == property.role)
            return rt_text_fail_found(text, property.name, "this property is declared already");
    if (!RT_ARRAY_GROW(header->properties, header->property_count, &header->property_capacity))
        return rt_status_no_memory(text->status, "a header");
    header->properties[header->property_count++] = property;
    element->property_count++;
    return true;
}

static bool has_role(const rt_ply_header *header, const rt_ply_element *element,
                     enum rt_ply_role role)
{
    for (size_t i = 0; i < element->property_count; ++i)
        if (header->properties[element->first + i].role == role)
            return true;
    return false;
}

/* Checks that vertices have places and faces have vertices. */
static bool check_header(rt_ply_header *header, const rt_text *text, rt_token end)
{
    bool has_vertices = false;
    for (size_t i = 0; i < header->element_count; ++i) {
        const rt_ply_element *e = &header->elements[i];
        if (e->kind == RT_PLY_VERTEX) {
            has_vertices = true;
            if (!has_role(header, e, RT_PLY_X) || !has_role(header, e, RT_PLY_Y) ||
                !has_role(header, e, RT_PLY_Z))
                return rt_text_fail_found(text, e->name, "this element lacks x, y or z");
            header->has_normals = has_role(header, e, RT_PLY_NX) &&
                                  has_role(header, e, RT_PLY_NY) && has_role(header, e, RT_PLY_NZ);
        } else if (e->kind != RT_PLY_OTHER && e->count > 0) {
            header->needs_rounds = header->needs_rounds || !has_vertices;
            if (!has_role(header, e, RT_PLY_INDICES))
                return rt_text_fail_found(text, e->name,
                                          "this element lacks the list 'vertex_indices'");
        }
    }
    return has_vertices || rt_text_fail_found(text, end, "the header lacks the element 'vertex'");
}

bool rt_ply_read_header(rt_ply_header *header, rt_text *text)
{
    bool has_format = false;
    for (;;) {
        rt_text_next_line(text); /* the first one is "ply" */
        const rt_token keyword = rt_text_token(text);
        const bool is_format = rt_token_equals(keyword, "format");
        const bool is_end = rt_token_equals(keyword, "end_header");
        if (rt_token_equals(keyword, "comment") || rt_token_equals(keyword, "obj_info"))
            continue;
        if (!is_format && !has_format)
            return rt_text_fail_found(text, keyword, "'format' is the first statement of PLY");
        has_format = true;
        bool good = true;
        if (is_format)
            good = read_format(header, text);
        else if (rt_token_equals(keyword, "element"))
            good = read_element(header, text);
        else if (rt_token_equals(keyword, "property"))
            good = read_property(header, text);
        else if (!is_end)
            return rt_text_fail_found(text, keyword,
                                      "a header has format, comment, obj_info, element, property "
                                      "and end_header");
        const rt_token rest = good ? rt_text_token(text) : keyword;
        if (good && rest.length > 0)
            return rt_text_fail_found(text, rest, "the statement is complete");
        if (!good)
            return false;
        if (is_end) {
            rt_text_next_line(text);
            return check_header(header, text, keyword);
        }
    }
}

void rt_ply_clear_header(rt_ply_header *header)
{
    free(header->elements);
    free(header->properties);
    *header = (rt_ply_header){0};
}
