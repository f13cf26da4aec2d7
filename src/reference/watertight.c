/* The watertight triangle test of the scalar reference (Woop, Benthin and Wald 2013), with exact
 * signs and with a rule for rays that run exactly through an edge or a corner: each is in one of
 * the triangles around. */
#include "reference/real.h"

/* A corner from the ray's origin, axes in an order in which the ray's main one is the last. */
typedef struct corner {
    real v[3];
    real x, y; /* sheared: how far from the ray */
    real t;    /* how far along the ray */
} corner;

/* The ray's view: the order of axes, and its slopes over the main one. */
typedef struct view {
    int axes[3];
    real origin[3], slope_x, slope_y, inverse;
} view;

static view view_of(const ray *r)
{
    const real d[3] = {r->direction.x, r->direction.y, r->direction.z};
    const real o[3] = {r->origin.x, r->origin.y, r->origin.z};
    int main_axis = 2;
    if (FABS(d[1]) >= FABS(d[2]))
        main_axis = 1;
    if (FABS(d[0]) >= FABS(d[1]) && FABS(d[0]) >= FABS(d[2]))
        main_axis = 0;
    view s;
    for (int i = 0; i < 3; ++i) {
        s.axes[i] = (main_axis + 1 + i) % 3;
        s.origin[i] = o[s.axes[i]];
    }
    s.inverse = (real)1 / d[main_axis];
    s.inverse = s.inverse > REAL_MAX ? REAL_MAX : s.inverse < -REAL_MAX ? -REAL_MAX : s.inverse;
    s.slope_x = d[s.axes[0]] * s.inverse;
    s.slope_y = d[s.axes[1]] * s.inverse;
    return s;
}

static corner seen(const view *s, float x, float y, float z)
{
    const real p[3] = {(real)x, (real)y, (real)z};
    corner c;
    for (int i = 0; i < 3; ++i)
        c.v[i] = p[s->axes[i]] - s->origin[i];
    c.x = FMA(-s->slope_x, c.v[2], c.v[0]);
    c.y = FMA(-s->slope_y, c.v[2], c.v[1]);
    c.t = c.v[2] * s->inverse;
    return c;
}

/* p.x q.y - p.y q.x: on which side of the line from p to q the ray is. The sign is exact (Kahan).
 */
static real side_of(const corner *p, const corner *q)
{
    const real product = p->y * q->x;
    return FMA(p->x, q->y, -product) + FMA(-p->y, q->x, product);
}

/* The side of an edge that the ray runs through, as if moved a little: to +x, and by far less to
 * +y. */
static bool is_on_positive_side(const corner *p, const corner *q, real side)
{
    if (side != 0)
        return side > 0;
    return p->y > q->y || (p->y == q->y && q->x > p->x);
}

/* A hit is near where some corner is so many times as far along the ray. */
#define NEAR 64

/* A corner from the ray's origin without rounding: `value`, and the rest that it leaves. */
typedef struct place {
    vec value, rest;
} place;

static place place_of(const view *s, float x, float y, float z)
{
    const real p[3] = {(real)x, (real)y, (real)z};
    twofold f[3];
    for (int i = 0; i < 3; ++i)
        f[i] = sum_of(p[s->axes[i]], -s->origin[i]);
    return (place){{f[0].value, f[1].value, f[2].value}, {f[0].rest, f[1].rest, f[2].rest}};
}

/* z (p.x q.y - p.y q.x), and what is to be added to make up for rounding. */
static twofold prism(real z, vec p, vec q)
{
    const twofold left = product_of(p.x, q.y), right = product_of(p.y, q.x);
    const twofold area = sum_of(left.value, -right.value);
    const twofold volume = product_of(z, area.value);
    return (twofold){volume.value, FMA(z, area.rest + (left.rest - right.rest), volume.rest)};
}

/* The volume a . (c x b) that three corners span with the origin, six times that of their
 * tetrahedron, as if in twice the precision. */
static real volume_of(const place *a, const place *b, const place *c)
{
    const twofold pa = prism(a->value.z, c->value, b->value);
    const twofold pb = prism(b->value.z, a->value, c->value);
    const twofold pc = prism(c->value.z, b->value, a->value);
    const twofold ab = sum_of(pa.value, pb.value);
    const twofold all = sum_of(ab.value, pc.value);
    const real small = dot(a->rest, cross(c->value, b->value)) +
                       dot(b->rest, cross(a->value, c->value)) +
                       dot(c->rest, cross(b->value, a->value));
    return all.value + (((ab.rest + all.rest) + (pa.rest + pb.rest + pc.rest)) + small);
}

/* t of a hit beside which the triangle is huge, by that volume; false for one that is nearer than
 * what rounding can make of it. */
static bool near_t(const rt_triangle *triangle, const view *s, real det, real *t)
{
    const place p[3] = {place_of(s, triangle->ax, triangle->ay, triangle->az),
                        place_of(s, triangle->bx, triangle->by, triangle->bz),
                        place_of(s, triangle->cx, triangle->cy, triangle->cz)};
    real far = 0;
    for (int i = 0; i < 3; ++i) {
        const vec m = magnitudes(p[i].value);
        far = FMAX(far, FMAX(m.x, FMAX(m.y, m.z)));
    }
    const real over = s->inverse / FABS(det);
    const real volume = volume_of(&p[0], &p[1], &p[2]);
    *t = (det < 0 ? -volume : volume) * over;
    return *t > 512 * HALF_ULP * HALF_ULP * FABS(over) * far * far * far;
}

bool NAME(meet_watertight)(const rt_triangle *triangle, const ray *r, int cull, hit *h)
{
    const view s = view_of(r);
    const corner c[3] = {seen(&s, triangle->ax, triangle->ay, triangle->az),
                         seen(&s, triangle->bx, triangle->by, triangle->bz),
                         seen(&s, triangle->cx, triangle->cy, triangle->cz)};
    real w[3];
    int positive = 0;
    for (int i = 0; i < 3; ++i) {
        const corner *p = &c[(i + 2) % 3], *q = &c[(i + 1) % 3];
        w[i] = side_of(p, q);
        positive += is_on_positive_side(p, q, w[i]);
    }
    const real det = w[0] + w[1] + w[2];
    if ((positive != 0 && positive != 3) || !(det > 0 || det < 0))
        return false;
    const bool is_front = (det > 0) == (s.inverse > 0);
    if ((cull > 0 && !is_front) || (cull < 0 && is_front))
        return false;
    h->t = FMA(w[0], c[0].t, FMA(w[1], c[1].t, w[2] * c[2].t)) / det;
    h->u = w[1] / det;
    h->v = w[2] / det;
    const real farthest = FMAX(FABS(c[0].t), FMAX(FABS(c[1].t), FABS(c[2].t)));
    return !(farthest > NEAR * FABS(h->t)) || near_t(triangle, &s, det, &h->t);
}
