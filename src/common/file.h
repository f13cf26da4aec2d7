/* Whole files: read into memory, and written so that an earlier file is never half overwritten. */
#ifndef RT_COMMON_FILE_H
#define RT_COMMON_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include "common/status.h"

/* A file's bytes, followed by a terminating NUL that `length` does not count. */
typedef struct rt_file_text {
    char *bytes; /* owned */
    size_t length;
} rt_file_text;

/* Reads a file, or standard input for NULL. Returns NULL on success, else the reason as text that
 * needs no release; *text is then empty. */
const char *rt_file_read(const char *path, rt_file_text *text);
/* The path that `name` has where the file `path` names it: as it is when it begins with a slash,
 * else relative to the folder of `path`. The caller frees it; NULL without memory. */
char *rt_file_beside(const char *path, const char *name, size_t length);
void rt_file_free(rt_file_text *text);

/* Removes a file, or a folder with all that is in it, links as such; false, with errno set, where
 * some of it stays. */
bool rt_file_remove_tree(const char *path);

/* A file on its way out. It is opened before the work, so that a target that cannot be written is
 * known at once; what stands at the target stays until rt_output_commit. */
typedef struct rt_output {
    char *target;    /* owned; NULL for standard output */
    char *temporary; /* owned; NULL when written in place (standard output, pipes, devices) */
    int descriptor;  /* -1 when not open */
} rt_output;

#define RT_OUTPUT_INIT ((rt_output){NULL, NULL, -1})

/* Opens a temporary file beside `path` ("-" for standard output). A target that is not a regular
 * file, such as /dev/null, is written in place; a symbolic link stays and what it points to is
 * replaced. A target without any write permission is refused, for root too. */
bool rt_output_open(rt_output *output, const char *path, rt_status *status);
bool rt_output_write(rt_output *output, const void *bytes, size_t length, rt_status *status);
/* Puts the file in its place. */
bool rt_output_commit(rt_output *output, rt_status *status);
/* Closes and removes what has not been committed; harmless after a commit. */
void rt_output_discard(rt_output *output);

#endif
