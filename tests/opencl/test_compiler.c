/* Compilers in processes of their own. */
#define _GNU_SOURCE
#include "support/support.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "kernels/effects.def"
#include "kernels/parts.h"
#include "opencl/compiler.h"
#include "opencl/program.h"

/* Of the stages of Phong alone, which are quickly compiled. */
#define OFF(word, name) "-DRT_" #word "=0 "
#define STAGES RT_EFFECTS(OFF) "-DRT_PART=3 "
_Static_assert(RT_PART_STAGES == 3, "the part in the options");

static const char *const good[] = {STAGES "-DRT_LANES=1", STAGES "-DRT_LANES=4"};

/* An empty cache, alone for a test. */
static void open_cache(const char *name)
{
    const char *folder = test_path(name);
    assert_int_equal(mkdir(folder, 0700), 0);
    setenv("RT_CACHE_DIR", folder, 1);
}

/* Beside the place that PoCL of this process has. */
static int files_in_cache(void)
{
    DIR *folder = opendir(getenv("RT_CACHE_DIR"));
    int count = 0;
    assert_non_null(folder);
    for (const struct dirent *e = readdir(folder); e; e = readdir(folder))
        count += e->d_name[0] != '.' && strcmp(e->d_name, "pocl-kernels") != 0;
    closedir(folder);
    return count;
}

static bool is_kept(const char *options)
{
    cl_int error = CL_SUCCESS;
    cl_context context = clCreateContext(NULL, 1, &test_device()->id, NULL, NULL, &error);
    assert_int_equal(error, CL_SUCCESS);
    cl_program program = rt_program_kept(context, test_device(), options);
    if (program)
        clReleaseProgram(program);
    clReleaseContext(context);
    return program != NULL;
}

static void programs_come_from_the_processes(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    open_cache("both");
    assert_false(is_kept(good[0]));
    assert_good(rt_compiler_run(test_device(), good, 2, NULL, &status), &status);
    assert_int_equal(files_in_cache(), 2);
    assert_true(is_kept(good[0]));
    assert_true(is_kept(good[1]));
}

static bool stop_at_once(void *context, double done)
{
    *(double *)context = done;
    return false;
}

static void a_watch_stops_them(void **state)
{
    (void)state;
    double done = -1.0;
    const rt_watch watch = {stop_at_once, &done};
    rt_status status = RT_STATUS_INIT;
    open_cache("stopped");
    assert_false(rt_compiler_run(test_device(), good, 2, &watch, &status));
    assert_int_equal(status.code, RT_INTERRUPTED);
    assert_true(done >= 0.0 && done < 1.0);
    assert_int_equal(files_in_cache(), 0);
    rt_status_clear(&status);
}

/* That is for whoever builds the program then to find out and to say. */
static void what_does_not_build_is_not_kept(void **state)
{
    (void)state;
    static const char *const bad[] = {STAGES "-DRT_LANES=3"};
    rt_status status = RT_STATUS_INIT;
    open_cache("bad");
    assert_good(rt_compiler_run(test_device(), bad, 1, NULL, &status), &status);
    assert_int_equal(files_in_cache(), 0);
    assert_false(is_kept(bad[0]));
}

static void without_a_cache_there_are_none(void **state)
{
    (void)state;
    double done = -1.0;
    const rt_watch watch = {stop_at_once, &done};
    static const char *const folders[] = {"", "/proc/nowhere"};
    for (int i = 0; i < 2; ++i) {
        rt_status status = RT_STATUS_INIT;
        setenv("RT_CACHE_DIR", folders[i], 1);
        assert_good(rt_compiler_run(test_device(), good, 2, &watch, &status), &status);
        assert_true(done < 0.0);
    }
}

int main(void)
{
    const char *rt = getenv("RT");
    const struct CMUnitTest tests[] = {cmocka_unit_test(programs_come_from_the_processes),
                                       cmocka_unit_test(a_watch_stops_them),
                                       cmocka_unit_test(what_does_not_build_is_not_kept),
                                       cmocka_unit_test(without_a_cache_there_are_none)};
    rt_compiler_set(rt ? rt : "./rt");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
