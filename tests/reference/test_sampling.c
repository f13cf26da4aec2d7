/* The reference's sample points against what they are meant to be, in double. */
#include "support/support.h"

#include <string.h>

#define RT_SCALAR_DOUBLE
#include "reference/effects.h"

#define PI 3.14159265358979323846

/* Sobol's sequence in two dimensions by its definition: the base-2 digits of the index times
 * Pascal's matrix modulo 2, mirrored at the point. */
static void sobol_is_pascal_s_triangle(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 4096; ++i) {
        const uint32_t index = i * UINT32_C(1048583);
        uint32_t x = 0, y = 0, point[2];
        for (uint32_t row = 0; row < 32; ++row) {
            uint32_t sum = 0;
            /* The binomial coefficient (column over row) is odd where row's bits are in column. */
            for (uint32_t column = 0; column < 32; ++column)
                sum += (index >> column & 1) * ((column & row) == row);
            x |= (index >> row & 1) << (31 - row);
            y |= (sum & 1) << (31 - row);
        }
        rt_scalar_double_sobol(index, point);
        assert_int_equal(point[0], x);
        assert_int_equal(point[1], y);
    }
}

/* Of 2^k points from a multiple of 2^k on, each of the 2^k rectangles of any shape that are
 * 2^-a by 2^(a-k) holds one: that is what makes means of them good. */
static void every_elementary_interval_holds_one_point(void **state)
{
    (void)state;
    for (uint32_t purpose = 0; purpose < 20; ++purpose)
        for (int k = 0; k <= 12; ++k) {
            const stream s = {31 * purpose, 7, 0, purpose % 3, purpose};
            const uint32_t count = UINT32_C(1) << k, first = count * (purpose % 5);
            for (int a = 0; a <= k; ++a) {
                static unsigned char taken[4096];
                memset(taken, 0, sizeof taken);
                for (uint32_t i = 0; i < count; ++i) {
                    const pair p = rt_scalar_double_sample_point(&s, purpose, first + i);
                    assert_true(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
                    const size_t column = (size_t)ldexp(p.x, a), row = (size_t)ldexp(p.y, k - a);
                    assert_int_equal(taken[(row << a) + column]++, 0);
                }
            }
        }
}

/* Each point alone is evenly distributed over the pixels: no count of samples leaves anything out.
 * The chi-squared of 64 cells has the mean 63 and the deviation 11.2. */
static void every_point_is_evenly_distributed(void **state)
{
    (void)state;
    const uint32_t side = 128;
    for (uint32_t index = 0; index < 100; index += 1 + index / 16) {
        uint32_t counts[64] = {0};
        for (uint32_t i = 0; i < side * side; ++i) {
            const stream s = {i % side, i / side, 0, 0, 0};
            const pair p = rt_scalar_double_sample_point(&s, FOR_LENS, index);
            ++counts[(int)(8 * p.x) + 8 * (int)(8 * p.y)];
        }
        const double expected = side * side / 64.0;
        double chi = 0;
        for (int c = 0; c < 64; ++c)
            chi += (counts[c] - expected) * (counts[c] - expected) / expected;
        assert_true(chi > 63 - 4 * 11.2 && chi < 63 + 4 * 11.2);
    }
}

/* Sets of neighbours, of other uses and of other rays have nothing to do with each other: the
 * correlation of two such sequences is that of chance, about 1 / sqrt(10000). */
static void sets_are_independent(void **state)
{
    (void)state;
    const uint32_t count = 10000;
    for (int kind = 0; kind < 6; ++kind) {
        double sum = 0, squares = 0;
        for (uint32_t i = 0; i < count; ++i) {
            stream a = {i % 100, i / 100, 0, 0, 0}, b = a;
            b.x += kind == 0;
            b.y += kind == 1;
            b.step += kind == 2;
            b.seed += kind == 3;
            const uint32_t purpose = FOR_LIGHT + (kind == 4);
            const double x = rt_scalar_double_sample_point(&a, FOR_LIGHT, 0).x - 0.5;
            const pair other = rt_scalar_double_sample_point(&b, purpose, 0);
            const double y = (kind == 5 ? other.y : other.x) - 0.5;
            sum += x * y;
            squares += x * x;
        }
        assert_near(squares / count, 1.0 / 12.0, 0.003);
        assert_near(sum / squares, 0.0, 0.05);
    }
}

/* Half of the bits of the result change with any bit of the argument. */
static void mixing_spreads_every_bit(void **state)
{
    (void)state;
    const uint32_t count = 4096;
    for (int bit = 0; bit < 32; ++bit) {
        int changed = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t x = i * UINT32_C(0x9e3779b9);
            changed += __builtin_popcount(rt_scalar_double_mix(x) ^
                                          rt_scalar_double_mix(x ^ UINT32_C(1) << bit));
        }
        assert_near((double)changed / count, 16.0, 0.5);
    }
}

static void filters_have_their_mean_and_variance(void **state)
{
    (void)state;
    const int count = 100000;
    const struct {
        enum rt_filter filter;
        double reach, variance;
    } filters[] = {{RT_FILTER_BOX, 0.5, 1.0 / 12.0}, {RT_FILTER_TENT, 1.0, 1.0 / 6.0}};
    for (size_t i = 0; i < 2; ++i) {
        double mean = 0, square = 0;
        for (int k = 0; k < count; ++k) {
            const double x = rt_scalar_double_filtered(filters[i].filter, (k + 0.5) / count);
            mean += x / count;
            square += x * x / count;
        }
        assert_near(mean, 0.0, 1e-9);
        assert_near(square, filters[i].variance, 1e-6);
        assert_near(rt_scalar_double_filtered(filters[i].filter, 0.0), -filters[i].reach, 0.0);
        assert_near(rt_scalar_double_filtered(filters[i].filter, 1.0), filters[i].reach, 0.0);
        assert_near(rt_scalar_double_filtered(filters[i].filter, 0.5), 0.0, 1e-15);
    }
}

