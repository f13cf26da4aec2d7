/* Vectors of the host, in double. */
#ifndef RT_COMMON_VEC3_H
#define RT_COMMON_VEC3_H

#include <math.h>

typedef struct vec3 {
    double x, y, z;
} vec3;

/* a + s * b */
static inline vec3 vec3_plus(vec3 a, double s, vec3 b)
{
    return (vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline vec3 vec3_cross(vec3 a, vec3 b)
{
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double vec3_dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Not finite for the zero vector. */
static inline vec3 vec3_unit(vec3 a)
{
    const double length = sqrt(vec3_dot(a, a));
    return (vec3){a.x / length, a.y / length, a.z / length};
}

static inline vec3 vec3_of(const float a[3])
{
    return (vec3){(double)a[0], (double)a[1], (double)a[2]};
}

static inline void vec3_store(vec3 a, float out[3])
{
    out[0] = (float)a.x;
    out[1] = (float)a.y;
    out[2] = (float)a.z;
}

#endif
