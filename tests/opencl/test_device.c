/* Choosing a device by what a user types, on a list made up for the purpose and on the real one. */
#define _GNU_SOURCE
#include "support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rt_device made_up[] = {
    {.index = 0,
     .platform_index = 0,
     .device_index = 0,
     .type = CL_DEVICE_TYPE_ACCELERATOR,
     .name = "Board 7",
     .platform_name = "Acme",
     .native_float_width = 2},
    {.index = 1,
     .platform_index = 1,
     .device_index = 0,
     .type = CL_DEVICE_TYPE_CPU,
     .name = "Xeon",
     .platform_name = "PoCL",
     .native_float_width = 16,
     .native_double_width = 8,
     .has_fp64 = true},
    {.index = 2,
     .platform_index = 1,
     .device_index = 1,
     .type = CL_DEVICE_TYPE_CPU,
     .name = "Atom 1000",
     .platform_name = "PoCL",
     .native_float_width = 4},
    {.index = 3,
     .platform_index = 3,
     .device_index = 0,
     .type = CL_DEVICE_TYPE_GPU,
     .name = "GeForce",
     .platform_name = "NVIDIA CUDA",
     .native_float_width = 1},
};

static int chosen(size_t count, const char *selector)
{
    const rt_device_list list = {made_up, count, count};
    rt_status status = RT_STATUS_INIT;
    const rt_device *device = rt_device_choose(&list, selector, &status);
    assert_true((device != NULL) == (status.code == RT_OK));
    if (!device)
        assert_int_equal(status.code, RT_ERROR_DEVICE);
    rt_status_clear(&status);
    return device ? device->index : -1;
}

static void selectors(void **state)
{
    (void)state;
    assert_int_equal(chosen(4, NULL), 3); /* the first GPU */
    assert_int_equal(chosen(3, NULL), 1); /* else the first CPU */
    assert_int_equal(chosen(1, NULL), 0); /* else what there is */
    assert_int_equal(chosen(4, "2"), 2);
    assert_int_equal(chosen(4, "1:1"), 2);
    assert_int_equal(chosen(4, "3:0"), 3);
    assert_int_equal(chosen(4, "cpu"), 1);
    assert_int_equal(chosen(4, "GPU"), 3);
    assert_int_equal(chosen(4, "accelerator"), 0);
    assert_int_equal(chosen(4, "atom"), 2);
    assert_int_equal(chosen(4, "pocl"), 1);
    assert_int_equal(chosen(4, "cuda"), 3);
    assert_int_equal(chosen(4, "4"), -1);
    assert_int_equal(chosen(4, "-1"), -1);
    assert_int_equal(chosen(4, "2:0"), -1);
    assert_int_equal(chosen(4, "1000"), -1); /* an index, though a name has it */
    assert_int_equal(chosen(4, "7"), -1);
    assert_int_equal(chosen(4, "radeon"), -1);
    assert_int_equal(chosen(3, "gpu"), -1);
    assert_int_equal(chosen(0, NULL), -1);
}

/* The indices of the chosen devices as text; the message where there are none. */
static const char *chosen_of(size_t count, const char *selectors)
{
    static char text[512];
    const rt_device_list list = {made_up, count, count};
    const rt_device *chosen[4];
    rt_status status = RT_STATUS_INIT;
    const size_t found = rt_device_choose_list(&list, selectors, chosen, &status);
    assert_int_equal(status.code, found ? RT_OK : RT_ERROR_DEVICE);
    snprintf(text, sizeof text, "%s", status.text ? status.text : "");
    for (size_t i = 0; i < found; ++i)
        sprintf(text + i, "%d", chosen[i]->index);
    rt_status_clear(&status);
    return text;
}

static void lists_of_selectors(void **state)
{
    (void)state;
    assert_string_equal(chosen_of(4, NULL), "3");
    assert_string_equal(chosen_of(4, "2"), "2");
    assert_string_equal(chosen_of(4, "all"), "0123");
    assert_string_equal(chosen_of(1, "ALL"), "0");
    assert_string_equal(chosen_of(4, "2,0"), "20");
    assert_string_equal(chosen_of(4, "gpu,cpu,0:0"), "310");
    assert_string_equal(chosen_of(4, "gpu, atom"), "32");
    assert_string_equal(chosen_of(4, "1,1,xeon,1:0,3"), "13"); /* each once */
    assert_non_null(strstr(chosen_of(4, "0,radeon"), "no device fits 'radeon'"));
    assert_non_null(strstr(chosen_of(4, "0,4"), "no device fits '4'"));
    assert_non_null(strstr(chosen_of(0, "all"), "pocl-opencl-icd"));
    assert_non_null(strstr(chosen_of(0, "0,1"), "pocl-opencl-icd"));
}

