#include "opencl/arguments.h"

#include <string.h>

#include "opencl/kernel_text.h"

#define NAME_SIZE 64

/* A kernel and what it is told by. */
typedef struct signature {
    cl_kernel kernel;
    char name[NAME_SIZE];
    cl_uint count;
} signature;

static bool read_signature(signature *s, cl_kernel kernel, rt_status *status)
{
    s->kernel = kernel;
    return RT_CL(clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, NAME_SIZE, s->name, NULL),
                 status) &&
           RT_CL(clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof s->count, &s->count, NULL),
                 status);
}

/* Copies word i of a text; false where there is none. */
static bool word(const char *text, cl_uint i, char *out)
{
    for (; i > 0 && text; --i)
        text = (text = strchr(text, ' ')) ? text + 1 : NULL;
    const size_t length = text ? strcspn(text, " ") : 0;
    if (length == 0 || length >= NAME_SIZE)
        return false;
    memcpy(out, text, length);
    out[length] = '\0';
    return true;
}

/* Parameter i by the list from build time; false where that is of another kernel. */
static bool listed_name(const signature *s, cl_uint i, char *name)
{
    char first[NAME_SIZE];
    for (const char *const *line = rt_kernel_parameters; *line; ++line)
        if (word(*line, 0, first) && strcmp(first, s->name) == 0)
            return !word(*line, s->count + 1, name) && word(*line, s->count, name) &&
                   word(*line, i + 1, name);
    return false;
}

static bool name_of(const signature *s, cl_uint i, char *name)
{
    return (clGetKernelArgInfo(s->kernel, i, CL_KERNEL_ARG_NAME, NAME_SIZE, name, NULL) ==
                CL_SUCCESS &&
            name[0]) ||
           listed_name(s, i, name);
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
    signature s;
    char name[NAME_SIZE];
    if (!read_signature(&s, kernel, status))
        return false;
    for (cl_uint i = 0; i < s.count; ++i) {
        if (!name_of(&s, i, name))
            return rt_status_fail(status, RT_ERROR_DEVICE,
                                  "rt: kernel %s: the name of parameter %u is not to be had",
                                  s.name, (unsigned)i);
        const rt_argument *a = find(known, count, name);
        if (!a)
            return rt_status_fail(status, RT_ERROR_DEVICE,
                                  "rt: kernel %s: nothing is known as parameter '%s'", s.name,
                                  name);
        const cl_int error = clSetKernelArg(kernel, i, a->size, a->value);
        if (error != CL_SUCCESS)
            return rt_status_fail(status, RT_ERROR_DEVICE,
                                  "rt: kernel %s: parameter '%s' of %zu bytes: %s (%d)", s.name,
                                  name, a->size, rt_cl_error_name(error), (int)error);
    }
    return true;
}

int rt_arguments_place(cl_kernel kernel, const char *name)
{
    signature s;
    char parameter[NAME_SIZE];
    rt_status ignored = RT_STATUS_INIT;
    int place = -1;
    if (read_signature(&s, kernel, &ignored))
        for (cl_uint i = 0; i < s.count && place < 0; ++i)
            if (name_of(&s, i, parameter) && strcmp(parameter, name) == 0)
                place = (int)i;
    rt_status_clear(&ignored);
    return place;
}
