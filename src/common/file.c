#define _GNU_SOURCE
#include "common/file.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Bytes asked for at a time where the size is not known beforehand. */
#define CHUNK ((size_t)1 << 16)

static const char *read_all(int descriptor, rt_file_text *text)
{
    struct stat info;
    size_t capacity = CHUNK;
    if (fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) && info.st_size > 0)
        capacity = (size_t)info.st_size + 2; /* one more to see the end, one for the NUL */
    for (;;) {
        char *grown = realloc(text->bytes, capacity);
        if (!grown)
            return strerror(ENOMEM);
        text->bytes = grown;
        while (text->length + 1 < capacity) {
            const ssize_t got =
                read(descriptor, text->bytes + text->length, capacity - 1 - text->length);
            if (got < 0 && errno == EINTR)
                continue;
            if (got < 0)
                return strerror(errno);
            if (got == 0) {
                text->bytes[text->length] = '\0';
                return NULL;
            }
            text->length += (size_t)got;
        }
        capacity *= 2;
    }
}

const char *rt_file_read(const char *path, rt_file_text *text)
{
    *text = (rt_file_text){NULL, 0};
    const int descriptor = path ? open(path, O_RDONLY | O_CLOEXEC) : STDIN_FILENO;
    if (descriptor < 0)
        return strerror(errno);
    const char *reason = read_all(descriptor, text);
    if (path)
        close(descriptor);
    if (reason)
        rt_file_free(text);
    return reason;
}

char *rt_file_beside(const char *path, const char *name, size_t length)
{
    const char *slash = strrchr(path, '/');
    const int folder = !slash || (length > 0 && name[0] == '/') ? 0 : (int)(slash + 1 - path);
    char *joined = NULL;
    return asprintf(&joined, "%.*s%.*s", folder, path, (int)length, name) < 0 ? NULL : joined;
}

void rt_file_free(rt_file_text *text)
{
    free(text->bytes);
    *text = (rt_file_text){NULL, 0};
}

static int remove_entry(const char *path, const struct stat *what, int type, struct FTW *at)
{
    (void)what;
    (void)type;
    (void)at;
    return remove(path);
}

bool rt_file_remove_tree(const char *path)
{
    return nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS) == 0;
}

static bool fail(rt_status *status, const char *path, const char *reason)
{
    return rt_status_fail(status, RT_ERROR_OUTPUT, "rt: cannot write '%s': %s", path, reason);
}

/* Opens a fresh file beside the target with the permissions that a plain creation would give. */
static bool open_temporary(rt_output *output, rt_status *status)
{
    if (asprintf(&output->temporary, "%s.XXXXXX", output->target) < 0) {
        output->temporary = NULL;
        return rt_status_no_memory(status, "a path");
    }
    output->descriptor = mkostemp(output->temporary, O_CLOEXEC);
    if (output->descriptor < 0) {
        const int reason = errno;
        free(output->temporary);
        output->temporary = NULL;
        return fail(status, output->target, strerror(reason));
    }
    const mode_t mask = umask(0);
    umask(mask);
    if (fchmod(output->descriptor, 0666 & ~mask) != 0)
        return fail(status, output->target, strerror(errno));
    return true;
}

static bool open_target(rt_output *output, rt_status *status)
{
    struct stat info;
    const bool exists = stat(output->target, &info) == 0;
    if (exists && S_ISDIR(info.st_mode))
        return fail(status, output->target, strerror(EISDIR));
    if (exists && !S_ISREG(info.st_mode)) {
        output->descriptor = open(output->target, O_WRONLY | O_CLOEXEC);
        return output->descriptor >= 0 || fail(status, output->target, strerror(errno));
    }
    /* Renaming would replace a read-only file, and root may write one, but somebody meant it. */
    if (exists && ((info.st_mode & 0222) == 0 || access(output->target, W_OK) != 0))
        return fail(status, output->target, "the file is read-only");
    return open_temporary(output, status);
}

bool rt_output_open(rt_output *output, const char *path, rt_status *status)
{
    *output = RT_OUTPUT_INIT;
    if (strcmp(path, "-") == 0) {
        output->descriptor = STDOUT_FILENO;
        return true;
    }
    output->target = realpath(path, NULL);
    if (!output->target)
        output->target = strdup(path);
    if (!output->target)
        return rt_status_no_memory(status, "a path");
    if (open_target(output, status))
        return true;
    rt_output_discard(output);
    return false;
}

static const char *name_of(const rt_output *output)
{
    return output->target ? output->target : "standard output";
}

bool rt_output_write(rt_output *output, const void *bytes, size_t length, rt_status *status)
{
    const char *next = bytes;
    while (length > 0) {
        const ssize_t written = write(output->descriptor, next, length);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return fail(status, name_of(output), strerror(errno));
        next += written;
        length -= (size_t)written;
    }
    return true;
}

bool rt_output_commit(rt_output *output, rt_status *status)
{
    if (!output->target) /* standard output stays open; a pipe that is gone failed in write */
        return true;
    const int closed = close(output->descriptor);
    output->descriptor = -1;
    if (closed != 0 || (output->temporary && rename(output->temporary, output->target) != 0)) {
        const bool failed = fail(status, output->target, strerror(errno));
        rt_output_discard(output);
        return failed;
    }
    free(output->temporary);
    output->temporary = NULL;
    rt_output_discard(output);
    return true;
}

void rt_output_discard(rt_output *output)
{
    if (output->target && output->descriptor >= 0)
        close(output->descriptor);
    if (output->temporary)
        unlink(output->temporary);
    free(output->temporary);
    free(output->target);
    *output = RT_OUTPUT_INIT;
}
