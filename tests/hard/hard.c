#define _GNU_SOURCE
#include "hard/hard.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RAYS_DEFAULT 250000
/* Naive variants hold every ray against every primitive, in plain C. */
#define RAYS_NAIVE 20000

size_t hard_rays(const hard_way *way)
{
    const char *text = getenv("RT_HARD_RAYS");
    const double wanted = text && *text ? atof(text) : RAYS_DEFAULT;
    const size_t all = wanted >= 1.0 ? (size_t)wanted : RAYS_DEFAULT;
    if (way->naive)
        return all < RAYS_NAIVE ? all : RAYS_NAIVE;
    return way->level >= RT_ACCURACY_ROBUST || all < 10 ? all : all / 10;
}

double hard_per_million(size_t events, size_t of)
{
    return of ? 1e6 * (double)events / (double)of : NAN;
}

const char *hard_naive_name(const hard_naive *naive)
{
    return naive->name ? naive->name : test_mutations[naive->mutant].what;
}

static bool is_there(enum rt_accuracy level)
{
    return level != RT_ACCURACY_DOUBLE || test_device()->has_fp64;
}

/* Written so that NaN is out. */
static bool is_lawful(double figure, double gate)
{
    return gate == HARD_REPORT ? !isnan(figure) : figure <= gate;
}

static size_t figure_count(const hard_case *c)
{
    size_t count = 0;
    while (count < HARD_FIGURES && c->figures[count].what)
        ++count;
    return count;
}

static void print_cell(double figure, double gate)
{
    char text[64];
    if (isnan(figure))
        snprintf(text, sizeof text, "nothing");
    else
        snprintf(text, sizeof text, "%.3g", figure);
    if (gate == HARD_REPORT)
        printf(" %s |", text);
    else if (is_lawful(figure, gate))
        printf(" %s (<= %.3g) |", text, gate);
    else
        printf(" **%s, not <= %.3g** |", text, gate);
}

/* The variants that break what robust, or naive_level, promises: all must, each by one of the
 * figures. */
static bool hold_naives(const hard_case *c, size_t figures, char cells[][256])
{
    const enum rt_accuracy naive_level = c->naive_level ? c->naive_level : RT_ACCURACY_ROBUST;
    bool good = true;
    for (size_t f = 0; f < figures; ++f)
        cells[f][0] = 0;
    for (int n = 0; n < HARD_NAIVES && c->naives[n]; ++n) {
        const enum rt_accuracy level =
            c->naives[n]->at_robust ? RT_ACCURACY_ROBUST : RT_ACCURACY_STANDARD;
        const hard_way way = {hard_naive_name(c->naives[n]), level, c->naives[n], false};
        double values[HARD_FIGURES] = {0.0};
        bool is_caught = false;
        c->measure(&way, c->of, values);
        for (size_t f = 0; f < figures; ++f) {
            const size_t used = strlen(cells[f]);
            const double gate = c->figures[f].gates[naive_level];
            is_caught = is_caught || (gate != HARD_REPORT && !is_lawful(values[f], gate));
            snprintf(cells[f] + used, 256 - used, "%s%s %.3g", n ? ", " : "",
                     hard_naive_name(c->naives[n]), values[f]);
        }
        if (!is_caught)
            print_error("row %d, %s: lets %s pass\n", c->row, c->name,
                        hard_naive_name(c->naives[n]));
        good = good && is_caught;
    }
    return good;
}

static int broken;

void hard_hold(const hard_case *c)
{
    const size_t figures = figure_count(c);
    double values[RT_ACCURACY_COUNT][HARD_FIGURES] = {{0.0}};
    char naive[HARD_FIGURES][256];
    bool good = true;
    for (int level = 0; level < RT_ACCURACY_COUNT; ++level) {
        const hard_way way = {rt_accuracy_name((enum rt_accuracy)level), (enum rt_accuracy)level,
                              NULL, c->by_brute_force};
        if (is_there(way.level))
            c->measure(&way, c->of, values[level]);
    }
    good = hold_naives(c, figures, naive);
    for (size_t f = 0; f < figures; ++f) {
        const hard_figure *figure = &c->figures[f];
        bool holds = true;
        printf("| %d | %s: %s | %s |", c->row, c->name, figure->what, naive[f][0] ? naive[f] : "-");
        for (int level = 0; level < RT_ACCURACY_COUNT; ++level) {
            if (!is_there((enum rt_accuracy)level)) {
                printf(" no fp64 |");
                continue;
            }
            const double gate = figure->gates[level];
            print_cell(values[level][f], gate);
            holds = holds && is_lawful(values[level][f], gate);
        }
        printf(" %s |\n", holds ? "yes" : "**no**");
        good = good && holds;
    }
    fflush(stdout);
    broken += !good;
}

void hard_finish(void)
{
    const int count = broken;
    broken = 0;
    if (count > 0)
        fail_msg("%d cases do not hold", count);
}

