/* The least that an OpenCL program can do: a device, a context, a queue, a program, one launch.
 * What it takes is what every OpenCL program pays before its work begins. */
#include <stdio.h>

#include "opencl/cl.h"
#include "opencl/device.h"

#define GLOBAL_SIZE 64

static bool launch(cl_command_queue queue, cl_program program, cl_mem buffer, rt_status *status)
{
    cl_int error = CL_SUCCESS;
    const size_t size = GLOBAL_SIZE;
    cl_kernel kernel = clCreateKernel(program, "nothing", &error);
    if (!RT_CL_MADE(error, "clCreateKernel", status))
        return false;
    const bool good =
        RT_CL(clSetKernelArg(kernel, 0, sizeof buffer, &buffer), status) &&
        RT_CL(clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &size, &size, 0, NULL, NULL),
              status) &&
        RT_CL(clFinish(queue), status);
    clReleaseKernel(kernel);
    return good;
}

static bool build_and_launch(const rt_device *device, cl_context context, cl_command_queue queue,
                             rt_status *status)
{
    const char *text = "__kernel void nothing(__global int *a) { a[get_global_id(0)] = 1; }";
    cl_int error = CL_SUCCESS;
    cl_mem buffer =
        clCreateBuffer(context, CL_MEM_WRITE_ONLY, GLOBAL_SIZE * sizeof(cl_int), NULL, &error);
    if (!RT_CL_MADE(error, "clCreateBuffer", status))
        return false;
    cl_program program = clCreateProgramWithSource(context, 1, &text, NULL, &error);
    const bool good = RT_CL_MADE(error, "clCreateProgramWithSource", status) &&
                      RT_CL(clBuildProgram(program, 1, &device->id, "", NULL, NULL), status) &&
                      launch(queue, program, buffer, status);
    if (program)
        clReleaseProgram(program);
    clReleaseMemObject(buffer);
    return good;
}

static bool run(const rt_device *device, rt_status *status)
{
    cl_int error = CL_SUCCESS;
    cl_context context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &error);
    if (!RT_CL_MADE(error, "clCreateContext", status))
        return false;
    cl_command_queue queue = clCreateCommandQueue(context, device->id, 0, &error);
    bool good = RT_CL_MADE(error, "clCreateCommandQueue", status);
    if (good) {
        good = build_and_launch(device, context, queue, status);
        clReleaseCommandQueue(queue);
    }
    clReleaseContext(context);
    return good;
}

/* The device is chosen as rt chooses it; the one argument is its --device. */
int main(int argc, char **argv)
{
    rt_status status = RT_STATUS_INIT;
    rt_device_list devices = {NULL, 0, 0};
    const rt_device *device = NULL;
    const bool good =
        rt_device_list_read(&devices, &status) &&
        (device = rt_device_choose(&devices, argc > 1 ? argv[1] : NULL, &status)) != NULL &&
        run(device, &status);
    if (status.text)
        fputs(status.text, stderr);
    rt_device_list_clear(&devices);
    const enum rt_code code = good ? RT_OK : status.code;
    rt_status_clear(&status);
    return (int)code;
}
