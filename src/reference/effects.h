/* What the files of the scalar reference share beyond rays and primitives: sample points, surfaces,
 * and what comes back along a ray. Compiled twice, as real.h says. */
#ifndef RT_REFERENCE_EFFECTS_H
#define RT_REFERENCE_EFFECTS_H

#include "reference/real.h"

#ifdef RT_SCALAR_DOUBLE
#define COPYSIGN copysign
#define FLOOR floor
#define EXP exp
#define ATAN2 atan2
#define ASIN asin
#else
#define COPYSIGN copysignf
#define FLOOR floorf
#define EXP expf
#define ATAN2 atan2f
#define ASIN asinf
#endif

typedef struct pair {
    real x, y;
} pair;

/* ---- sampling.c ---- */

/* Which samples are meant: those of a picture's pixel, of its `sample`th ray, after `step` mirror
 * or refracted rays in a row. */
typedef struct stream {
    uint32_t x, y, sample, step, seed;
} stream;

/* What samples are for; the shadow rays of light k are FOR_LIGHT + k. */
enum { FOR_PIXEL, FOR_LENS, FOR_ROUTE, FOR_OCCLUSION, FOR_LIGHT };

uint32_t NAME(mix)(uint32_t x);

/* Point `index` of a sequence in the unit square. The sequence is the stream's for that purpose,
 * whatever `sample` is: of several points a sample, the numbers run on from sample to sample. */
pair NAME(sample_point)(const stream *s, uint32_t purpose, uint32_t index);

/* Point `index` of Sobol's sequence in two dimensions, as fractions of 2^32. */
void NAME(sobol)(uint32_t index, uint32_t point[2]);

/* The way from the pixel's centre, in pixels, of a point in [0, 1]. */
real NAME(filtered)(enum rt_filter filter, real t);

/* Of an angle from -pi/4 to pi/4. */
void NAME(sine_cosine)(real phi, real *sine, real *cosine);

/* From the unit square to the disk of radius 1; equal areas stay equal. */
pair NAME(disk)(pair square);

/* From the unit square to the hemisphere about a unit normal, denser where the cosine is larger. */
vec NAME(hemisphere)(pair square, vec normal);

/* Two unit vectors at right angles to each other and to the unit vector n. */
void NAME(axes_about)(vec n, vec *t1, vec *t2);

/* ---- surface.c ---- */

/* Where a ray meets a primitive. */
typedef struct surface {
    const rt_material *material;
    int material_index;
    vec point;         /* where the ray is at t */
    vec within;        /* the same, but not outside of the primitive's box: in which cell it is */
    vec normal;        /* to shade by: unit, on the side that the ray comes from */
    vec facing;        /* geometric: likewise */
    bool from_outside; /* whether that side is the primitive's outside */
    real u, v;         /* texture coordinates */
    bool is_globe;     /* u goes round, v ends at poles, whatever the material says */
    vec foot;          /* on the primitive, clear of its edges: what next rays start above */
    real lift; /* how far above, so that no rounding brings the primitive back in their way */
} surface;

/* In a file of each kind of primitive: all but the material of the i-th of the kind. */
#define KIND_IN_SURFACE(name, names, NAMES)                                                        \
    surface NAME(surface_of_##name)(const rt_scene *scene, const ray *r, size_t i, const hit *h);
RT_KINDS(KIND_IN_SURFACE)

/* Turns a geometric normal that points outward to the side that the ray comes from. */
void NAME(face)(surface *s, vec outward, vec direction);

/* A point moved into a box, which is flat where the primitive is. */
vec NAME(into_box)(vec point, vec lo, vec hi);

/* What rounding can do to a start on a primitive, and to one on the ray, relative to the numbers
 * that went in. */
#define START_BOUND (8 * HALF_ULP)
#define POINT_BOUND (32 * HALF_ULP)

/* How far a box reaches along the normal whose half sides are the bound times `sizes`. */
real NAME(lift_for)(real bound, vec sizes, vec normal);

surface NAME(surface_at)(const rt_scene *scene, const ray *r, const hit *h);

/* Where a ray starts that leaves the surface on the side that `side` points to. */
vec NAME(start)(const surface *s, vec side);

/* ---- texture.c ---- */

/* What the material's checker and picture multiply ka and kd by. */
vec NAME(pattern)(const rt_scene *scene, const surface *s);

/* ---- shade.c ---- */

/* The light that the surface itself sends against the ray's direction. */
vec NAME(local_color)(const scalar_world *world, const surface *s, vec direction,
                      const stream *samples);

/* ---- path.c ---- */

/* What the camera gets along a ray that meets `h`. */
vec NAME(radiance)(const scalar_world *world, const ray *r, const hit *h, const stream *samples);

/* The part of unpolarised light that the boundary between two media mirrors: eta is the quotient of
 * their indices, this side's by the other's, c1 the cosine of incidence. */
real NAME(fresnel)(real eta, real c1);

#endif
