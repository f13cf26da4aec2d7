/* STL, text and binary (3D Systems, "StereoLithography Interface Specification", 1989). A facet's
 * normal is left alone: the corners' order says the same, and files disagree with themselves. */
#include <inttypes.h>
#include <math.h>

#include "mesh/build.h"

/* A normal and three corners of three floats, and a number of two bytes that means nothing. */
#define FACET_SIZE ((size_t)50)
#define FACET_CORNERS ((size_t)12)

uint64_t rt_mesh_stl_size(uint64_t triangles)
{
    return RT_MESH_STL_HEADER + FACET_SIZE * triangles;
}

/* Adds the triangle of the three vertices added last. */
static bool add_facet(rt_mesh *mesh, rt_status *status)
{
    const int32_t last = (int32_t)mesh->vertex_count - 1;
    return rt_mesh_add_triangle(mesh, (rt_mesh_corner){last - 2, -1, -1},
                                (rt_mesh_corner){last - 1, -1, -1}, (rt_mesh_corner){last, -1, -1},
                                -1, status);
}

static bool read_facet(rt_mesh *mesh, const rt_mesh_source *source, const char *at,
                       rt_status *status)
{
    for (int i = 0; i < 3; ++i) {
        float position[3];
        for (int k = 0; k < 3; ++k, at += 4) {
            position[k] = rt_mesh_float_of(rt_mesh_little32(at));
            if (!isfinite(position[k]))
                return rt_mesh_fail_byte(source, status, at,
                                         "found %g; a vertex takes three finite floats",
                                         (double)position[k]);
        }
        if (!rt_mesh_add_vertex(mesh, position, status))
            return false;
    }
    return add_facet(mesh, status);
}

bool rt_mesh_read_stl_binary(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status)
{
    const char *at = source->bytes + RT_MESH_STL_HEADER - 4;
    const uint64_t count = rt_mesh_little32(at), size = rt_mesh_stl_size(count);
    /* Some programs add data of their own behind the last facet; a count of 0 was never filled. */
    if (size > source->length || (count == 0 && size != source->length))
        return rt_mesh_fail_byte(source, status, at,
                                 "found a count of %" PRIu64 " facets, which take %" PRIu64
                                 " bytes of binary STL; the file has %zu",
                                 count, size, source->length);
    if (size < source->length)
        rt_status_warn(status, "%s: warning: byte %" PRIu64 ": data behind the last facet",
                       source->name, size);
    at = source->bytes + RT_MESH_STL_HEADER + FACET_CORNERS;
    for (uint64_t i = 0; i < count; ++i, at += FACET_SIZE)
        if (!read_facet(mesh, source, at, status))
            return false;
    return true;
}

/* Programs write the keywords in either case. */
static bool expect(rt_text *text, const char *word)
{
    const rt_token token = rt_text_word(text);
    return rt_token_resembles(token, word) ||
           rt_text_fail_found(text, token, "a facet of STL has '%s' here", word);
}

/* What follows "facet". */
static bool read_facet_text(rt_mesh *mesh, rt_text *text)
{
    if (!expect(text, "normal"))
        return false;
    for (int i = 0; i < 3; ++i) /* "nan" where a program divided by the area */
        rt_text_word(text);
    if (!expect(text, "outer") || !expect(text, "loop"))
        return false;
    for (int i = 0; i < 3; ++i) {
        float position[3];
        if (!expect(text, "vertex"))
            return false;
        for (int k = 0; k < 3; ++k)
            if (!rt_text_float(text, rt_text_word(text), "'vertex' takes three numbers",
                               &position[k]))
                return false;
        if (!rt_mesh_add_vertex(mesh, position, text->status))
            return false;
    }
    return expect(text, "endloop") && expect(text, "endfacet") && add_facet(mesh, text->status);
}

/* A file may hold several solids; all are one mesh. */
bool rt_mesh_read_stl_text(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status)
{
    rt_text text = rt_mesh_text(source, status);
    bool is_open = false;
    for (;;) {
        const rt_token word = rt_text_word(&text);
        if (word.length == 0 && !is_open)
            return true;
        if (is_open && rt_token_resembles(word, "facet")) {
            if (!read_facet_text(mesh, &text))
                return false;
        } else if (rt_token_resembles(word, is_open ? "endsolid" : "solid")) {
            rt_text_next_line(&text); /* a name */
            is_open = !is_open;
        } else {
            return rt_text_fail_found(&text, word, "STL has %s here",
                                      is_open ? "'facet' or 'endsolid'" : "'solid'");
        }
    }
}
