#include "mesh/ply_data.h"

#include <math.h>

#include "common/number.h"

/* Reads the rows of one file after another element. Nothing is made room for by a declared count:
 * arrays grow with what has been read. */
typedef struct rows {
    rt_mesh *mesh;
    const rt_mesh_source *source;
    const rt_ply_header *header;
    rt_text *text; /* its cursor stands for both text and binary data */
    rt_mesh_face face;
    const rt_ply_element *element;
    bool takes_vertices, takes_faces;
} rows;

/* The open end of a strip: the last two corners, and which way around the next triangle runs. */
typedef struct strip {
    rt_mesh_corner a, b;
    int held;
    bool is_odd;
} strip;

static bool is_text(const rows *r)
{
    return r->header->format == RT_PLY_ASCII;
}

/* Fails at a place of the data, which `at` points to. */
#define FAIL_AT(r_, at_, ...)                                                                      \
    (is_text(r_) ? rt_text_fail((r_)->text, at_, __VA_ARGS__)                                      \
                 : rt_mesh_fail_byte((r_)->source, (r_)->text->status, at_, __VA_ARGS__))

/* A property and its element in a message. */
#define NAMED "'%.*s' of element '%.*s'"
#define NAMES(r_, property_)                                                                       \
    (int)(property_)->name.length, (property_)->name.text, (int)(r_)->element->name.length,        \
        (r_)->element->name.text

/* The next `size` bytes of binary data, or NULL after an error. */
static const char *take(rows *r, const rt_ply_property *property, size_t size)
{
    const char *at = r->text->cursor;
    if (size <= (size_t)(r->text->end - at)) {
        r->text->cursor = at + size;
        return at;
    }
    FAIL_AT(r, at, "the file ends in " NAMED, NAMES(r, property));
    return NULL;
}

/* Bytes of a value in a binary file. */
static size_t size_of(enum rt_ply_type type)
{
    static const size_t sizes[] = {
        [RT_PLY_INT8] = 1,  [RT_PLY_UINT8] = 1,  [RT_PLY_INT16] = 2,   [RT_PLY_UINT16] = 2,
        [RT_PLY_INT32] = 4, [RT_PLY_UINT32] = 4, [RT_PLY_FLOAT32] = 4, [RT_PLY_FLOAT64] = 8};
    return sizes[type];
}

/* Where the next value begins, for messages. */
static const char *next_value(const rows *r)
{
    const char *at = r->text->cursor;
    while (is_text(r) && (*at == '\n' || rt_text_is_blank(*at)))
        ++at;
    return at;
}

static uint64_t load(const char *bytes, size_t size, bool is_big)
{
    uint64_t value = 0;
    for (size_t i = 0; i < size; ++i)
        value = value << 8 | (unsigned char)bytes[is_big ? i : size - 1 - i];
    return value;
}

static double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The whole number in the low bytes; the sign is theirs. */
static int64_t integer_of(uint64_t bits, enum rt_ply_type type)
{
    switch (type) {
    case RT_PLY_INT8:
        return (int8_t)bits;
    case RT_PLY_INT16:
        return (int16_t)bits;
    case RT_PLY_INT32:
        return (int32_t)bits;
    default:
        return (int64_t)bits;
    }
}

static bool read_float(rows *r, const rt_ply_property *property, float *value)
{
    if (is_text(r)) {
        const rt_token token = rt_text_word(r->text);
        return rt_number_float(token.text, token.length, value) == RT_NUMBER_OK ||
               rt_text_fail_found(r->text, token, NAMED " takes a finite number",
                                  NAMES(r, property));
    }
    const size_t size = size_of(property->type);
    const char *bytes = take(r, property, size);
    if (!bytes)
        return false;
    const uint64_t bits = load(bytes, size, r->header->format == RT_PLY_BIG);
    if (property->type == RT_PLY_FLOAT32)
        *value = rt_mesh_float_of((uint32_t)bits);
    else if (property->type == RT_PLY_FLOAT64)
        *value = (float)double_of(bits);
    else
        *value = (float)integer_of(bits, property->type);
    return isfinite(*value) || FAIL_AT(r, bytes, "found %g; " NAMED " takes a finite float",
                                       (double)*value, NAMES(r, property));
}

