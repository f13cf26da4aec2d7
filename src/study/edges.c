/* Rays that start inside of a closed mesh and are aimed at its edges: each must cross the mesh an
 * odd number of times. An even number is a leak where nothing is hit near the edge, else a double
 * hit.
 *
 * The trace kernel tells the nearest hit only. So each ray is traced again and again from behind
 * what it hit, and that through four scenes that share the mesh between them: triangles with a
 * common edge are in different ones, so the hits of both are seen, however near they are. */
#include <math.h>
#include <stdlib.h>

#include "common/parallel.h"
#include "reference/scalar.h"
#include "scene/places.h"
#include "study/closed_mesh.h"
#include "study/parts.h"

#define EDGE_RAYS 200000
#define STARTS_TRIED 512
/* Where a start is tried, in sizes of its triangle away from it. */
#define START_DEPTH 0.01
/* Crossings of one ray that are followed. */
#define CROSSINGS_MOST 64
/* A hit whose t is that near to the edge's belongs to the edge. */
#define NEAR 1e-3f

/* Rays that are followed through their crossings. */
typedef struct walk {
    size_t count;
    const rt_ray *rays;
    rt_ray *active;
    rt_hit *hits;
    size_t *source;     /* of each active ray */
    uint8_t *crossings; /* of each ray */
    uint8_t
        *near_crossings; /* of those, the ones at the edge: rays are so long that it is at t = 1 */
} walk;

static void free_walk(walk *w)
{
    free(w->active);
    free(w->hits);
    free(w->source);
    free(w->crossings);
    free(w->near_crossings);
}

static bool make_walk(walk *w, const rt_ray *rays, size_t count, rt_status *status)
{
    *w = (walk){count,
                rays,
                calloc(count, sizeof *w->active),
                calloc(count, sizeof *w->hits),
                calloc(count, sizeof *w->source),
                calloc(count, 1),
                calloc(count, 1)};
    return (w->active && w->hits && w->source && w->crossings && w->near_crossings) ||
           rt_status_no_memory(status, "rays");
}

/* Counts the hits of the active rays; those that hit go on from behind. Returns how many do. */
static size_t take_hits(walk *w, size_t active)
{
    size_t left = 0;
    for (size_t i = 0; i < active; ++i) {
        if (w->hits[i].primitive == RT_MISS)
            continue;
        const size_t source = w->source[i];
        ++w->crossings[source];
        w->near_crossings[source] =
            (uint8_t)(w->near_crossings[source] + (fabsf(w->hits[i].t - 1.0f) < NEAR));
        w->active[left] = w->active[i];
        /* A level may know t better than a float does: one step further is behind in any case. */
        w->active[left].tmin = nextafterf(w->hits[i].t, INFINITY);
        w->source[left++] = source;
    }
    return left;
}

/* Follows all rays through one scene: by the renderer, or where that is NULL by the scalar path and
 * its tree. */
static bool follow(study_state *s, walk *w, const rt_scene *scene, rt_renderer *renderer,
                   const rt_scalar_tree *tree)
{
    size_t active = w->count;
    for (size_t i = 0; i < active; ++i) {
        w->active[i] = w->rays[i];
        w->source[i] = i;
    }
    for (int round = 0; active > 0 && round < CROSSINGS_MOST; ++round) {
        if (!renderer)
            rt_scalar_double_trace_by(tree, scene, w->active, active, w->hits);
        else if (!rt_renderer_trace(renderer, w->active, active, w->hits, s->status))
            return false;
        active = take_hits(w, active);
    }
    return true;
}

/* The mesh, or the triangles of one colour, as a scene that has nothing else. */
static bool make_scene(rt_scene *scene, const rt_study_mesh *mesh, int color, rt_status *status)
{
    const rt_material dull = {.exponent = 1};
    rt_scene_init(scene);
    scene->accuracy = RT_ACCURACY_DOUBLE;
    bool good = rt_scene_add_material(scene, &dull, status);
    for (size_t i = 0; good && i < mesh->count; ++i)
        if (color == RT_MESH_COLORS || mesh->colors[i] == color)
            good = rt_scene_add_triangle(scene, &mesh->triangles[i], NULL, 0, status);
    return good;
}