static void sine_and_cosine_are_near_the_library_s(void **state)
{
    (void)state;
    for (int i = -10000; i <= 10000; ++i) {
        const double phi = PI / 4 * i / 10000;
        double sine, cosine;
        rt_scalar_double_sine_cosine(phi, &sine, &cosine);
        assert_near(sine, sin(phi), 1e-7);
        assert_near(cosine, cos(phi), 1e-7);
    }
}

/* The determinant of the map's derivative is the disk's area everywhere. */
static void the_disk_keeps_areas(void **state)
{
    (void)state;
    const double h = 1e-5;
    test_random random = {1};
    for (int i = 0; i < 10000; ++i) {
        const double u = (double)test_random_float(&random, 0.01f, 0.99f);
        const double v = (double)test_random_float(&random, 0.01f, 0.99f);
        /* Not across a diagonal, where two smooth maps meet. */
        if (fabs(fabs(2 * u - 1) - fabs(2 * v - 1)) < 4 * h)
            continue;
        const pair right = rt_scalar_double_disk((pair){u + h, v});
        const pair left = rt_scalar_double_disk((pair){u - h, v});
        const pair above = rt_scalar_double_disk((pair){u, v + h});
        const pair below = rt_scalar_double_disk((pair){u, v - h});
        const double xu = (right.x - left.x) / (2 * h), xv = (above.x - below.x) / (2 * h);
        const double yu = (right.y - left.y) / (2 * h), yv = (above.y - below.y) / (2 * h);
        assert_near(xu * yv - xv * yu, PI, 1e-5);
    }
}

static void the_square_s_border_becomes_the_circle(void **state)
{
    (void)state;
    for (int i = 0; i <= 100; ++i) {
        const double t = i / 100.0;
        const pair sides[] = {{t, 0}, {t, 1}, {0, t}, {1, t}};
        for (size_t k = 0; k < 4; ++k) {
            const pair p = rt_scalar_double_disk(sides[k]);
            assert_near(hypot(p.x, p.y), 1.0, 1e-7);
        }
    }
    const pair middle = rt_scalar_double_disk((pair){0.5, 0.5});
    assert_true(middle.x == 0 && middle.y == 0);
}

static void axes_are_at_right_angles(void **state)
{
    (void)state;
    test_random random = {2};
    for (int i = 0; i < 10000; ++i) {
        vec n = {(double)test_random_float(&random, -1, 1),
                 (double)test_random_float(&random, -1, 1),
                 (double)test_random_float(&random, -1, 1)};
        /* Near the poles, of which one is where sign + n.z could vanish. */
        if (i % 4 == 0)
            n = (vec){n.x * 1e-6, n.y * 1e-6, n.z < 0 ? -1 : 1};
        if (i % 100 == 0)
            n = (vec){0, 0, n.z};
        n = unit(n);
        vec t1, t2;
        rt_scalar_double_axes_about(n, &t1, &t2);
        assert_near(dot(t1, t1), 1.0, 1e-14);
        assert_near(dot(t2, t2), 1.0, 1e-14);
        assert_near(dot(t1, t2), 0.0, 1e-14);
        assert_near(dot(t1, n), 0.0, 1e-14);
        assert_near(dot(t2, n), 0.0, 1e-14);
        assert_near(dot(cross(t1, t2), n), 1.0, 1e-14);
    }
}

/* About any normal: unit vectors above the surface, of which the cosine has the mean 2/3 and the
 * variance 1/18 that its own weight gives it. */
static void the_hemisphere_is_cosine_weighted(void **state)
{
    (void)state;
    const uint32_t count = 4096;
    const vec normals[] = {{0, 0, 1}, {0, 0, -1}, {0.6, 0, -0.8}, {0.48, -0.6, 0.64}};
    for (size_t i = 0; i < sizeof normals / sizeof *normals; ++i) {
        const stream s = {(uint32_t)i, 5, 0, 0, 0};
        double mean = 0, square = 0;
        vec sum = {0, 0, 0};
        for (uint32_t k = 0; k < count; ++k) {
            const pair p = rt_scalar_double_sample_point(&s, FOR_OCCLUSION, k);
            const vec d = rt_scalar_double_hemisphere(p, normals[i]);
            const double cosine = dot(d, normals[i]);
            assert_near(dot(d, d), 1.0, 1e-12);
            assert_true(cosine >= 0);
            mean += cosine / count;
            square += cosine * cosine / count;
            sum = plus(sum, d);
        }
        assert_near(mean, 2.0 / 3.0, 1e-3);
        assert_near(square - mean * mean, 1.0 / 18.0, 1e-3);
        assert_near(dot(sum, sum) / count / count, 4.0 / 9.0, 2e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sobol_is_pascal_s_triangle),
        cmocka_unit_test(every_elementary_interval_holds_one_point),
        cmocka_unit_test(every_point_is_evenly_distributed),
        cmocka_unit_test(sets_are_independent),
        cmocka_unit_test(mixing_spreads_every_bit),
        cmocka_unit_test(filters_have_their_mean_and_variance),
        cmocka_unit_test(sine_and_cosine_are_near_the_library_s),
        cmocka_unit_test(the_disk_keeps_areas),
        cmocka_unit_test(the_square_s_border_becomes_the_circle),
        cmocka_unit_test(axes_are_at_right_angles),
        cmocka_unit_test(the_hemisphere_is_cosine_weighted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
