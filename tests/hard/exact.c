#include "hard/exact.h"

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <stdlib.h>

quad hard_root(quad x)
{
    if (!(x > 0))
        return 0;
    quad root = (quad)sqrtl((long double)x);
    for (int i = 0; i < 3; ++i)
        root = (root + x / root) / 2;
    return root;
}

static quad dot(const quad a[3], const quad b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(quad out[3], const quad a[3], const quad b[3])
{
    for (int k = 0; k < 3; ++k)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void take(quad out[3], const float a[3], const float minus[3])
{
    for (int k = 0; k < 3; ++k)
        out[k] = (quad)a[k] - (minus ? (quad)minus[k] : 0);
}

hard_truth hard_true_sphere(const rt_ray *ray, const rt_sphere *sphere)
{
    const float center[3] = {sphere->cx, sphere->cy, sphere->cz};
    const quad radius = (quad)sphere->radius;
    quad f[3], d[3], n[3];
    take(f, ray->origin, center);
    take(d, ray->direction, NULL);
    cross(n, f, d);
    const quad dd = dot(d, d), b = -dot(f, d);
    const quad distance = hard_root(dot(n, n) / dd);
    const double margin = (double)((distance - radius) / radius) * 0x1p23;
    const quad discriminant = radius * radius * dd - dot(n, n);
    hard_truth truth = {false, INFINITY, fabs(margin)};
    if (!(discriminant >= 0))
        return truth;
    const quad root = hard_root(discriminant);
    const quad c = dot(f, f) - radius * radius;
    const quad q = b + (b >= 0 ? root : -root);
    const quad sum = q / dd, product = c / q;
    const quad near = sum < product ? sum : product, far = sum < product ? product : sum;
    const quad t = near > 0 ? near : far;
    truth.is_hit = t > 0;
    truth.t = truth.is_hit ? (double)t : (double)INFINITY;
    return truth;
}

/* sum = a[i] * b[i] over the axes. */
static void dot_rational(mpq_t sum, mpq_t a[3], mpq_t b[3])
{
    mpq_t product;
    mpq_init(product);
    mpq_set_ui(sum, 0, 1);
    for (int k = 0; k < 3; ++k) {
        mpq_mul(product, a[k], b[k]);
        mpq_add(sum, sum, product);
    }
    mpq_clear(product);
}

bool hard_true_tangent(const rt_ray *ray, const rt_sphere *sphere)
{
    const float center[3] = {sphere->cx, sphere->cy, sphere->cz};
    mpq_t f[3], d[3], ff, fd, dd, c;
    mpq_inits(ff, fd, dd, c, (mpq_ptr)NULL);
    for (int k = 0; k < 3; ++k) {
        mpq_inits(f[k], d[k], (mpq_ptr)NULL);
        mpq_set_d(f[k], (double)ray->origin[k]);
        mpq_set_d(c, (double)center[k]);
        mpq_sub(f[k], f[k], c);
        mpq_set_d(d[k], (double)ray->direction[k]);
    }
    dot_rational(ff, f, f);
    dot_rational(fd, f, d);
    dot_rational(dd, d, d);
    /* (f.d)^2 - dd (f.f - r^2) >= 0 */
    mpq_set_d(c, (double)sphere->radius * (double)sphere->radius); /* 48 bits: exact */
    mpq_sub(ff, ff, c);
    mpq_mul(ff, ff, dd);
    mpq_mul(fd, fd, fd);
    const bool is_met = mpq_cmp(fd, ff) >= 0;
    for (int k = 0; k < 3; ++k)
        mpq_clears(f[k], d[k], (mpq_ptr)NULL);
    mpq_clears(ff, fd, dd, c, (mpq_ptr)NULL);
    return is_met;
}

hard_truth hard_true_triangle(const rt_ray *ray, const rt_triangle *s)
{
    const float a[3] = {s->ax, s->ay, s->az}, b[3] = {s->bx, s->by, s->bz};
    const float c[3] = {s->cx, s->cy, s->cz};
    quad d[3], e1[3], e2[3], p[3], q[3], o[3];
    take(d, ray->direction, NULL);
    take(e1, b, a);
    take(e2, c, a);
    take(o, ray->origin, a);
    cross(p, d, e2);
    cross(q, o, e1);
    quad det = dot(e1, p), u = dot(o, p), v = dot(d, q), t = dot(e2, q);
    if (det < 0) {
        det = -det;
        u = -u;
        v = -v;
        t = -t;
    }
    const bool is_hit = det > 0 && u >= 0 && v >= 0 && u + v <= det && t > 0;
    return (hard_truth){is_hit, is_hit ? (double)(t / det) : (double)INFINITY, 0.0};
}

double hard_ulps(double actual, double truth)
{
    const int exponent = truth == 0.0 ? FLT_MIN_EXP : ilogb(truth);
    return fabs(actual - truth) / ldexp(1.0, exponent - 23);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double hard_percentile(double *values, size_t count, double p)
{
    if (count == 0)
        return NAN;
    qsort(values, count, sizeof *values, compare);
    const size_t at = (size_t)ceil(p * (double)count);
    return values[at > 0 ? at - 1 : 0];
}
