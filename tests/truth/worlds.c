/* What all worlds share: eye, floor and mirror. */
#include "truth/worlds.h"

#include <math.h>

/* The mirror stands at half a right angle across the view, half way down. */
#define MIRROR_AT 50.0

truth_vec truth_placed(const truth_text *text, truth_vec p)
{
    if (!(text->row->mirror > 0.0))
        return p;
    return (truth_vec){p.z - MIRROR_AT, p.y, p.x + MIRROR_AT};
}

void truth_triangle(truth_text *text, truth_vec a, truth_vec b, truth_vec c, const char *material)
{
    a = truth_placed(text, a), b = truth_placed(text, b), c = truth_placed(text, c);
    fprintf(text->out, "triangle a %.9g %.9g %.9g b %.9g %.9g %.9g c %.9g %.9g %.9g material %s\n",
            a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, material);
}

/* One triangle, which has no seam. What is behind it must not reach beyond it. */
static void add_mirror(truth_text *text)
{
    const double side = 21.0, long_side = 42.0;
    fprintf(text->out,
            "material mirror reflect %.9g\ntriangle a %.9g -44 %.9g b %.9g 44 %.9g "
            "c %.9g 0 %.9g material mirror\n",
            text->row->mirror, -side, MIRROR_AT - side, -side, MIRROR_AT - side, long_side,
            MIRROR_AT + long_side);
}

void truth_begin(truth_text *text)
{
    const double pi = 3.14159265358979323846;
    fprintf(text->out, "rt 1\ncamera from 0 0 %.9g at 0 0 0 up %.9g %.9g 0 vfov %.9g %s\n%s",
            TRUTH_EYE, -sin(text->angle), cos(text->angle),
            2.0 * atan(0.5 * TRUTH_SIDE / TRUTH_EYE) * 180.0 / pi,
            text->row->eye ? text->row->eye : "", text->row->text);
    if (text->row->mirror > 0.0)
        add_mirror(text);
}

void truth_add_floor(truth_text *text)
{
    truth_triangle(text, (truth_vec){-80, -60, 0}, (truth_vec){80, -60, 0}, (truth_vec){0, 100, 0},
                   "white");
}
