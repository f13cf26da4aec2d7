#include "study/closed_mesh.h"

#include <stdlib.h>
#include <string.h>

typedef struct corner {
    float x, y, z;
} corner;

/* A side of a triangle, its ends in order, so that both triangles at an edge name it alike. */
typedef struct side {
    corner ends[2];
    int32_t triangle;
} side;

typedef struct finder {
    size_t count;       /* triangles of the scene */
    side *sides;        /* 3 * count, later sorted */
    int32_t *parents;   /* of the forest of triangles that hang together */
    int32_t *neighbors; /* 3 * count: across the sides in the order in which they were met; -1 */
    int32_t *sizes;     /* of each tree, at its root */
    uint8_t *is_open;   /* at the root: some edge has not exactly two triangles */
} finder;

/* +0 and -0 are one coordinate. */
static corner corner_of(float x, float y, float z)
{
    return (corner){x + 0.0f, y + 0.0f, z + 0.0f};
}

static int compare_sides(const void *a, const void *b)
{
    const side *p = a, *q = b;
    const int ends = memcmp(p->ends, q->ends, sizeof p->ends);
    return ends ? ends : (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

static side side_of(corner a, corner b, size_t triangle)
{
    side s = {{a, b}, (int32_t)triangle};
    if (memcmp(&a, &b, sizeof a) > 0) {
        s.ends[0] = b;
        s.ends[1] = a;
    }
    return s;
}

static void list_sides(finder *f, const rt_scene *scene)
{
    for (size_t i = 0; i < f->count; ++i) {
        const rt_triangle *t = &scene->triangles[i];
        const corner a = corner_of(t->ax, t->ay, t->az), b = corner_of(t->bx, t->by, t->bz),
                     c = corner_of(t->cx, t->cy, t->cz);
        f->sides[3 * i] = side_of(a, b, i);
        f->sides[3 * i + 1] = side_of(b, c, i);
        f->sides[3 * i + 2] = side_of(c, a, i);
        f->parents[i] = (int32_t)i;
        f->sizes[i] = 1;
        for (size_t k = 0; k < 3; ++k)
            f->neighbors[3 * i + k] = -1;
    }
    qsort(f->sides, 3 * f->count, sizeof *f->sides, compare_sides);
}

static int32_t root_of(finder *f, int32_t i)
{
    while (f->parents[i] != i) {
        f->parents[i] = f->parents[f->parents[i]];
        i = f->parents[i];
    }
    return i;
}

static void unite(finder *f, int32_t a, int32_t b)
{
    a = root_of(f, a);
    b = root_of(f, b);
    if (a == b)
        return;
    const int32_t big = f->sizes[a] < f->sizes[b] ? b : a, small = big == a ? b : a;
    f->parents[small] = big;
    f->sizes[big] += f->sizes[small];
    f->is_open[big] = f->is_open[big] || f->is_open[small];
}

static void add_neighbor(finder *f, int32_t triangle, int32_t neighbor)
{
    int32_t *n = f->neighbors + 3 * (size_t)triangle;
    while (*n >= 0)
        ++n;
    *n = neighbor;
}

/* The triangles along one edge, which is sides[first] up to sides[end]. */
static void join(finder *f, size_t first, size_t end)
{
    for (size_t i = first + 1; i < end; ++i)
        unite(f, f->sides[first].triangle, f->sides[i].triangle);
    if (end - first != 2) {
        f->is_open[root_of(f, f->sides[first].triangle)] = 1;
        return;
    }
    add_neighbor(f, f->sides[first].triangle, f->sides[first + 1].triangle);
    add_neighbor(f, f->sides[first + 1].triangle, f->sides[first].triangle);
}

/* The root of the largest closed mesh; -1 for none. */
static int32_t largest(finder *f)
{
    int32_t best = -1;
    const size_t sides = 3 * f->count;
    for (size_t i = 0; i < sides;) {
        size_t end = i + 1;
        while (end < sides &&
               memcmp(f->sides[i].ends, f->sides[end].ends, sizeof f->sides[i].ends) == 0)
            ++end;
        join(f, i, end);
        i = end;
    }
    for (size_t i = 0; i < f->count; ++i)
        if (f->parents[i] == (int32_t)i && !f->is_open[i] &&
            (best < 0 || f->sizes[i] > f->sizes[best]))
            best = (int32_t)i;
    return best;
}

/* The first colour that no neighbour has. Those that come later count as without one. */
static uint8_t color_of(const finder *f, const uint8_t *colors, size_t i)
{
    bool taken[RT_MESH_COLORS + 1] = {false};
    for (size_t k = 0; k < 3; ++k)
        taken[colors[f->neighbors[3 * i + k]]] = true;
    uint8_t color = 0;
    while (taken[color])
        ++color;
    return color;
}

static bool collect(finder *f, const rt_scene *scene, int32_t root, rt_study_mesh *mesh,
                    rt_status *status)
{
    const size_t count = (size_t)f->sizes[root];
    uint8_t *colors = malloc(f->count);
    mesh->triangles = calloc(count, sizeof *mesh->triangles);
    mesh->colors = calloc(count, sizeof *mesh->colors);
    if (!colors || !mesh->triangles || !mesh->colors) {
        free(colors);
        rt_study_mesh_clear(mesh);
        return rt_status_no_memory(status, "a mesh");
    }
    memset(colors, RT_MESH_COLORS, f->count);
    for (size_t i = 0; i < f->count; ++i)
        if (root_of(f, (int32_t)i) == root) {
            colors[i] = color_of(f, colors, i);
            mesh->colors[mesh->count] = colors[i];
            mesh->triangles[mesh->count++] = scene->triangles[i];
        }
    free(colors);
    return true;
}

bool rt_study_mesh_find(rt_study_mesh *mesh, const rt_scene *scene, rt_status *status)
{
    *mesh = (rt_study_mesh){0};
    const size_t count = scene->triangle_count;
    if (count == 0)
        return true;
    finder f = {.count = count,
                .sides = calloc(3 * count, sizeof *f.sides),
                .parents = calloc(count, sizeof *f.parents),
                .neighbors = calloc(3 * count, sizeof *f.neighbors),
                .sizes = calloc(count, sizeof *f.sizes),
                .is_open = calloc(count, sizeof *f.is_open)};
    bool good = false;
    if (!f.sides || !f.parents || !f.neighbors || !f.sizes || !f.is_open) {
        rt_status_no_memory(status, "a mesh");
    } else {
        list_sides(&f, scene);
        const int32_t root = largest(&f);
        good = root < 0 || collect(&f, scene, root, mesh, status);
    }
    free(f.sides);
    free(f.parents);
    free(f.neighbors);
    free(f.sizes);
    free(f.is_open);
    return good;
}

void rt_study_mesh_clear(rt_study_mesh *mesh)
{
    free(mesh->triangles);
    free(mesh->colors);
    *mesh = (rt_study_mesh){0};
}
