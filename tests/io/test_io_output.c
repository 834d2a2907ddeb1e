/* test_io_output.c - output files: complete under their name or not there at all. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

/* wrap: access */
#include "io/text/output.h"
#include "support/files.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Without /proc no file without a name can get one: then a temporary name is used. */
static bool proc_hidden;
int __real_access(const char *path, int mode);
int __wrap_access(const char *path, int mode);
int __wrap_access(const char *path, int mode)
{
    if (proc_hidden && strncmp(path, "/proc", 5) == 0) {
        errno = ENOENT;
        return -1;
    }
    return __real_access(path, mode);
}

static int hide_proc(void **state)
{
    (void)state;
    proc_hidden = true;
    return 0;
}

static int show_proc(void **state)
{
    (void)state;
    proc_hidden = false;
    return 0;
}

static void expect_contents(const char *name, const char *wanted)
{
    char *contents = files_read(name, NULL);
    assert_non_null(contents);
    assert_string_equal(contents, wanted);
    free(contents);
}

static mw_output *open_output(const char *path)
{
    mw_output *output = NULL;
    mw_error error;
    if (mw_output_open(path, &output, &error) != MW_OK) fail_msg("%s", error.message);
    return output;
}

static void test_commit(void **state)
{
    (void)state;
    mw_output *output = open_output("new.txt");
    mw_output_write(output, "text ", 5);
    mw_output_double(output, 0.1);
    mw_output_printf(output, " %d %s\n", 7, "words");
    assert_false(files_exists("new.txt"));
    assert_false(mw_output_failed(output));
    assert_int_equal(mw_output_close(output, 1, NULL), MW_OK);
    expect_contents("new.txt", "text 0.1 7 words\n");
    assert_int_equal(files_count(), 1);
    files_clear();
}

static void test_abandon(void **state)
{
    (void)state;
    files_write_text("old.txt", "precious");
    mw_output *output = open_output("old.txt");
    mw_output_printf(output, "half");
    mw__output_flush(output);
    assert_int_equal(mw_output_close(output, 0, NULL), MW_OK);
    expect_contents("old.txt", "precious");
    output = open_output("never.txt");
    assert_int_equal(mw_output_close(output, 0, NULL), MW_OK);
    assert_int_equal(files_count(), 1);
    files_clear();
}

/* Replaced in one step: who has the old file open goes on reading it. */
static void test_replace(void **state)
{
    (void)state;
    files_write_text("data.txt", "old");
    assert_int_equal(chmod("data.txt", 0640), 0);
    FILE *reader = fopen("data.txt", "r");
    mw_output *output = open_output("data.txt");
    mw_output_printf(output, "new contents");
    expect_contents("data.txt", "old");
    assert_int_equal(mw_output_close(output, 1, NULL), MW_OK);
    char text[16] = "";
    assert_int_equal(fread(text, 1, 15, reader), 3);
    assert_string_equal(text, "old");
    fclose(reader);
    expect_contents("data.txt", "new contents");
    struct stat status;
    assert_int_equal(stat("data.txt", &status), 0);
    assert_int_equal(status.st_mode & 0777, 0640);
    assert_int_equal(files_count(), 1);
    files_clear();
}

static void test_permissions(void **state)
{
    (void)state;
    mode_t old = umask(027);
    mw_output *output = open_output("fresh.txt");
    mw_output_close(output, 1, NULL);
    struct stat status;
    assert_int_equal(stat("fresh.txt", &status), 0);
    umask(old);
    assert_int_equal(status.st_mode & 0777, 0640);
    files_clear();
}

