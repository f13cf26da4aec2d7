/* The folder of built programs: what is believed, how large it becomes, and PoCL's place. */
#define _GNU_SOURCE
#include "support/support.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "opencl/cache.h"

#define KILOBYTES 600
/* Names of programs. */
#define OLD "0123456789abcdef"
#define OLDER "0123456789abcde0"
#define FRESH "ffffffffffffffff"

static const char *open_cache(const char *name)
{
    const char *folder = test_path(name);
    assert_int_equal(mkdir(folder, 0700), 0);
    setenv("RT_CACHE_DIR", folder, 1);
    return folder;
}

/* A file in the cache, last used so many days ago. */
static const char *add(const char *name, int days)
{
    static char bytes[KILOBYTES << 10];
    char *path = NULL;
    assert_true(asprintf(&path, "%s/%s", getenv("RT_CACHE_DIR"), name) > 0);
    const char *kept = test_path(strstr(path, "cache"));
    free(path);
    test_write_file(kept, bytes, sizeof bytes);
    const time_t then = time(NULL) - (time_t)days * 86400;
    const struct timespec times[2] = {{then, 0}, {then, 0}};
    assert_int_equal(utimensat(AT_FDCWD, kept, times, 0), 0);
    return kept;
}

static bool is_there(const char *path)
{
    return access(path, F_OK) == 0;
}

static void a_folder_of_others_is_not_believed(void **state)
{
    (void)state;
    rt_cache_size size;
    rt_status status = RT_STATUS_INIT;
    const char *folder = open_cache("cache-of-others");
    char *used = rt_cache_folder();
    assert_non_null(used);
    free(used);
    const mode_t modes[] = {0770, 0707, 0722};
    for (size_t i = 0; i < sizeof modes / sizeof *modes; ++i) {
        assert_int_equal(chmod(folder, modes[i]), 0);
        assert_null(rt_cache_folder());
        assert_false(rt_cache_measure(&size, &status));
        assert_non_null(strstr(status.text, "others can write"));
        rt_status_clear(&status);
    }
    assert_int_equal(chmod(folder, 0755), 0);
    used = rt_cache_folder();
    assert_non_null(used);
    free(used);
    if (geteuid() == 0) {
        assert_int_equal(chown(folder, 12345, 12345), 0);
        assert_null(rt_cache_folder());
        assert_int_equal(chown(folder, 0, 0), 0);
    }
}

static void a_file_of_others_is_not_believed(void **state)
{
    (void)state;
    open_cache("cache-of-files");
    const char *file = add(FRESH, 0);
    assert_int_equal(chmod(file, 0644), 0);
    assert_true(rt_cache_is_own(file));
    assert_int_equal(chmod(file, 0664), 0);
    assert_false(rt_cache_is_own(file));
    assert_int_equal(chmod(file, 0600), 0);
    const char *link = test_path("cache-of-files/link");
    assert_int_equal(symlink(file, link), 0);
    assert_false(rt_cache_is_own(link));
}

static void what_rests_longest_goes_first(void **state)
{
    (void)state;
    rt_cache_size size;
    rt_status status = RT_STATUS_INIT;
    open_cache("cache-bounded");
    const char *old = add(OLD, 3), *older = add(OLDER, 4), *fresh = add(FRESH, 0);
    setenv("RT_CACHE_SIZE", "2", 1);
    rt_cache_bound(); /* 1.8 MB are few enough */
    assert_true(is_there(old) && is_there(older) && is_there(fresh));
    setenv("RT_CACHE_SIZE", "1", 1);
    rt_cache_touch(older);
    rt_cache_bound();
    assert_false(is_there(old));
    assert_true(is_there(older) != is_there(fresh));
    assert_good(rt_cache_measure(&size, &status), &status);
    assert_int_equal(size.programs, 1);
    assert_true(size.bytes >= KILOBYTES << 10 && size.bytes < 2 * KILOBYTES << 10);
    unsetenv("RT_CACHE_SIZE");
    assert_int_equal(rt_cache_limit(), 256 << 20);
}

