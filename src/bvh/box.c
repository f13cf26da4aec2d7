#include "bvh/box.h"

#include <math.h>

#include "kernels/margins.h"

static inline void widen(float lo[3], float hi[3])
{
    const float x = fabsf(lo[0]) + fabsf(hi[0]), y = fabsf(lo[1]) + fabsf(hi[1]),
                z = fabsf(lo[2]) + fabsf(hi[2]);
    const float xy = x > y ? x : y;
    const float margin = (xy > z ? xy : z) * RT_BOX_MARGIN;
    for (int i = 0; i < 3; ++i) {
        lo[i] -= margin;
        hi[i] += margin;
    }
}

/* ---- box_of_NAME: the exact box of each kind ---- */

static inline void box_of_sphere(const rt_sphere *s, float lo[3], float hi[3])
{
    const float c[3] = {s->cx, s->cy, s->cz};
    for (int i = 0; i < 3; ++i) {
        lo[i] = c[i] - s->radius;
        hi[i] = c[i] + s->radius;
    }
}

static inline void box_of_triangle(const rt_triangle *t, float lo[3], float hi[3])
{
    const float a[3] = {t->ax, t->ay, t->az}, b[3] = {t->bx, t->by, t->bz},
                c[3] = {t->cx, t->cy, t->cz};
    for (int i = 0; i < 3; ++i) {
        const float low = a[i] < b[i] ? a[i] : b[i], high = a[i] > b[i] ? a[i] : b[i];
        lo[i] = low < c[i] ? low : c[i];
        hi[i] = high > c[i] ? high : c[i];
    }
}

/* A loop a kind, so that a box costs no call. */
#define BOXES_OF_KIND(name, names, NAMES)                                                          \
    case RT_KIND_##NAMES:                                                                          \
        for (size_t i = begin; i < end; ++i, ++r) {                                                \
            box_of_##name(&scene->names[i], r->lo, r->hi);                                         \
            widen(r->lo, r->hi);                                                                   \
        }                                                                                          \
        break;

void rt_boxes_of(const rt_scene *scene, enum rt_kind kind, size_t begin, size_t end,
                 rt_reference *r)
{
    switch (kind) {
        RT_KINDS(BOXES_OF_KIND)
    case RT_KIND_COUNT:
        break;
    }
}
