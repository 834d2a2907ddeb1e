/* test_io_huge.c - numbers beyond 64 bits are named as they stand in the file, by each reader. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/files.h"

#include <meshwalk/meshwalk.h>

#include <string.h>

#define HUGE_COUNT "18446744073709551616"
#define PLY_TOP "ply\nformat ascii 1.0\n"
#define PLY_VERTICES(count)                                                                        \
    "element vertex " count "\nproperty float x\nproperty float y\nproperty float z\n"
#define PLY_FACES(count)                                                                           \
    "element face " count "\nproperty list int int vertex_indices\nend_header\n"
#define PLY_POINTS "0 0 0\n1 0 0\n0 1 0\n"
#define OFF_POINTS "0 0 0\n1 0 0\n0 1 0\n"
#define NODE(head) head "\n1 0 0\n2 1 0\n3 0 1\n"

typedef struct huge {
    const char *name, *text;
    int64_t line;
} huge;

static void expect_named(mw_status status, const mw_error *error, const huge *h)
{
    if (status != MW_ERROR_INPUT) fail_msg("%s: status %d", h->name, (int)status);
    if (!strstr(error->message, HUGE_COUNT)) fail_msg("%s: \"%s\"", h->name, error->message);
    if (strstr(error->message, "9223372036854775807"))
        fail_msg("%s: \"%s\"", h->name, error->message);
    if (h->line >= 0 && error->line != h->line) fail_msg("%s: \"%s\"", h->name, error->message);
}

static void test_meshes(void **state)
{
    (void)state;
    static const huge meshes[] = {
        {"a.off", "OFF\n" HUGE_COUNT " 1 0\n" OFF_POINTS, 2},
        {"b.off", "OFF\n3 " HUGE_COUNT " 0\n" OFF_POINTS "3 0 1 2\n", 2},
        {"c.off", "OFF 3 1 0\n" OFF_POINTS HUGE_COUNT " 0 1 2\n", -1},
        {"d.off", "OFF\n3 1 0\n" OFF_POINTS "3 0 1 " HUGE_COUNT "\n", 6},
        {"e.off", "OFF\n3 1 0\n" OFF_POINTS "3 0 1 -" HUGE_COUNT "\n", 6},
        {"a.ply", PLY_TOP PLY_VERTICES(HUGE_COUNT) PLY_FACES("1") PLY_POINTS "3 0 1 2\n", 3},
        {"b.ply", PLY_TOP PLY_VERTICES("3") PLY_FACES(HUGE_COUNT) PLY_POINTS "3 0 1 2\n", 7},
        {"c.ply", PLY_TOP PLY_VERTICES("3") PLY_FACES("1") PLY_POINTS HUGE_COUNT " 0 1 2\n", 13},
        {"d.ply", PLY_TOP PLY_VERTICES("3") PLY_FACES("1") PLY_POINTS "3 0 1 " HUGE_COUNT "\n", 13},
        {"e.ply",
         PLY_TOP "element other " HUGE_COUNT "\nproperty int a\n" PLY_VERTICES("3") PLY_FACES("0"),
         3},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " HUGE_COUNT "\n", 4},
        {"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -" HUGE_COUNT "/1/1\n", 4},
    };
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        mw_mesh_file file;
        mw_error error;
        files_write_text(meshes[i].name, meshes[i].text);
        expect_named(mw_read_mesh(meshes[i].name, NULL, &file, &error), &error, &meshes[i]);
    }
    files_clear();
}

static void test_pairs(void **state)
{
    (void)state;
    static const struct {
        const char *node, *ele;
    } pairs[] = {
        {NODE(HUGE_COUNT " 2 0 0"), "1 3 0\n1 1 2 3\n"},
        {NODE("3 " HUGE_COUNT " 0 0"), "1 3 0\n1 1 2 3\n"},
        {NODE("3 2 " HUGE_COUNT " 0"), "1 3 0\n1 1 2 3\n"},
        {NODE("3 2 0 " HUGE_COUNT), "1 3 0\n1 1 2 3\n"},
        {NODE("3 2 0 0"), HUGE_COUNT " 3 0\n1 1 2 3\n"},
        {NODE("3 2 0 0"), "1 " HUGE_COUNT " 0\n1 1 2 3\n"},
        {NODE("3 2 0 0"), "1 3 " HUGE_COUNT "\n1 1 2 3\n"},
        {NODE("3 2 0 0"), "1 3 0\n1 1 2 " HUGE_COUNT "\n"},
        {NODE("3 2 0 0"), "1 3 0\n" HUGE_COUNT " 1 2 3\n"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        const huge shown = {pairs[i].node, NULL, -1};
        mw_mesh_file file;
        mw_error error;
        files_write_text("pair.node", pairs[i].node);
        files_write_text("pair.ele", pairs[i].ele);
        expect_named(mw_read_mesh("pair.node", NULL, &file, &error), &error, &shown);
    }
    files_clear();
}

static void test_constraints(void **state)
{
    (void)state;
    static const huge files[] = {
        {"a.poly", NODE("3 2 0 0") HUGE_COUNT " 0\n1 1 2\n0\n", 5},
        {"b.poly", NODE("3 2 0 0") "1 0\n1 1 2\n" HUGE_COUNT "\n", 7},
        {"c.poly", NODE(HUGE_COUNT " 2 0 0") "1 0\n1 1 2\n0\n", 1},
        {"d.poly", NODE("3 2 0 0") "1 0\n1 1 " HUGE_COUNT "\n0\n", 6},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        mw_constraint_file file;
        mw_error error;
        files_write_text(files[i].name, files[i].text);
        expect_named(mw_read_constraints(files[i].name, NULL, &file, &error), &error, &files[i]);
    }
    files_clear();
}

static void test_points(void **state)
{
    (void)state;
    static const huge heads[] = {
        {"a.node", HUGE_COUNT " 2 0 0\n1 0 0\n", 1},
        {"b.node", "1 " HUGE_COUNT " 0 0\n1 0 0\n", 1},
    };
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) {
        mw_point_reader *reader = NULL;
        mw_error error;
        files_write_text(heads[i].name, heads[i].text);
        expect_named(mw_point_reader_open(heads[i].name, NULL, &reader, &error), &error, &heads[i]);
        assert_null(reader);
    }
    files_clear();
}

/* Of 64 bits without a sign the upper half has no place in a signed number. */
static void test_binary(void **state)
{
    (void)state;
    static const char head[] =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n"
        "property uchar y\nproperty uchar z\nelement face 1\n"
        "property list uint64 uchar vertex_indices\nend_header\n";
    static const char data[] = "\0\0\0\1\0\0\0\1\0\xff\xff\xff\xff\xff\xff\xff\xff\0\1\2";
    char file[sizeof head + sizeof data];
    memcpy(file, head, sizeof head - 1);
    memcpy(file + sizeof head - 1, data, sizeof data - 1);
    files_write("huge.ply", (bytes){file, sizeof head + sizeof data - 2});
    mw_mesh_file mesh;
    mw_error error;
    assert_int_equal(mw_read_mesh("huge.ply", NULL, &mesh, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "the number 18446744073709551615 is too large"));
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_meshes),      cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_constraints), cmocka_unit_test(test_points),
        cmocka_unit_test(test_binary),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
