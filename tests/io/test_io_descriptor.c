/* test_io_descriptor.c - files of the library never take the place of a standard stream that is
 * closed; outputs through symbolic links. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

/* wrap: access */
#include "support/files.h"

#include <meshwalk/meshwalk.h>

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
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

static const char mesh_text[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/* --- closed streams --------------------------------------------------------------------------- */

/* The streams put aside while they are closed. */
static int kept[3];

static void close_streams(void)
{
    fflush(NULL);
    for (int fd = 0; fd < 3; fd++) {
        kept[fd] = fcntl(fd, F_DUPFD_CLOEXEC, 100);
        close(fd);
    }
}

static void open_streams(void)
{
    for (int fd = 0; fd < 3; fd++) {
        if (kept[fd] < 0) continue; /* it was closed before */
        dup2(kept[fd], fd);
        close(kept[fd]);
    }
}

static bool streams_are_closed(void)
{
    bool closed = true;
    for (int fd = 0; fd < 3; fd++) closed = closed && fcntl(fd, F_GETFD) == -1;
    return closed;
}

typedef struct outcome {
    bool read, points, constraints, edits, written, standard, closed;
} outcome;

static bool write_output(bool *closed)
{
    mw_output *output;
    if (mw_output_open("out.txt", &output, NULL) != MW_OK) return false;
    *closed = *closed && streams_are_closed();
    mw_output_printf(output, "all");
    return mw_output_close(output, 1, NULL) == MW_OK;
}

/* What works with closed streams; no file may be found in their places meanwhile. Nothing is
 * asserted here, since that prints. */
static outcome work(void)
{
    outcome o = {.closed = true};
    mw_mesh_file mesh;
    mw_point_reader *points;
    mw_constraint_file constraints;
    mw_edit_reader *edits;
    mw_error error;
    close_streams();
    o.read = mw_read_mesh("mesh.off", NULL, &mesh, NULL) == MW_OK;
    o.closed = o.closed && streams_are_closed();
    o.points = mw_point_reader_open("points.txt", NULL, &points, NULL) == MW_OK;
    o.closed = o.closed && streams_are_closed();
    o.constraints = mw_read_constraints("lines.poly", NULL, &constraints, NULL) == MW_OK;
    o.edits = mw_edit_reader_open("edits.txt", NULL, &edits, NULL) == MW_OK;
    o.closed = o.closed && streams_are_closed();
    o.written = write_output(&o.closed);
    o.standard = mw_point_reader_open("-", NULL, NULL, NULL) == MW_ERROR_ARGUMENT;
    mw_point_reader *none = NULL;
    o.standard = o.standard && mw_point_reader_open("-", NULL, &none, &error) == MW_ERROR_SYSTEM &&
                 !none && strstr(error.message, "standard input") != NULL;
    if (o.read) mw_mesh_file_release(&mesh);
    if (o.points) mw_point_reader_close(points);
    if (o.constraints) mw_constraint_file_release(&constraints);
    if (o.edits) mw_edit_reader_close(edits);
    o.closed = o.closed && streams_are_closed();
    open_streams();
    return o;
}

static void test_closed_streams(void **state)
{
    (void)state;
    for (int hidden = 0; hidden < 2; hidden++) {
        files_write_text("mesh.off", mesh_text);
        files_write_text("points.txt", "0 0\n1 1\n");
        files_write_text("lines.poly", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n1 0\n0 0 1\n0\n");
        files_write_text("edits.txt", "undo\n");
        proc_hidden = hidden;
        outcome o = work();
        proc_hidden = false;
        assert_true(o.read);
        assert_true(o.points);
        assert_true(o.constraints);
        assert_true(o.edits);
        assert_true(o.written);
        assert_true(o.standard);
        assert_true(o.closed);
        char *contents = files_read("out.txt", NULL);
        assert_string_equal(contents, "all");
        free(contents);
        files_clear();
    }
}

/* --- links ------------------------------------------------------------------------------------ */

static void write_through(const char *name, const char *text, bool commit)
{
    mw_output *output = NULL;
    mw_error error;
    if (mw_output_open(name, &output, &error) != MW_OK) fail_msg("%s", error.message);
    mw_output_printf(output, "%s", text);
    assert_int_equal(mw_output_close(output, commit, NULL), MW_OK);
}

static void expect_link(const char *name, const char *target)
{
    char found[64];
    ssize_t length = readlink(name, found, sizeof found - 1);
    assert_true(length > 0);
    found[length] = 0;
    assert_string_equal(found, target);
}

static void expect_text(const char *name, const char *text)
{
    char *contents = files_read(name, NULL);
    assert_non_null(contents);
    assert_string_equal(contents, text);
    free(contents);
}

/* A link to a link to a file that does not exist yet, in another directory. */
static void test_dangling_link(void **state)
{
    (void)state;
    for (int hidden = 0; hidden < 2; hidden++) {
        proc_hidden = hidden;
        assert_int_equal(mkdir("deep", 0777), 0);
        assert_int_equal(symlink("deep/second.txt", "first.txt"), 0);
        assert_int_equal(symlink("real.txt", "deep/second.txt"), 0);
        write_through("first.txt", "never", false);
        assert_int_equal(access("deep/real.txt", F_OK), -1);
        write_through("first.txt", "new", true);
        expect_link("first.txt", "deep/second.txt");
        expect_link("deep/second.txt", "real.txt");
        expect_text("deep/real.txt", "new");
        char *name;
        assert_int_equal(mw_output_resolve("first.txt", &name, NULL), MW_OK);
        assert_string_equal(name, "deep/real.txt");
        free(name);
        assert_int_equal(unlink("deep/real.txt"), 0);
        assert_int_equal(unlink("deep/second.txt"), 0);
        assert_int_equal(rmdir("deep"), 0);
        files_clear();
        proc_hidden = false;
    }
}

static void test_absolute_link(void **state)
{
    (void)state;
    char place[4096], target[4200];
    assert_non_null(getcwd(place, sizeof place));
    snprintf(target, sizeof target, "%s/real.txt", place);
    assert_int_equal(symlink(target, "link.txt"), 0);
    write_through("link.txt", "new", true);
    expect_text("real.txt", "new");
    write_through("link.txt", "newer", true);
    expect_text("real.txt", "newer");
    struct stat status;
    assert_int_equal(lstat("link.txt", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    files_clear();
}

static void test_bad_links(void **state)
{
    (void)state;
    static const char *const names[] = {"round.txt", "self.txt", "lost.txt"};
    static const char *const says[] = {"Too many levels", "Too many levels", "No such file"};
    assert_int_equal(symlink("trip.txt", "round.txt"), 0);
    assert_int_equal(symlink("round.txt", "trip.txt"), 0);
    assert_int_equal(symlink("self.txt", "self.txt"), 0);
    assert_int_equal(symlink("nowhere/real.txt", "lost.txt"), 0);
    for (int i = 0; i < 3; i++) {
        mw_output *output;
        char *name = NULL;
        mw_error error;
        assert_int_equal(mw_output_open(names[i], &output, &error), MW_ERROR_SYSTEM);
        assert_null(output);
        assert_non_null(strstr(error.message, says[i]));
        assert_int_equal(strncmp(error.message, names[i], strlen(names[i])), 0);
        assert_int_equal(mw_output_resolve(names[i], &name, &error),
                         i < 2 ? MW_ERROR_SYSTEM : MW_OK);
        free(name);
    }
    assert_int_equal(mw_output_resolve(NULL, NULL, NULL), MW_ERROR_ARGUMENT);
    expect_link("self.txt", "self.txt");
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_streams),
        cmocka_unit_test(test_dangling_link),
        cmocka_unit_test(test_absolute_link),
        cmocka_unit_test(test_bad_links),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
