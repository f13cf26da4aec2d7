#include "opencl/arguments.h"

#include <string.h>

#define NAME_SIZE 64

/* The names of a kernel and of the parameter that is looked at. */
typedef struct names {
    char kernel[NAME_SIZE], parameter[NAME_SIZE];
} names;

static cl_uint count_of(cl_kernel kernel)
{
    cl_uint count = 0;
    return clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, NULL) == CL_SUCCESS
               ? count
               : 0;
}

static bool name_of(cl_kernel kernel, cl_uint i, char *name)
{
    return clGetKernelArgInfo(kernel, i, CL_KERNEL_ARG_NAME, NAME_SIZE, name, NULL) == CL_SUCCESS;
}

static const rt_argument *find(const rt_argument *known, size_t count, const char *name)
{
    for (size_t i = 0; i < count; ++i)
        if (strcmp(known[i].name, name) == 0)
            return &known[i];
    return NULL;
}

bool rt_arguments_set(cl_kernel kernel, const rt_argument *known, size_t count, rt_status *status)
{
    names n = {"", ""};
    const cl_uint parameters = count_of(kernel);
    if (!RT_CL(clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, NAME_SIZE, n.kernel, NULL), status))
        return false;
    for (cl_uint i = 0; i < parameters; ++i) {
        if (!name_of(kernel, i, n.parameter))
            return rt_status_fail(status, RT_ERROR_DEVICE,
                                  "rt: kernel %s: the device does not tell the parameters' names",
                                  n.kernel);
        const rt_argument *a = find(known, count, n.parameter);
        if (!a)
            return rt_status_fail(status, RT_ERROR_DEVICE,
                                  "rt: kernel %s: nothing is known as parameter '%s'", n.kernel,
                                  n.parameter);
        const cl_int error = clSetKernelArg(kernel, i, a->size, a->value);
        if (error != CL_SUCCESS)
            return rt_status_fail(status, RT_ERROR_DEVICE,
                                  "rt: kernel %s: parameter '%s' of %zu bytes: %s (%d)", n.kernel,
                                  n.parameter, a->size, rt_cl_error_name(error), (int)error);
    }
    return true;
}

int rt_arguments_place(cl_kernel kernel, const char *name)
{
    const cl_uint parameters = count_of(kernel);
    char parameter[NAME_SIZE];
    for (cl_uint i = 0; i < parameters; ++i)
        if (name_of(kernel, i, parameter) && strcmp(parameter, name) == 0)
            return (int)i;
    return -1;
}
