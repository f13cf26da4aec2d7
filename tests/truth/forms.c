#include "truth/forms.h"

#include <math.h>

#define PI 3.14159265358979323846

double truth_dot(truth_vec a, truth_vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

truth_vec truth_add(truth_vec a, double s, truth_vec b)
{
    return (truth_vec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

truth_vec truth_cross(truth_vec a, truth_vec b)
{
    return (truth_vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* The area under the unit circle's upper half from 0 to x. */
static double under_circle(double x)
{
    return 0.5 * (x * sqrt(1.0 - x * x) + asin(x));
}

double truth_disk_part(double s)
{
    if (!(fabs(s) < 1.0))
        return s > 0.0 ? 1.0 : 0.0;
    return 0.5 + 2.0 * under_circle(s) / PI;
}

double truth_disk_corner(double a, double b)
{
    /* Where the corner is outside, no point is beyond both lines, or all points beyond one are
     * beyond the other. */
    if (a * a + b * b >= 1.0) {
        const double least = fmin(truth_disk_part(a), truth_disk_part(b));
        return a > 0.0 && b > 0.0   ? truth_disk_part(a) + truth_disk_part(b) - 1.0
               : a < 0.0 && b < 0.0 ? 0.0
                                    : least;
    }
    /* For x from -root to a up to b; for b above 0, left of that, up to the circle. */
    const double root = sqrt(1.0 - b * b);
    const double below = under_circle(a) + under_circle(root) + b * (a + root);
    const double left = 2.0 * (under_circle(1.0) - under_circle(root));
    return (below + (b > 0.0 ? left : 0.0)) / PI;
}

/* The volume of a cube's corner cut off by a plane, by inclusion and exclusion of its vertices. */
double truth_sum_below(const double *widths, int count, double t)
{
    double used[8], product = 1.0, whole = 0.0, sum = 0.0;
    int n = 0;
    for (int i = 0; i < count; ++i) {
        if (widths[i] < 1e-9)
            continue;
        used[n++] = widths[i];
        product *= widths[i] * n;
        whole += widths[i];
        t += 0.5 * widths[i];
    }
    /* Far from the edge, as most are, and where there is nothing random. */
    if (t <= 0.0 || t >= whole)
        return t > 0.0 ? 1.0 : 0.0;
    for (unsigned set = 0; set < 1u << n; ++set) {
        double rest = t, sign = 1.0;
        for (int i = 0; i < n; ++i) {
            if (set >> i & 1) {
                rest -= used[i];
                sign = -sign;
            }
        }
        sum += rest > 0.0 ? sign * pow(rest, n) : 0.0;
    }
    return fmin(fmax(sum / product, 0.0), 1.0);
}

double truth_half_hidden(truth_vec p, truth_vec lamp, double radius, truth_vec edge,
                         truth_vec along, truth_vec open)
{
    /* The plane through p and the edge cuts the disk's plane in a line. */
    truth_vec normal = truth_cross(truth_add(edge, -1.0, p), along);
    if (truth_dot(normal, open) < 0.0)
        normal = (truth_vec){-normal.x, -normal.y, -normal.z};
    const truth_vec way = truth_add(lamp, -1.0, p);
    const double beyond = truth_dot(normal, way);
    const truth_vec in_disk = truth_add(normal, -beyond / truth_dot(way, way), way);
    return truth_disk_part(beyond / (radius * sqrt(truth_dot(in_disk, in_disk))));
}

bool truth_meet_sphere(const truth_ray *ray, truth_vec center, double radius, double *way,
                       double *inside)
{
    const truth_vec to = truth_add(center, -1.0, ray->origin);
    const double length = sqrt(truth_dot(ray->direction, ray->direction));
    const double along = truth_dot(to, ray->direction) / length;
    const double half2 = radius * radius - truth_dot(to, to) + along * along;
    if (!(half2 > 0.0 && along > 0.0))
        return false;
    *way = along - sqrt(half2);
    *inside = 2.0 * sqrt(half2);
    return true;
}

truth_vec truth_floor(const truth_ray *ray)
{
    return truth_add(ray->origin, -ray->origin.z / ray->direction.z, ray->direction);
}
