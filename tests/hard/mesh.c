#include "hard/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ORIGINS 0.1 /* of the size: how far from the centre rays start */

static void allocate(hard_mesh *mesh, int vertices, int triangles)
{
    mesh->vertices = calloc((size_t)vertices, sizeof *mesh->vertices);
    mesh->triangles = calloc((size_t)triangles, sizeof *mesh->triangles);
    mesh->colors = calloc((size_t)triangles, sizeof *mesh->colors);
    assert_true(mesh->vertices && mesh->triangles && mesh->colors);
}

void hard_mesh_clear(hard_mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->triangles);
    free(mesh->colors);
    *mesh = (hard_mesh){0};
}

static bool share_a_vertex(const int a[3], const int b[3])
{
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (a[i] == b[k])
                return true;
    return false;
}

/* Gives each triangle a colour that no triangle at its vertices has, of as few as come easily. */
static void color(hard_mesh *mesh)
{
    int most = 0;
    for (int i = 0; i < mesh->triangle_count; ++i) {
        uint64_t taken = 0;
        for (int k = 0; k < i; ++k)
            if (share_a_vertex(mesh->triangles[i], mesh->triangles[k]))
                taken |= UINT64_C(1) << mesh->colors[k];
        int c = 0;
        while (taken >> c & 1)
            ++c;
        assert_true(c < 63);
        mesh->colors[i] = c;
        most = c > most ? c : most;
    }
    for (mesh->color_bits = 1; most >> mesh->color_bits; ++mesh->color_bits)
        ;
}

/* ---- Meshes ---- */

/* The vertex at whole-number coordinates of |x| + |y| + |z| = n, which is made where there is none
 * yet; a table by coordinates tells. */
static int lattice_vertex(hard_mesh *mesh, int *table, int n, const int at[3])
{
    const int side = 2 * n + 1;
    int *entry = &table[((at[0] + n) * side + at[1] + n) * side + at[2] + n];
    if (*entry >= 0)
        return *entry;
    test_random random = {(uint64_t)(entry - table)};
    double p[3], length = 0.0;
    for (int k = 0; k < 3; ++k) {
        p[k] = at[k] + (double)test_random_float(&random, -0.2f, 0.2f);
        length += p[k] * p[k];
    }
    const double radius = 1.0 + (double)test_random_float(&random, -0.02f, 0.02f);
    for (int k = 0; k < 3; ++k)
        mesh->vertices[mesh->vertex_count][k] =
            (float)(mesh->center[k] + mesh->size * radius * p[k] / sqrt(length));
    return *entry = mesh->vertex_count++;
}

static void add_lattice_triangle(hard_mesh *mesh, int *table, int n, const int sign[3],
                                 const int uv[3][2])
{
    int *t = mesh->triangles[mesh->triangle_count++];
    const bool turn = sign[0] * sign[1] * sign[2] < 0;
    for (int k = 0; k < 3; ++k) {
        const int *c = uv[turn ? 2 - k : k];
        const int at[3] = {sign[0] * c[0], sign[1] * c[1], sign[2] * (n - c[0] - c[1])};
        t[k] = lattice_vertex(mesh, table, n, at);
    }
}

/* Six times the volume of the tetrahedron from p to a triangle: positive where p sees its inside.
 */