/* The triangles of one colour, and their tree where the study goes by trees. */
typedef struct colored {
    rt_scene scene;
    rt_bvh bvh;
} colored;

static bool make_colored(study_state *s, colored *c, const rt_study_mesh *mesh, int color)
{
    c->bvh = (rt_bvh){0};
    return make_scene(&c->scene, mesh, color, s->status) &&
           (!s->how->bvh || rt_bvh_build(&c->bvh, &c->scene, rt_parallel_processors(), s->status));
}

/* What a walk needs at most is compiled in: with the same for all, all have the same program. */
static void share_programs(colored parts[RT_MESH_COLORS])
{
    size_t most = 0;
    for (int color = 0; color < RT_MESH_COLORS; ++color)
        most = parts[color].bvh.stack_size > most ? parts[color].bvh.stack_size : most;
    for (int color = 0; color < RT_MESH_COLORS; ++color)
        parts[color].bvh.stack_size = most;
}

static void clear_colored(colored *c)
{
    rt_bvh_clear(&c->bvh);
    rt_scene_clear(&c->scene);
}

static size_t pick(uint32_t index, uint32_t stream, size_t count)
{
    return (size_t)(rt_study_random(index, stream) * (double)count);
}

/* A ray from a little above or below the middle of some triangle into any direction. */
static rt_ray trial_ray(const rt_study_mesh *mesh, uint32_t index)
{
    vec3 c[3];
    rt_triangle_corners(&mesh->triangles[pick(index / 2, 0, mesh->count)], c);
    const vec3 normal = vec3_cross(vec3_plus(c[1], -1.0, c[0]), vec3_plus(c[2], -1.0, c[0]));
    const double size = sqrt(sqrt(vec3_dot(normal, normal)));
    const double depth = (index % 2 ? 1.0 : -1.0) * START_DEPTH * size;
    const vec3 sum = vec3_plus(vec3_plus(c[0], 1.0, c[1]), 1.0, c[2]);
    const vec3 middle = {sum.x / 3.0, sum.y / 3.0, sum.z / 3.0};
    rt_ray ray = {.tmin = 0.0f, .tmax = INFINITY};
    vec3_store(vec3_plus(middle, depth, vec3_unit(normal)), ray.origin);
    for (uint32_t axis = 0; axis < 3; ++axis)
        ray.direction[axis] = (float)(rt_study_random(index, 1 + axis) - 0.5);
    return ray;
}

/* Leaves in starts[0..*count) the rays that begin inside, which is where one that goes anywhere
 * crosses the mesh an odd number of times. */
static bool find_starts(study_state *s, const rt_study_mesh *mesh, rt_ray *starts, size_t *count)
{
    rt_scene scene;
    walk w;
    for (uint32_t i = 0; i < STARTS_TRIED; ++i)
        starts[i] = trial_ray(mesh, i);
    bool good = make_walk(&w, starts, STARTS_TRIED, s->status);
    good = make_scene(&scene, mesh, RT_MESH_COLORS, s->status) && good;
    rt_scalar_tree *tree = good ? rt_scalar_double_tree(&scene) : NULL;
    good = good && follow(s, &w, &scene, NULL, tree);
    *count = 0;
    for (size_t i = 0; good && i < STARTS_TRIED; ++i)
        if (w.crossings[i] % 2 == 1)
            starts[(*count)++] = starts[i];
    rt_scalar_double_tree_free(tree);
    free_walk(&w);
    rt_scene_clear(&scene);
    return good;
}

