/* test_surface_edits_io.c - edits of a surface as lines of text: every request with all that it
 * names, what is refused and how, chains of any length. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/files.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static mw_surface_edit_reader *reader_of(const char *text)
{
    mw_surface_edit_reader *reader;
    mw_error error;
    files_write_text("s.txt", text);
    if (mw_surface_edit_reader_open("s.txt", &reader, &error)) fail_msg("%s", error.message);
    return reader;
}

/* --- what is taken ---------------------------------------------------------------------------- */

typedef struct wanted_line {
    const char *text, *kept; /* the line, and the request without its comment; NULL: the line */
    mw_surface_edit_line_kind line;
    mw_surface_edit_kind edit;
    uint32_t triangle, vertex[3];
    double point[3], motion[3];
    uint32_t count, path[4], other[4];
} wanted_line;

#define EDIT(kind) MW_SURFACE_EDIT_LINE_EDIT, MW_SURFACE_##kind
#define USUAL                                                                                      \
    {                                                                                              \
        NAN, NAN, NAN                                                                              \
    }

static const wanted_line taken[] = {
    {"add-vertex 1 2.5 -3e2", NULL, EDIT(ADD_VERTEX), .point = {1, 2.5, -300}},
    {"ADD-Vertex,1,2,3 # here", "ADD-Vertex,1,2,3", EDIT(ADD_VERTEX), .point = {1, 2, 3}},
    {"remove-vertex 7", NULL, EDIT(REMOVE_VERTEX), .vertex = {7}},
    {"remove-vertex 17.0", NULL, EDIT(REMOVE_VERTEX), .vertex = {17}},
    {"move-vertex 7 1 2 3", NULL, EDIT(MOVE_VERTEX), .vertex = {7}, .point = {1, 2, 3}},
    {"add-triangle 7 8 9", NULL, EDIT(ADD_TRIANGLE), .vertex = {7, 8, 9}},
    {"remove-triangle 11", NULL, EDIT(REMOVE_TRIANGLE), .triangle = 11},
    {"split-edge 4 5", NULL, EDIT(SPLIT_EDGE), .vertex = {4, 5}, .point = USUAL},
    {"split-edge 4 5,,, # no place", "split-edge 4 5", EDIT(SPLIT_EDGE), .vertex = {4, 5},
     .point = USUAL},
    {"split-edge 4 5 1 2 3", NULL, EDIT(SPLIT_EDGE), .vertex = {4, 5}, .point = {1, 2, 3}},
    {"split-triangle 6", NULL, EDIT(SPLIT_TRIANGLE), .triangle = 6, .point = USUAL},
    {"split-triangle 6 3 2 1", NULL, EDIT(SPLIT_TRIANGLE), .triangle = 6, .point = {3, 2, 1}},
    {"flip 4 5", NULL, EDIT(FLIP), .vertex = {4, 5}},
    {"collapse 5 4", NULL, EDIT(COLLAPSE), .vertex = {5, 4}, .point = USUAL},
    {"collapse 5 4 7 8 9", NULL, EDIT(COLLAPSE), .vertex = {5, 4}, .point = {7, 8, 9}},
    {"cut 1 2", NULL, EDIT(CUT), .count = 2, .path = {1, 2}},
    {"cut,1,,2,3,", "cut,1,,2,3", EDIT(CUT), .count = 3, .path = {1, 2, 3}},
    {"sew 1 2 to 3 4", NULL, EDIT(SEW), .count = 2, .path = {1, 2}, .other = {3, 4}},
    {"sew 1 2 9 TO 3 4 0", NULL, EDIT(SEW), .count = 3, .path = {1, 2, 9}, .other = {3, 4, 0}},
    {"probe 1 2 3 4 5 6", NULL, MW_SURFACE_EDIT_LINE_PROBE, .point = {1, 2, 3},
     .motion = {4, 5, 6}},
    {"undo", NULL, .line = MW_SURFACE_EDIT_LINE_UNDO},
    {"  compact  ", "  compact", .line = MW_SURFACE_EDIT_LINE_COMPACT},
};