static double volume(const hard_mesh *mesh, const int t[3], const double p[3])
{
    double e[3][3];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            e[i][k] = (double)mesh->vertices[t[i]][k] - p[k];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/* That every corner of the box that rays start in sees the inside of every triangle: then each ray
 * from the box crosses the mesh exactly once, whatever its direction. */
static void check_inside(const hard_mesh *mesh)
{
    const double size = mesh->size;
    for (int i = 0; i < mesh->triangle_count; ++i)
        for (int corner = 0; corner < 8; ++corner) {
            double p[3];
            for (int k = 0; k < 3; ++k)
                p[k] = mesh->center[k] + (corner >> k & 1 ? ORIGINS : -ORIGINS) * 1.01 * size;
            assert_true(volume(mesh, mesh->triangles[i], p) > 1e-9 * size * size * size);
        }
}

void hard_mesh_ball(hard_mesh *mesh, int n, const double center[3], double size)
{
    static const int up[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    static const int down[3][2] = {{1, 0}, {1, 1}, {0, 1}};
    *mesh = (hard_mesh){.size = size};
    memcpy(mesh->center, center, sizeof mesh->center);
    allocate(mesh, 4 * n * n + 2, 8 * n * n);
    const size_t side = 2 * (size_t)n + 1;
    int *table = malloc(side * side * side * sizeof *table);
    assert_non_null(table);
    memset(table, 0xff, side * side * side * sizeof *table);
    for (int octant = 0; octant < 8; ++octant) {
        const int sign[3] = {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j)
                for (int is_down = 0; is_down < (i + j + 1 < n ? 2 : 1); ++is_down) {
                    int uv[3][2];
                    for (int k = 0; k < 3; ++k) {
                        uv[k][0] = i + (is_down ? down : up)[k][0];
                        uv[k][1] = j + (is_down ? down : up)[k][1];
                    }
                    add_lattice_triangle(mesh, table, n, sign, (const int(*)[2])uv);
                }
    }
    free(table);
    assert_int_equal(mesh->vertex_count, 4 * n * n + 2);
    assert_int_equal(mesh->triangle_count, 8 * n * n);
    color(mesh);
    check_inside(mesh);
}

void hard_mesh_fan(hard_mesh *mesh, int n)
{
    *mesh = (hard_mesh){.center = {0.0, 0.0, 0.0}, .size = 1.0};
    allocate(mesh, n + 1, n);
    mesh->vertex_count = n + 1;
    mesh->triangle_count = n;
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * 3.14159265358979323846 * i / n;
        mesh->vertices[i + 1][0] = (float)cos(angle);
        mesh->vertices[i + 1][1] = (float)sin(angle);
        const int t[3] = {0, i + 1, (i + 1) % n + 1};
        memcpy(mesh->triangles[i], t, sizeof t);
        mesh->colors[i] = i; /* all meet at the hub */
    }
    for (mesh->color_bits = 1; (n - 1) >> mesh->color_bits; ++mesh->color_bits)
        ;
}

void hard_mesh_quad(hard_mesh *mesh, bool across)
{
    static const float corners[4][3] = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
    static const int seams[2][2][3] = {{{0, 1, 2}, {0, 2, 3}}, {{0, 1, 3}, {1, 2, 3}}};
    *mesh = (hard_mesh){.size = 5.0, .vertex_count = 4, .triangle_count = 2, .color_bits = 1};
    allocate(mesh, 4, 2);
    memcpy(mesh->vertices, corners, sizeof corners);
    memcpy(mesh->triangles, seams[across], sizeof seams[0]);
    mesh->colors[1] = 1;
}

/* ---- Rays ---- */

/* A point that rays start from: every second one where differences to vertices are exact. */
static void start(const hard_mesh *mesh, test_random *random, float out[3])
{
    const bool exact = test_random_bits(random) & 1;
    for (int k = 0; k < 3; ++k) {
        const float spread = exact ? 0.0f : test_random_float(random, -1.0f, 1.0f);
        out[k] = (float)(mesh->center[k] + ORIGINS * (double)spread * mesh->size);
    }
    if (mesh->color_bits > 8) /* the fan: from above its plane */
        out[2] = 1.0f + out[2];
}

/* The direction from an origin to a point, brought to moderate length by a power of two. */
static void set_direction(const hard_mesh *mesh, const double target[3], rt_ray *ray)
{
    const int k = -ilogb(mesh->size);
    for (int i = 0; i < 3; ++i)
        ray->direction[i] = (float)ldexp(target[i] - (double)ray->origin[i], k);
}

static void aim_at_triangle(const hard_mesh *mesh, const int t[3], enum hard_aim aim,
                            test_random *random, rt_ray *ray)
{
    const int corner = (int)(test_random_bits(random) % 3);
    const float *a = mesh->vertices[t[corner]], *b = mesh->vertices[t[(corner + 1) % 3]];
    const double f = aim == HARD_AIM_VERTICES ? 0.0 : (double)test_random_float(random, 0.0f, 1.0f);
    double target[3];
    for (int k = 0; k < 3; ++k)
        target[k] = (double)a[k] + f * ((double)b[k] - (double)a[k]);
    set_direction(mesh, target, ray);
}

/* Rays from `first` on. In every second block of 64 all start at one point and are aimed at one
 * triangle. */
void hard_mesh_aim(const hard_mesh *mesh, enum hard_aim aim, size_t first, size_t count,
                   rt_ray *rays)
{
    const bool fan = mesh->color_bits > 8;
    for (size_t i = 0; i < count; ++i) {
        const size_t number = first + i, block = number / RT_BLOCK_RAYS;
        const bool together = block % 2 == 0;
        test_random shared = {block * UINT64_C(0x100000001)}, own = {~number};
        test_random *random = together ? &shared : &own;
        const uint64_t choice = test_random_bits(random);
        const int triangle = (int)(choice % (uint64_t)mesh->triangle_count);
        rt_ray *ray = &rays[i];
        *ray = (rt_ray){.tmin = 0.0f, .tmax = INFINITY};
        start(mesh, random, ray->origin);
        if (fan)
            set_direction(mesh, (const double[3]){0.0, 0.0, 0.0}, ray);
        else if (aim == HARD_AIM_ANYWHERE)
            for (int k = 0; k < 3; ++k)
                ray->direction[k] = test_random_float(&own, -1.0f, 1.0f);
        else
            aim_at_triangle(mesh, mesh->triangles[triangle], aim, &own, ray);
    }
}

/* Rays from one point above the quad at places of its seam that are on a grid of floats about the
 * one that is known to be hard. */
static void aim_at_seam(const hard_mesh *mesh, size_t first, size_t count, rt_ray *rays)
{
    const float side = mesh->triangles[0][2] == 2 ? 1.0f : -1.0f;
    for (size_t i = 0; i < count; ++i) {
        const float d = 0.30458447f + (float)(first + i) * 0x1p-25f;
        rays[i] = (rt_ray){{0.0f, 0.0f, 10.0f}, {d, side * d, -0.9024725f}, 0.0f, INFINITY};
    }
}

/* ---- Counting ---- */

#define SCENES_MAX (1 + 2 * 16)

typedef struct counter {
    rt_scene scenes[SCENES_MAX]; /* the whole, then for each bit those without and with it */
    hard_tracer tracers[SCENES_MAX];
    int count;
} counter;

void hard_mesh_fill(rt_scene *scene, const hard_mesh *mesh, int bit, int value)
{
    for (int i = 0; i < mesh->triangle_count; ++i) {
        float corners[9];
        if (bit >= 0 && (mesh->colors[i] >> bit & 1) != value)
            continue;
        for (int k = 0; k < 3; ++k)
            memcpy(corners + 3 * k, mesh->vertices[mesh->triangles[i][k]], 3 * sizeof(float));
        hard_add_triangle(scene, corners);
    }
}

static void open_all(counter *c, const hard_way *way, const hard_mesh *mesh)
{
    c->count = 1 + 2 * mesh->color_bits;
    assert_true(c->count <= SCENES_MAX);
    for (int i = 0; i < c->count; ++i) {
        hard_scene(&c->scenes[i]);
        hard_mesh_fill(&c->scenes[i], mesh, i ? (i - 1) / 2 : -1, (i - 1) % 2);
        hard_open(&c->tracers[i], way, &c->scenes[i]);
    }
}

static void close_all(counter *c)
{
    for (int i = 0; i < c->count; ++i) {
        hard_close(&c->tracers[i]);
        rt_scene_clear(&c->scenes[i]);
    }
}

#define IS_HIT 1
#define IS_TWICE 2

/* Adds a chunk of rays to the counts: none where the whole mesh, or both of its parts, are not hit;
 * several where both parts are. */
static void count_chunk(counter *c, const rt_ray *rays, size_t count, hard_crossings *sum)
{
    static rt_hit hits[HARD_CHUNK];
    static uint8_t first[HARD_CHUNK], state[HARD_CHUNK];
    for (int scene = 0; scene < c->count; ++scene) {
        hard_trace(&c->tracers[scene], rays, count, hits);
        for (size_t i = 0; i < count; ++i) {
            const bool is_hit = hits[i].primitive != RT_MISS;
            if (scene == 0)
                state[i] = is_hit ? IS_HIT : 0;
            else if (scene % 2 == 1)
                first[i] = is_hit;
            else if (first[i] && is_hit)
                state[i] |= IS_TWICE;
            else if (!first[i] && !is_hit)
                state[i] &= (uint8_t)~IS_HIT;
        }
    }
    for (size_t i = 0; i < count; ++i) {
        sum->none += !(state[i] & IS_HIT);
        sum->several += (state[i] & IS_TWICE) != 0;
    }
    sum->rays += count;
}

hard_crossings hard_count(const hard_way *way, const hard_mesh *mesh, enum hard_aim aim,
                          size_t count)
{
    static rt_ray rays[HARD_CHUNK];
    static counter c;
    hard_crossings sum = {0, 0, 0};
    open_all(&c, way, mesh);
    while (sum.rays < count) {
        const size_t left = count - sum.rays, part = left < HARD_CHUNK ? left : HARD_CHUNK;
        if (aim == HARD_AIM_SEAM)
            aim_at_seam(mesh, sum.rays, part, rays);
        else
            hard_mesh_aim(mesh, aim, sum.rays, part, rays);
        count_chunk(&c, rays, part, &sum);
    }
    close_all(&c);
    return sum;
}
