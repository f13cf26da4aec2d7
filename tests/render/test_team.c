/* Several devices at one picture. A device may be there twice, so one is enough for these tests;
 * what makes it slow or fail stands between the renderer and the OpenCL library. */
#define _GNU_SOURCE
#include "support/support.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "render/team.h"

/* Members' threads wait for each other at their first tile. */
static pthread_barrier_t meeting;
static int meeting_round;         /* 0 for none; a thread goes to each once */
static pthread_t calling_thread;  /* the first member's */
static int calling_thread_sleeps; /* microseconds a tile */
static bool others_fail;

/* Called in place of the library's: a tile's last command. */
cl_int clEnqueueReadBufferRect(cl_command_queue queue, cl_mem buffer, cl_bool blocking,
                               const size_t *buffer_origin, const size_t *host_origin,
                               const size_t *region, size_t buffer_row, size_t buffer_slice,
                               size_t host_row, size_t host_slice, void *to, cl_uint wait_count,
                               const cl_event *wait, cl_event *event)
{
    static _Thread_local int met;
    cl_int (*next)(cl_command_queue, cl_mem, cl_bool, const size_t *, const size_t *,
                   const size_t *, size_t, size_t, size_t, size_t, void *, cl_uint,
                   const cl_event *, cl_event *) = NULL;
    void *symbol = dlsym(RTLD_NEXT, "clEnqueueReadBufferRect");
    memcpy(&next, &symbol, sizeof next);
    if (meeting_round && meeting_round != met) {
        met = meeting_round;
        pthread_barrier_wait(&meeting);
    }
    if (pthread_equal(pthread_self(), calling_thread))
        usleep((useconds_t)calling_thread_sleeps);
    else if (others_fail)
        return CL_OUT_OF_RESOURCES;
    return next(queue, buffer, blocking, buffer_origin, host_origin, region, buffer_row,
                buffer_slice, host_row, host_slice, to, wait_count, wait, event);
}

static rt_scene scene;
static rt_image image;
static rt_status status = RT_STATUS_INIT;

/* A team of `count` times the device under test, and room for its picture. */
static rt_team *begin(size_t count, int width, int height, int tile)
{
    const rt_device *const devices[] = {test_device(), test_device(), test_device()};
    const rt_render_options options = {.tile = tile, .with_hits = true};
    test_scene_file(&scene, "scenes/icecream.txt");
    scene.width = width;
    scene.height = height;
    rt_team *team = rt_team_new(devices, count, &scene, NULL, &options, &status);
    assert_good(team != NULL, &status);
    assert_good(rt_image_init(&image, width, height, true, &status), &status);
    calling_thread = pthread_self();
    return team;
}

static void end(rt_team *team)
{
    meeting_round = 0;
    others_fail = false;
    calling_thread_sleeps = 0;
    rt_team_free(team);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
    rt_status_clear(&status);
}

static void assert_as_one_device_draws_it(void)
{
    rt_image alone;
    test_draw(&scene, NULL, &alone);
    const size_t pixels = (size_t)image.width * (size_t)image.height;
    assert_memory_equal(image.rgb, alone.rgb, pixels * 3 * sizeof(float));
    assert_memory_equal(image.hits, alone.hits, pixels * sizeof(rt_hit));
    rt_image_clear(&alone);
}

static void the_picture_is_one_devices(void **state)
{
    (void)state;
    static const struct {
        size_t count;
        int width, height, tile;
    } cases[] = {{1, 99, 61, 16}, {2, 1, 1, 0},     {2, 7, 93, 8},   {2, 257, 131, 8},
                 {3, 144, 5, 7},  {3, 301, 203, 0}, {3, 99, 61, 512}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rt_team *team = begin(cases[i].count, cases[i].width, cases[i].height, cases[i].tile);
        assert_good(rt_team_draw(team, &image, NULL, &status), &status);
        assert_as_one_device_draws_it();
        /* Shares add up to the picture, and again for a second one. */
        memset(image.rgb, 0, sizeof *image.rgb);
        assert_good(rt_team_draw(team, &image, NULL, &status), &status);
        assert_as_one_device_draws_it();
        size_t tiles = 0, rays = 0;
        assert_int_equal(rt_team_count(team), cases[i].count);
        for (size_t m = 0; m < cases[i].count; ++m) {
            tiles += rt_team_share_of(team, m).tiles;
            rays += rt_team_share_of(team, m).rays;
        }
        assert_int_equal(rays, 2 * cases[i].width * cases[i].height);
        const rt_render_times times = rt_team_times(team);
        assert_int_equal(times.tiles, tiles);
        assert_int_equal(times.rays.primary, rays);
        assert_int_equal(times.launches[RT_STAGE_CAMERA], tiles);
        end(team);
    }
}

static void everyone_has_tiles(void **state)
{
    (void)state;
    rt_team *team = begin(3, 256, 256, 32);
    assert_int_equal(pthread_barrier_init(&meeting, NULL, 3), 0);
    meeting_round = 1;
    assert_good(rt_team_draw(team, &image, NULL, &status), &status);
    size_t tiles = 0;
    for (size_t m = 0; m < 3; ++m) {
        const rt_team_share share = rt_team_share_of(team, m);
        assert_ptr_equal(share.device, test_device());
        assert_true(share.tiles >= 1 && share.rays >= share.tiles && share.seconds > 0.0);
        tiles += share.tiles;
    }
    assert_int_equal(tiles, 64);
    meeting_round = 0;
    assert_as_one_device_draws_it();
    pthread_barrier_destroy(&meeting);
    end(team);
}

