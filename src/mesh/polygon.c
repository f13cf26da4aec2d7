/* Ear clipping: a simple polygon of more than three corners has two ears (G. H. Meisters, "Polygons
 * have ears", 1975), corners whose triangle with both neighbours lies inside, so that one after the
 * other can be cut off. Only a corner that is not convex can spoil an ear, which leaves few to
 * test.
 *
 * The plane is the one of Newell's normal (M. E. Newell in Sutherland, Sproull, Schumacker, 1974),
 * seen along the axis nearest to it: dropping a coordinate keeps the other two as they are, and so
 * the sign of an area is exact (see `area`), where turning the plane would round it. */
#include "mesh/polygon.h"

#include <math.h>
#include <stdlib.h>

struct rt_polygon_node {
    double x, y;
    int32_t previous, next;
    bool is_blocker; /* not strictly convex: may lie in another corner's triangle */
    bool is_listed;  /* in the list of blockers, from which a corner is dropped late */
    bool is_tried;   /* no ear by the current rule, and no neighbour has changed since */
};

/* From the one that is always right to those that save what they can. */
enum rule {
    RULE_SPIKE,    /* no area, and both neighbours on one side: goes before ears stand on it */
    RULE_EAR,      /* convex, and nothing in its triangle, border included */
    RULE_FLAT,     /* no area: as above, or between both neighbours */
    RULE_EAR_LEFT, /* what RULE_FLAT has uncovered */
    RULE_TOUCHED,  /* flat, or convex with nothing strictly inside: for outlines that touch */
    RULE_FAN       /* edges cross, so that there is no ear: anything that ends */
};

/* Twice the area of a triangle, positive where it runs counter-clockwise. Differences of floats and
 * their products are exact in double while the magnitudes are within 2^28 of each other; the last
 * subtraction rounds, which keeps the sign and keeps zero. */
static double area(const rt_polygon_node *a, const rt_polygon_node *b, const rt_polygon_node *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

static bool is_same(const rt_polygon_node *a, const rt_polygon_node *b)
{
    return a->x == b->x && a->y == b->y;
}

static bool reserve(rt_polygon *polygon, size_t count)
{
    if (count <= polygon->capacity)
        return true;
    rt_polygon_clear(polygon);
    const size_t capacity = count < 16 ? 16 : 2 * count;
    polygon->triangles = malloc(3 * capacity * sizeof *polygon->triangles);
    polygon->nodes = calloc(capacity, sizeof *polygon->nodes);
    polygon->blockers = malloc(capacity * sizeof *polygon->blockers);
    if (!polygon->triangles || !polygon->nodes || !polygon->blockers) {
        rt_polygon_clear(polygon);
        return false;
    }
    polygon->capacity = capacity;
    return true;
}

void rt_polygon_clear(rt_polygon *polygon)
{
    free(polygon->triangles);
    free(polygon->nodes);
    free(polygon->blockers);
    *polygon = RT_POLYGON_INIT;
}

/* Newell's normal, from points relative to the first one, so that a polygon far away from the
 * origin does not lose its digits. */
static void newell_normal(const float *points, size_t count, double normal[3])
{
    normal[0] = normal[1] = normal[2] = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const float *a = points + 3 * i, *b = points + 3 * ((i + 1) % count);
        double p[3], q[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = (double)a[k] - (double)points[k];
            q[k] = (double)b[k] - (double)points[k];
        }
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            normal[k] += (p[u] - q[u]) * (p[v] + q[v]);
        }
    }
}

/* Classes a corner anew after one of its neighbours has gone. */
static void classify(rt_polygon *polygon, int32_t i)
{
    rt_polygon_node *node = &polygon->nodes[i];
    node->is_blocker =
        !(area(&polygon->nodes[node->previous], node, &polygon->nodes[node->next]) > 0.0);
    node->is_tried = false;
    if (node->is_blocker && !node->is_listed) {
        node->is_listed = true;
        polygon->blockers[polygon->blocker_count++] = i;
    }
}

/* Links the corners into a ring that runs counter-clockwise as seen. */
static void make_ring(rt_polygon *polygon, const float *points, size_t count)
{
    double normal[3];
    newell_normal(points, count, normal);
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (fabs(normal[k]) > fabs(normal[axis]))
            axis = k;
    const int u = (axis + (normal[axis] < 0.0 ? 2 : 1)) % 3, v = 3 - axis - u;
    for (size_t i = 0; i < count; ++i) {
        rt_polygon_node *node = &polygon->nodes[i];
        node->x = (double)points[3 * i + (size_t)u];
        node->y = (double)points[3 * i + (size_t)v];
        node->previous = (int32_t)(i ? i - 1 : count - 1);
        node->next = (int32_t)(i + 1 < count ? i + 1 : 0);
        node->is_listed = false;
    }
    polygon->blocker_count = 0;
    for (size_t i = 0; i < count; ++i)
        classify(polygon, (int32_t)i);
}

