#include "scene/triangle.h"

#include <math.h>

#include "kernels/layout.h"
#include "scene/places.h"

bool rt_triangle_is_degenerate(const rt_triangle *t)
{
    vec3 c[3];
    rt_triangle_corners(t, c);
    /* Products of two 25-bit differences are exact in double, so zero means zero, as long as the
     * corners' magnitudes are within 2^28 of each other. */
    const vec3 normal = vec3_cross(vec3_plus(c[1], -1.0, c[0]), vec3_plus(c[2], -1.0, c[0]));
    return normal.x == 0.0 && normal.y == 0.0 && normal.z == 0.0;
}

bool rt_triangle_settle(rt_triangle *t, float *normals)
{
    float largest = 0.0f;
    for (int i = 0; normals && i < RT_NORMAL_COMPONENTS; ++i)
        largest = fmaxf(largest, fabsf(normals[i]));
    /* In double, since the factor may be outside fp32. */
    const double factor = largest > 0.0f ? ldexp(1.0, -ilogbf(largest)) : 1.0;
    for (int i = 0; normals && i < RT_NORMAL_COMPONENTS; ++i)
        normals[i] = (float)(factor * (double)normals[i]);
    if (!rt_triangle_is_degenerate(t))
        return true;
    *t = (rt_triangle){t->ax, t->ay, t->az, t->ax, t->ay, t->az, t->ax, t->ay, t->az};
    return false;
}
