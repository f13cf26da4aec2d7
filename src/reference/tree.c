/* The scalar reference's way through a scene: a binary tree that halves the primitives by their
 * centres, again and again. A hit's t lies within the ray's part in its primitive's box, and so in
 * that of every box around it: what the tree skips is never a hit, and brute force gives the same
 * bits. */
#include <stdlib.h>

#include "reference/real.h"
#include "reference/scalar.h"

#define LEAF_PRIMITIVES 4
/* Halving 2^31 primitives ends long before. */
#define DEPTH_MAX 64

/* The left child of a node is the one behind it; a leaf has its primitives in the order. */
typedef struct scalar_node {
    vec lo, hi;
    int right;        /* 0 for a leaf */
    int begin, count; /* of a leaf */
} scalar_node;

typedef struct builder {
    const rt_scene *scene;
    scalar_node *nodes;
    int *order;
    int used;
} builder;

static real component(vec v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* Where a primitive is along an axis: twice its centre. */
static real place(const builder *b, int primitive, int axis)
{
    vec lo, hi;
    NAME(box)(b->scene, primitive, &lo, &hi);
    return component(lo, axis) + component(hi, axis);
}

static void enclose(const builder *b, int begin, int end, scalar_node *node)
{
    NAME(box)(b->scene, b->order[begin], &node->lo, &node->hi);
    for (int i = begin + 1; i < end; ++i) {
        vec lo, hi;
        NAME(box)(b->scene, b->order[i], &lo, &hi);
        node->lo = (vec){FMIN(node->lo.x, lo.x), FMIN(node->lo.y, lo.y), FMIN(node->lo.z, lo.z)};
        node->hi = (vec){FMAX(node->hi.x, hi.x), FMAX(node->hi.y, hi.y), FMAX(node->hi.z, hi.z)};
    }
}

/* Orders [begin, end) so that what is before `middle` is not beyond what is from there on (Hoare
 * 1961). */
static void halve(const builder *b, int begin, int middle, int end, int axis)
{
    int first = begin, last = end - 1;
    while (first < last) {
        const real pivot = place(b, b->order[middle], axis);
        int i = first, k = last;
        while (i <= k) {
            while (place(b, b->order[i], axis) < pivot)
                ++i;
            while (pivot < place(b, b->order[k], axis))
                --k;
            if (i <= k) {
                const int swapped = b->order[i];
                b->order[i++] = b->order[k];
                b->order[k--] = swapped;
            }
        }
        if (k < middle)
            first = i;
        if (middle < i)
            last = k;
    }
}

static int build(builder *b, int begin, int end)
{
    const int at = b->used++;
    scalar_node node = {.begin = begin, .count = end - begin};
    enclose(b, begin, end, &node);
    if (node.count > LEAF_PRIMITIVES) {
        const vec size = minus(node.hi, node.lo);
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const int middle = begin + node.count / 2;
        halve(b, begin, middle, end, axis);
        build(b, begin, middle);
        node.right = build(b, middle, end);
    }
    b->nodes[at] = node;
    return at;
}

scalar_world NAME(world)(const rt_scene *scene)
{
    const size_t count = rt_scene_primitive_count(scene);
    scalar_world world = {.scene = scene};
    rt_status status = {0};
    (void)rt_media_find(&world.media, scene, &status);
    rt_status_clear(&status);
    if (count == 0)
        return world;
    builder b = {scene, malloc(count * sizeof *b.nodes), calloc(count, sizeof *b.order), 0};
    if (!b.nodes || !b.order) {
        free(b.nodes);
        free(b.order);
        return world;
    }
    for (size_t i = 0; i < count; ++i)
        b.order[i] = (int)i;
    build(&b, 0, (int)count);
    world.nodes = b.nodes;
    world.order = b.order;
    return world;
}

void NAME(world_clear)(scalar_world *world)
{
    rt_media_clear(&world->media);
    free(world->nodes);
    free(world->order);
    *world = (scalar_world){0};
}

struct rt_scalar_tree {
    scalar_world world;
};

rt_scalar_tree *NAME(tree)(const rt_scene *scene)
{
    rt_scalar_tree *tree = malloc(sizeof *tree);
    if (tree)
        tree->world = NAME(world)(scene);
    return tree;
}

void NAME(tree_free)(rt_scalar_tree *tree)
{
    if (tree)
        NAME(world_clear)(&tree->world);
    free(tree);
}

scalar_world NAME(world_open)(const rt_scene *scene, const rt_scalar_tree *tree)
{
    if (!tree)
        return NAME(world)(scene);
    scalar_world world = tree->world;
    world.scene = scene;
    return world;
}

void NAME(world_leave)(scalar_world *world, const rt_scalar_tree *tree)
{
    if (!tree)
        NAME(world_clear)(world);
}

static void try_every_primitive(const scalar_world *w, const ray *r, hit *best)
{
    const int count = (int)rt_scene_primitive_count(w->scene);
    for (int i = 0; i < count; ++i)
        NAME(meet)(w->scene, r, i, best);
}

/* Whether a node can hold a hit that is nearer than `best`, or as near. */
static bool is_worth(const rt_scene *scene, const ray *r, const scalar_node *node, const hit *best,
                     real *enter)
{
    real leave;
    NAME(part_in_box)(scene, r, node->lo, node->hi, enter, &leave);
    return *enter <= leave && leave >= r->tmin && *enter <= best->t;
}

static void walk(const scalar_world *w, const ray *r, bool any, hit *best)
{
    int stack[DEPTH_MAX], top = 0;
    real enter, other;
    if (is_worth(w->scene, r, w->nodes, best, &enter))
        stack[top++] = 0;
    while (top > 0) {
        const int at = stack[--top];
        const scalar_node *node = &w->nodes[at];
        if (!is_worth(w->scene, r, node, best, &enter))
            continue;
        if (!node->right) {
            for (int i = 0; i < node->count; ++i)
                NAME(meet)(w->scene, r, w->order[node->begin + i], best);
            if (any && best->primitive != RT_MISS)
                return;
            continue;
        }
        const bool left = is_worth(w->scene, r, &w->nodes[at + 1], best, &enter);
        const bool right = is_worth(w->scene, r, &w->nodes[node->right], best, &other);
        const bool left_first = enter <= other;
        if (right && left_first)
            stack[top++] = node->right;
        if (left)
            stack[top++] = at + 1;
        if (right && !left_first)
            stack[top++] = node->right;
    }
}

/* A ray with a component that is not finite, or without a direction, hits nothing. */
static bool is_lawful(const ray *r)
{
    const vec o = r->origin, d = r->direction;
    return isfinite(o.x) && isfinite(o.y) && isfinite(o.z) && isfinite(d.x) && isfinite(d.y) &&
           isfinite(d.z) && (d.x != 0 || d.y != 0 || d.z != 0) && r->tmax > r->tmin;
}

static hit find(const scalar_world *w, const ray *r, bool any)
{
    hit best = {RT_MISS, r->tmax, 0, 0};
    if (is_lawful(r) && w->nodes)
        walk(w, r, any, &best);
    else if (is_lawful(r))
        try_every_primitive(w, r, &best);
    if (best.primitive == RT_MISS)
        best.t = INFINITY;
    return best;
}

hit NAME(closest)(const scalar_world *world, const ray *r)
{
    return find(world, r, false);
}

bool NAME(occluded)(const scalar_world *world, const ray *r)
{
    return find(world, r, true).primitive != RT_MISS;
}

void NAME(trace_by)(const rt_scalar_tree *tree, const rt_scene *scene, const rt_ray *rays,
                    size_t count, rt_hit *hits)
{
    scalar_world world = NAME(world_open)(scene, tree);
    for (size_t i = 0; i < count; ++i) {
        const float *o = rays[i].origin, *d = rays[i].direction;
        const vec direction = moderate(vec_of(d[0], d[1], d[2]));
        /* t is in units of the direction, whose own are a power of two now. */
        const real most = FMAX(FABS((real)d[0]), FMAX(FABS((real)d[1]), FABS((real)d[2])));
        const int unit = scene->unit_exponent;
        const int along = most > 0 && isfinite(most) ? unit + ILOGB(most) : unit;
        const ray r = {{LDEXP((real)o[0], unit), LDEXP((real)o[1], unit), LDEXP((real)o[2], unit)},
                       direction,
                       LDEXP((real)rays[i].tmin, along),
                       LDEXP((real)rays[i].tmax, along)};
        const hit h = NAME(closest)(&world, &r);
        hits[i] = (rt_hit){h.primitive, (float)LDEXP(h.t, -along), (float)h.u, (float)h.v};
    }
    NAME(world_leave)(&world, tree);
}

void NAME(trace)(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits)
{
    NAME(trace_by)(NULL, scene, rays, count, hits);
}