/* True where an edge at `v`, a corner at the same place as `p`, leads into the triangle p q r. */
static bool enters(const rt_polygon *polygon, const rt_polygon_node *v, const rt_polygon_node *p,
                   const rt_polygon_node *q, const rt_polygon_node *r)
{
    const rt_polygon_node *before = &polygon->nodes[v->previous], *after = &polygon->nodes[v->next];
    return (area(p, q, before) > 0.0 && area(r, p, before) > 0.0) ||
           (area(p, q, after) > 0.0 && area(r, p, after) > 0.0);
}

/* True where corner `v` spoils the ear a b c. */
static bool blocks(const rt_polygon *polygon, const rt_polygon_node *v, const rt_polygon_node *a,
                   const rt_polygon_node *b, const rt_polygon_node *c, enum rule rule)
{
    const double ab = area(a, b, v), bc = area(b, c, v), ca = area(c, a, v);
    if (rule == RULE_TOUCHED)
        return ab > 0.0 && bc > 0.0 && ca > 0.0;
    if (ab < 0.0 || bc < 0.0 || ca < 0.0)
        return false;
    /* A hole joined to the outline by a cut has corners in the same place. */
    if (is_same(v, a))
        return enters(polygon, v, a, b, c);
    if (is_same(v, b))
        return enters(polygon, v, b, c, a);
    if (is_same(v, c))
        return enters(polygon, v, c, a, b);
    return true;
}

static bool can_clip(rt_polygon *polygon, int32_t i, enum rule rule)
{
    const rt_polygon_node *nodes = polygon->nodes, *b = &nodes[i];
    const rt_polygon_node *a = &nodes[b->previous], *c = &nodes[b->next];
    const double twice = area(a, b, c);
    if (rule == RULE_FAN)
        return true;
    if (rule == RULE_SPIKE)
        return twice == 0.0 && (a->x - b->x) * (c->x - b->x) + (a->y - b->y) * (c->y - b->y) >= 0.0;
    if (rule == RULE_FLAT || (rule == RULE_TOUCHED && twice == 0.0))
        return twice == 0.0;
    if (!(twice > 0.0))
        return false;
    for (size_t k = 0; k < polygon->blocker_count;) {
        rt_polygon_node *v = &polygon->nodes[polygon->blockers[k]];
        if (!v->is_blocker) {
            v->is_listed = false;
            polygon->blockers[k] = polygon->blockers[--polygon->blocker_count];
            continue;
        }
        if (v != a && v != c && blocks(polygon, v, a, b, c, rule))
            return false;
        ++k;
    }
    return true;
}

static void emit(rt_polygon *polygon, size_t *emitted, int32_t i)
{
    int32_t *triangle = polygon->triangles + 3 * (*emitted)++;
    triangle[0] = polygon->nodes[i].previous;
    triangle[1] = i;
    triangle[2] = polygon->nodes[i].next;
}

static void clip(rt_polygon *polygon, int32_t i)
{
    rt_polygon_node *node = &polygon->nodes[i];
    polygon->nodes[node->previous].next = node->next;
    polygon->nodes[node->next].previous = node->previous;
    node->is_blocker = false;
    classify(polygon, node->previous);
    classify(polygon, node->next);
}

bool rt_polygon_split(rt_polygon *polygon, const float *points, size_t count)
{
    if (!reserve(polygon, count))
        return false;
    make_ring(polygon, points, count);
    enum rule rule = RULE_SPIKE;
    size_t emitted = 0, left = count, misses = 0;
    int32_t i = 1; /* so that the first corner stays and a convex polygon becomes its fan */
    while (left > 3) {
        rt_polygon_node *node = &polygon->nodes[i];
        if (!node->is_tried && can_clip(polygon, i, rule)) {
            emit(polygon, &emitted, i);
            clip(polygon, i);
            --left;
            misses = 0;
        } else {
            node->is_tried = true;
            ++misses;
        }
        i = node->next;
        if (misses < left)
            continue;
        /* Each rule is given up for good, so that the number of tests stays bounded. */
        ++rule;
        misses = 0;
        for (size_t k = 0; k < count; ++k)
            polygon->nodes[k].is_tried = false;
    }
    emit(polygon, &emitted, i);
    return true;
}