static void pocls_programs_count_too(void **state)
{
    (void)state;
    rt_cache_size size;
    rt_status status = RT_STATUS_INIT;
    open_cache("cache-of-pocl");
    const char *names[] = {"pocl-kernels", "pocl-kernels/AB", "pocl-kernels/AB/OLD",
                           "pocl-kernels/AB/FAB"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        char name[64];
        snprintf(name, sizeof name, "cache-of-pocl/%s", names[i]);
        assert_int_equal(mkdir(test_path(name), 0700), 0);
    }
    const char *old = add("pocl-kernels/AB/OLD/kernel.so", 3),
               *used = add("pocl-kernels/AB/FAB/kernel.so", 0);
    const struct timespec times[2] = {{time(NULL) - 86400, 0}, {time(NULL) - 86400, 0}};
    assert_int_equal(utimensat(AT_FDCWD, test_path("cache-of-pocl/pocl-kernels/AB/OLD"), times, 0),
                     0);
    assert_good(rt_cache_measure(&size, &status), &status);
    assert_int_equal(size.programs, 0);
    assert_int_equal(size.pocl_programs, 2);
    /* What may be in use stays, whatever the bound. */
    setenv("RT_CACHE_SIZE", "0", 1);
    rt_cache_bound();
    unsetenv("RT_CACHE_SIZE");
    assert_false(is_there(old));
    assert_true(is_there(used));
    assert_good(rt_cache_clear(&status), &status);
    assert_false(is_there(used));
}

/* A folder may hold what is nobody's to remove but its owner's. */
static void what_is_not_ours_stays(void **state)
{
    (void)state;
    static const char *const names[] = {
        "letter.txt",         "0123456789abcde",       "0123456789abcdef0", "0123456789ABCDEF",
        "pocl-kernels/notes", "pocl-kernels/AB/notes", "pocl-kernels/ABC"};
    static const char *const ours[] = {OLD, OLD ".x1y2z3", RT_CACHE_COMPILING "abcdef",
                                       "pocl-kernels/AB/CDEF", "pocl-kernels/tempfile_1"};
    enum { NAMES = sizeof names / sizeof *names, OURS = sizeof ours / sizeof *ours };
    rt_status status = RT_STATUS_INIT;
    char *paths[NAMES];
    rt_cache_size size;
    open_cache("cache-of-many");
    assert_int_equal(mkdir(test_path("cache-of-many/pocl-kernels"), 0700), 0);
    assert_int_equal(mkdir(test_path("cache-of-many/pocl-kernels/AB"), 0700), 0);
    for (size_t i = 0; i < NAMES; ++i)
        assert_non_null(paths[i] = strdup(add(names[i], 9)));
    for (size_t i = 0; i < OURS; ++i)
        add(ours[i], 9);
    setenv("RT_CACHE_SIZE", "0", 1);
    rt_cache_bound();
    unsetenv("RT_CACHE_SIZE");
    assert_good(rt_cache_measure(&size, &status), &status);
    assert_int_equal(size.programs + size.pocl_programs, 0);
    for (size_t i = 0; i < OURS; ++i)
        add(ours[i], 9);
    assert_good(rt_cache_clear(&status), &status);
    assert_good(rt_cache_measure(&size, &status), &status);
    assert_int_equal(size.programs + size.pocl_programs, 0);
    for (size_t i = 0; i < NAMES; ++i) {
        assert_true(is_there(paths[i]));
        free(paths[i]);
    }
}

/* In processes of their own, whose PoCL has not begun. */
static void there_is_a_device_without_a_place(void **state)
{
    (void)state;
    const char *rt = getenv("RT");
    char command[600];
    static const char *const places[] = {"HOME=/proc/none", "HOME=/dev/null",
                                         "HOME=", "RT_CACHE_DIR= HOME=/proc/none",
                                         "POCL_CACHE_DIR=/proc/none/pocl"};
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        snprintf(command, sizeof command,
                 "mkdir -p %s && env -u XDG_CACHE_HOME -u RT_CACHE_DIR -u POCL_CACHE_DIR TMPDIR=%s "
                 "%s %s -q --size 8x8 scenes/sphere.txt %s",
                 test_path("tmp"), test_path("tmp"), places[i], rt ? rt : "./rt",
                 test_path("sphere.png"));
        assert_int_equal(system(command), 0);
    }
    /* Nothing is left of the temporary folders. */
    assert_int_equal(rmdir(test_path("tmp")), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_folder_of_others_is_not_believed),
                                       cmocka_unit_test(a_file_of_others_is_not_believed),
                                       cmocka_unit_test(what_rests_longest_goes_first),
                                       cmocka_unit_test(pocls_programs_count_too),
                                       cmocka_unit_test(what_is_not_ours_stays),
                                       cmocka_unit_test(there_is_a_device_without_a_place)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
