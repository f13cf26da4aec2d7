/* Kernels' arguments by the names of their parameters: a kernel that asks for something else is
 * refused, and the names are the same where the driver does not tell them. */
#define _GNU_SOURCE
#include "support/mutants.h"
#include "support/support.h"

#include <dlfcn.h>
#include <string.h>

#include "opencl/arguments.h"
#include "opencl/kernel_text.h"
#include "opencl/program.h"
#include "render/variant.h"

typedef cl_int get_info(cl_kernel, cl_uint, cl_kernel_arg_info, size_t, void *, size_t *);

static bool is_silent;
static int asked;

/* Stands before the library's: a driver that keeps the names to itself. */
CL_API_ENTRY cl_int CL_API_CALL clGetKernelArgInfo(cl_kernel kernel, cl_uint i,
                                                   cl_kernel_arg_info what, size_t size,
                                                   void *value, size_t *size_ret)
{
    get_info *inner = NULL;
    void *symbol = dlsym(RTLD_NEXT, "clGetKernelArgInfo");
    assert_non_null(symbol);
    memcpy(&inner, &symbol, sizeof inner);
    ++asked;
    return is_silent ? CL_KERNEL_ARG_INFO_NOT_AVAILABLE
                     : inner(kernel, i, what, size, value, size_ret);
}

static const char scene_text[] =
    "image width 40 height 24 samples 2\nambient 0.5 0.5 0.5\nshadows on\n"
    "occlusion samples 2 distance 1\nlight point at 3 5 3\n"
    "material m ka 1 0 0 kd 1 1 1 ks 0.5 0.5 0.5 reflect 0.3 transmit 0.3\n"
    "sphere center 0 0 -3 radius 1 material m\n"
    "triangle a -9 -1 -9 b -9 -1 9 c 9 -1 9 material m\n";

/* A renderer of the scene, all that there is compiled in; NULL where one cannot be made. */
static rt_renderer *renderer_of(rt_scene *scene, rt_status *status)
{
    rt_effects effects;
    test_scene(scene, scene_text);
    effects = rt_effects_of(scene);
    effects.mode = RT_EFFECTS_ALL;
    const rt_render_options options = {.with_hits = true, .effects = &effects};
    return rt_renderer_new(test_device(), scene, NULL, &options, status);
}

static void draw(rt_image *image)
{
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    rt_renderer *renderer = renderer_of(&scene, &status);
    assert_good(renderer != NULL, &status);
    assert_good(rt_image_init(image, scene.width, scene.height, true, &status), &status);
    assert_good(rt_renderer_draw(renderer, image, NULL, &status), &status);
    rt_renderer_free(renderer);
    rt_scene_clear(&scene);
}

/* From source, from the cache, and by the list, the first two of a driver that tells. */
static void a_picture_by_the_list(void **state)
{
    (void)state;
    rt_image told[2], listed;
    setenv("RT_CACHE_DIR", test_path("cache"), 1);
    draw(&told[0]);
    draw(&told[1]);
    is_silent = true;
    asked = 0;
    draw(&listed);
    is_silent = false;
    assert_true(asked > 0);
    const size_t pixels = (size_t)listed.width * (size_t)listed.height;
    for (int i = 0; i < 2; ++i) {
        assert_memory_equal(told[i].rgb, listed.rgb, 3 * pixels * sizeof *listed.rgb);
        assert_memory_equal(told[i].hits, listed.hits, pixels * sizeof *listed.hits);
        rt_image_clear(&told[i]);
    }
    rt_image_clear(&listed);
}

