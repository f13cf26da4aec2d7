#define _GNU_SOURCE
#include "opencl/program.h"

#include <stdio.h>
#include <stdlib.h>

#include "common/file.h"
#include "opencl/kernel_text.h"
#include "opencl/program_cache.h"

/* The files of RT_KERNELS, each behind a #line like the embedded ones; NULL after an error. */
static char *read_folder(const char *folder, size_t *length, rt_status *status)
{
    char *all = NULL;
    *length = 0;
    FILE *stream = open_memstream(&all, length);
    if (!stream) {
        rt_status_no_memory(status, "kernels");
        return NULL;
    }
    bool good = true;
    for (const char *const *name = rt_kernel_names; good && *name; ++name) {
        char *path = NULL;
        rt_file_text text = {NULL, 0};
        if (asprintf(&path, "%s/%s", folder, *name) < 0) {
            good = rt_status_no_memory(status, "kernels");
            break;
        }
        const char *reason = rt_file_read(path, &text);
        if (reason)
            good =
                rt_status_fail(status, RT_ERROR_DEVICE, "rt: cannot read '%s': %s", path, reason);
        else
            fprintf(stream, "#line 1 \"%s\"\n%s\n", path, text.bytes);
        rt_file_free(&text);
        free(path);
    }
    if (fclose(stream) != 0)
        good = rt_status_no_memory(status, "kernels");
    if (good)
        return all;
    free(all);
    return NULL;
}

static void report_failure(cl_program program, const rt_device *device, const char *options,
                           rt_status *status)
{
    size_t size = 0;
    char *log = NULL;
    if (clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size) ==
            CL_SUCCESS &&
        (log = calloc(size + 1, 1)) != NULL)
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    rt_status_fail(status, RT_ERROR_DEVICE,
                   "rt: the kernels do not build\ndevice: %s\ndriver: %s\noptions: %s\nlog:\n%s",
                   device->name, device->driver, options, log ? log : "none");
    free(log);
}

/* Compiles the source; NULL, with the whole log in the status, where it does not build. */
static cl_program compile(const rt_recipe *r, rt_status *status)
{
    cl_int error = CL_SUCCESS;
    cl_program program =
        clCreateProgramWithSource(r->context, 1, (const char *[]){r->text}, &r->length, &error);
    if (!RT_CL_MADE(error, "clCreateProgramWithSource", status))
        return NULL;
    error = clBuildProgram(program, 1, &r->device->id, r->options, NULL, NULL);
    if (error == CL_SUCCESS)
        return program;
    if (error == CL_BUILD_PROGRAM_FAILURE)
        report_failure(program, r->device, r->options, status);
    else
        RT_CL_MADE(error, "clBuildProgram", status);
    clReleaseProgram(program);
    return NULL;
}

/* The options with those of the environment, NULL without memory; the caller frees them. */
static char *all_options(const char *options)
{
    const char *more = getenv("RT_BUILD_OPTIONS");
    char *all = NULL;
    return asprintf(&all, "%s%s%s", options, more && *more ? " " : "", more ? more : "") < 0 ? NULL
                                                                                             : all;
}

/* Kernels that someone is working on, or NULL: each is another program, and not kept. */
static const char *folder_of_kernels(void)
{
    const char *folder = getenv("RT_KERNELS");
    return folder && *folder ? folder : NULL;
}

/* The recipe's program, from the cache or the compiler. */
static cl_program build(rt_recipe *recipe, rt_status *status)
{
    const char *folder = folder_of_kernels();
    if (folder) {
        char *text = read_folder(folder, &recipe->length, status);
        recipe->text = text;
        cl_program program = text ? compile(recipe, status) : NULL;
        free(text);
        return program;
    }
    cl_program program = rt_program_cache_load(recipe);
    if (program)
        return program;
    program = compile(recipe, status);
    if (program)
        rt_program_cache_save(recipe, program);
    return program;
}

cl_program rt_program_kept(cl_context context, const rt_device *device, const char *options)
{
    char *all = folder_of_kernels() ? NULL : all_options(options);
    const rt_recipe recipe = {context, device, all, rt_kernel_text, rt_kernel_text_length};
    cl_program program = all ? rt_program_cache_load(&recipe) : NULL;
    free(all);
    return program;
}

bool rt_program_can_be_kept(const rt_device *device, const char *options)
{
    char *all = folder_of_kernels() ? NULL : all_options(options);
    const rt_recipe recipe = {NULL, device, all, rt_kernel_text, rt_kernel_text_length};
    const bool can = all && rt_program_cache_wants(&recipe);
    free(all);
    return can;
}

cl_program rt_program_build(cl_context context, const rt_device *device, const char *options,
                            rt_status *status)
{
    char *all = all_options(options);
    if (!all) {
        rt_status_no_memory(status, "kernels");
        return NULL;
    }
    rt_recipe recipe = {context, device, all, rt_kernel_text, rt_kernel_text_length};
    cl_program program = build(&recipe, status);
    free(all);
    return program;
}
