/* Walls, and a ball, that keep the sky away from the floor. */
#include "truth/worlds.h"

#include <math.h>

#include "truth/forms.h"

/* A wall's distance from the floor's middle. Its height and width are beyond all rays' ends. */
#define WALL_AT 24.0

static void add_wall_at(truth_text *text, double angle)
{
    const truth_vec out = {cos(angle), sin(angle), 0}, side = {-sin(angle), cos(angle), 0};
    const truth_vec foot = truth_add((truth_vec){0, 0, 0}, WALL_AT, out);
    truth_triangle(text, truth_add(foot, -100, side), truth_add(foot, 100, side),
                   (truth_vec){foot.x, foot.y, 44}, "black");
}

/* Seen from straight above, the rays of a hemisphere, weighted by their cosine, fill a disk evenly;
 * a wall takes those beyond a line. Where that is, for a wall at right angles to `angle`. */
static double wall_line(const truth_picture *p, truth_vec at, double angle)
{
    const double away = WALL_AT - at.x * cos(angle) - at.y * sin(angle);
    return away / (double)p->scene->occlusion_distance;
}

void truth_add_wall(truth_text *text)
{
    truth_add_floor(text);
    fprintf(text->out, "material black\n");
    add_wall_at(text, text->angle);
}

double truth_wall(const truth_picture *p, const truth_ray *ray)
{
    return truth_disk_part(wall_line(p, truth_floor(ray), p->angle));
}

#define QUARTER 1.57079632679489661923

void truth_add_corner(truth_text *text)
{
    truth_add_wall(text);
    add_wall_at(text, text->angle + QUARTER);
}

double truth_corner(const truth_picture *p, const truth_ray *ray)
{
    const truth_vec at = truth_floor(ray);
    return truth_disk_corner(wall_line(p, at, p->angle), wall_line(p, at, p->angle + QUARTER));
}

/* The lamp is at angle 0, so the wall is on the other side. */
void truth_add_lit_wall(truth_text *text)
{
    truth_add_lit_floor(text);
    add_wall_at(text, 2.0 * QUARTER);
}

double truth_lit_wall(const truth_picture *p, const truth_ray *ray)
{
    const truth_vec at = truth_floor(ray);
    return truth_lamplight(p, at) + truth_disk_part(wall_line(p, at, 2.0 * QUARTER));
}

static const truth_vec ball = {2, -1, 6};

void truth_add_ball_on_floor(truth_text *text)
{
    truth_add_floor(text);
    fprintf(text->out, "material black\nsphere center %.9g %.9g %.9g radius %.9g material black\n",
            ball.x, ball.y, ball.z, ball.z);
}

/* A ball above the horizon takes (r / distance)^2 times the cosine. */
double truth_ball_on_floor(const truth_picture *p, const truth_ray *ray)
{
    double way, inside;
    (void)p;
    if (truth_meet_sphere(ray, ball, ball.z + 0.01, &way, &inside))
        return NAN;
    const truth_vec to = truth_add(ball, -1.0, truth_floor(ray));
    return 1.0 - pow(ball.z / sqrt(truth_dot(to, to)), 3.0);
}