/* Holds a kernel's line of the list against the driver. */
static void check_line(cl_program program, const char *line)
{
    char words[1024], *rest = NULL;
    cl_int error = CL_SUCCESS;
    cl_uint count = 0, i = 0;
    snprintf(words, sizeof words, "%s", line);
    cl_kernel kernel = clCreateKernel(program, strtok_r(words, " ", &rest), &error);
    assert_int_equal(error, CL_SUCCESS);
    assert_int_equal(clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, NULL),
                     CL_SUCCESS);
    for (char *name = strtok_r(NULL, " ", &rest); name; name = strtok_r(NULL, " ", &rest)) {
        char told[64];
        assert_int_equal(
            clGetKernelArgInfo(kernel, i++, CL_KERNEL_ARG_NAME, sizeof told, told, NULL),
            CL_SUCCESS);
        assert_string_equal(told, name);
    }
    assert_int_equal(i, count);
    clReleaseKernel(kernel);
}

static void the_list_is_the_drivers(void **state)
{
    (void)state;
    const rt_device *device = test_device();
    const rt_effects effects = {.mode = RT_EFFECTS_ALL};
    const rt_walk walk = {.lanes = 1, .packet = 1, .accuracy = 1};
    rt_status status = RT_STATUS_INIT;
    char options[RT_VARIANT_OPTIONS_SIZE], names[1024];
    cl_int error = CL_SUCCESS;
    size_t kernels = 1, listed = 0;
    cl_context context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &error);
    assert_int_equal(error, CL_SUCCESS);
    rt_variant_options(RT_PART_ALL, &effects, &walk, rt_variant_rounding(device), options);
    cl_program program = rt_program_build(context, device, options, &status);
    assert_good(program != NULL, &status);
    assert_int_equal(clGetProgramInfo(program, CL_PROGRAM_KERNEL_NAMES, sizeof names, names, NULL),
                     CL_SUCCESS);
    for (const char *at = names; *at; ++at)
        kernels += *at == ';';
    for (; rt_kernel_parameters[listed]; ++listed)
        check_line(program, rt_kernel_parameters[listed]);
    assert_int_equal(listed, kernels);
    clReleaseProgram(program);
    clReleaseContext(context);
}

/* The renderer's making fails over a kernel that is changed so, with this message. */
static void assert_refused(test_mutant mutant, const char *message)
{
    rt_scene scene;
    rt_status status = RT_STATUS_INIT;
    test_mutate_kernels(mutant);
    assert_null(renderer_of(&scene, &status));
    test_restore_kernels();
    assert_int_equal(status.code, RT_ERROR_DEVICE);
    if (strncmp(status.text, message, strlen(message)) != 0)
        fail_msg("%s", status.text);
    rt_status_clear(&status);
    rt_scene_clear(&scene);
}

static void a_parameter_that_is_not_known(void **state)
{
    (void)state;
    assert_refused(MUTANT_PARAMETER_MORE,
                   "rt: kernel rt_resolve_hits: nothing is known as parameter 'more'");
    is_silent = true;
    assert_refused(MUTANT_PARAMETER_MORE,
                   "rt: kernel rt_resolve_hits: the name of parameter 0 is not to be had");
    is_silent = false;
}

static void a_parameter_of_another_size(void **state)
{
    (void)state;
    assert_refused(MUTANT_PARAMETER_LARGE,
                   "rt: kernel rt_pack: parameter 'total' of 4 bytes: CL_INVALID_ARG_SIZE");
}

/* In any order of parameters each gets its own. */
static void parameters_may_be_swapped(void **state)
{
    (void)state;
    rt_image straight, swapped;
    draw(&straight);
    test_mutate_kernels(MUTANT_PARAMETERS_SWAPPED);
    draw(&swapped);
    test_restore_kernels();
    assert_memory_equal(straight.rgb, swapped.rgb,
                        3 * (size_t)straight.width * (size_t)straight.height *
                            sizeof *straight.rgb);
    rt_image_clear(&straight);
    rt_image_clear(&swapped);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_by_the_list),
        cmocka_unit_test(the_list_is_the_drivers),
        cmocka_unit_test(a_parameter_that_is_not_known),
        cmocka_unit_test(a_parameter_of_another_size),
        cmocka_unit_test(parameters_may_be_swapped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