static void expect_triple(const double got[3], const double wanted[3])
{
    for (int k = 0; k < 3; k++) assert_true(isnan(wanted[k]) ? isnan(got[k]) : got[k] == wanted[k]);
}

static void expect_line(const mw_surface_edit_line *got, const wanted_line *wanted)
{
    const mw_surface_edit *e = &got->edit;
    assert_int_equal(got->kind, wanted->line);
    assert_string_equal(got->text, wanted->kept ? wanted->kept : wanted->text);
    if (wanted->line == MW_SURFACE_EDIT_LINE_EDIT) {
        assert_int_equal(e->kind, wanted->edit);
        expect_triple(e->point, wanted->point);
    } else {
        expect_triple(got->point, wanted->point);
    }
    expect_triple(got->motion, wanted->motion);
    assert_int_equal(e->triangle, wanted->triangle);
    assert_memory_equal(e->vertex, wanted->vertex, sizeof e->vertex);
    assert_int_equal(e->path_count, wanted->count);
    for (uint32_t i = 0; i < wanted->count; i++) {
        assert_int_equal(e->path[i], wanted->path[i]);
        if (wanted->edit == MW_SURFACE_SEW) assert_int_equal(e->other[i], wanted->other[i]);
    }
}

static void test_requests(void **state)
{
    (void)state;
    char text[4000] = "# all of them\n\n,,\n";
    const size_t count = sizeof taken / sizeof *taken;
    double fraction = 0;
    mw_surface_edit_line line;
    mw_error error;
    for (size_t i = 0; i < count; i++) {
        strcat(text, taken[i].text);
        strcat(text, i % 2 ? "\n" : "\r\n");
    }
    mw_surface_edit_reader *reader = reader_of(text);
    for (size_t i = 0; i < count; i++) {
        if (mw_surface_edit_reader_read(reader, &line, &error)) fail_msg("%s", error.message);
        expect_line(&line, &taken[i]);
        assert_int_equal(line.line, i + 4);
        assert_true(mw_surface_edit_reader_fraction(reader) >= fraction);
        fraction = mw_surface_edit_reader_fraction(reader);
    }
    assert_true(fraction > 0.5 && fraction <= 1);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(mw_surface_edit_reader_read(reader, &line, &error), MW_OK);
        assert_int_equal(line.kind, MW_SURFACE_EDIT_LINE_NONE);
        assert_int_equal(line.line, 0);
    }
    mw_surface_edit_reader_close(reader);
}

/* Chains that need more room than there was. */
static void test_long_chains(void **state)
{
    (void)state;
    static const size_t lengths[] = {15, 16, 17, 2, 47, 48, 49, 500};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++)
        for (int sew = 0; sew < 2; sew++) {
            char text[9000] = "";
            size_t used = (size_t)sprintf(text, "cut 8 9\n%s", sew ? "sew" : "cut");
            for (size_t k = 0; k < lengths[i]; k++)
                used += (size_t)sprintf(text + used, " %zu", 1000 + k);
            if (sew) used += (size_t)sprintf(text + used, " to");
            for (size_t k = 0; k < lengths[i] && sew; k++)
                used += (size_t)sprintf(text + used, " %zu", 3000 + k);
            mw_surface_edit_reader *reader = reader_of(text);
            mw_surface_edit_line line;
            mw_error error;
            assert_int_equal(mw_surface_edit_reader_read(reader, &line, &error), MW_OK);
            if (mw_surface_edit_reader_read(reader, &line, &error)) fail_msg("%s", error.message);
            assert_int_equal(line.edit.path_count, lengths[i]);
            for (size_t k = 0; k < lengths[i]; k++) {
                assert_int_equal(line.edit.path[k], 1000 + k);
                if (sew) assert_int_equal(line.edit.other[k], 3000 + k);
            }
            mw_surface_edit_reader_close(reader);
        }
}

/* --- what is refused -------------------------------------------------------------------------- */