static bool read_integer(rows *r, const rt_ply_property *property, enum rt_ply_type type,
                         int64_t *value)
{
    if (is_text(r)) {
        const rt_token token = rt_text_word(r->text);
        return rt_number_int(token.text, token.length, value) == RT_NUMBER_OK ||
               rt_text_fail_found(r->text, token, NAMED " takes a whole number",
                                  NAMES(r, property));
    }
    const size_t size = size_of(type);
    const char *bytes = take(r, property, size);
    if (!bytes)
        return false;
    *value = integer_of(load(bytes, size, r->header->format == RT_PLY_BIG), type);
    return true;
}

/* Reads a list's count, which must leave room for its values. */
static bool read_count(rows *r, const rt_ply_property *property, int64_t *count)
{
    const char *at = next_value(r);
    if (!read_integer(r, property, property->count_type, count))
        return false;
    const size_t left = (size_t)(r->text->end - r->text->cursor);
    const size_t size = is_text(r) ? 2 : size_of(property->type); /* a blank and a digit */
    if (*count >= 0 && (uint64_t)*count <= left / size)
        return true;
    return FAIL_AT(r, at,
                   "found a count of %lld in " NAMED "; the file has %zu "
                   "bytes left",
                   (long long)*count, NAMES(r, property), left);
}

/* Passes over `count` values of one property. */
static bool skip_values(rows *r, const rt_ply_property *property, int64_t count)
{
    if (!is_text(r))
        return take(r, property, (size_t)count * size_of(property->type)) != NULL;
    for (int64_t i = 0; i < count; ++i) {
        const rt_token token = rt_text_word(r->text);
        if (token.length == 0)
            return rt_text_fail_found(r->text, token, NAMED " takes a value", NAMES(r, property));
    }
    return true;
}

static bool skip_property(rows *r, const rt_ply_property *property)
{
    int64_t count = 1;
    if (property->is_list && !read_count(r, property, &count))
        return false;
    return skip_values(r, property, count);
}

static bool read_corner(rows *r, const rt_ply_property *property, bool takes_end,
                        rt_mesh_corner *corner)
{
    const char *at = next_value(r);
    int64_t index;
    if (!read_integer(r, property, property->type, &index))
        return false;
    if ((index < 0 || index >= r->header->vertex_count) && !(takes_end && index == -1))
        return FAIL_AT(r, at, "found the vertex %lld; this file has vertices from 0 to %lld",
                       (long long)index, (long long)r->header->vertex_count - 1);
    *corner = (rt_mesh_corner){(int32_t)index, r->header->has_normals ? (int32_t)index : -1, -1};
    return true;
}

static bool read_face(rows *r, const rt_ply_property *property)
{
    const char *at = next_value(r);
    int64_t count;
    if (!read_count(r, property, &count))
        return false;
    if (count < 3 || count > RT_POLYGON_CORNERS_MAX)
        return FAIL_AT(r, at, "found a face of %lld corners; a face takes 3 to %d",
                       (long long)count, RT_POLYGON_CORNERS_MAX);
    r->face.count = 0;
    for (int64_t i = 0; i < count; ++i) {
        rt_mesh_corner corner;
        if (!read_corner(r, property, false, &corner) ||
            !rt_mesh_face_add(&r->face, corner, r->text->status))
            return false;
    }
    return rt_mesh_add_face(r->mesh, &r->face, -1, r->text->status);
}

/* Adds the triangle that `c` makes with the two corners before it. A corner that comes twice joins
 * two strips and makes no triangle. */
