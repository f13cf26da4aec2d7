/* What stands at a target stays until the new file is whole. */
#define _GNU_SOURCE
#include "support/support.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/file.h"

static void assert_content(const char *path, const char *expected)
{
    char *text = test_read_file(path, NULL);
    assert_non_null(text);
    assert_string_equal(text, expected);
    free(text);
}

/* Names in the test folder that begin with `name`: the file and any temporary beside it. */
static int count_files(const char *name)
{
    DIR *folder = opendir(test_folder());
    assert_non_null(folder);
    int count = 0;
    for (const struct dirent *entry; (entry = readdir(folder));)
        count += strncmp(entry->d_name, name, strlen(name)) == 0;
    closedir(folder);
    return count;
}

static void a_commit_replaces_at_once(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    const char *path = test_path("commit.txt");
    test_write_text(path, "old");
    assert_good(rt_output_open(&output, path, &status), &status);
    assert_good(rt_output_write(&output, "new", 3, &status), &status);
    assert_content(path, "old");
    assert_good(rt_output_commit(&output, &status), &status);
    assert_content(path, "new");
    assert_int_equal(count_files("commit.txt"), 1);
}

static void a_discard_changes_nothing(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    const char *path = test_path("discard.txt");
    test_write_text(path, "old");
    assert_good(rt_output_open(&output, path, &status), &status);
    assert_good(rt_output_write(&output, "new", 3, &status), &status);
    rt_output_discard(&output);
    assert_content(path, "old");
    assert_int_equal(count_files("discard.txt"), 1);
    rt_output_discard(&output); /* harmless twice */
}

static void permissions_are_those_of_a_plain_file(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    const mode_t before = umask(027);
    const char *path = test_path("mode.txt");
    assert_good(rt_output_open(&output, path, &status), &status);
    assert_good(rt_output_commit(&output, &status), &status);
    umask(before);
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
}

static void targets_that_cannot_be_written(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    assert_false(rt_output_open(&output, test_path("missing/a.png"), &status));
    assert_int_equal(status.code, RT_ERROR_OUTPUT);
    assert_non_null(strstr(status.text, "No such file or directory"));
    rt_status_clear(&status);
    assert_false(rt_output_open(&output, test_folder(), &status));
    assert_int_equal(status.code, RT_ERROR_OUTPUT);
    rt_status_clear(&status);
    const char *path = test_path("read-only.txt");
    test_write_text(path, "old");
    assert_int_equal(chmod(path, 0444), 0);
    assert_false(rt_output_open(&output, path, &status));
    assert_int_equal(status.code, RT_ERROR_OUTPUT);
    assert_content(path, "old");
    rt_status_clear(&status);
}

static void a_full_disk_is_an_error(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    /* A device is written in place, and stays what it is. */
    assert_good(rt_output_open(&output, "/dev/full", &status), &status);
    assert_false(rt_output_write(&output, "x", 1, &status));
    assert_int_equal(status.code, RT_ERROR_OUTPUT);
    assert_non_null(strstr(status.text, "No space left on device"));
    rt_output_discard(&output);
    struct stat info;
    assert_int_equal(stat("/dev/full", &info), 0);
    assert_true(S_ISCHR(info.st_mode));
    rt_status_clear(&status);
}

static void a_link_stays_a_link(void **state)
{
    (void)state;
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    const char *path = test_path("pointed-to.txt"), *link = test_path("a-link.txt");
    test_write_text(path, "old");
    assert_int_equal(symlink(path, link), 0);
    assert_good(rt_output_open(&output, link, &status), &status);
    assert_good(rt_output_write(&output, "new", 3, &status), &status);
    assert_good(rt_output_commit(&output, &status), &status);
    assert_content(path, "new");
    struct stat info;
    assert_int_equal(lstat(link, &info), 0);
    assert_true(S_ISLNK(info.st_mode));
}

static void files_of_every_size_are_read_whole(void **state)
{
    (void)state;
    const size_t sizes[] = {0, 1, 65535, 65536, 65537, 1000000};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        char *bytes = malloc(sizes[i] + 1);
        assert_non_null(bytes);
        for (size_t k = 0; k < sizes[i]; ++k)
            bytes[k] = (char)(k * 31);
        const char *path = test_path("sized.bin");
        test_write_file(path, bytes, sizes[i]);
        rt_file_text text;
        assert_null(rt_file_read(path, &text));
        assert_int_equal(text.length, sizes[i]);
        assert_memory_equal(text.bytes, bytes, sizes[i]);
        assert_int_equal(text.bytes[text.length], 0);
        rt_file_free(&text);
        free(bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_commit_replaces_at_once),
        cmocka_unit_test(a_discard_changes_nothing),
        cmocka_unit_test(permissions_are_those_of_a_plain_file),
        cmocka_unit_test(targets_that_cannot_be_written),
        cmocka_unit_test(a_full_disk_is_an_error),
        cmocka_unit_test(a_link_stays_a_link),
        cmocka_unit_test(files_of_every_size_are_read_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