static const struct {
    const char *text, *says;
} refused[] = {
    {"add-vertx 1 2 3", "unknown edit 'add-vertx'; known edits are add-vertex, remove-vertex, "},
    {"add-vertex 1 2", "add-vertex: the z is missing"},
    {"add-vertex 1 b 3", "add-vertex: y: 'b' is not a number"},
    {"add-vertex 1 2 3 4", "add-vertex: '4' is one word too many"},
    {"remove-vertex", "remove-vertex: the vertex is missing"},
    {"remove-vertex -1", "remove-vertex: vertex: '-1' is not a vertex number"},
    {"remove-vertex 1.5", "is not a vertex number"},
    {"remove-vertex 4294967296", "is not a vertex number"},
    {"add-triangle 1 2", "add-triangle: the third vertex is missing"},
    {"remove-triangle x", "remove-triangle: triangle: 'x' is not a triangle number"},
    {"split-edge 1", "split-edge: the second vertex is missing"},
    {"split-edge 1 2 3", "split-edge: the y is missing"},
    {"split-triangle 1 2 3 4 5", "split-triangle: '5' is one word too many"},
    {"cut 1", "cut: a cut needs at least two vertices"},
    {"cut", "cut: a cut needs at least two vertices"},
    {"cut 1 2 to 3", "cut: 'to' is not a vertex number"},
    {"cut 1 2 too", "cut: vertex: 'too' is not a vertex number"},
    {"sew 1 2", "sew: the word 'to' and the other chain are missing"},
    {"sew 1 2 to 3",
     "sew: both chains need the same number of vertices, at least two; they have 2 and 1"},
    {"sew 1 to 3",
     "sew: both chains need the same number of vertices, at least two; they have 1 and 1"},
    {"sew 1 2 to 3 4 5", "they have 2 and 3"},
    {"sew 1 2 to 3 4 to 5 6", "sew: 'to' comes twice"},
    {"probe 1 2 3 4 5", "probe: the z of the motion is missing"},
    {"probe 1 2 3 a 5 6", "probe: x of the motion: 'a' is not a number"},
    {"undo 1", "undo: '1' is one word too many"},
    {"compact 1", "compact: '1' is one word too many"},
    {",1", "'1' is one word too many"},
};

static void test_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        char text[200];
        mw_surface_edit_line line;
        mw_error error;
        snprintf(text, sizeof text, "\n%s\nundo\n", refused[i].text);
        mw_surface_edit_reader *reader = reader_of(text);
        if (mw_surface_edit_reader_read(reader, &line, &error) == MW_OK)
            fail_msg("'%s' is taken", refused[i].text);
        files_expect_error(&error, MW_ERROR_INPUT, 2, refused[i].says);
        assert_int_equal(line.line, 2);
        assert_int_equal(mw_surface_edit_reader_read(reader, &line, &error), MW_OK);
        assert_int_equal(line.kind, MW_SURFACE_EDIT_LINE_UNDO);
        assert_int_equal(line.line, 3);
        mw_surface_edit_reader_close(reader);
    }
}

static void test_files(void **state)
{
    (void)state;
    mw_surface_edit_reader *reader;
    mw_surface_edit_line line;
    mw_error error;
    assert_int_equal(mw_surface_edit_reader_open("missing.txt", &reader, &error), MW_ERROR_SYSTEM);
    assert_null(reader);
    assert_int_equal(mw_surface_edit_reader_open(NULL, &reader, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_edit_reader_open("s.txt", NULL, &error), MW_ERROR_ARGUMENT);
    mw_surface_edit_reader_close(NULL);
    files_write("s.txt", BYTES("undo\nun\0do\nundo\n"));
    assert_int_equal(mw_surface_edit_reader_open("s.txt", &reader, &error), MW_OK);
    assert_int_equal(mw_surface_edit_reader_read(reader, &line, &error), MW_OK);
    for (int i = 0; i < 2; i++) { /* it cannot be read on */
        assert_int_equal(mw_surface_edit_reader_read(reader, &line, &error), MW_ERROR_INPUT);
        assert_int_equal(line.line, 0);
    }
    mw_surface_edit_reader_close(reader);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_requests),
        cmocka_unit_test(test_long_chains),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_files),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