static void test_symbolic_link(void **state)
{
    (void)state;
    files_write_text("real.txt", "old");
    assert_int_equal(symlink("real.txt", "link.txt"), 0);
    mw_output *output = open_output("link.txt");
    mw_output_printf(output, "new");
    assert_int_equal(mw_output_close(output, 1, NULL), MW_OK);
    struct stat status;
    assert_int_equal(lstat("link.txt", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    expect_contents("real.txt", "new");
    files_clear();
}

/* Two writers of one name: the last to finish wins, nothing else is left. */
static void test_race(void **state)
{
    (void)state;
    mw_output *first = open_output("same.txt"), *second = open_output("same.txt");
    mw_output_printf(first, "first");
    mw_output_printf(second, "second");
    assert_int_equal(mw_output_close(second, 1, NULL), MW_OK);
    expect_contents("same.txt", "second");
    assert_int_equal(mw_output_close(first, 1, NULL), MW_OK);
    expect_contents("same.txt", "first");
    assert_int_equal(files_count(), 1);
    files_clear();
}

static void test_large(void **state)
{
    (void)state;
    mw_output *output = open_output("large.txt");
    char *block = malloc(300001);
    assert_non_null(block);
    memset(block, 'a', 300000);
    block[300000] = 0;
    mw_output_write(output, block, 300000);
    mw_output_printf(output, "%s", block);
    for (int i = 0; i < 300000; i++) mw__output_char(output, 'a');
    for (int i = 0; i < 100000; i++) mw__output_text(output, "aaa");
    for (int i = 0; i < 100000; i++) mw_output_double(output, 111);
    mw__output_integer(output, UINT64_MAX);
    assert_int_equal(mw_output_close(output, 1, NULL), MW_OK);
    size_t size;
    char *contents = files_read("large.txt", &size);
    assert_int_equal(size, 5 * 300000 + 20);
    for (size_t i = 0; i < 4 * 300000; i++)
        if (contents[i] != 'a') fail();
    for (size_t i = 4 * 300000; i < 5 * 300000; i++)
        if (contents[i] != '1') fail();
    assert_string_equal(contents + 5 * 300000, "18446744073709551615");
    free(contents);
    free(block);
    files_clear();
}

static void expect_open_error(const char *path, const char *says)
{
    mw_output *output;
    mw_error error;
    assert_int_equal(mw_output_open(path, &output, &error), MW_ERROR_SYSTEM);
    assert_null(output);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, path);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, says);
}

static void test_no_such_place(void **state)
{
    (void)state;
    expect_open_error("nowhere/out.txt", "No such file or directory");
    expect_open_error("/", "Is a directory");
    expect_open_error("/dev/null/out.txt", "Not a directory");
    files_write_text("locked.txt", "precious");
    assert_int_equal(chmod("locked.txt", 0444), 0);
    if (access("locked.txt", W_OK) != 0) expect_open_error("locked.txt", "Permission denied");
    files_clear();
}

static void test_full_device(void **state)
{
    (void)state;
    if (access("/dev/full", W_OK) != 0) {
        print_message("left out: there is no /dev/full\n");
        skip();
    }
    mw_error error;
    mw_output *output = open_output("/dev/full");
    for (int i = 0; i < 100000; i++) mw_output_printf(output, "%d\n", i);
    assert_true(mw_output_failed(output));
    assert_int_equal(mw_output_close(output, 1, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "/dev/full: No space left on device");
    output = open_output("/dev/full"); /* little data: the error shows in the end only */
    mw_output_printf(output, "text");
    assert_false(mw_output_failed(output));
    assert_int_equal(mw_output_close(output, 1, &error), MW_ERROR_SYSTEM);
    output = open_output("/dev/null");
    mw_output_printf(output, "text");
    assert_int_equal(mw_output_close(output, 1, NULL), MW_OK);
}

/* A limit on the size of files stands for a full disk: nothing is left. In a child, since the
 * limit stays. */
static void test_full_disk(void **state)
{
    (void)state;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        struct rlimit limit = {20000, 20000};
        mw_output *output = NULL;
        mw_error error = {0};
        signal(SIGXFSZ, SIG_IGN);
        int right = setrlimit(RLIMIT_FSIZE, &limit) == 0 &&
                    mw_output_open("out.txt", &output, &error) == MW_OK;
        for (int i = 0; right && i < 100000; i++) mw_output_printf(output, "%d\n", i);
        right = right && mw_output_failed(output) &&
                mw_output_close(output, 1, &error) == MW_ERROR_SYSTEM;
        _exit(right && strstr(error.message, "out.txt: File too large") ? 0 : 1);
    }
    int end = 0;
    assert_int_equal(waitpid(child, &end, 0), child);
    assert_true(WIFEXITED(end) && WEXITSTATUS(end) == 0);
    assert_int_equal(files_count(), 0);
}