static void *copy_of(const void *from, size_t size)
{
    void *to = malloc(size ? size : 1);
    assert_non_null(to);
    if (size)
        memcpy(to, from, size);
    return to;
}

/* A renderer for the scene in the unit of length that a scene from a file would get. The scene
 * itself stays as it is, for oracles to look at. */
static rt_renderer *renderer_of(const rt_scene *scene, const rt_render_options *options)
{
    rt_scene own = *scene;
    own.triangles = copy_of(scene->triangles, scene->triangle_count * sizeof *scene->triangles);
    own.spheres = copy_of(scene->spheres, scene->sphere_count * sizeof *scene->spheres);
    own.materials = copy_of(scene->materials, scene->material_count * sizeof *scene->materials);
    own.lights = copy_of(scene->lights, scene->light_count * sizeof *scene->lights);
    rt_scene_choose_unit(&own);
    rt_scene_settle_lights(&own);
    rt_renderer *renderer = test_renderer(&own, options);
    free(own.triangles);
    free(own.spheres);
    free(own.materials);
    free(own.lights);
    return renderer;
}

static void open_tracer(hard_tracer *tracer, const hard_way *way, rt_scene *scene,
                        bool with_occlusion)
{
    const rt_render_options options = {.with_occlusion = with_occlusion};
    scene->accuracy = way->level;
    *tracer = (hard_tracer){scene, NULL, NULL};
    if (way->naive && way->naive->trace) {
        tracer->naive = way->naive;
        return;
    }
    if (way->naive && way->naive->mutant)
        test_mutate_kernels(way->naive->mutant);
    test_use_tree(!way->by_brute_force);
    tracer->renderer = renderer_of(scene, &options);
    test_use_tree(true);
    test_restore_kernels();
}

void hard_open(hard_tracer *tracer, const hard_way *way, rt_scene *scene)
{
    open_tracer(tracer, way, scene, false);
}

void hard_draw(const hard_way *way, rt_scene *scene, rt_image *image)
{
    scene->accuracy = way->level;
    if (way->naive && way->naive->mutant)
        test_mutate_kernels(way->naive->mutant);
    test_draw(scene, NULL, image);
    test_restore_kernels();
}

void hard_trace(hard_tracer *tracer, const rt_ray *rays, size_t count, rt_hit *hits)
{
    rt_status status = RT_STATUS_INIT;
    if (tracer->naive)
        tracer->naive->trace(tracer->scene, rays, count, hits);
    else
        assert_good(rt_renderer_trace(tracer->renderer, rays, count, hits, &status), &status);
}

size_t hard_open_rays(const hard_way *way, rt_scene *scene, const rt_ray *rays, size_t count)
{
    static uint8_t occluded[HARD_CHUNK];
    rt_status status = RT_STATUS_INIT;
    hard_tracer tracer;
    size_t open = 0;
    open_tracer(&tracer, way, scene, true);
    for (size_t done = 0; done < count; done += HARD_CHUNK) {
        const size_t part = count - done < HARD_CHUNK ? count - done : HARD_CHUNK;
        assert_good(rt_renderer_occluded(tracer.renderer, rays + done, part, occluded, &status),
                    &status);
        for (size_t i = 0; i < part; ++i)
            open += !occluded[i];
    }
    hard_close(&tracer);
    return open;
}

void hard_close(hard_tracer *tracer)
{
    rt_renderer_free(tracer->renderer);
    *tracer = (hard_tracer){NULL, NULL, NULL};
}

void hard_scene(rt_scene *scene)
{
    const float grey[3] = {0.5f, 0.5f, 0.5f}, zero[3] = {0.0f, 0.0f, 0.0f};
    const rt_material material = rt_material_make(grey, grey, zero, 1.0f);
    rt_status status = RT_STATUS_INIT;
    rt_scene_init(scene);
    assert_good(rt_scene_add_material(scene, &material, &status), &status);
}

/* A scene that was read already has a unit of its own. */
void hard_add_triangle(rt_scene *scene, const float corners[9])
{
    rt_triangle triangle;
    rt_status status = RT_STATUS_INIT;
    float scaled[9];
    for (int i = 0; i < 9; ++i)
        scaled[i] = ldexpf(corners[i], scene->unit_exponent);
    memcpy(&triangle, scaled, sizeof triangle);
    assert_good(rt_scene_add_triangle(scene, &triangle, NULL, 0, &status), &status);
}

void hard_add_sphere(rt_scene *scene, float x, float y, float z, float radius)
{
    const int unit = scene->unit_exponent;
    const rt_sphere sphere = {ldexpf(x, unit), ldexpf(y, unit), ldexpf(z, unit),
                              ldexpf(radius, unit)};
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_scene_add_sphere(scene, &sphere, 0, &status), &status);
}

void hard_read(rt_scene *scene, const char *format, ...)
{
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    assert_true(vasprintf(&text, format, arguments) > 0);
    va_end(arguments);
    test_scene(scene, text);
    free(text);
}
