/* Balls, fog, glass. */
#include "truth/worlds.h"

#include <math.h>

#include "truth/forms.h"

double truth_point(const truth_picture *p, const truth_ray *ray)
{
    double way, inside;
    (void)p;
    return truth_meet_sphere(ray, (truth_vec){1.3, -0.7, 0}, 3.0, &way, &inside);
}

double truth_foggy_floor(const truth_picture *p, const truth_ray *ray)
{
    const truth_vec way = truth_add(truth_floor(ray), -1.0, ray->origin);
    const double clear = exp(-(double)p->scene->fog_density * sqrt(truth_dot(way, way)));
    return clear + (1.0 - clear) * (double)p->scene->fog.x;
}

/* The length of a ray's way inside a ball about the floor's middle. */
static double inside_ball(const truth_ray *ray, double radius)
{
    double way, inside;
    return truth_meet_sphere(ray, (truth_vec){0, 0, 0}, radius, &way, &inside) ? inside : 0.0;
}

double truth_absorbing(const truth_picture *p, const truth_ray *ray)
{
    (void)p;
    return exp(-TRUTH_ABSORB * inside_ball(ray, 14.0));
}

double truth_bubble(const truth_picture *p, const truth_ray *ray)
{
    (void)p;
    return exp(-TRUTH_ABSORB * (inside_ball(ray, 14.0) - inside_ball(ray, 9.0)));
}

/* All rays meet the ball at a right angle, and what is mirrored comes back by the middle. */
double truth_in_glass(const truth_picture *p, const truth_ray *ray)
{
    const double mirrored = 0.04, left = exp(-1.0);
    (void)p, (void)ray;
    return left * (1.0 - mirrored) / (1.0 - mirrored * left * left);
}

void truth_add_shells(truth_text *text)
{
    for (int i = 0; i < 16; ++i)
        fprintf(text->out, "sphere center 0 0 0 radius %.9g material glass\n", 14.0 - 0.8 * i);
}

/* Corners run counter-clockwise as seen from outside: above, then below. */
static void add_panes(truth_text *text, int count, double thickness)
{
    const truth_vec a = {-800, -600, 0}, b = {800, -600, 0}, c = {0, 1000, 0}, up = {0, 0, 1};
    for (int i = 0; i < count; ++i) {
        const double top = -2.0 * thickness * i, low = top - thickness;
        truth_triangle(text, truth_add(a, top, up), truth_add(b, top, up), truth_add(c, top, up),
                       "glass");
        truth_triangle(text, truth_add(a, low, up), truth_add(c, low, up), truth_add(b, low, up),
                       "glass");
    }
}

void truth_add_panes(truth_text *text)
{
    add_panes(text, 30, 0.4);
}

void truth_add_thin_panes(truth_text *text)
{
    add_panes(text, 400, 0.04);
}

/* Under them, which are 24 high. */
void truth_add_panes_on_white(truth_text *text)
{
    truth_add_panes(text);
    truth_triangle(text, (truth_vec){-800, -600, -30}, (truth_vec){800, -600, -30},
                   (truth_vec){0, 1000, -30}, "white");
}

/* The part of unpolarised light that a surface mirrors. */
static double fresnel(double cosine, double ior)
{
    const double behind = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    const double s = (cosine - ior * behind) / (cosine + ior * behind);
    const double p = (behind - ior * cosine) / (behind + ior * cosine);
    return 0.5 * (s * s + p * p);
}

/* Stokes's pile of plates (1862): light goes to and fro between 60 surfaces. */
double truth_panes_on_white(const truth_picture *p, const truth_ray *ray)
{
    const double length = sqrt(truth_dot(ray->direction, ray->direction));
    const double mirrored = fresnel(-ray->direction.z / length, 1.5);
    (void)p;
    return (1.0 - mirrored) / (1.0 + 59.0 * mirrored);
}

/* The light of a sky that is black below and white above, as the camera has it. */
static double sky(const truth_picture *p, truth_vec d)
{
    const double up = cos(p->angle) * d.y - sin(p->angle) * d.x;
    return 0.5 + 0.5 * up / sqrt(truth_dot(d, d));
}

static truth_vec turned(truth_vec d, truth_vec side, double angle)
{
    const truth_vec along = {cos(angle) * d.x, cos(angle) * d.y, cos(angle) * d.z};
    return truth_add(along, sin(angle), side);
}

/* All of a ray's way through a ball is in one plane, and turns by the same angle at each surface.
 */
double truth_ball_in_sky(const truth_picture *p, const truth_ray *ray)
{
    const truth_vec center = {0, 0, 0};
    double way, inside;
    if (!truth_meet_sphere(ray, center, 14.0, &way, &inside))
        return sky(p, ray->direction);
    const double length = sqrt(truth_dot(ray->direction, ray->direction));
    const truth_vec d = truth_add(center, 1.0 / length, ray->direction);
    const truth_vec out = truth_add(ray->origin, way, d);
    const double cosine = 0.5 * inside / 14.0, mirrored = fresnel(cosine, 1.5);
    const truth_vec aside = truth_add(out, -truth_dot(out, d), d);
    const double off = sqrt(truth_dot(aside, aside));
    /* At right angles to d, away from the axis. */
    const truth_vec side = truth_add(center, 1.0 / off, aside);
    const double before = acos(cosine), behind = asin(sin(before) / 1.5);
    const double quarter = 1.57079632679489661923;
    double sum = mirrored * sky(p, turned(d, side, 2.0 * (quarter - before)));
    double part = (1.0 - mirrored) * (1.0 - mirrored);
    for (int k = 0; part > 1e-9; ++k) {
        const double turn = 2.0 * (before - behind) + 2.0 * k * (quarter - behind);
        sum += part * sky(p, turned(d, side, -turn));
        part *= mirrored;
    }
    return sum;
}

/* Turned, so that no face is square to the view. */
void truth_add_cube(truth_text *text)
{
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    truth_vec corners[8];
    for (int i = 0; i < 8; ++i) {
        const double x = i & 1 ? 8 : -8, y = i & 2 ? 8 : -8, z = i & 4 ? 8 : -8;
        const double y2 = 0.8 * y - 0.6 * z, z2 = 0.6 * y + 0.8 * z;
        corners[i] = (truth_vec){0.96 * x + 0.28 * z2, y2, -0.28 * x + 0.96 * z2};
    }
    for (int f = 0; f < 6; ++f) {
        const int *at = faces[f];
        truth_triangle(text, corners[at[0]], corners[at[1]], corners[at[2]], "glass");
        truth_triangle(text, corners[at[0]], corners[at[2]], corners[at[3]], "glass");
    }
}

double truth_furnace(const truth_picture *p, const truth_ray *ray)
{
    (void)p, (void)ray;
    return 0.5;
}
