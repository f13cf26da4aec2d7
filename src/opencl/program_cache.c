#define _GNU_SOURCE
#include "opencl/program_cache.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/file.h"
#include "opencl/cache.h"

#define MAGIC "rt program 1\n"

/* Everything that decides what comes out of a build; the caller frees it. */
static char *key_of(const rt_recipe *r, size_t *length)
{
    char *key = NULL;
    FILE *stream = open_memstream(&key, length);
    if (!stream)
        return NULL;
    fprintf(stream, MAGIC "%s\n%s\n%s\n%s\n%s\n%zu\n", r->device->platform_name, r->device->name,
            r->device->version, r->device->driver, r->options, r->length);
    fwrite(r->text, 1, r->length, stream);
    if (fclose(stream) == 0)
        return key;
    free(key);
    return NULL;
}

/* FNV-1a (Fowler, Noll and Vo). It only names the file: the key in it decides. */
static uint64_t hash_of(const char *bytes, size_t length)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < length; ++i)
        hash = (hash ^ (uint8_t)bytes[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static char *path_of(const char *key, size_t length)
{
    char *folder = rt_cache_folder();
    char *path = NULL;
    if (folder &&
        asprintf(&path, "%s/%016llx", folder, (unsigned long long)hash_of(key, length)) < 0)
        path = NULL;
    free(folder);
    return path;
}

static cl_program program_of(const rt_recipe *r, const unsigned char *binary, size_t size)
{
    cl_int status = CL_SUCCESS, error = CL_SUCCESS;
    cl_program program =
        clCreateProgramWithBinary(r->context, 1, &r->device->id, &size, &binary, &status, &error);
    if (error != CL_SUCCESS)
        return NULL;
    if (status == CL_SUCCESS &&
        clBuildProgram(program, 1, &r->device->id, r->options, NULL, NULL) == CL_SUCCESS)
        return program;
    clReleaseProgram(program);
    return NULL;
}

/* What stands between key and binary: runtimes crash on a binary that is damaged. */
#define SEAL_SIZE 20
static void seal(const char *binary, size_t size, char text[SEAL_SIZE + 1])
{
    snprintf(text, SEAL_SIZE + 1, "\n%0*llx\n", SEAL_SIZE - 2,
             (unsigned long long)hash_of(binary, size));
}

bool rt_program_cache_wants(const rt_recipe *r)
{
    size_t length = 0;
    char *key = key_of(r, &length);
    char *folder = rt_cache_folder();
    char *path = key && folder ? path_of(key, length) : NULL;
    const bool wants = path && access(path, F_OK) != 0 && access(folder, W_OK | X_OK) == 0;
    free(path);
    free(folder);
    free(key);
    return wants;
}

cl_program rt_program_cache_load(const rt_recipe *r)
{
    size_t length = 0;
    char *key = key_of(r, &length);
    char *path = key ? path_of(key, length) : NULL;
    rt_file_text file = {NULL, 0};
    cl_program program = NULL;
    if (path && rt_cache_is_own(path) && rt_file_read(path, &file) == NULL &&
        file.length > length + SEAL_SIZE && memcmp(file.bytes, key, length) == 0) {
        const char *binary = file.bytes + length + SEAL_SIZE;
        const size_t size = file.length - length - SEAL_SIZE;
        char expected[SEAL_SIZE + 1];
        seal(binary, size, expected);
        if (memcmp(file.bytes + length, expected, SEAL_SIZE) == 0)
            program = program_of(r, (const unsigned char *)binary, size);
        if (program)
            rt_cache_touch(path);
    }
    rt_file_free(&file);
    free(path);
    free(key);
    return program;
}

/* The program's binary; NULL where the runtime does not give it out. The caller frees it. */
static unsigned char *binary_of(cl_program program, size_t *size)
{
    *size = 0;
    if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof *size, size, NULL) !=
            CL_SUCCESS ||
        *size == 0)
        return NULL;
    unsigned char *binary = malloc(*size);
    if (binary &&
        clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof binary, &binary, NULL) == CL_SUCCESS)
        return binary;
    free(binary);
    return NULL;
}

void rt_program_cache_save(const rt_recipe *r, cl_program program)
{
    size_t length = 0, size = 0;
    char *key = key_of(r, &length);
    char *path = key ? path_of(key, length) : NULL;
    unsigned char *binary = path ? binary_of(program, &size) : NULL;
    rt_status ignored = RT_STATUS_INIT;
    rt_output file = RT_OUTPUT_INIT;
    char sealed[SEAL_SIZE + 1];
    if (binary)
        seal((const char *)binary, size, sealed);
    if (binary && rt_output_open(&file, path, &ignored) &&
        rt_output_write(&file, key, length, &ignored) &&
        rt_output_write(&file, sealed, SEAL_SIZE, &ignored) &&
        rt_output_write(&file, binary, size, &ignored) && rt_output_commit(&file, &ignored)) {
        chmod(path, S_IRUSR | S_IWUSR);
        rt_cache_bound();
    }
    rt_output_discard(&file);
    rt_status_clear(&ignored);
    free(binary);
    free(path);
    free(key);
}
