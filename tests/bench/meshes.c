#include "bench/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CORNERS 12
#define FACES 20
#define EDGES 30

/* Corners of the icosahedron in units of 1 and the golden ratio; each face runs counter-clockwise
 * as seen from outside. */
static const int corner_signs[CORNERS][3] = {{-1, 2, 0}, {1, 2, 0}, {-1, -2, 0}, {1, -2, 0},
                                             {0, -1, 2}, {0, 1, 2}, {0, -1, -2}, {0, 1, -2},
                                             {2, 0, -1}, {2, 0, 1}, {-2, 0, -1}, {-2, 0, 1}};
static const int faces[FACES][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};

/* Finds a vertex by its place on a face, so that neighbouring faces share theirs. */
typedef struct grid {
    size_t n;                   /* parts of an edge */
    int edge[CORNERS][CORNERS]; /* number of the edge between two corners */
} grid;

double bench_random(uint64_t index, uint64_t stream)
{
    /* splitmix64 (Steele, Lea, Flood 2014) as a hash of its counter. */
    uint64_t z = (index + 1) * UINT64_C(0x9e3779b97f4a7c15) + stream * UINT64_C(0xd1342543de82ef95);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    z ^= z >> 31;
    return (double)(z >> 11) * 0x1p-53;
}

unsigned bench_frequency(size_t triangles)
{
    const double n = floor(sqrt((double)triangles / FACES) + 0.5);
    return n < 1.0 ? 1 : (unsigned)n;
}

static void number_edges(grid *g)
{
    int next = 0;
    memset(g->edge, -1, sizeof g->edge);
    for (int f = 0; f < FACES; ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = faces[f][k], b = faces[f][(k + 1) % 3];
            if (g->edge[a][b] < 0)
                g->edge[a][b] = g->edge[b][a] = next++;
        }
}

/* The vertex `k` parts of the way from corner a to corner b, 0 < k < n. */
static size_t edge_vertex(const grid *g, int a, int b, size_t k)
{
    const size_t from_lower = a < b ? k : g->n - k;
    return CORNERS + (size_t)g->edge[a][b] * (g->n - 1) + from_lower - 1;
}

/* The vertex i parts toward the face's second corner and j toward its third. */
static size_t face_vertex(const grid *g, int face, size_t i, size_t j)
{
    const int *c = faces[face];
    const size_t n = g->n, k = n - i - j;
    if (k == n || i == n || j == n)
        return (size_t)c[k == n ? 0 : i == n ? 1 : 2];
    if (j == 0)
        return edge_vertex(g, c[0], c[1], i);
    if (i == 0)
        return edge_vertex(g, c[0], c[2], j);
    if (k == 0)
        return edge_vertex(g, c[1], c[2], j);
    const size_t inside = (n - 1) * (n - 2) / 2;
    return CORNERS + EDGES * (n - 1) + (size_t)face * inside + (j - 1) * (n - 1) - (j - 1) * j / 2 +
           i - 1;
}

/* Waves of about 0.8 to 0.2 units, each about as steep: smooth at 82k triangles and more, with
 * parts that shade one another and catch one another's bounce rays. */
static double radius_at(const double p[3])
{
    return 1.0 + 0.08 * sin(6.1 * p[0] + 4.7 * p[1] + 0.3) +
           0.06 * sin(9.3 * p[1] - 7.9 * p[2] + 1.1) + 0.04 * sin(15.7 * p[2] + 11.1 * p[0] + 2.3) +
           0.02 * sin(25.3 * p[0] - 21.1 * p[1] + 0.7);
}

static void place_vertex(float out[3], const grid *g, int face, size_t i, size_t j)
{
    const double golden = 0.5 * (1.0 + sqrt(5.0));
    const double weights[3] = {(double)(g->n - i - j), (double)i, (double)j};
    double p[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis) {
            const int s = corner_signs[faces[face][k]][axis];
            p[axis] += weights[k] * (s == 2 || s == -2 ? 0.5 * s * golden : (double)s);
        }
    const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (int axis = 0; axis < 3; ++axis)
        p[axis] /= length;
    const double radius = radius_at(p);
    for (int axis = 0; axis < 3; ++axis)
        out[axis] = (float)(radius * p[axis]);
}

