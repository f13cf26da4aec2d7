/* The one check that every OpenCL call goes through. */
#ifndef RT_OPENCL_CL_H
#define RT_OPENCL_CL_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include "common/status.h"

/* True for CL_SUCCESS; otherwise adds "file:line: call: CL_NAME (code)" to the status, with code
 * RT_ERROR_DEVICE, and returns false. */
bool rt_cl_check(cl_int error, const char *call, const char *file, int line, rt_status *status);

/* For calls that return their error ... */
#define RT_CL(call, status) rt_cl_check(call, #call, __FILE__, __LINE__, status)
/* ... and for those that return an object and put the error into a variable. */
#define RT_CL_MADE(error, name, status) rt_cl_check(error, name, __FILE__, __LINE__, status)

/* "CL_INVALID_VALUE" and so on; "unknown error" for a code that OpenCL 1.2 does not have. */
const char *rt_cl_error_name(cl_int error);

#endif
