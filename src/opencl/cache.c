#define _GNU_SOURCE
#include "opencl/cache.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

#include "common/array.h"
#include "common/file.h"

#define MEGABYTE ((size_t)1 << 20)
#define DEFAULT_MEGABYTES 256
/* PoCL loads its files one by one while it runs, so those are left that may be in use. */
#define SECONDS_OF_REST 3600
/* Less is left on the disk than a picture's kernels may take. */
#define LITTLE_SPACE (64 * MEGABYTE)
#define POCL_FOLDER "pocl-kernels"

/* ---- Where it is ---- */

/* The folder's name, NULL for none; the caller frees it. */
static char *name_of_folder(void)
{
    const char *own = getenv("RT_CACHE_DIR");
    const char *shared = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    char *folder = NULL;
    int length = -1;
    if (own)
        length = *own ? asprintf(&folder, "%s", own) : -1;
    else if (shared && *shared == '/')
        length = asprintf(&folder, "%s/rt", shared);
    else if (home && *home == '/')
        length = asprintf(&folder, "%s/.cache/rt", home);
    return length < 0 ? NULL : folder;
}

static void make_folders(char *path)
{
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(path, 0700); /* most are there already; what cannot be made shows at the end */
        *slash = '/';
    }
    mkdir(path, 0700);
}

static bool is_own(const struct stat *s)
{
    return s->st_uid == geteuid() && !(s->st_mode & (S_IWGRP | S_IWOTH));
}

bool rt_cache_is_own(const char *path)
{
    struct stat s;
    return lstat(path, &s) == 0 && S_ISREG(s.st_mode) && is_own(&s);
}

/* Why a folder is not used; NULL where it is. */
static const char *objection(const char *folder)
{
    struct stat s;
    if (stat(folder, &s) != 0)
        return strerror(errno);
    if (!S_ISDIR(s.st_mode))
        return strerror(ENOTDIR);
    if (!is_own(&s))
        return "it belongs to somebody else, or others can write to it";
    return NULL;
}

char *rt_cache_folder(void)
{
    char *folder = name_of_folder();
    if (!folder)
        return NULL;
    make_folders(folder);
    if (!objection(folder))
        return folder;
    free(folder);
    return NULL;
}

void rt_cache_touch(const char *path)
{
    utimensat(AT_FDCWD, path, NULL, 0);
}

/* ---- What is in it ---- */

/* A program of rt's, or a folder of PoCL's that holds one. */
typedef struct entry {
    char *path; /* owned */
    size_t bytes;
    time_t used;
    bool is_pocls;
} entry;

typedef struct entries {
    entry *list; /* owned */
    size_t count, capacity;
    bool has_memory;
} entries;

/* What nftw adds up has no other way to its callback; a scan is of one thread. */
static _Thread_local entry *summed;

static int add_up(const char *path, const struct stat *s, int type, struct FTW *at)
{
    (void)path;
    (void)at;
    if (type != FTW_NS) {
        summed->bytes += (size_t)s->st_blocks * 512;
        if (s->st_mtime > summed->used)
            summed->used = s->st_mtime;
    }
    return 0;
}

static void add(entries *all, const char *folder, const char *name, bool is_pocls)
{
    entry e = {NULL, 0, 0, is_pocls};
    if (asprintf(&e.path, "%s/%s", folder, name) < 0) {
        all->has_memory = false;
        return;
    }
    summed = &e;
    nftw(e.path, add_up, 16, FTW_PHYS);
    summed = NULL;
    if (RT_ARRAY_GROW(all->list, all->count, &all->capacity)) {
        all->list[all->count++] = e;
    } else {
        all->has_memory = false;
        free(e.path);
    }
}

/* Calls `each` with what is in a folder, but for "." and "..". */
static void scan(entries *all, const char *folder,
                 void (*each)(entries *all, const char *folder, const char *name))
{
    DIR *open = opendir(folder);
    for (const struct dirent *e = open ? readdir(open) : NULL; e; e = readdir(open))
        if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
            each(all, folder, e->d_name);
    if (open)
        closedir(open);
}

/* ---- Whose the names are: somebody may keep other things in a folder that RT_CACHE_DIR names ----
 */

static bool begins_with(const char *name, const char *digits, size_t count)
{
    return strspn(name, digits) == count;
}

/* A program's hash, with an ending while it is written; what a compiler writes meanwhile. */
static bool is_ours(const char *name)
{
    return (begins_with(name, "0123456789abcdef", 16) && (name[16] == '\0' || name[16] == '.')) ||
           strncmp(name, RT_CACHE_COMPILING, strlen(RT_CACHE_COMPILING)) == 0;
}

#define POCLS_LETTERS "ABCDEFGHIJKLMNOP"

static void add_pocls(entries *all, const char *folder, const char *name)
{
    if (strspn(name, POCLS_LETTERS) == strlen(name))
        add(all, folder, name, true);
}

/* PoCL puts a program's folder into one of the first two letters of its hash. */
static void scan_pocls(entries *all, const char *folder, const char *name)
{
    const bool is_row = begins_with(name, POCLS_LETTERS, 2) && name[2] == '\0';
    if (!is_row && strncmp(name, "tempfile_", 9) != 0)
        return;
    char *path = NULL;
    if (asprintf(&path, "%s/%s", folder, name) < 0) {
        all->has_memory = false;
        return;
    }
    if (is_row)
        scan(all, path, add_pocls);
    else
        add(all, folder, name, true);
    free(path);
}

