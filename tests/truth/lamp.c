/* A lamp with a size, a part of it hidden. */
#include "truth/worlds.h"

#include <math.h>

#include "truth/forms.h"

static const truth_vec lamp = {100, 0, 30};
/* On the half plane's edge: from the floor's middle it hides half of the lamp. */
static const truth_vec edge = {45, 0, 13.5};

/* Along the edge, and from it to what is open. */
static void edge_axes(double angle, truth_vec *along, truth_vec *open)
{
    *along = (truth_vec){0, cos(angle), sin(angle)};
    *open = (truth_vec){0, -sin(angle), cos(angle)};
}

static void add_lamp(truth_text *text)
{
    const truth_vec at = truth_placed(text, lamp);
    truth_vec along, open;
    edge_axes(text->angle, &along, &open);
    fprintf(text->out, "light point at %.9g %.9g %.9g shadow on %s\nmaterial black\n", at.x, at.y,
            at.z, text->row->lamp);
    /* Large enough for the lamp, small enough not to come before the mirror. */
    truth_triangle(text, truth_add(edge, -24, along), truth_add(edge, 24, along),
                   truth_add(edge, -60, open), "black");
}

double truth_lamplight(const truth_picture *p, truth_vec at)
{
    const rt_light *light = &p->scene->lights[0];
    const truth_vec way = truth_add(lamp, -1.0, at);
    truth_vec along, open;
    edge_axes(p->angle, &along, &open);
    return (double)light->r * way.z / sqrt(truth_dot(way, way)) *
           truth_half_hidden(at, lamp, (double)light->radius, edge, along, open);
}

void truth_add_lit_floor(truth_text *text)
{
    truth_add_floor(text);
    add_lamp(text);
}

double truth_lit_floor(const truth_picture *p, const truth_ray *ray)
{
    return truth_lamplight(p, truth_floor(ray));
}

void truth_add_lit_stairs(truth_text *text)
{
    truth_add_stairs(text);
    add_lamp(text);
}

double truth_lit_stairs(const truth_picture *p, const truth_ray *ray)
{
    const truth_vec at = truth_floor(ray);
    return truth_stairs_at(at) / TRUTH_STAIRS * truth_lamplight(p, at);
}
