#define _GNU_SOURCE
#include "bench/folder.h"

#include <errno.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool bench_folder_make(char *folder, rt_status *status)
{
    const char *parent = getenv("TMPDIR");
    snprintf(folder, BENCH_FOLDER_SIZE, "%s/rt-bench-XXXXXX", parent && *parent ? parent : "/tmp");
    return mkdtemp(folder) || rt_status_fail(status, RT_ERROR_OUTPUT, "bench: cannot make '%s': %s",
                                             folder, strerror(errno));
}

static int remove_one(const char *path, const struct stat *about, int kind, struct FTW *place)
{
    (void)about;
    (void)kind;
    (void)place;
    return remove(path);
}

void bench_folder_remove(const char *folder)
{
    nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}
