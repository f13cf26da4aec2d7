/* The hard cases: figures that are measured at every level of accuracy on the device under test and
 * held against what is lawful there. Each case is also put to naive variants, which it must fail:
 * a case that passes whatever is put to it proves nothing. The rows go to standard output as lines
 * of one Markdown table, which tests/run puts together. */
#ifndef RT_TESTS_HARD_HARD_H
#define RT_TESTS_HARD_HARD_H

#include "support/support.h"

#include "reference/scalar.h"
#include "support/mutants.h"

/* A naive variant: nearest hits by plain scalar C (tests/hard/naive.c), or wrong kernels, named by
 * what is wrong with them, or neither where the case itself is naive then. */
typedef void hard_trace_fn(const rt_scene *scene, const rt_ray *rays, size_t count, rt_hit *hits);
typedef struct hard_naive {
    const char *name; /* NULL: the mutant's */
    hard_trace_fn *trace;
    test_mutant mutant;
    bool at_robust; /* the mutant is of that level's kernels, else of standard's */
} hard_naive;

/* What answers: a level on the device, through the tree or by brute force; or a naive variant. */
typedef struct hard_way {
    const char *name;
    enum rt_accuracy level;
    const hard_naive *naive; /* NULL: the device */
    bool by_brute_force;
} hard_way;

#define HARD_FIGURES 4
#define HARD_NAIVES 3
/* In the place of a gate: the figure is told, and nothing is asked of it. */
#define HARD_REPORT (-1.0)

/* One figure: at each level it must be at most the gate. */
typedef struct hard_figure {
    const char *what; /* with its unit */
    double gates[RT_ACCURACY_COUNT];
} hard_figure;

typedef struct hard_case {
    int row; /* of README.md's table, in this folder */
    const char *name;
    hard_figure figures[HARD_FIGURES]; /* ended by one without `what` */
    /* Each must break the gate of some figure at naive_level, robust if not set; ended by NULL. */
    const hard_naive *naives[HARD_NAIVES];
    enum rt_accuracy naive_level;
    void (*measure)(const hard_way *way, const void *of, double figures[]);
    const void *of;
    bool by_brute_force; /* no tree */
} hard_case;

/* Measures at all levels that the device has and by all naive variants, and prints the rows. */
void hard_hold(const hard_case *c);

/* Ends a test: fails it where a figure has broken its gate, or a naive variant has not. */
void hard_finish(void);

/* Rays for a measurement at this way: RT_HARD_RAYS, 250,000 if not set, where a level promises
 * something; a tenth of it where figures are only told; naive variants, which are slow, get as many
 * as they can do in a moment. */
size_t hard_rays(const hard_way *way);

/* Events per million. */
double hard_per_million(size_t events, size_t of);

/* A scene that answers rays in some way. The scene is the caller's and must outlive it. */
typedef struct hard_tracer {
    const rt_scene *scene;
    const hard_naive *naive;
    rt_renderer *renderer;
} hard_tracer;

/* What the table calls it. */
const char *hard_naive_name(const hard_naive *naive);

/* Makes the renderer, for a scene in the file's unit. */
void hard_open(hard_tracer *tracer, const hard_way *way, rt_scene *scene);
void hard_trace(hard_tracer *tracer, const rt_ray *rays, size_t count, rt_hit *hits);
void hard_close(hard_tracer *tracer);

/* How many of the rays nothing is in the way of, by the kernel for any hit. */
size_t hard_open_rays(const hard_way *way, rt_scene *scene, const rt_ray *rays, size_t count);

/* A scene by its text, behind "rt 1"; primitives can be added. */
void hard_read(rt_scene *scene, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Renders the scene in some way, with hit records where the device does it. */
void hard_draw(const hard_way *way, rt_scene *scene, rt_image *image);

/* Rays that are traced at a time. */
#define HARD_CHUNK 65536

/* An empty scene with one material, and primitives for a scene that may have a unit of length. */
void hard_scene(rt_scene *scene);
void hard_add_triangle(rt_scene *scene, const float corners[9]);
void hard_add_sphere(rt_scene *scene, float x, float y, float z, float radius);

#endif