static void add_own(entries *all, const char *folder, const char *name)
{
    if (is_ours(name))
        add(all, folder, name, false);
    if (strcmp(name, POCL_FOLDER) != 0)
        return;
    char *path = NULL;
    if (asprintf(&path, "%s/%s", folder, name) < 0) {
        all->has_memory = false;
        return;
    }
    scan(all, path, scan_pocls);
    free(path);
}

static int by_use(const void *a, const void *b)
{
    const time_t x = ((const entry *)a)->used, y = ((const entry *)b)->used;
    return (x > y) - (x < y);
}

/* All that is in the folder, what has rested longest first. */
static entries entries_of(const char *folder)
{
    entries all = {NULL, 0, 0, true};
    scan(&all, folder, add_own);
    if (all.count)
        qsort(all.list, all.count, sizeof *all.list, by_use);
    return all;
}

static void free_entries(entries *all)
{
    for (size_t i = 0; i < all->count; ++i)
        free(all->list[i].path);
    free(all->list);
}

/* ---- How large it is ---- */

size_t rt_cache_limit(void)
{
    const char *text = getenv("RT_CACHE_SIZE");
    char *end = NULL;
    const unsigned long megabytes = text && *text ? strtoul(text, &end, 10) : DEFAULT_MEGABYTES;
    return (end && *end ? DEFAULT_MEGABYTES : (size_t)megabytes) * MEGABYTE;
}

void rt_cache_bound(void)
{
    char *folder = rt_cache_folder();
    if (!folder)
        return;
    entries all = entries_of(folder);
    const time_t now = time(NULL);
    size_t sum = 0;
    for (size_t i = 0; i < all.count; ++i)
        sum += all.list[i].bytes;
    for (size_t i = 0; i < all.count && sum > rt_cache_limit(); ++i) {
        const entry *e = &all.list[i];
        struct stat s;
        const bool is_folder = lstat(e->path, &s) == 0 && S_ISDIR(s.st_mode);
        if (is_folder && now - e->used < SECONDS_OF_REST)
            continue;
        rt_file_remove_tree(e->path);
        sum -= e->bytes;
    }
    free_entries(&all);
    free(folder);
}

/* The folder as it is named, where it can be used. */
static char *folder_or_reason(rt_status *status)
{
    char *folder = name_of_folder();
    if (!folder) {
        rt_status_fail(status, RT_ERROR_OUTPUT,
                       "rt: built programs are not kept: RT_CACHE_DIR is empty, or neither it nor "
                       "XDG_CACHE_HOME nor HOME is set");
        return NULL;
    }
    make_folders(folder);
    const char *reason = objection(folder);
    if (!reason)
        return folder;
    rt_status_fail(status, RT_ERROR_OUTPUT, "rt: built programs are not kept in '%s': %s", folder,
                   reason);
    free(folder);
    return NULL;
}

bool rt_cache_measure(rt_cache_size *size, rt_status *status)
{
    char *folder = folder_or_reason(status);
    *size = (rt_cache_size){0, 0, 0, 0};
    if (!folder)
        return false;
    entries all = entries_of(folder);
    for (size_t i = 0; i < all.count; ++i) {
        const entry *e = &all.list[i];
        *(e->is_pocls ? &size->pocl_programs : &size->programs) += 1;
        *(e->is_pocls ? &size->pocl_bytes : &size->bytes) += e->bytes;
    }
    const bool good = all.has_memory || rt_status_no_memory(status, "the cache");
    free_entries(&all);
    free(folder);
    return good;
}

bool rt_cache_clear(rt_status *status)
{
    char *folder = folder_or_reason(status);
    if (!folder)
        return false;
    entries all = entries_of(folder);
    bool good = all.has_memory || rt_status_no_memory(status, "the cache");
    for (size_t i = 0; good && i < all.count; ++i)
        if (!rt_file_remove_tree(all.list[i].path))
            good = rt_status_fail(status, RT_ERROR_OUTPUT, "rt: cannot remove '%s': %s",
                                  all.list[i].path, strerror(errno));
    free_entries(&all);
    free(folder);
    return good;
}

/* ---- PoCL's ---- */

static bool has_room(char *folder)
{
    struct statvfs disk;
    make_folders(folder);
    return access(folder, W_OK | X_OK) == 0 && statvfs(folder, &disk) == 0 &&
           (size_t)disk.f_bavail * disk.f_frsize >= LITTLE_SPACE;
}

static char *temporary; /* until the process ends */

static void remove_temporary(void)
{
    rt_file_remove_tree(temporary);
}

static void use_temporary(void)
{
    const char *parent = getenv("TMPDIR");
    if (temporary ||
        asprintf(&temporary, "%s/rt-pocl-XXXXXX", parent && *parent ? parent : "/tmp") < 0)
        return;
    if (mkdtemp(temporary) && setenv("POCL_CACHE_DIR", temporary, 1) == 0 &&
        atexit(remove_temporary) == 0)
        return;
    free(temporary);
    temporary = NULL;
}

void rt_cache_suit_pocl(void)
{
    const char *given = getenv("POCL_CACHE_DIR");
    char *folder = NULL;
    if (given && *given) {
        folder = strdup(given);
    } else {
        char *own = rt_cache_folder();
        if (own && asprintf(&folder, "%s/" POCL_FOLDER, own) < 0)
            folder = NULL;
        free(own);
    }
    if (folder && has_room(folder))
        setenv("POCL_CACHE_DIR", folder, 1);
    else
        use_temporary();
    free(folder);
}