/* llvmpipe's name has one, for instance. */
static void names_with_commas(void **state)
{
    (void)state;
    rt_device two[2] = {made_up[1], made_up[3]};
    snprintf(two[0].name, RT_DEVICE_TEXT, "pipe (LLVM 15, 256 bits)");
    const rt_device_list list = {two, 2, 2};
    const rt_device *chosen[2];
    rt_status status = RT_STATUS_INIT;
    assert_int_equal(rt_device_choose_list(&list, "pipe (LLVM 15, 256 bits)", chosen, &status), 1);
    assert_ptr_equal(chosen[0], &two[0]);
    assert_int_equal(rt_device_choose_list(&list, "geforce,pipe", chosen, &status), 2);
    assert_ptr_equal(chosen[0], &two[1]);
    assert_int_equal(status.code, RT_OK);
}

static void no_device_names_the_way_out(void **state)
{
    (void)state;
    const rt_device_list list = {NULL, 0, 0};
    rt_status status = RT_STATUS_INIT;
    assert_null(rt_device_choose(&list, NULL, &status));
    assert_non_null(strstr(status.text, "pocl-opencl-icd"));
    assert_non_null(strstr(status.text, "--device scalar"));
    rt_status_clear(&status);
}

static void an_unknown_device_lists_what_there_is(void **state)
{
    (void)state;
    const rt_device_list list = {made_up, 4, 4};
    rt_status status = RT_STATUS_INIT;
    assert_null(rt_device_choose(&list, "radeon", &status));
    for (int i = 0; i < 4; ++i)
        assert_non_null(strstr(status.text, made_up[i].name));
    rt_status_clear(&status);
}

static void lanes_follow_the_native_width(void **state)
{
    (void)state;
    assert_int_equal(rt_device_lanes(&made_up[0], RT_ACCURACY_ROBUST), 1);
    assert_int_equal(rt_device_lanes(&made_up[1], RT_ACCURACY_ROBUST), 16);
    assert_int_equal(rt_device_lanes(&made_up[2], RT_ACCURACY_ROBUST), 4);
    assert_int_equal(rt_device_lanes(&made_up[3], RT_ACCURACY_ROBUST), 1);
    assert_int_equal(rt_device_lanes(&made_up[1], RT_ACCURACY_DOUBLE), 8);
    rt_device wide_gpu = made_up[3];
    wide_gpu.native_float_width = 8;
    assert_int_equal(rt_device_lanes(&wide_gpu, RT_ACCURACY_ROBUST), 1);
}

static void double_asks_for_fp64(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    for (int level = 0; level < RT_ACCURACY_COUNT; ++level) {
        assert_true(rt_device_check_level(&made_up[1], (enum rt_accuracy)level, &status));
        const bool expected = level != RT_ACCURACY_DOUBLE;
        assert_int_equal(rt_device_check_level(&made_up[2], (enum rt_accuracy)level, &status),
                         expected);
    }
    assert_int_equal(status.code, RT_ERROR_DEVICE);
    assert_string_equal(status.text, "rt: Atom 1000 has no double precision (fp64); its levels of "
                                     "accuracy are fast, standard and robust\n");
    rt_status_clear(&status);
}

static void the_real_list(void **state)
{
    (void)state;
    const rt_device *device = test_device();
    assert_true(device->name[0] != '\0' && device->platform_name[0] != '\0');
    assert_non_null(strstr(device->version, "OpenCL"));
    assert_true(device->compute_units > 0);
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    const rt_device_list list = {made_up, 4, 4};
    rt_device_list_print(&list, stream);
    fclose(stream);
    assert_non_null(strstr(text, "index"));
    assert_non_null(strstr(text, "1:1"));
    assert_non_null(strstr(text, "GeForce [NVIDIA CUDA]"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(selectors),
        cmocka_unit_test(lists_of_selectors),
        cmocka_unit_test(names_with_commas),
        cmocka_unit_test(no_device_names_the_way_out),
        cmocka_unit_test(an_unknown_device_lists_what_there_is),
        cmocka_unit_test(lanes_follow_the_native_width),
        cmocka_unit_test(double_asks_for_fp64),
        cmocka_unit_test(the_real_list),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
