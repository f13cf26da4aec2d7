/* What the files of the scalar reference share: its number type, its vectors, its rays. Each file
 * is compiled twice, as it is for float and with RT_SCALAR_DOUBLE for double. Every multiply-add is
 * a written fma and contraction is off, so the float version's bits are the same everywhere. */
#ifndef RT_REFERENCE_REAL_H
#define RT_REFERENCE_REAL_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "scene/media.h"
#include "scene/scene.h"

#ifdef RT_SCALAR_DOUBLE
typedef double real;
#define NAME(verb) rt_scalar_double_##verb
#define FMA fma
#define SQRT sqrt
#define POW pow
#define FABS fabs
#define FMAX fmax
#define FMIN fmin
#define REAL_MAX DBL_MAX
#define LDEXP ldexp
#define ILOGB ilogb
#define HALF_ULP 0x1p-53
#else
typedef float real;
#define NAME(verb) rt_scalar_float_##verb
#define FMA fmaf
#define SQRT sqrtf
#define POW powf
#define FABS fabsf
#define FMAX fmaxf
#define FMIN fminf
#define REAL_MAX FLT_MAX
#define LDEXP ldexpf
#define ILOGB ilogbf
#define HALF_ULP 0x1p-24f
#endif

typedef struct vec {
    real x, y, z;
} vec;

typedef struct ray {
    vec origin, direction;
    real tmin, tmax;
} ray;

typedef struct hit {
    int primitive;
    real t, u, v;
} hit;

/* A number and what rounding took from it: together they are exact (Knuth; Dekker). */
typedef struct twofold {
    real value, rest;
} twofold;

static inline twofold sum_of(real a, real b)
{
    const real s = a + b;
    const real b_part = s - a;
    return (twofold){s, (a - (s - b_part)) + (b - b_part)};
}

static inline twofold product_of(real a, real b)
{
    const real p = a * b;
    return (twofold){p, FMA(a, b, -p)};
}

static inline vec vec_of(float x, float y, float z)
{
    return (vec){(real)x, (real)y, (real)z};
}

static inline real dot(vec a, vec b)
{
    return FMA(a.x, b.x, FMA(a.y, b.y, a.z * b.z));
}

static inline vec minus(vec a, vec b)
{
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline vec plus(vec a, vec b)
{
    return (vec){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline vec times(vec a, real s)
{
    return (vec){a.x * s, a.y * s, a.z * s};
}

static inline vec magnitudes(vec a)
{
    return (vec){FABS(a.x), FABS(a.y), FABS(a.z)};
}

/* Component by component. */
static inline vec product(vec a, vec b)
{
    return (vec){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* a * s + b */
static inline vec add_scaled(vec a, real s, vec b)
{
    return (vec){FMA(a.x, s, b.x), FMA(a.y, s, b.y), FMA(a.z, s, b.z)};
}

static inline vec cross(vec a, vec b)
{
    return (vec){FMA(a.y, b.z, -(a.z * b.y)), FMA(a.z, b.x, -(a.x * b.z)),
                 FMA(a.x, b.y, -(a.y * b.x))};
}

/* The exponent of the power of two that brings a vector's largest component to [1, 2), where
 * products neither overflow nor vanish; 0 where there is none. */
static inline int moderating_exponent(vec a)
{
    const real largest = FMAX(FABS(a.x), FMAX(FABS(a.y), FABS(a.z)));
    return largest > 0 && isfinite(largest) ? -ILOGB(largest) : 0;
}

/* `a` times 2^k: exact. */
static inline vec scaled(vec a, int k)
{
    return (vec){LDEXP(a.x, k), LDEXP(a.y, k), LDEXP(a.z, k)};
}

static inline vec moderate(vec a)
{
    return scaled(a, moderating_exponent(a));
}

/* NaN for the zero vector. */
static inline vec unit(vec a)
{
    const vec m = moderate(a);
    return times(m, (real)1 / SQRT(dot(m, m)));
}

/* A scene made ready to be traced. The tree is a plain one of this path's own; without it (`nodes`
 * NULL, where there was no memory) every primitive is tried, which gives the same bits. */
typedef struct scalar_world {
    const rt_scene *scene;
    rt_media media;            /* owned; `list` is NULL where there was no memory */
    struct scalar_node *nodes; /* owned */
    int *order;                /* owned: primitives as the leaves have them */
    rt_ray_counts *counts;     /* the caller's: where rays that are traced are put down, or NULL */
} scalar_world;

/* tree.c. The scene must outlive the world and stay as it is. */
scalar_world NAME(world)(const rt_scene *scene);
void NAME(world_clear)(scalar_world *world);

/* A world to be shared, of scenes of the same primitives (scalar.h). */
struct rt_scalar_tree *NAME(tree)(const rt_scene *scene);
void NAME(tree_free)(struct rt_scalar_tree *tree);
/* The scene's world by that tree, or one of its own for NULL; to be left as it was opened. */
scalar_world NAME(world_open)(const rt_scene *scene, const struct rt_scalar_tree *tree);
void NAME(world_leave)(scalar_world *world, const struct rt_scalar_tree *tree);

/* The nearest hit with t in (tmin, tmax); t is infinite where there is none. */
hit NAME(closest)(const scalar_world *world, const ray *r);
/* Whether there is any hit with t in (tmin, tmax). */
bool NAME(occluded)(const scalar_world *world, const ray *r);

/* trace.c: takes a hit with one primitive if it is nearer than the best, or as near and of a
 * lower index. The t that it takes is within the ray's part in the primitive's box. */
void NAME(meet)(const rt_scene *scene, const ray *r, int primitive, hit *best);
/* That box. */
void NAME(box)(const rt_scene *scene, int primitive, vec *lo, vec *hi);
/* The ray's part in a box, as t from `enter` to `leave`; empty where enter > leave. Monotone in the
 * box, rounding included. */
void NAME(part_in_box)(const rt_scene *scene, const ray *r, vec lo, vec hi, real *enter,
                       real *leave);

/* In a file of each kind of primitive: t, u and v of a hit with the i-th of the kind, false for a
 * miss; its exact box. */
#define KIND_IN_TRACE(name, names, NAMES)                                                          \
    bool NAME(meet_##name)(const rt_scene *scene, const ray *r, size_t i, hit *h);                 \
    void NAME(box_of_##name)(const rt_##name *primitive, float lo[3], float hi[3]);
RT_KINDS(KIND_IN_TRACE)

/* watertight.c: the robust test of a triangle; false for a miss. */
bool NAME(meet_watertight)(const rt_triangle *triangle, const ray *r, int cull, hit *h);

/* Whether the scene's level asks for the robust tests; in double they are the only ones. */
static inline bool is_robust(const rt_scene *scene)
{
#ifdef RT_SCALAR_DOUBLE
    (void)scene;
    return true;
#else
    return scene->accuracy >= RT_ACCURACY_ROBUST;
#endif
}

#endif
