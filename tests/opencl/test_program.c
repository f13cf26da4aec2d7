/* Builds: logs that name the file, and variants that must not build. */
#define _GNU_SOURCE
#include "support/mutants.h"
#include "support/support.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/effects.def"
#include "opencl/program.h"

/* Builds without effects but those that the options say once more. */
static cl_program build(const char *options, rt_status *status)
{
#define OFF(word, name) "-DRT_" #word "=0 "
    char all[1000];
    snprintf(all, sizeof all, RT_EFFECTS(OFF) "%s", options);
    const rt_device *device = test_device();
    cl_int error = CL_SUCCESS;
    cl_context context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &error);
    assert_int_equal(error, CL_SUCCESS);
    cl_program program = rt_program_build(context, device, all, status);
    clReleaseContext(context);
    return program;
}

static void unknown_variants_do_not_build(void **state)
{
    (void)state;
    static const char *const bad[] = {"-DRT_LANES=3",
                                      "-DRT_LANES=2",
                                      "-DRT_ACCURACY=4",
                                      "-DRT_SPHERES=2",
                                      "-DRT_CULL=2",
                                      "-DRT_CULL=-2",
                                      "-DRT_SMOOTH=7",
                                      "-DRT_ROUNDING=3",
                                      "-DRT_SHININESS_BITS=9",
                                      "-DRT_SHININESS_FRACTION=2",
                                      "-DRT_SMOOTH=1 -DRT_TRIANGLES=0",
                                      "-DRT_LIGHTS=5",
                                      "-DRT_FOG=2",
                                      "-DRT_HARD_SHADOWS=2",
                                      "-DRT_SWITCHED=2",
                                      "-DRT_ABSORB=1",
                                      "-DRT_PART=5",
                                      "-DRT_LENS=RT_LENS"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        rt_status status = RT_STATUS_INIT;
        assert_null(build(bad[i], &status));
        assert_int_equal(status.code, RT_ERROR_DEVICE);
        assert_non_null(strstr(status.text, bad[i]));
        rt_status_clear(&status);
    }
}

static void a_log_names_the_file_and_line(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    test_mutate_kernels(MUTANT_UNKNOWN_FUNCTION);
    assert_null(build("", &status));
    test_restore_kernels();
    assert_non_null(strstr(status.text, "resolve.cl:"));
    assert_non_null(strstr(status.text, "driver: "));
    assert_non_null(strstr(status.text, "device: "));
    rt_status_clear(&status);
}

static void a_missing_kernel_folder(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    setenv("RT_KERNELS", "/nowhere", 1);
    assert_null(build("", &status));
    unsetenv("RT_KERNELS");
    assert_int_equal(status.code, RT_ERROR_DEVICE);
    assert_string_equal(status.text,
                        "rt: cannot read '/nowhere/effects.def': No such file or directory\n");
    rt_status_clear(&status);
}

/* The one file in the cache's folder, or an empty text. */
static const char *cached_file(const char *folder)
{
    static char path[600];
    path[0] = '\0';
    DIR *dir = opendir(folder);
    for (struct dirent *e; dir && (e = readdir(dir)) != NULL;)
        if (e->d_name[0] != '.')
            snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
    if (dir)
        closedir(dir);
    return path;
}

static void assert_builds(void)
{
    rt_status status = RT_STATUS_INIT;
    cl_program program = build("-DRT_LANES=1", &status);
    assert_good(program != NULL, &status);
    cl_int error = CL_SUCCESS;
    cl_kernel kernel = clCreateKernel(program, "rt_resolve", &error);
    assert_int_equal(error, CL_SUCCESS);
    clReleaseKernel(kernel);
    clReleaseProgram(program);
}

static void a_program_is_kept(void **state)
{
    (void)state;
    const char *folder = test_path("cache/of/programs");
    setenv("RT_CACHE_DIR", folder, 1);
    assert_builds();
    size_t length = 0;
    char path[600];
    snprintf(path, sizeof path, "%s", cached_file(folder));
    char *whole = test_read_file(path, &length);
    assert_non_null(whole);
    assert_builds(); /* from the file */

    /* A file that is cut, another program's, or no program at all, is not believed: it is written
     * anew. */
    const size_t lengths[] = {0, 10, length / 2, length - 1};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; ++i) {
        test_write_file(path, whole, lengths[i]);
        assert_builds();
    }
    const size_t places[] = {20, length / 2, length - 20};
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        whole[places[i]] ^= 1;
        test_write_file(path, whole, length);
        whole[places[i]] ^= 1;
        assert_builds();
    }
    char *again = test_read_file(path, NULL);
    assert_memory_equal(again, whole, 64);
    free(again);
    free(whole);
}

static void a_cache_that_cannot_be_used_is_no_error(void **state)
{
    (void)state;
    static const char *const folders[] = {"", "/dev/null/cache", "/proc/cache"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; ++i) {
        setenv("RT_CACHE_DIR", folders[i], 1);
        assert_builds();
    }
}

/* Options that are added reach the compiler, and make another program in the cache. */
static void options_from_outside(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    const char *folder = test_path("cache");
    setenv("RT_CACHE_DIR", folder, 1);
    assert_builds();
    setenv("RT_BUILD_OPTIONS", "-DRT_SPHERES=2", 1);
    assert_null(build("-DRT_LANES=1", &status));
    unsetenv("RT_BUILD_OPTIONS");
    assert_non_null(strstr(status.text, " -DRT_LANES=1 -DRT_SPHERES=2\n"));
    rt_status_clear(&status);
    assert_builds();
}

static void errors_have_names(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    assert_true(rt_cl_check(CL_SUCCESS, "clFinish(queue)", "a.c", 7, &status));
    assert_false(rt_cl_check(CL_OUT_OF_RESOURCES, "clFinish(queue)", "a.c", 7, &status));
    assert_string_equal(status.text, "rt: a.c:7: clFinish: CL_OUT_OF_RESOURCES (-5)\n");
    assert_string_equal(rt_cl_error_name(-9999), "unknown error");
    rt_status_clear(&status);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unknown_variants_do_not_build),
        cmocka_unit_test(a_log_names_the_file_and_line),
        cmocka_unit_test(a_missing_kernel_folder),
        cmocka_unit_test(a_program_is_kept),
        cmocka_unit_test(a_cache_that_cannot_be_used_is_no_error),
        cmocka_unit_test(options_from_outside),
        cmocka_unit_test(errors_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
