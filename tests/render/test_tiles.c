/* The queue of tiles: all of the picture once, whoever takes them and however fast. */
#define _GNU_SOURCE
#include "support/support.h"

#include <pthread.h>
#include <stdlib.h>

#include "render/tiles.h"

/* Marks a tile's pixels; fails where one was marked before. */
static void mark(unsigned char *seen, const rt_tiles *tiles, const rt_tile *tile)
{
    assert_true(tile->width >= 1 && tile->height >= 1);
    assert_true(tile->x + tile->width <= tiles->width && tile->y + tile->height <= tiles->height);
    for (int y = tile->y; y < tile->y + tile->height; ++y)
        for (int x = tile->x; x < tile->x + tile->width; ++x)
            assert_int_equal(seen[y * tiles->width + x]++, 0);
}

static void every_pixel_once(void **state)
{
    (void)state;
    static const int cases[][3] = {{1, 1, 256}, {7, 93, 8}, {144, 5, 7}, {64, 64, 32}, {33, 65, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rt_tiles tiles;
        rt_tile tile;
        rt_tiles_init(&tiles, cases[i][0], cases[i][1], cases[i][2], 1);
        rt_taker taker = {&tiles, 0};
        const size_t pixels = (size_t)tiles.width * (size_t)tiles.height;
        unsigned char *seen = calloc(pixels, 1);
        assert_non_null(seen);
        for (int taken = 0; rt_tiles_take(&taker, &tile); ++taken) {
            assert_near(rt_tiles_done(&tiles), (double)taken / tiles.count, 1e-12);
            mark(seen, &tiles, &tile);
            rt_tiles_finish(&taker);
        }
        assert_near(rt_tiles_done(&tiles), 1.0, 0.0);
        assert_false(rt_tiles_take(&taker, &tile));
        for (size_t p = 0; p < pixels; ++p)
            assert_int_equal(seen[p], 1);
        free(seen);
    }
}

static void a_stop_leaves_none(void **state)
{
    (void)state;
    rt_tiles tiles;
    rt_tile tile;
    rt_tiles_init(&tiles, 64, 64, 8, 2);
    rt_taker one = {&tiles, 0}, other = {&tiles, 0};
    assert_true(rt_tiles_take(&one, &tile));
    rt_tiles_stop(&tiles);
    assert_false(rt_tiles_take(&one, &tile));
    assert_false(rt_tiles_take(&other, &tile));
}

/* Two takers by turns, the second after every `ratio` tiles of the first; returns what it had. */
static int tiles_of_the_slower(int count, int ratio)
{
    rt_tiles tiles;
    rt_tile tile;
    rt_tiles_init(&tiles, count, 1, 1, 2);
    rt_taker fast = {&tiles, 0}, slow = {&tiles, 0};
    bool is_out = !rt_tiles_take(&slow, &tile);
    assert_false(is_out);
    while (rt_tiles_done(&tiles) < 1.0) {
        for (int i = 0; i < ratio && rt_tiles_take(&fast, &tile); ++i)
            rt_tiles_finish(&fast);
        if (!is_out) {
            rt_tiles_finish(&slow);
            is_out = !rt_tiles_take(&slow, &tile);
        }
    }
    assert_int_equal(fast.finished + slow.finished, count);
    return slow.finished;
}

/* The share follows the speed, and a slow one does not begin what keeps the picture waiting. */
static void speeds(void **state)
{
    (void)state;
    assert_int_equal(tiles_of_the_slower(64, 1), 32);
    assert_near(tiles_of_the_slower(400, 3), 100, 1);
    assert_int_equal(tiles_of_the_slower(64, 50), 1); /* 13 are left, for which it takes too long */
    assert_near(tiles_of_the_slower(1000, 50), 19, 1);
    assert_int_equal(tiles_of_the_slower(4, 100), 1);
}

/* However the speeds look, somebody stays for the last tile. */
static void not_all_decline(void **state)
{
    (void)state;
    rt_tiles tiles;
    rt_tile tile;
    rt_tiles_init(&tiles, 1000, 1, 1, 3);
    rt_taker takers[3] = {{&tiles, 1}, {&tiles, 1}, {&tiles, 1}};
    atomic_store(&tiles.taken, 998);
    atomic_store(&tiles.finished, 998);
    assert_false(rt_tiles_take(&takers[0], &tile));
    assert_false(rt_tiles_take(&takers[2], &tile));
    assert_true(rt_tiles_take(&takers[1], &tile));
    assert_true(rt_tiles_take(&takers[1], &tile));
    assert_int_equal(tile.x, 999);
    assert_false(rt_tiles_take(&takers[1], &tile));
}

#define THREADS 4
#define SIDE 300

typedef struct taking {
    rt_tiles *tiles;
    unsigned char *seen;
    int finished;
} taking;

static void *take_all(void *argument)
{
    taking *t = argument;
    rt_taker taker = {t->tiles, 0};
    rt_tile tile;
    while (rt_tiles_take(&taker, &tile)) {
        t->seen[tile.y * SIDE + tile.x]++;
        rt_tiles_finish(&taker);
    }
    t->finished = taker.finished;
    return NULL;
}

static void threads_share(void **state)
{
    (void)state;
    static unsigned char seen[SIDE * SIDE];
    rt_tiles tiles;
    rt_tiles_init(&tiles, SIDE, SIDE, 1, THREADS);
    pthread_t threads[THREADS];
    taking all[THREADS];
    int finished = 0;
    for (int i = 0; i < THREADS; ++i) {
        all[i] = (taking){&tiles, seen, 0};
        assert_int_equal(pthread_create(&threads[i], NULL, take_all, &all[i]), 0);
    }
    for (int i = 0; i < THREADS; ++i) {
        pthread_join(threads[i], NULL);
        finished += all[i].finished;
    }
    assert_int_equal(finished, SIDE * SIDE);
    for (int i = 0; i < SIDE * SIDE; ++i)
        assert_int_equal(seen[i], 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pixel_once), cmocka_unit_test(a_stop_leaves_none),
        cmocka_unit_test(speeds),           cmocka_unit_test(not_all_decline),
        cmocka_unit_test(threads_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
