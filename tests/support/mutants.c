#define _GNU_SOURCE
#include "support/mutants.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "opencl/kernel_text.h"
#include "support/support.h"

const test_mutation test_mutations[MUTANT_COUNT] = {
#define MUTANT(name, file, what, from, to)                                                         \
    [MUTANT_##name] = {"MUTANT_" #name, file, what, from, to},
#include "support/mutants.def"
#undef MUTANT
};

/* Makes the folders on the way to a file below `root`. */
static void make_folders(const char *root, const char *name)
{
    char path[300];
    mkdir(root, 0777);
    for (const char *slash = strchr(name, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(path, sizeof path, "%s/%.*s", root, (int)(slash - name), name);
        mkdir(path, 0777);
    }
}

/* The text of a kernel file; the caller frees it. */
static char *read_kernel(const char *folder, const char *name)
{
    char *path = NULL;
    assert_true(asprintf(&path, "%s/%s", folder, name) > 0);
    char *text = test_read_file(path, NULL);
    free(path);
    assert_non_null(text);
    return text;
}

/* The file with the change in it. In kernels that `make mutants` has changed in that very place the
 * file is taken as it was. */
static char *mutated(const char *folder, const test_mutation *m)
{
    char *text = read_kernel(folder, m->file), *changed = NULL;
    if (strcmp(folder, "kernels") != 0 && test_count_text(text, m->from) != 1) {
        free(text);
        text = read_kernel("kernels", m->file);
    }
    if (test_count_text(text, m->from) != 1)
        fail_msg("%s: '%s' is not in %s exactly once", m->name, m->from, m->file);
    const char *at = strstr(text, m->from);
    assert_true(
        asprintf(&changed, "%.*s%s%s", (int)(at - text), text, m->to, at + strlen(m->from)) >= 0);
    free(text);
    return changed;
}

/* RT_KERNELS before it was changed. */
static char original[512];
static bool is_changed;

void test_mutate_kernels(test_mutant mutant)
{
    const test_mutation *m = &test_mutations[mutant];
    test_restore_kernels();
    const char *folder = getenv("RT_KERNELS");
    assert_true(snprintf(original, sizeof original, "%s", folder ? folder : "") <
                (int)sizeof original);
    if (!original[0])
        folder = "kernels";
    const char *to_folder = test_path("kernels");
    bool is_found = false;
    for (const char *const *name = rt_kernel_names; *name; ++name) {
        char target[1024];
        const bool is_meant = strcmp(*name, m->file) == 0;
        char *text = is_meant ? mutated(folder, m) : read_kernel(folder, *name);
        snprintf(target, sizeof target, "%s/%s", to_folder, *name);
        make_folders(to_folder, *name);
        test_write_text(target, text);
        free(text);
        is_found = is_found || is_meant;
    }
    assert_true(is_found);
    is_changed = true;
    setenv("RT_KERNELS", to_folder, 1);
}

void test_restore_kernels(void)
{
    if (!is_changed)
        return;
    is_changed = false;
    if (original[0])
        setenv("RT_KERNELS", original, 1);
    else
        unsetenv("RT_KERNELS");
}
