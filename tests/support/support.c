#define _GNU_SOURCE
#include "support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "common/file.h"
#include "reference/scalar.h"
#include "scene_file/read.h"

void test_near(double actual, double expected, double tolerance, const char *file, int line)
{
    /* Written so that a NaN on either side fails. */
    if (fabs(actual - expected) <= tolerance)
        return;
    print_error("%.9g is not within %.3g of %.9g\n", actual, tolerance, expected);
    _fail(file, line);
}

void test_good(bool good, const rt_status *status, const char *file, int line)
{
    if (good)
        return;
    print_error("%s", status->text ? status->text : "no message\n");
    _fail(file, line);
}

bool test_is_long(void)
{
    const char *text = getenv("RT_TEST_LONG");
    return text && *text;
}

uint64_t test_random_bits(test_random *random)
{
    uint64_t z = random->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

float test_random_float(test_random *random, float low, float high)
{
    const float unit = (float)(test_random_bits(random) >> 40) * 0x1p-24f;
    return low + (high - low) * unit;
}

static rt_device_list devices;

static void forget_devices(void)
{
    rt_device_list_clear(&devices);
}

const rt_device *test_device(void)
{
    rt_status status = RT_STATUS_INIT;
    if (devices.count == 0) {
        assert_good(rt_device_list_read(&devices, &status), &status);
        atexit(forget_devices);
    }
    const char *selector = getenv("RT_DEVICE");
    const rt_device *device =
        rt_device_choose(&devices, selector && *selector ? selector : NULL, &status);
    assert_good(device != NULL, &status);
    return device;
}

void test_scene_file(rt_scene *scene, const char *path)
{
    rt_status status = RT_STATUS_INIT;
    rt_scene_init(scene);
    assert_good(rt_scene_read(scene, path, &status), &status);
    rt_status_clear(&status);
}

void test_scene(rt_scene *scene, const char *text)
{
    const char *path = test_path("scene.txt");
    char *whole = NULL;
    assert_true(asprintf(&whole, "rt 1\n%s", text) > 0);
    test_write_text(path, whole);
    free(whole);
    test_scene_file(scene, path);
}

static bool use_tree = true;

void test_use_tree(bool use)
{
    use_tree = use;
}

rt_renderer *test_renderer(const rt_scene *scene, const rt_render_options *options)
{
    rt_status status = RT_STATUS_INIT;
    rt_bvh bvh = {0};
    assert_good(!use_tree || rt_bvh_build(&bvh, scene, 2, &status), &status);
    rt_renderer *renderer =
        rt_renderer_new(test_device(), scene, use_tree ? &bvh : NULL, options, &status);
    assert_good(renderer != NULL, &status);
    rt_bvh_clear(&bvh);
    return renderer;
}

void test_draw(const rt_scene *scene, const rt_render_options *options, rt_image *image)
{
    rt_status status = RT_STATUS_INIT;
    rt_render_options with_hits = options ? *options : (rt_render_options){0};
    with_hits.with_hits = true;
    assert_good(rt_image_init(image, scene->width, scene->height, true, &status), &status);
    rt_renderer *renderer = test_renderer(scene, &with_hits);
    assert_good(rt_renderer_draw(renderer, image, NULL, &status), &status);
    rt_renderer_free(renderer);
}

void test_draw_scalar(const rt_scene *scene, rt_image *image)
{
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_image_init(image, scene->width, scene->height, true, &status), &status);
    assert_good(rt_scalar_float_render(scene, image, NULL, &status), &status);
}

static char folder[256];

static void remove_folder(void)
{
    char command[600];
    snprintf(command, sizeof command, "chmod -R u+w '%s'; rm -rf '%s'", folder, folder);
    if (system(command) != 0)
        fprintf(stderr, "%s is left behind\n", folder);
}

const char *test_folder(void)
{
    if (!folder[0]) {
        const char *where = getenv("TMPDIR");
        const int length =
            snprintf(folder, sizeof folder, "%s/rt-test-XXXXXX", where && *where ? where : "/tmp");
        /* It goes into commands, between quotes. */
        assert_true(length < (int)sizeof folder && !strchr(folder, '\''));
        assert_non_null(mkdtemp(folder));
        atexit(remove_folder);
    }
    return folder;
}

const char *test_path(const char *name)
{
    static char paths[16][512];
    static int next;
    char *path = paths[next++ % 16];
    snprintf(path, sizeof paths[0], "%s/%s", test_folder(), name);
    return path;
}

void test_write_file(const char *path, const void *bytes, size_t length)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

void test_write_text(const char *path, const char *text)
{
    test_write_file(path, text, strlen(text));
}

char *test_read_file(const char *path, size_t *length)
{
    rt_file_text text;
    if (rt_file_read(path, &text) != NULL)
        return NULL;
    if (length)
        *length = text.length;
    return text.bytes;
}

size_t test_count_text(const char *text, const char *part)
{
    size_t count = 0;
    for (const char *at = strstr(text, part); at; at = strstr(at + 1, part))
        ++count;
    return count;
}

int test_run(const char *command, char *errors, size_t size)
{
    const char *log = test_path("errors.log");
    char *line = NULL;
    assert_true(asprintf(&line, "{ %s\n} 2>'%s'", command, log) > 0);
    const int result = system(line);
    free(line);
    if (errors) {
        char *text = test_read_file(log, NULL);
        snprintf(errors, size, "%s", text ? text : "");
        free(text);
    }
    return WIFEXITED(result) ? WEXITSTATUS(result) : 128 + WTERMSIG(result);
}
