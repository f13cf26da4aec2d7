/* What the tests share. Every random value comes from a written seed. */
#ifndef RT_TESTS_SUPPORT_SUPPORT_H
#define RT_TESTS_SUPPORT_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "common/status.h"
#include "image/image.h"
#include "opencl/device.h"
#include "render/renderer.h"
#include "scene/scene.h"

/* Fails unless |actual - expected| <= tolerance; NaN always fails (cmocka's own comparison lets NaN
 * pass and widens the tolerance). */
#define assert_near(actual, expected, tolerance)                                                   \
    test_near((double)(actual), (double)(expected), (double)(tolerance), __FILE__, __LINE__)
void test_near(double actual, double expected, double tolerance, const char *file, int line);

/* Fails with the status's messages unless the call has succeeded. */
#define assert_good(good, status) test_good(good, status, __FILE__, __LINE__)
void test_good(bool good, const rt_status *status, const char *file, int line);

/* Whether the long forms are wanted (RT_TEST_LONG, which make test-hard sets). Compiling is what
 * takes long: short forms leave out programs that show what others show too. */
bool test_is_long(void);

/* splitmix64 (Steele, Lea and Flood 2014). */
typedef struct test_random {
    uint64_t state;
} test_random;
uint64_t test_random_bits(test_random *random);
/* Uniform in [low, high). */
float test_random_float(test_random *random, float low, float high);

/* The device under test: RT_DEVICE's choice or the default. Fails the test where there is none. */
const rt_device *test_device(void);

/* A scene from its text, behind "rt 1"; fails the test on an error. */
void test_scene(rt_scene *scene, const char *text);
void test_scene_file(rt_scene *scene, const char *path);

/* A renderer for the scene on the device under test, by a tree unless test_use_tree(false) was said
 * last; fails the test on an error. */
rt_renderer *test_renderer(const rt_scene *scene, const rt_render_options *options);
void test_use_tree(bool use);

/* Renders on the device under test with hit records; fails the test on an error. */
void test_draw(const rt_scene *scene, const rt_render_options *options, rt_image *image);
/* The same, by the scalar float path. */
void test_draw_scalar(const rt_scene *scene, rt_image *image);

/* A fresh folder, in TMPDIR or /tmp, that is removed, with what is in it, when the process ends. */
const char *test_folder(void);
/* A path in that folder; the text lives until the 16th call after it. */
const char *test_path(const char *name);
void test_write_file(const char *path, const void *bytes, size_t length);
void test_write_text(const char *path, const char *text);
/* The file's bytes and a terminator; the caller frees them. NULL if it cannot be read. */
char *test_read_file(const char *path, size_t *length);

/* How often `part` is in `text`. */
size_t test_count_text(const char *text, const char *part);

/* Runs a shell command; returns its exit code. Standard error goes to `errors`[0..size) where that
 * is not NULL; standard output goes where the command says. In the command, $RT is the program. */
int test_run(const char *command, char *errors, size_t size);
/* Within a command, with $T the test folder: waits, minutes if it must, until standard error tells
 * how far something is. How soon that is depends on the machine. */
#define TEST_WAIT_FOR_PROGRESS                                                                     \
    "for i in $(seq 3000); do grep -q ' gone' $T/errors.log && break; sleep 0.1; done"

#endif
