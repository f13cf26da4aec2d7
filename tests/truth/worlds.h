/* What stands before the eye, each with the light that should come of it. */
#ifndef RT_TESTS_TRUTH_WORLDS_H
#define RT_TESTS_TRUTH_WORLDS_H

#include "truth/truth.h"

/* Writes what every row has: the camera, the row's text and the mirror. */
void truth_begin(truth_text *text);

/* What is added after that is given as it is seen: of a row with a mirror it is written as its
 * mirror image, and light goes there by the mirror. */
truth_vec truth_placed(const truth_text *text, truth_vec p);
void truth_triangle(truth_text *text, truth_vec a, truth_vec b, truth_vec c, const char *material);

/* Stairs: the floor in stripes, each brighter by 1 than the one before, so that every pixel has an
 * edge that rises in the direction of the angle. By ambient light of colour TRUTH_STAIRS, or by a
 * lamp of that colour. */
#define TRUTH_STAIRS 24
void truth_add_stairs(truth_text *text);
double truth_stairs_mean(const truth_picture *p, double x, double y);
double truth_stairs_at(truth_vec at);

/* A plain floor, of the material white. */
void truth_add_floor(truth_text *text);

/* The same and a lamp, a part of it behind a half plane whose edge is at the angle. */
void truth_add_lit_floor(truth_text *text);
double truth_lit_floor(const truth_picture *p, const truth_ray *ray);
double truth_lamplight(const truth_picture *p, truth_vec at);
/* Stairs in its place. */
void truth_add_lit_stairs(truth_text *text);
double truth_lit_stairs(const truth_picture *p, const truth_ray *ray);

/* The floor and a wall, two that make a corner, or a ball on it: how much of the sky is open. */
void truth_add_wall(truth_text *text);
double truth_wall(const truth_picture *p, const truth_ray *ray);
void truth_add_corner(truth_text *text);
double truth_corner(const truth_picture *p, const truth_ray *ray);
void truth_add_ball_on_floor(truth_text *text);
double truth_ball_on_floor(const truth_picture *p, const truth_ray *ray);
/* The wall, and the lamp on the other side. */
void truth_add_lit_wall(truth_text *text);
double truth_lit_wall(const truth_picture *p, const truth_ray *ray);

/* A small white ball, out of focus. */
#define TRUTH_POINT "sphere center 1.3 -0.7 0 radius 3 material white\n"
double truth_point(const truth_picture *p, const truth_ray *ray);

/* Fog in front of the floor. */
double truth_foggy_floor(const truth_picture *p, const truth_ray *ray);

/* Balls of what only absorbs, before a white sky: whole, and with a bubble. */
#define TRUTH_ABSORB 0.05
#define TRUTH_ABSORBING                                                                            \
    "background 1 1 1\nmaterial dark transmit 1 ior 1 absorb 0.05 0.05 0.05\n"                     \
    "sphere center 0 0 0 radius 14 material dark\n"
#define TRUTH_BUBBLE "material air transmit 1 ior 1\nsphere center 0 0 0 radius 9 material air\n"
double truth_absorbing(const truth_picture *p, const truth_ray *ray);
double truth_bubble(const truth_picture *p, const truth_ray *ray);

/* The eye in the middle of a ball of absorbing glass. */
#define TRUTH_IN_GLASS                                                                             \
    "background 1 1 1\nmaterial glass transmit 1 ior 1.5 absorb 1 1 1\n"                           \
    "sphere center 0 0 100 radius 1 material glass\n"
double truth_in_glass(const truth_picture *p, const truth_ray *ray);

/* 30 panes of glass before a white floor, and a ball of glass in a sky that is brighter above. */
void truth_add_panes_on_white(truth_text *text);
double truth_panes_on_white(const truth_picture *p, const truth_ray *ray);
#define TRUTH_BALL "sphere center 0 0 0 radius 14 material glass\n"
double truth_ball_in_sky(const truth_picture *p, const truth_ray *ray);

/* Under a sky of 0.5 all around, what neither absorbs nor shines cannot be seen. */
double truth_furnace(const truth_picture *p, const truth_ray *ray);
void truth_add_shells(truth_text *text);     /* 16 balls of glass in one another */
void truth_add_panes(truth_text *text);      /* 30 panes, 0.4 thick at 0.8 */
void truth_add_thin_panes(truth_text *text); /* 400, a tenth of that */
void truth_add_cube(truth_text *text);

/* A picture on the floor, a texel 4 units wide, and 0.4. Writes the picture's file. */
void truth_add_large_texels(truth_text *text);
double truth_large_texels(const truth_picture *p, const truth_ray *ray);
void truth_add_small_texels(truth_text *text);
double truth_small_texels(const truth_picture *p, const truth_ray *ray);

#endif