static void test_closed_pipe(void **state)
{
    (void)state;
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    close(ends[0]);
    char path[32];
    snprintf(path, sizeof path, "/dev/fd/%d", ends[1]);
    if (access(path, W_OK) != 0) {
        print_message("left out: there is no /dev/fd\n");
        skip();
    }
    void (*old)(int) = signal(SIGPIPE, SIG_IGN);
    mw_error error;
    mw_output *output = open_output(path);
    for (int i = 0; i < 100000 && !mw_output_failed(output); i++)
        mw_output_printf(output, "%d\n", i);
    assert_int_equal(mw_output_close(output, 1, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "Broken pipe");
    signal(SIGPIPE, old);
    close(ends[1]);
}

/* Killed while writing: nothing is left, or what mw_output_temporary named. */
static void test_killed(void **state)
{
    (void)state;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        mw_output *output = NULL;
        if (mw_output_open("killed.txt", &output, NULL) != MW_OK) _exit(1);
        for (int i = 0; i < 100000; i++) mw_output_printf(output, "%d\n", i);
        if (mw_output_temporary(output)) unlink(mw_output_temporary(output));
        kill(getpid(), SIGKILL);
    }
    int end = 0;
    assert_int_equal(waitpid(child, &end, 0), child);
    assert_true(WIFSIGNALED(end));
    assert_int_equal(files_count(), 0);
}

/* Standard output stays open, and data reach it in order. */
static void test_standard_output(void **state)
{
    (void)state;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        mw_output *output = NULL;
        int fd = open("captured.txt", O_WRONLY | O_CREAT, 0600);
        if (fd < 0 || dup2(fd, STDOUT_FILENO) < 0 || mw_output_open("-", &output, NULL) != MW_OK)
            _exit(1);
        mw_output_printf(output, "one\n");
        if (mw_output_close(output, 1, NULL) != MW_OK) _exit(2);
        _exit(write(STDOUT_FILENO, "two\n", 4) == 4 ? 0 : 3);
    }
    int end = 0;
    assert_int_equal(waitpid(child, &end, 0), child);
    assert_true(WIFEXITED(end) && WEXITSTATUS(end) == 0);
    expect_contents("captured.txt", "one\ntwo\n");
    files_clear();
}

static void test_temporary_name(void **state)
{
    (void)state;
    mw_output *output = open_output("named.txt");
    const char *temporary = mw_output_temporary(output);
    assert_non_null(temporary);
    assert_int_equal(strncmp(strrchr(temporary, '/') ? strrchr(temporary, '/') + 1 : temporary,
                             ".named.txt.", 11),
                     0);
    assert_true(files_exists(temporary));
    assert_int_equal(mw_output_close(output, 0, NULL), MW_OK);
    assert_int_equal(files_count(), 0);
}

static void test_arguments(void **state)
{
    (void)state;
    mw_output *output;
    assert_int_equal(mw_output_open(NULL, &output, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_output_open("x", NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_output_close(NULL, 1, NULL), MW_OK);
}

/* A very long name has no room for the temporary one; it works, or fails by name. */
static void test_long_name(void **state)
{
    (void)state;
    char name[256];
    memset(name, 'n', 255);
    name[255] = 0;
    for (int round = 0; round < 2; round++) {
        mw_output *output = open_output(name);
        mw_output_printf(output, "round %d", round);
        assert_int_equal(mw_output_close(output, 1, NULL), MW_OK);
    }
    expect_contents(name, "round 1");
    assert_int_equal(files_count(), 1);
    files_clear();
}

int main(void)
{
#define BOTH_WAYS(test)                                                                            \
    cmocka_unit_test(test), cmocka_unit_test_setup_teardown(test, hide_proc, show_proc)
    const struct CMUnitTest tests[] = {
        BOTH_WAYS(test_commit),
        BOTH_WAYS(test_abandon),
        BOTH_WAYS(test_replace),
        BOTH_WAYS(test_permissions),
        BOTH_WAYS(test_symbolic_link),
        BOTH_WAYS(test_race),
        BOTH_WAYS(test_large),
        BOTH_WAYS(test_no_such_place),
        BOTH_WAYS(test_full_disk),
        BOTH_WAYS(test_killed),
        BOTH_WAYS(test_long_name),
        cmocka_unit_test(test_full_device),
        cmocka_unit_test(test_closed_pipe),
        cmocka_unit_test(test_standard_output),
        cmocka_unit_test_setup_teardown(test_temporary_name, hide_proc, show_proc),
        cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