static void fill_face(bench_input *input, const grid *g, int face)
{
    const size_t n = g->n;
    uint32_t *index = input->indices + (size_t)face * n * n * 3;
    for (size_t j = 0; j <= n; ++j)
        for (size_t i = 0; i + j <= n; ++i) {
            const size_t vertex = face_vertex(g, face, i, j);
            place_vertex(input->vertices + 3 * vertex, g, face, i, j);
            if (i + j == n)
                continue;
            const uint32_t right = (uint32_t)face_vertex(g, face, i + 1, j);
            const uint32_t above = (uint32_t)face_vertex(g, face, i, j + 1);
            *index++ = (uint32_t)vertex;
            *index++ = right;
            *index++ = above;
            if (i + j + 2 > n)
                continue;
            *index++ = right;
            *index++ = (uint32_t)face_vertex(g, face, i + 1, j + 1);
            *index++ = above;
        }
}

/* Everything but the primitives. */
static bool set_up_scene(rt_scene *scene, int size, rt_status *status)
{
    const float ka[3] = {0.4f, 0.3f, 0.2f}, kd[3] = {0.8f, 0.6f, 0.4f}, ks[3] = {0.5f, 0.5f, 0.5f};
    const rt_material material = rt_material_make(ka, kd, ks, 32.0f);
    const rt_light light = {.x = BENCH_LIGHT_X,
                            .y = BENCH_LIGHT_Y,
                            .z = BENCH_LIGHT_Z,
                            .w = 1.0f,
                            .r = 0.9f,
                            .g = 0.9f,
                            .b = 0.9f};
    rt_scene_init(scene);
    scene->accuracy = RT_ACCURACY_STANDARD; /* as what it is held against computes */
    scene->width = scene->height = size;
    scene->camera.from = (rt_vec3){0.0f, 0.0f, 3.0f};
    scene->camera.at = (rt_vec3){0.0f, 0.0f, 0.0f};
    scene->camera.vfov = 45.0f;
    scene->ambient = (rt_vec3){0.2f, 0.2f, 0.2f};
    return rt_scene_add_light(scene, &light, status) &&
           rt_scene_add_material(scene, &material, status);
}

static bool add_triangles(bench_input *input, size_t count, rt_status *status)
{
    for (size_t i = 0; i < count; ++i) {
        const float *a = input->vertices + 3 * (size_t)input->indices[3 * i];
        const float *b = input->vertices + 3 * (size_t)input->indices[3 * i + 1];
        const float *c = input->vertices + 3 * (size_t)input->indices[3 * i + 2];
        const rt_triangle t = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
        if (!rt_scene_add_triangle(&input->scene, &t, NULL, 0, status))
            return false;
    }
    return true;
}

bool bench_input_icosphere(bench_input *input, unsigned frequency, int size, rt_status *status)
{
    grid g = {.n = frequency};
    const size_t triangles = FACES * g.n * g.n;
    *input = (bench_input){.vertex_count = triangles / 2 + 2};
    snprintf(input->label, sizeof input->label, "%zu triangles", triangles);
    input->vertices = malloc(3 * input->vertex_count * sizeof *input->vertices);
    input->indices = malloc(3 * triangles * sizeof *input->indices);
    if (!input->vertices || !input->indices)
        return rt_status_no_memory(status, "a mesh");
    number_edges(&g);
    for (int face = 0; face < FACES; ++face)
        fill_face(input, &g, face);
    return set_up_scene(&input->scene, size, status) && add_triangles(input, triangles, status);
}

bool bench_input_spheres(bench_input *input, size_t count, int size, rt_status *status)
{
    *input = (bench_input){.label = ""};
    snprintf(input->label, sizeof input->label, "%zu spheres", count);
    if (!set_up_scene(&input->scene, size, status))
        return false;
    if (count == 1)
        return rt_scene_add_sphere(&input->scene, &(rt_sphere){0.0f, 0.0f, 0.0f, 1.0f}, 0, status);
    /* The side of the cube that each would have to itself in a ball of radius 1.1. */
    const double spacing = 1.1 * cbrt(4.18879 / (double)count);
    for (size_t made = 0, i = 0; made < count; ++i) {
        const double x = 2.0 * bench_random(i, 0) - 1.0, y = 2.0 * bench_random(i, 1) - 1.0,
                     z = 2.0 * bench_random(i, 2) - 1.0;
        if (x * x + y * y + z * z > 1.0)
            continue;
        const rt_sphere sphere = {(float)(1.1 * x), (float)(1.1 * y), (float)(1.1 * z),
                                  (float)(spacing * (0.2 + 0.3 * bench_random(i, 3)))};
        if (!rt_scene_add_sphere(&input->scene, &sphere, 0, status))
            return false;
        ++made;
    }
    return true;
}

void bench_input_clear(bench_input *input)
{
    rt_scene_clear(&input->scene);
    free(input->vertices);
    free(input->indices);
    *input = (bench_input){.vertices = NULL};
}
