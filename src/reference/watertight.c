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

/* What rounding can make of t at most, by the hit's weights w, which add up to 1 with `part`: the
 * corners' errors along the ray, and across it times the slope of the triangle. */
static real error_of(const view *s, const corner c[3], const real w[3], real part)
{
    real along = 0, aside_x = 0, aside_y = 0;
    for (int i = 2; i >= 0; --i) {
        const real weight = FABS(w[i]);
        const real x = FMA(FABS(s->slope_x), FABS(c[i].v[2]), FABS(c[i].v[0]));
        const real y = FMA(FABS(s->slope_y), FABS(c[i].v[2]), FABS(c[i].v[1]));
        along = i == 2 ? weight * FABS(c[i].t) : FMA(weight, FABS(c[i].t), along);
        aside_x = i == 2 ? weight * x : FMA(weight, x, aside_x);
        aside_y = i == 2 ? weight * y : FMA(weight, y, aside_y);
    }
    const real x1 = c[1].x - c[0].x, y1 = c[1].y - c[0].y, t1 = c[1].t - c[0].t;
    const real x2 = c[2].x - c[0].x, y2 = c[2].y - c[0].y, t2 = c[2].t - c[0].t;
    const real slope_x = FABS(FMA(y1, t2, -(t1 * y2))) * part;
    const real slope_y = FABS(FMA(t1, x2, -(x1 * t2))) * part;
    return 8 * HALF_ULP * (FMA(slope_x, aside_x, FMA(slope_y, aside_y, along)) * part);
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
    /* t is a mean of the corners': where all are ahead, so is the hit. */
    const bool all_ahead = c[0].t > 0 && c[1].t > 0 && c[2].t > 0;
    return all_ahead || h->t > error_of(&s, c, w, 1 / FABS(det));
}
