/* The list of wrong kernels against the kernels: without a device, in milliseconds. */
#include "support/mutants.h"
#include "support/support.h"

#include <ctype.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "opencl/kernel_text.h"

static void each_text_is_there_once(void **state)
{
    (void)state;
    size_t wrong = 0;
    for (int i = MUTANT_NONE + 1; i < MUTANT_COUNT; ++i) {
        const test_mutation *m = &test_mutations[i];
        char path[300];
        size_t count = 0;
        for (const char *const *name = rt_kernel_names; *name; ++name) {
            if (strcmp(*name, m->file) != 0)
                continue;
            snprintf(path, sizeof path, "kernels/%s", *name);
            char *text = test_read_file(path, NULL);
            count += text ? test_count_text(text, m->from) : 0;
            free(text);
        }
        if (count != 1 || strcmp(m->from, m->to) == 0) {
            print_error("%s: '%s' is in %s %zu times\n", m->name, m->from, m->file, count);
            ++wrong;
        }
    }
    assert_int_equal(wrong, 0);
}

/* Whether a name is in a text, as a whole word. */
static bool names(const char *text, const char *name)
{
    for (const char *at = strstr(text, name); at; at = strstr(at + 1, name)) {
        const char next = at[strlen(name)];
        if (!isalnum((unsigned char)next) && next != '_')
            return true;
    }
    return false;
}

static void each_is_put_to_a_test(void **state)
{
    (void)state;
    static bool is_named[MUTANT_COUNT];
    glob_t found;
    assert_int_equal(glob("tests/*/*.c", 0, NULL, &found), 0);
    for (size_t f = 0; f < found.gl_pathc; ++f) {
        char *text = test_read_file(found.gl_pathv[f], NULL);
        assert_non_null(text);
        for (int i = MUTANT_NONE + 1; i < MUTANT_COUNT; ++i)
            is_named[i] = is_named[i] || names(text, test_mutations[i].name);
        free(text);
    }
    globfree(&found);
    for (int i = MUTANT_NONE + 1; i < MUTANT_COUNT; ++i)
        if (!is_named[i])
            fail_msg("%s is put to no test", test_mutations[i].name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_text_is_there_once),
                                       cmocka_unit_test(each_is_put_to_a_test)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
