#include "opencl/cl.h"

#include <string.h>

#define NAME(code)                                                                                 \
    {                                                                                              \
        code, #code                                                                                \
    }

static const struct {
    cl_int code;
    const char *name;
} names[] = {NAME(CL_SUCCESS),
             NAME(CL_DEVICE_NOT_FOUND),
             NAME(CL_DEVICE_NOT_AVAILABLE),
             NAME(CL_COMPILER_NOT_AVAILABLE),
             NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE),
             NAME(CL_OUT_OF_RESOURCES),
             NAME(CL_OUT_OF_HOST_MEMORY),
             NAME(CL_PROFILING_INFO_NOT_AVAILABLE),
             NAME(CL_MEM_COPY_OVERLAP),
             NAME(CL_IMAGE_FORMAT_MISMATCH),
             NAME(CL_IMAGE_FORMAT_NOT_SUPPORTED),
             NAME(CL_BUILD_PROGRAM_FAILURE),
             NAME(CL_MAP_FAILURE),
             NAME(CL_MISALIGNED_SUB_BUFFER_OFFSET),
             NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST),
             NAME(CL_COMPILE_PROGRAM_FAILURE),
             NAME(CL_LINKER_NOT_AVAILABLE),
             NAME(CL_LINK_PROGRAM_FAILURE),
             NAME(CL_DEVICE_PARTITION_FAILED),
             NAME(CL_KERNEL_ARG_INFO_NOT_AVAILABLE),
             NAME(CL_INVALID_VALUE),
             NAME(CL_INVALID_DEVICE_TYPE),
             NAME(CL_INVALID_PLATFORM),
             NAME(CL_INVALID_DEVICE),
             NAME(CL_INVALID_CONTEXT),
             NAME(CL_INVALID_QUEUE_PROPERTIES),
             NAME(CL_INVALID_COMMAND_QUEUE),
             NAME(CL_INVALID_HOST_PTR),
             NAME(CL_INVALID_MEM_OBJECT),
             NAME(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR),
             NAME(CL_INVALID_IMAGE_SIZE),
             NAME(CL_INVALID_SAMPLER),
             NAME(CL_INVALID_BINARY),
             NAME(CL_INVALID_BUILD_OPTIONS),
             NAME(CL_INVALID_PROGRAM),
             NAME(CL_INVALID_PROGRAM_EXECUTABLE),
             NAME(CL_INVALID_KERNEL_NAME),
             NAME(CL_INVALID_KERNEL_DEFINITION),
             NAME(CL_INVALID_KERNEL),
             NAME(CL_INVALID_ARG_INDEX),
             NAME(CL_INVALID_ARG_VALUE),
             NAME(CL_INVALID_ARG_SIZE),
             NAME(CL_INVALID_KERNEL_ARGS),
             NAME(CL_INVALID_WORK_DIMENSION),
             NAME(CL_INVALID_WORK_GROUP_SIZE),
             NAME(CL_INVALID_WORK_ITEM_SIZE),
             NAME(CL_INVALID_GLOBAL_OFFSET),
             NAME(CL_INVALID_EVENT_WAIT_LIST),
             NAME(CL_INVALID_EVENT),
             NAME(CL_INVALID_OPERATION),
             NAME(CL_INVALID_GL_OBJECT),
             NAME(CL_INVALID_BUFFER_SIZE),
             NAME(CL_INVALID_MIP_LEVEL),
             NAME(CL_INVALID_GLOBAL_WORK_SIZE),
             NAME(CL_INVALID_PROPERTY),
             NAME(CL_INVALID_IMAGE_DESCRIPTOR),
             NAME(CL_INVALID_COMPILER_OPTIONS),
             NAME(CL_INVALID_LINKER_OPTIONS),
             NAME(CL_INVALID_DEVICE_PARTITION_COUNT),
             {-1001, "CL_PLATFORM_NOT_FOUND_KHR"}};

const char *rt_cl_error_name(cl_int error)
{
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (names[i].code == error)
            return names[i].name;
    return "unknown error";
}

bool rt_cl_check(cl_int error, const char *call, const char *file, int line, rt_status *status)
{
    if (error == CL_SUCCESS)
        return true;
    /* The name of the call is enough; its arguments would be C that the reader has not seen. */
    const int length = (int)strcspn(call, "(");
    return rt_status_fail(status, RT_ERROR_DEVICE, "rt: %s:%d: %.*s: %s (%d)", file, line, length,
                          call, rt_cl_error_name(error), (int)error);
}
