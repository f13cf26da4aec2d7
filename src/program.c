#define _GNU_SOURCE
#include "program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "kernel_text.h"
#include "program_cache.h"

enum rt_rounding rt_program_rounding(const rt_device *device)
{
    if (device->rounds_divide_sqrt)
        return RT_ROUNDING_DEVICE;
    return device->has_fp64 ? RT_ROUNDING_DOUBLE : RT_ROUNDING_FMA;
}

/* Few sizes, because each is a variant to compile. */
static int round_stack(size_t need)
{
    int size = 64;
    while ((size_t)size < need)
        size *= 4;
    return size;
}

/* So many lights are a loop that is unrolled; each count is a variant to compile. */
#define LIGHTS_UNROLLED 4

/* Of the effects, the options of those that are on: the others' default is not to be there. */
static void effect_options(const rt_effects *effects, char *options, size_t size)
{
    static const struct {
        enum rt_effect effect;
        const char *option;
    } names[] = {{RT_EFFECT_CHECKER, "CHECKER"},
                 {RT_EFFECT_TEXTURE, "TEXTURE"},
                 {RT_EFFECT_REFLECTION, "REFLECT"},
                 {RT_EFFECT_REFRACTION, "REFRACT"},
                 {RT_EFFECT_ABSORPTION, "ABSORB"},
                 {RT_EFFECT_OCCLUSION, "AMBIENT_OCCLUSION"},
                 {RT_EFFECT_FOG, "FOG"},
                 {RT_EFFECT_GRADIENT, "GRADIENT"},
                 {RT_EFFECT_ANTIALIASING, "ANTIALIAS"},
                 {RT_EFFECT_DEPTH_OF_FIELD, "LENS"}};
    size_t length = strlen(options);
    const bool all = effects->mode == RT_EFFECTS_ALL;
    if (all)
        length += (size_t)snprintf(options + length, size - length, " -DRT_SWITCHED=1");
    else if (effects->light_count <= LIGHTS_UNROLLED)
        length += (size_t)snprintf(options + length, size - length, " -DRT_LIGHTS=%d",
                                   effects->light_count);
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (rt_effects_has(effects, names[i].effect))
            length +=
                (size_t)snprintf(options + length, size - length, " -DRT_%s=1", names[i].option);
    const bool soft = rt_effects_has(effects, RT_EFFECT_SOFT_SHADOWS);
    if (soft || rt_effects_has(effects, RT_EFFECT_HARD_SHADOWS))
        snprintf(options + length, size - length, " -DRT_SHADOWS=%d", soft ? 2 : 1);
}

void rt_program_options(const rt_effects *effects, const rt_walk *walk, enum rt_rounding rounding,
                        char *options)
{
    const bool all = effects->mode == RT_EFFECTS_ALL;
    snprintf(options, RT_PROGRAM_OPTIONS_SIZE,
             "-cl-std=CL1.2%s%s -DRT_ACCURACY=%d -DRT_LANES=%d -DRT_PACKET=%d -DRT_TREE=%d "
             "-DRT_STACK=%d "
             "-DRT_OCCLUSION=%d "
             "-DRT_SPHERES=%d -DRT_TRIANGLES=%d -DRT_CULL=%d "
             "-DRT_SMOOTH=%d -DRT_SHININESS_BITS=%d -DRT_SHININESS_FRACTION=%d -DRT_ROUNDING=%d",
             rounding == RT_ROUNDING_DEVICE ? " -cl-fp32-correctly-rounded-divide-sqrt" : "",
             walk->accuracy == RT_ACCURACY_FAST ? " -cl-fast-relaxed-math -cl-denorms-are-zero"
                                                : "",
             (int)walk->accuracy, walk->lanes, walk->packet, walk->stack_size > 0,
             round_stack(walk->stack_size), walk->with_occlusion, all || effects->has_spheres,
             all || effects->has_triangles, effects->cull_sign,
             rt_effects_has(effects, RT_EFFECT_SMOOTH_NORMALS), all ? 20 : effects->exponent_bits,
             all || effects->has_fractional_exponent, (int)rounding);
    effect_options(effects, options, RT_PROGRAM_OPTIONS_SIZE);
}

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

/* The recipe's program, from the cache or the compiler. */
static cl_program build(rt_recipe *recipe, rt_status *status)
{
    const char *folder = getenv("RT_KERNELS");
    if (folder && *folder) {
        /* Kernels that someone is working on: each is another program, and not kept. */
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

cl_program rt_program_build(cl_context context, const rt_device *device, const char *options,
                            rt_status *status)
{
    const char *more = getenv("RT_BUILD_OPTIONS");
    char *all = NULL;
    if (asprintf(&all, "%s%s%s", options, more && *more ? " " : "", more ? more : "") < 0) {
        rt_status_no_memory(status, "kernels");
        return NULL;
    }
    rt_recipe recipe = {context, device, all, rt_kernel_text, rt_kernel_text_length};
    cl_program program = build(&recipe, status);
    free(all);
    return program;
}
