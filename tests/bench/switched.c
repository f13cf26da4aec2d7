#define _GNU_SOURCE
#include "bench/switched.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/folder.h"
#include "common/clock.h"
#include "common/parallel.h"
#include "render/state.h"
#include "scene_file/read.h"

#define SAMPLES_MOST 4

/* One way to compile, in turns with the other. */
typedef struct way {
    rt_effects effects;
    rt_renderer *renderer; /* owned */
    rt_image image;        /* owned */
} way;

static double kernel_seconds(const rt_renderer *renderer)
{
    const rt_render_times *times = rt_renderer_times(renderer);
    double sum = 0.0;
    for (int i = 0; i < RT_STAGE_COUNT; ++i)
        sum += times->stages[i];
    return sum;
}

static bool take_turn(void *context, double *seconds, rt_status *status)
{
    way *w = context;
    const double before = kernel_seconds(w->renderer);
    if (!rt_renderer_draw(w->renderer, &w->image, NULL, status))
        return false;
    *seconds = kernel_seconds(w->renderer) - before;
    return true;
}

static void make_small(rt_scene *scene, int size)
{
    const double scale = (double)size / fmax(scene->width, scene->height);
    scene->width = (int)lround(scene->width * scale);
    scene->height = (int)lround(scene->height * scale);
    if (scene->samples > SAMPLES_MOST)
        scene->samples = SAMPLES_MOST;
    if (scene->occlusion_samples > SAMPLES_MOST)
        scene->occlusion_samples = SAMPLES_MOST;
    for (size_t i = 0; i < scene->light_count; ++i)
        if (scene->lights[i].samples > SAMPLES_MOST)
            scene->lights[i].samples = SAMPLES_MOST;
}

/* Runtimes compile when a program is built or when a kernel is first launched: what counts is how
 * much longer the first picture takes, the making of the renderer included. */
static bool make_way(way *w, const rt_device *device, const rt_scene *scene, const rt_bvh *bvh,
                     enum rt_effects_mode mode, double *build, size_t *binary, rt_status *status)
{
    w->effects = rt_effects_of(scene);
    w->effects.mode = mode;
    const rt_render_options options = {.effects = &w->effects};
    if (!rt_image_init(&w->image, scene->width, scene->height, false, status))
        return false;
    w->renderer = rt_renderer_new(device, scene, bvh, &options, status);
    if (!w->renderer)
        return false;
    const double start = rt_clock_seconds();
    if (!rt_renderer_draw(w->renderer, &w->image, NULL, status))
        return false;
    const double middle = rt_clock_seconds();
    if (!rt_renderer_draw(w->renderer, &w->image, NULL, status))
        return false;
    const double first = middle - start, second = rt_clock_seconds() - middle;
    *build = rt_renderer_times(w->renderer)->program + fmax(0.0, first - second);
    *binary = 0;
    for (int part = 0; part < RT_PART_COUNT; ++part) {
        const cl_program program = w->renderer->programs.parts[part];
        size_t size = 0;
        if (program &&
            !RT_CL(clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, NULL),
                   status))
            return false;
        *binary += size;
    }
    return true;
}

/* What the scene calls for goes first: whatever the first build of a process takes besides is at
 * its cost. */
static bool measure_ways(bench_switched *s, bench *b, const rt_scene *scene, const rt_bvh *bvh,
                         way ways[2])
{
    static const enum rt_effects_mode modes[2] = {RT_EFFECTS_SCENE, RT_EFFECTS_ALL};
    bench_contender contenders[2] = {{.name = "scene"}, {.name = "all"}};
    for (int i = 0; i < 2; ++i) {
        if (!make_way(&ways[i], b->device, scene, bvh, modes[i], &s->build[i], &s->binary[i],
                      &b->status))
            return false;
        contenders[i].run = take_turn;
        contenders[i].context = &ways[i];
    }
    const int repeats = b->settings.repeats;
    const bool good = bench_measure(contenders, 2, repeats, &b->status);
    if (good) {
        for (int i = 0; i < 2; ++i)
            s->frame[i] = bench_quartiles_of(contenders[i].seconds, repeats);
        s->ratio = bench_ratio(contenders[1].seconds, contenders[0].seconds, repeats);
    }
    bench_contenders_clear(contenders, 2);
    if (!good)
        return false;
    const rt_image_difference apart = rt_image_compare(&ways[0].image, &ways[1].image);
    return apart.max_step <= 1 ||
           rt_status_fail(&b->status, RT_DIFFERENT, "bench: %s: the pictures are %d steps apart",
                          s->input, apart.max_step);
}

static bool measure_scene(bench_switched *s, bench *b, const char *name, int size)
{
    char path[128];
    rt_scene scene;
    rt_bvh bvh = {0};
    way ways[2] = {{.renderer = NULL}, {.renderer = NULL}};
    snprintf(path, sizeof path, "scenes/%s.txt", name);
    rt_scene_init(&scene);
    bool good = rt_scene_read(&scene, path, &b->status);
    scene.accuracy = RT_ACCURACY_STANDARD;
    if (good) {
        make_small(&scene, size);
        s->width = scene.width;
        s->height = scene.height;
        snprintf(s->input, sizeof s->input, "%s %dx%d, %d sample%s", name, scene.width,
                 scene.height, scene.samples, scene.samples > 1 ? "s" : "");
        good = rt_bvh_build(&bvh, &scene, rt_parallel_processors(), &b->status) &&
               bench_find_device(b) && measure_ways(s, b, &scene, &bvh, ways);
    }
    for (int i = 0; i < 2; ++i) {
        rt_renderer_free(ways[i].renderer);
        rt_image_clear(&ways[i].image);
    }
    rt_bvh_clear(&bvh);
    rt_scene_clear(&scene);
    return good;
}

/* The process of its own: the exit code is all that it says besides *s. */
static void measure_and_exit(bench_switched *s, bench *b, const char *folder, const char *name,
                             int size)
{
    setenv("POCL_CACHE_DIR", folder, 1);
    setenv("RT_CACHE_DIR", folder, 1);
    const bool good = measure_scene(s, b, name, size);
    if (!good && b->status.text)
        fputs(b->status.text, stderr);
    fflush(stderr);
    _exit(good ? 0 : (int)b->status.code);
}

static bool measure_apart(bench_switched *s, bench *b, const char *folder, const char *name,
                          int size)
{
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0)
        measure_and_exit(s, b, folder, name, size);
    int how = 0;
    if (child < 0 || waitpid(child, &how, 0) != child)
        return rt_status_fail(&b->status, RT_ERROR_DEVICE, "bench: cannot start a process");
    return (WIFEXITED(how) && WEXITSTATUS(how) == RT_OK) ||
           rt_status_fail(&b->status,
                          WIFEXITED(how) ? (enum rt_code)WEXITSTATUS(how) : RT_ERROR_DEVICE,
                          "bench: %s could not be measured", name);
}

bool bench_switched_measure(bench_switched *switched, bench *b, const char *name, int size)
{
    char folder[BENCH_FOLDER_SIZE];
    bench_switched *shared =
        mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED)
        return rt_status_no_memory(&b->status, "what a process tells");
    bool good = bench_folder_make(folder, &b->status);
    if (good) {
        good = measure_apart(shared, b, folder, name, size);
        bench_folder_remove(folder);
    }
    *switched = *shared;
    munmap(shared, sizeof *shared);
    return good;
}

double bench_switched_pictures(const bench_switched *s)
{
    const double saved = s->frame[1].median - s->frame[0].median;
    return saved > 0.0 ? s->build[0] / saved : INFINITY;
}