static bool add_to_strip(rows *r, strip *s, rt_mesh_corner c)
{
    bool good = true;
    const bool is_joint =
        s->a.vertex == s->b.vertex || s->b.vertex == c.vertex || c.vertex == s->a.vertex;
    if (s->held < 2) {
        s->held++;
    } else {
        if (!is_joint)
            good = rt_mesh_add_triangle(r->mesh, s->is_odd ? s->b : s->a, s->is_odd ? s->a : s->b,
                                        c, -1, r->text->status);
        s->is_odd = !s->is_odd;
    }
    s->a = s->b;
    s->b = c;
    return good;
}

/* A list of strips, each ended by -1. */
static bool read_strips(rows *r, const rt_ply_property *property)
{
    int64_t count;
    if (!read_count(r, property, &count))
        return false;
    strip s = {.held = 0};
    for (int64_t i = 0; i < count; ++i) {
        rt_mesh_corner corner = {0, -1, -1};
        if (!read_corner(r, property, true, &corner))
            return false;
        if (corner.vertex < 0)
            s = (strip){.held = 0};
        else if (!add_to_strip(r, &s, corner))
            return false;
    }
    return true;
}

static bool read_row(rows *r)
{
    const rt_ply_element *element = r->element;
    const bool is_vertex = element->kind == RT_PLY_VERTEX;
    const bool is_taken = is_vertex ? r->takes_vertices : r->takes_faces;
    float values[RT_PLY_NZ + 1] = {0.0f};
    for (size_t i = 0; i < element->property_count; ++i) {
        const rt_ply_property *property = &r->header->properties[element->first + i];
        bool good;
        if (property->role == RT_PLY_UNUSED || !is_taken)
            good = skip_property(r, property);
        else if (is_vertex)
            good = read_float(r, property, &values[property->role]);
        else if (element->kind == RT_PLY_FACE)
            good = read_face(r, property);
        else
            good = read_strips(r, property);
        if (!good)
            return false;
    }
    if (!is_vertex || !is_taken)
        return true;
    return rt_mesh_add_vertex(r->mesh, values, r->text->status) &&
           (!r->header->has_normals ||
            rt_mesh_add_normal(r->mesh, values + RT_PLY_NX, r->text->status));
}

/* Refuses at once a count of rows that the rest of the file has no room for. */
static bool check_room(rows *r)
{
    const rt_ply_element *element = r->element;
    size_t size = 0;
    for (size_t i = 0; i < element->property_count; ++i) {
        const rt_ply_property *property = &r->header->properties[element->first + i];
        size += is_text(r) ? 2 : size_of(property->is_list ? property->count_type : property->type);
    }
    /* The last value of a text needs nothing behind it. */
    const size_t left = (size_t)(r->text->end - r->text->cursor) + (is_text(r) ? 1 : 0);
    if (size == 0 || (uint64_t)element->count <= left / size)
        return true;
    return rt_text_fail_found(r->text, element->name,
                              "%lld rows of %zu bytes or more are declared; the file has %zu bytes "
                              "left",
                              (long long)element->count, size, left);
}

static bool read_elements(rows *r)
{
    for (size_t i = 0; i < r->header->element_count; ++i) {
        r->element = &r->header->elements[i];
        if (!check_room(r))
            return false;
        for (int64_t row = 0; r->element->property_count > 0 && row < r->element->count; ++row)
            if (!read_row(r))
                return false;
    }
    return true;
}

bool rt_ply_read_data(rt_mesh *mesh, const rt_mesh_source *source, const rt_ply_header *header,
                      rt_text *text)
{
    rows r = {.mesh = mesh,
              .source = source,
              .header = header,
              .text = text,
              .takes_vertices = true,
              .takes_faces = !header->needs_rounds};
    const char *start = text->cursor;
    bool good = read_elements(&r);
    if (good && header->needs_rounds) {
        text->cursor = start;
        r.takes_vertices = false;
        r.takes_faces = true;
        good = read_elements(&r);
    }
    rt_mesh_face_clear(&r.face);
    if (good && is_text(&r)) {
        const rt_token rest = rt_text_word(text);
        if (rest.length > 0)
            rt_text_warn_found(text, rest, "the header declares no more data");
    }
    return good;
}