/* From a start to a point of an edge, not too near to its ends. */
static rt_ray edge_ray(const rt_study_mesh *mesh, const rt_ray *starts, size_t start_count,
                       uint32_t index)
{
    vec3 c[3];
    rt_triangle_corners(&mesh->triangles[pick(index, 5, mesh->count)], c);
    const size_t a = pick(index, 6, 3), b = (a + 1) % 3;
    const double f = 0.05 + 0.9 * rt_study_random(index, 7);
    float target[3];
    vec3_store(vec3_plus(c[a], f, vec3_plus(c[b], -1.0, c[a])), target);
    rt_ray ray = starts[pick(index, 4, start_count)];
    for (int axis = 0; axis < 3; ++axis)
        ray.direction[axis] = target[axis] - ray.origin[axis];
    return ray;
}

static void judge(const walk *w, rt_study_entry *entry)
{
    entry->edge_rays = w->count;
    for (size_t i = 0; i < w->count; ++i)
        if (w->crossings[i] % 2 == 0)
            ++*(w->near_crossings[i] < 2 ? &entry->leaks : &entry->double_hits);
}

static bool trace_entry(study_state *s, const colored parts[RT_MESH_COLORS], const rt_ray *rays,
                        rt_study_entry *entry)
{
    walk w;
    bool good = make_walk(&w, rays, EDGE_RAYS, s->status);
    for (int color = 0; good && color < RT_MESH_COLORS; ++color) {
        const rt_scene *scene = &parts[color].scene;
        const rt_bvh *bvh = s->how->bvh ? &parts[color].bvh : NULL;
        if (scene->triangle_count == 0)
            continue;
        rt_renderer *renderer = rt_study_renderer(s, scene, bvh, entry->device, entry->level, 1);
        good = renderer && follow(s, &w, scene, renderer, NULL);
        rt_renderer_free(renderer);
    }
    if (good)
        judge(&w, entry);
    free_walk(&w);
    return good;
}

static bool trace_mesh(study_state *s, const rt_study_mesh *mesh, const rt_ray *starts,
                       size_t start_count)
{
    rt_study *study = s->study;
    colored parts[RT_MESH_COLORS];
    rt_ray *rays = calloc(EDGE_RAYS, sizeof *rays);
    bool good = rays || rt_status_no_memory(s->status, "rays");
    for (int color = 0; color < RT_MESH_COLORS; ++color)
        good = make_colored(s, &parts[color], mesh, color) && good;
    share_programs(parts);
    for (uint32_t i = 0; good && i < EDGE_RAYS; ++i)
        rays[i] = edge_ray(mesh, starts, start_count, i);
    for (size_t i = 0; good && i < study->entry_count; ++i) {
        rt_study_begin_part(s, RT_WORK_EDGES, 1.0);
        good = rt_study_tick(s, 0.0) && trace_entry(s, parts, rays, &study->entries[i]);
    }
    for (int color = 0; color < RT_MESH_COLORS; ++color)
        clear_colored(&parts[color]);
    free(rays);
    return good;
}

bool rt_study_trace_edges(study_state *s)
{
    rt_study *study = s->study;
    rt_study_mesh mesh;
    rt_ray starts[STARTS_TRIED];
    size_t start_count = 0;
    if (!rt_study_mesh_find(&mesh, s->scene, s->status))
        return false;
    study->edge_triangles = mesh.count;
    bool good = mesh.count == 0 || find_starts(s, &mesh, starts, &start_count);
    if (good && start_count > 0) {
        good = trace_mesh(s, &mesh, starts, start_count);
    } else if (good) {
        rt_forecast_drop(&s->forecast, RT_WORK_EDGES, (double)study->entry_count);
        study->edges = s->scene->triangle_count == 0 ? RT_EDGES_NO_TRIANGLES
                       : mesh.count == 0             ? RT_EDGES_NOT_CLOSED
                                                     : RT_EDGES_NO_WAY_IN;
    }
    rt_study_mesh_clear(&mesh);
    return good;
}
