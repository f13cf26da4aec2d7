/* Whole pictures held against the truth: closed forms, and where there is none an integrator of its
 * own (integral.c). Nothing here shares code with the kernels or with src/reference/; scenes are
 * written as text, and pictures are asked of the device and of the scalar reference.
 *
 * All pictures are taken by one eye, at (0, 0, 100), turned about its view by the picture's angle;
 * 32 x 32 pixels, whose centres are one unit apart on the plane z = 0, the floor. */
#ifndef RT_TESTS_TRUTH_TRUTH_H
#define RT_TESTS_TRUTH_TRUTH_H

#include <stdio.h>

#include "support/support.h"

#define TRUTH_SIDE 32
#define TRUTH_PIXELS (TRUTH_SIDE * TRUTH_SIDE)
#define TRUTH_EYE 100.0
#define TRUTH_ANGLES 8

/* A picture that is asked for: a row's scene at one of its angles. */
typedef struct truth_picture {
    const struct truth_row *row;
    double angle; /* radians */
    const rt_scene *scene;
} truth_picture;

typedef struct truth_vec {
    double x, y, z;
} truth_vec;

typedef struct truth_ray {
    truth_vec origin, direction;
} truth_ray;

/* A scene's text in the making. What stands behind a mirror is written as its mirror image. */
typedef struct truth_text {
    FILE *out;
    const struct truth_row *row;
    double angle; /* radians */
} truth_text;

/* An estimator: what is drawn, and what should come of it. */
typedef struct truth_row {
    const char *name;
    const char *text; /* the scene but for the camera; the word N stands for the count */
    const char *eye;  /* more of the camera, such as its aperture; NULL for a pinhole */
    const char *lamp; /* more of the lamp, such as its samples; NULL where there is none */
    double mirror;    /* weight of a mirror between eye and floor; 0 for none */
    void (*add)(truth_text *text); /* adds what depends on the angle; NULL for nothing */
    /* The light that comes along a ray from the eye: the mean over all that is random beyond the
     * pixel and the lens. NaN where it is not known, which leaves out the pixel. */
    double (*light)(const truth_picture *picture, const truth_ray *ray);
    /* In its place the mean over pixel (x, y), where that has a closed form. */
    double (*mean)(const truth_picture *picture, double x, double y);
    double angles[TRUTH_ANGLES]; /* in degrees, a picture each */
    int pictures;                /* 0 for a single one, at 0 */
    double lawful;               /* a mean error that is lawful */
    double steps;                /* that a pixel may be off at 256 samples, of 255; 0: any */
    int most;                    /* where all counts would take too long, powers of 2 up to this */
    bool in_short;               /* whether the short form has it */
} truth_row;

/* What draws. */
typedef void truth_draw(const rt_scene *scene, rt_image *image);
void truth_draw_device(const rt_scene *scene, rt_image *image);
void truth_draw_reference(const rt_scene *scene, rt_image *image);

/* How far pictures are from the truth. */
typedef struct truth_figures {
    double bias;    /* the largest of a single count, in standard errors; ... */
    int bias_count; /* ... that count */
    double all;     /* the largest of all counts together, in standard errors */
    double slope;   /* of the logarithm of the RMS error against that of the count; NaN: no noise */
    double steps;   /* the largest error of a pixel at the last count up to 256, of 255; ... */
    int steps_count; /* ... that count */
} truth_figures;

/* Whether all counts are wanted, or a few. They are where RT_TRUTH_TABLE names the file for the
 * table's rows, as make test-truth has it. */
bool truth_is_long(void);

/* Whether a row is asked for: in the short form some are, in the long form all, or those that have
 * RT_TRUTH_ROWS in their name. */
bool truth_is_wanted(const truth_row *row);

void truth_measure(const truth_row *row, truth_draw *draw, truth_figures *figures);
bool truth_holds(const truth_row *row, const truth_figures *figures);

/* Prints a row of the table, in the long form to RT_TRUTH_TABLE too: the figures of the device,
 * NULL for none, and those of the reference. */
void truth_tell(const truth_row *row, const truth_figures *device, const truth_figures *reference);

/* integral.c: means[TRUTH_PIXELS] of a row's picture. */
void truth_integrate(const truth_picture *picture, double *means);

#endif
