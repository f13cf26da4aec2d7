/* The largest picture, by its last tiles, and the smallest: row 39 of the hard cases. */
#define _GNU_SOURCE
#include "hard/hard.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "scene/camera.h"

#define TOLD HARD_REPORT

#define LARGEST 16384
#define TAIL 3 /* tiles that are rendered, the picture's last */

/* Room for so much a pixel of the largest picture. Memory that is not touched is not there, and is
 * not asked for either: a machine may have less than this. */
static void *reserve(size_t size)
{
    void *room = mmap(NULL, (size_t)LARGEST * LARGEST * size, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    assert_true(room != MAP_FAILED);
    return room;
}

static void release(rt_image *image)
{
    munmap(image->rgb, (size_t)LARGEST * LARGEST * 3 * sizeof *image->rgb);
    munmap(image->hits, (size_t)LARGEST * LARGEST * sizeof *image->hits);
}

/* The largest picture: 2^28 pixels, of which only the last tiles are rendered. */
static void draw_tail(const hard_way *way, rt_scene *scene, int side, rt_image *image)
{
    if (way->naive)
        test_mutate_kernels(way->naive->mutant);
    rt_status status = RT_STATUS_INIT;
    const rt_render_options options = {.tile = side, .with_hits = true};
    rt_tiles tiles;
    scene->accuracy = way->level;
    *image = (rt_image){.width = LARGEST, .height = LARGEST};
    image->rgb = reserve(3 * sizeof *image->rgb);
    image->hits = reserve(sizeof *image->hits);
    rt_renderer *renderer = test_renderer(scene, &options);
    test_restore_kernels();
    rt_tiles_init(&tiles, LARGEST, LARGEST, side, 1);
    atomic_store(&tiles.taken, tiles.count - TAIL);
    assert_good(rt_renderer_draw_tiles(renderer, &tiles, NULL, image, NULL, &status), &status);
    rt_renderer_free(renderer);
}

#define CORNER 64 /* pixels a side that are compared: within the last tile at both sizes */

/* The corner at two sizes of tiles, and by rays that are made here, in float. */
static void measure_largest(const hard_way *way, const void *of, double figures[])
{
    rt_scene scene;
    rt_image image, other;
    (void)of;
    test_scene(&scene, "image width 16384 height 16384\ncamera from 0 0 2 at 0 0 0 vfov 90\n"
                       "light point at 1 2 3\nmaterial m kd 1 1 1\nsphere center 0.5 -0.5 1 "
                       "radius 0.5 material m\n"
                       "triangle a -9 -9 -1 b 9 -9 -1 c 0 9 -1 material m\n");
    draw_tail(way, &scene, 128, &image);
    draw_tail(way, &scene, 256, &other);
    const rt_frame f = rt_scene_frame(&scene);
    figures[0] = figures[1] = 0.0;
    for (int i = 0; i < CORNER * CORNER; ++i) {
        const int x = LARGEST - CORNER + i % CORNER, y = LARGEST - CORNER + i / CORNER;
        const size_t at = (size_t)y * LARGEST + (size_t)x;
        rt_hit expected;
        const rt_ray ray = {{f.ox, f.oy, f.oz},
                            {(float)(2 * x + 1 - LARGEST) * f.right_x,
                             (float)(LARGEST - 1 - 2 * y) * f.up_y, f.forward_z},
                            0.0f,
                            INFINITY};
        rt_scalar_double_trace(&scene, &ray, 1, &expected);
        figures[0] += memcmp(&image.hits[at], &other.hits[at], sizeof expected) != 0 ||
                      memcmp(image.rgb + 3 * at, other.rgb + 3 * at, 3 * sizeof *image.rgb) != 0;
        figures[1] += image.hits[at].primitive != expected.primitive ||
                      !(fabsf(image.hits[at].u - expected.u) < 1e-5f);
    }
    release(&image);
    release(&other);
    rt_scene_clear(&scene);
}

static void sizes(void **state)
{
    (void)state;
    static const hard_naive few_bits = {.mutant = MUTANT_COLUMN_OF_13_BITS};
    const hard_case c = {
        .row = 39,
        .name = "the last corner of 16384 x 16384 pixels",
        .figures = {{"pixels that depend on the tiles", {0, 0, 0, 0}},
                    {"pixels that see another place than they should", {0, 0, 0, 0}}},
        .naives = {&few_bits},
        .measure = measure_largest};
    hard_hold(&c);
    hard_finish();
}

/* One pixel is the middle pixel of three by three that are as large. */
static void measure_one(const hard_way *way, const void *of, double figures[])
{
    static const char format[] = "image width %d height %d\ncamera from 0 0 2 at 0 0 0 vfov %.9g\n"
                                 "light point at 1 2 3\nmaterial m kd 1 1 1\n"
                                 "sphere center 0.1 0.1 0 radius 1 material m\n";
    rt_image images[2];
    (void)of;
    for (int i = 0; i < 2; ++i) {
        char text[400];
        rt_scene scene;
        snprintf(text, sizeof text, format, i ? 3 : 1, i ? 3 : 1, i ? 90.0 : 36.8698976458);
        test_scene(&scene, text);
        hard_draw(way, &scene, &images[i]);
        rt_scene_clear(&scene);
    }
    const rt_hit *one = &images[0].hits[0], *middle = &images[1].hits[4];
    figures[0] = memcmp(one, middle, sizeof *one) != 0;
    figures[1] = memcmp(images[0].rgb, images[1].rgb + 12, 3 * sizeof(float)) != 0;
    /* One ray goes with those beside it and the other alone: two loops, in which relaxed math may
     * round quotients differently, as the processor's estimate of a reciprocal has it. */
    if (way->level == RT_ACCURACY_FAST) {
        figures[0] = one->primitive != middle->primitive || !(fabsf(one->t - middle->t) < 1e-5f);
        figures[1] = !(fabsf(images[0].rgb[0] - images[1].rgb[12]) < 1e-5f);
    }
    rt_image_clear(&images[0]);
    rt_image_clear(&images[1]);
}

static void one_pixel(void **state)
{
    (void)state;
    const hard_case c = {.row = 39,
                         .name = "a picture of one pixel",
                         .figures = {{"hits that differ from the middle of 3 x 3", {0, 0, 0, 0}},
                                     {"colours that do", {0, 0, 0, 0}}},
                         .measure = measure_one};
    hard_hold(&c);
    hard_finish();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes),
        cmocka_unit_test(one_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