static void the_slower_has_less(void **state)
{
    (void)state;
    rt_team *team = begin(2, 256, 256, 16);
    calling_thread_sleeps = 30000;
    assert_good(rt_team_draw(team, &image, NULL, &status), &status);
    calling_thread_sleeps = 0;
    const size_t slow = rt_team_share_of(team, 0).tiles, fast = rt_team_share_of(team, 1).tiles;
    assert_int_equal(slow + fast, 256);
    assert_true(slow >= 1 && slow < fast);
    assert_as_one_device_draws_it();
    end(team);
}

/* Two halves of one device, where it can be cut. */
static void sub_devices(void **state)
{
    (void)state;
    const cl_device_partition_property half = test_device()->compute_units / 2;
    const cl_device_partition_property units[] = {CL_DEVICE_PARTITION_EQUALLY, half, 0};
    cl_device_id ids[3]; /* where the number is odd one is left over */
    cl_uint count = 0;
    rt_device parts[2] = {*test_device(), *test_device()};
    if (clCreateSubDevices(parts[0].id, units, 3, ids, &count) != CL_SUCCESS || count < 2) {
        print_message("the device cannot be cut in two\n");
        skip();
    }
    const rt_device *const devices[] = {&parts[0], &parts[1]};
    const rt_render_options options = {.tile = 32, .with_hits = true};
    rt_team_free(begin(1, 200, 150, 0));
    parts[0].id = ids[0];
    parts[1].id = ids[1];
    rt_team *team = rt_team_new(devices, 2, &scene, NULL, &options, &status);
    assert_good(team != NULL, &status);
    assert_good(rt_team_draw(team, &image, NULL, &status), &status);
    assert_as_one_device_draws_it();
    end(team);
    for (cl_uint i = 0; i < count; ++i)
        clReleaseDevice(ids[i]);
}

static void a_device_that_fails_stops_all(void **state)
{
    (void)state;
    rt_team *team = begin(2, 256, 256, 8);
    assert_int_equal(pthread_barrier_init(&meeting, NULL, 2), 0);
    meeting_round = 2;
    others_fail = true;
    calling_thread_sleeps = 2000;
    assert_false(rt_team_draw(team, &image, NULL, &status));
    assert_int_equal(status.code, RT_ERROR_DEVICE);
    assert_non_null(strstr(status.text, test_device()->name));
    assert_non_null(strstr(status.text, "clEnqueueReadBufferRect: CL_OUT_OF_RESOURCES"));
    assert_true(rt_team_share_of(team, 0).tiles < 1000);
    /* The team is as good as it was. */
    meeting_round = 0;
    others_fail = false;
    calling_thread_sleeps = 0;
    rt_status_clear(&status);
    assert_good(rt_team_draw(team, &image, NULL, &status), &status);
    assert_as_one_device_draws_it();
    pthread_barrier_destroy(&meeting);
    end(team);
}

static void a_device_that_is_none_is_named(void **state)
{
    (void)state;
    rt_device none = *test_device();
    none.id = NULL;
    none.index = 77;
    const rt_device *const devices[] = {test_device(), &none};
    const rt_render_options options = {0};
    test_scene_file(&scene, "scenes/sphere.txt");
    assert_null(rt_team_new(devices, 2, &scene, NULL, &options, &status));
    assert_int_equal(status.code, RT_ERROR_DEVICE);
    assert_non_null(strstr(status.text, "rt: device 77, "));
    assert_non_null(strstr(status.text, "clCreateContext"));
    end(NULL);
}

typedef struct watched {
    atomic_int inside, ticks;
    double last;
    int stop_at;
    bool is_wrong; /* cmocka's assertions are for the calling thread alone */
} watched;

static bool look(void *context, double done)
{
    watched *w = context;
    if (atomic_fetch_add(&w->inside, 1) != 0 || done < w->last || done >= 1.0)
        w->is_wrong = true;
    w->last = done;
    const int ticks = atomic_fetch_add(&w->ticks, 1) + 1;
    atomic_fetch_sub(&w->inside, 1);
    return ticks != w->stop_at;
}

/* One thread at a time, never backwards, and not again after it has said stop. */
static void the_watch_is_asked_in_order(void **state)
{
    (void)state;
    rt_team *team = begin(3, 256, 256, 16);
    watched all = {.stop_at = 0}, some = {.stop_at = 9};
    const rt_watch watch_all = {look, &all}, watch_some = {look, &some};
    assert_good(rt_team_draw(team, &image, &watch_all, &status), &status);
    assert_int_equal(atomic_load(&all.ticks), 256);
    assert_false(rt_team_draw(team, &image, &watch_some, &status));
    assert_int_equal(atomic_load(&some.ticks), 9);
    assert_false(all.is_wrong || some.is_wrong);
    assert_int_equal(status.code, RT_INTERRUPTED);
    assert_string_equal(status.text, "rt: interrupted\n");
    end(team);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_picture_is_one_devices),
        cmocka_unit_test(everyone_has_tiles),
        cmocka_unit_test(the_slower_has_less),
        cmocka_unit_test(sub_devices),
        cmocka_unit_test(a_device_that_fails_stops_all),
        cmocka_unit_test(a_device_that_is_none_is_named),
        cmocka_unit_test(the_watch_is_asked_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
