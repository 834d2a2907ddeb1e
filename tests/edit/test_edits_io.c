/* test_edits_io.c - edits as lines of text: what is taken, what is refused and how, and that
 * numbers come back. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "support/files.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const char *const names[] = {"temp", "z", "wind speed", "12", "say \"hi\"", "a#b", "z"};
static const mw_edit_text_options named = {.fields = names,
                                           .field_count = sizeof names / sizeof *names};

static mw_edit_line parse(const char *text, const mw_edit_text_options *options)
{
    mw_edit_line line;
    mw_error error;
    if (mw_edit_parse(text, options, &line, &error) != MW_OK)
        fail_msg("'%s': %s", text, error.message);
    assert_int_equal(line.line, 0);
    return line;
}

static bool same_double(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* Both ask for the same: only what the kind names counts. */
static void expect_same(const mw_edit_line *a, const mw_edit_line *b, const char *text)
{
    const mw_edit *e = &a->edit, *f = &b->edit;
    bool same = a->kind == b->kind, edit = a->kind == MW_EDIT_LINE_EDIT;
    if (edit) same = same && e->kind == f->kind;
    bool place = a->kind == MW_EDIT_LINE_LOCATE ||
                 (edit && (e->kind == MW_EDIT_INSERT || e->kind == MW_EDIT_MOVE));
    if (place) same = same && same_double(e->x, f->x) && same_double(e->y, f->y);
    if (edit && e->kind != MW_EDIT_INSERT) same = same && e->vertex == f->vertex;
    if (edit &&
        (e->kind == MW_EDIT_FLIP || e->kind == MW_EDIT_CONSTRAIN || e->kind == MW_EDIT_RELEASE))
        same = same && e->other == f->other;
    if (edit && (e->kind == MW_EDIT_INSERT || e->kind == MW_EDIT_VALUE)) {
        same = same && same_double(e->value, f->value);
        if (!isnan(e->value) || e->kind == MW_EDIT_VALUE) same = same && e->field == f->field;
    }
    if (!same) fail_msg("'%s' does not come back", text);
}

static void expect(const char *text, mw_edit_line wanted)
{
    mw_edit_line line = parse(text, &named);
    expect_same(&line, &wanted, text);
}

#define EDIT(...) ((mw_edit_line){.kind = MW_EDIT_LINE_EDIT, .edit = {__VA_ARGS__}})

static void test_kinds(void **state)
{
    (void)state;
    expect("insert 1.5 -2", EDIT(.kind = MW_EDIT_INSERT, .x = 1.5, .y = -2, .value = NAN));
    expect("insert 1.5 -2 7e2",
           EDIT(.kind = MW_EDIT_INSERT, .x = 1.5, .y = -2, .value = 700, .field = 1));
    expect("insert 1 2 nan", EDIT(.kind = MW_EDIT_INSERT, .x = 1, .y = 2, .value = NAN));
    expect("insert 1 2 3 temp",
           EDIT(.kind = MW_EDIT_INSERT, .x = 1, .y = 2, .value = 3, .field = 0));
    expect("remove 17", EDIT(.kind = MW_EDIT_REMOVE, .vertex = 17));
    expect("remove 0", EDIT(.kind = MW_EDIT_REMOVE, .vertex = 0));
    expect("move 4294967294 0 -0.0", EDIT(.kind = MW_EDIT_MOVE, .vertex = 4294967294u, .y = -0.0));
    expect("flip 3 9", EDIT(.kind = MW_EDIT_FLIP, .vertex = 3, .other = 9));
    expect("constrain 3 9", EDIT(.kind = MW_EDIT_CONSTRAIN, .vertex = 3, .other = 9));
    expect("release 3 9", EDIT(.kind = MW_EDIT_RELEASE, .vertex = 3, .other = 9));
    expect("value 3 9.25", EDIT(.kind = MW_EDIT_VALUE, .vertex = 3, .value = 9.25, .field = 1));
    expect("value 3 9.25 \"wind speed\"",
           EDIT(.kind = MW_EDIT_VALUE, .vertex = 3, .value = 9.25, .field = 2));
    expect("value 3 9.25 4", EDIT(.kind = MW_EDIT_VALUE, .vertex = 3, .value = 9.25, .field = 4));
    expect("locate 5 6", (mw_edit_line){.kind = MW_EDIT_LINE_LOCATE, .edit = {.x = 5, .y = 6}});
    expect("locate nan -inf",
           (mw_edit_line){.kind = MW_EDIT_LINE_LOCATE, .edit = {.x = NAN, .y = -INFINITY}});
    expect("undo", (mw_edit_line){.kind = MW_EDIT_LINE_UNDO});
    expect("compact", (mw_edit_line){.kind = MW_EDIT_LINE_COMPACT});
}

/* Ways to separate words, tables that were padded or kept whole numbers with a point, comments. */
static void test_forms(void **state)
{
    (void)state;
    static const char *const moves[] = {
        "move 17 1.5 2",
        "move,17,1.5,2",
        "move, 17, 1.5, 2",
        "  move\t17 ,1.5\t, 2  ",
        "move 17,1.5 2,,,",
        "MOVE 17 +1.5 2e0",
        "Move 17 1.5 2 # to the left",
        "\"move\",\"17\",\"1.5\",\"2\"",
        "move 17.0 1.5 2.00",
        "move 1.7e1,1.5d0,2#now",
        "move 017 1.50 2,\"\"",
    };
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++)
        expect(moves[i], EDIT(.kind = MW_EDIT_MOVE, .vertex = 17, .x = 1.5, .y = 2));
    static const char *const nothing[] = {"",      "   \t", "# insert 1 2",
                                          "  # x", ",,,",   " , , # empty"};
    for (size_t i = 0; i < sizeof nothing / sizeof *nothing; i++)
        assert_int_equal(parse(nothing[i], NULL).kind, MW_EDIT_LINE_NONE);
    expect("insert,1,2,", EDIT(.kind = MW_EDIT_INSERT, .x = 1, .y = 2, .value = NAN));
    expect("insert,1,2,,", EDIT(.kind = MW_EDIT_INSERT, .x = 1, .y = 2, .value = NAN));
}

static const struct {
    const char *text, *says;
} refused[] = {
    {"insrt 1 2",
     "unknown edit 'insrt'; known edits are insert, remove, move, flip, constrain, release, "
     "value, locate, undo, compact"},
    {"x,y,z", "unknown edit 'x'"},
    {"insert 1", "insert: the y is missing"},
    {"insert", "insert: the x is missing"},
    {"insert,1,,3", "insert: the y is missing"},
    {"insert 1 2 3 4 5", "insert: '5' is one word too many"},
    {"insert 1 2 3 salt", "insert: there is no field 'salt'"},
    {"insert 1 2 3 7", "insert: there is no field '7'"},
    {"insert 1 2x", "insert: y: '2x' is not a number"},
    {"insert 0x1 2", "insert: x: '0x1' is not a number"},
    {"insert 1;2", "insert: x: '1;2' is not a number"},
    {"remove", "remove: the vertex is missing"},
    {"remove -1", "remove: vertex: '-1' is not a vertex number"},
    {"remove 1.5", "'1.5' is not a vertex number"},
    {"remove 4294967295", "'4294967295' is not a vertex number"},
    {"remove 99999999999999999999", "is not a vertex number"},
    {"remove 1e400", "is not a vertex number"},
    {"remove nan", "is not a vertex number"},
    {"remove v1", "'v1' is not a vertex number"},
    {"remove 1 2", "remove: '2' is one word too many"},
    {"flip 1", "flip: the second vertex is missing"},
    {"flip x 1", "flip: first vertex: 'x' is not a vertex number"},
    {"move 1 2", "move: the y is missing"},
    {"value 1", "value: the value is missing"},
    {"undo 3", "undo: '3' is one word too many"},
    {"compact,,x", "compact: 'x' is one word too many"},
    {",insert 1 2", "'insert' is one word too many"},
    {"\"insert 1 2", "unknown edit '\"insert'"},
    {"\x01\x02 1 2", "unknown edit '\?\?'"},
};

static void test_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        mw_edit_line line;
        mw_error error;
        if (mw_edit_parse(refused[i].text, &named, &line, &error) != MW_ERROR_INPUT)
            fail_msg("'%s' was taken", refused[i].text);
        assert_int_equal(line.kind, MW_EDIT_LINE_NONE);
        files_expect_error(&error, MW_ERROR_INPUT, -1, refused[i].says);
        assert_int_equal(mw_edit_parse(refused[i].text, &named, &line, NULL), MW_ERROR_INPUT);
    }
    mw_edit_line line;
    assert_int_equal(mw_edit_parse(NULL, NULL, &line, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_parse("undo", NULL, NULL, NULL), MW_ERROR_ARGUMENT);
}

/* Without names a field is a number, and the first is meant; with names and no z, one has to be
 * named. */
static void test_fields(void **state)
{
    (void)state;
    mw_edit_line line = parse("value 1 2", NULL);
    assert_int_equal(line.edit.field, 0);
    line = parse("value 1 2 300", NULL);
    assert_int_equal(line.edit.field, 300);
    mw_error error;
    assert_int_equal(mw_edit_parse("value 1 2 z", NULL, &line, &error), MW_ERROR_INPUT);
    assert_int_equal(mw_edit_parse("value 1 2 4294967295", NULL, &line, &error), MW_ERROR_INPUT);
    static const char *const salt[] = {"salt"};
    const mw_edit_text_options no_z = {.fields = salt, .field_count = 1};
    assert_int_equal(mw_edit_parse("insert 1 2 3", &no_z, &line, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, "the mesh has no z");
    assert_int_equal(parse("insert 1 2 3 salt", &no_z).edit.field, 0);
    assert_int_equal(parse("insert 1 2", &no_z).kind, MW_EDIT_LINE_EDIT);
}

static void expect_text(const char *wanted, mw_edit_line line)
{
    char text[MW_EDIT_TEXT_SIZE];
    size_t length = mw_edit_format(&line, &named, text);
    assert_string_equal(text, wanted);
    assert_int_equal(length, strlen(wanted));
    if (length == 0) return;
    mw_edit_line again = parse(text, &named);
    expect_same(&line, &again, text);
}

static void test_format(void **state)
{
    (void)state;
    expect_text("insert 0.1 -2",
                EDIT(.kind = MW_EDIT_INSERT, .x = 0.1, .y = -2, .value = NAN, .field = 3));
    expect_text("insert 0.1 -2 7",
                EDIT(.kind = MW_EDIT_INSERT, .x = 0.1, .y = -2, .value = 7, .field = 1));
    expect_text("insert 0.1 -2 7 temp",
                EDIT(.kind = MW_EDIT_INSERT, .x = 0.1, .y = -2, .value = 7));
    expect_text("value 8 7 \"wind speed\"",
                EDIT(.kind = MW_EDIT_VALUE, .vertex = 8, .value = 7, .field = 2));
    for (uint32_t field = 3; field < 7;
         field++) { /* names that cannot stand there, or lead elsewhere */
        char wanted[32];
        snprintf(wanted, sizeof wanted, "value 8 nan %u", field);
        expect_text(wanted, EDIT(.kind = MW_EDIT_VALUE, .vertex = 8, .value = NAN, .field = field));
    }
    expect_text("remove 5", EDIT(.kind = MW_EDIT_REMOVE, .vertex = 5));
    expect_text("release 5 6", EDIT(.kind = MW_EDIT_RELEASE, .vertex = 5, .other = 6));
    expect_text("locate 1 2",
                (mw_edit_line){.kind = MW_EDIT_LINE_LOCATE, .edit = {.x = 1, .y = 2}});
    expect_text("undo", (mw_edit_line){.kind = MW_EDIT_LINE_UNDO});
    expect_text("compact", (mw_edit_line){.kind = MW_EDIT_LINE_COMPACT});
    expect_text("", (mw_edit_line){.kind = MW_EDIT_LINE_NONE});
    expect_text("", EDIT(.kind = MW_EDIT_KIND_COUNT));
    /* the longest line there is */
    char name[64], text[MW_EDIT_TEXT_SIZE];
    for (size_t length = 1; length < sizeof name; length++) {
        memset(name, ',', length);
        name[length] = 0;
        const char *const field = name;
        const mw_edit_text_options options = {.fields = &field, .field_count = 1};
        mw_edit_line line = EDIT(.kind = MW_EDIT_INSERT, .x = -1.2345678901234567e-300,
                                 .y = -1.2345678901234567e-300, .value = -1e-300);
        size_t used = mw_edit_format(&line, &options, text);
        assert_true(used < sizeof text && strlen(text) == used);
        mw_edit_line again = parse(text, &options);
        expect_same(&line, &again, text);
    }
}

static double any_double(uint64_t *random)
{
    uint64_t bits = mw__random(random) << 32 ^ mw__random(random);
    double value;
    memcpy(&value, &bits, sizeof value);
    return mw__random(random) % 2 ? value : (double)(int64_t)bits / 4294967296.0;
}

/* Every bit of every number comes back. */
static void test_round_trip(void **state)
{
    (void)state;
    uint64_t random = 20261122;
    print_message("seed %llu\n", (unsigned long long)random);
    for (int i = 0; i < 200000; i++) {
        mw_edit_line line =
            EDIT(.kind = (mw_edit_kind)(mw__random(&random) % MW_EDIT_KIND_COUNT),
                 .x = any_double(&random), .y = any_double(&random), .value = any_double(&random),
                 .vertex = (uint32_t)mw__random(&random), .other = (uint32_t)mw__random(&random),
                 .field = (uint32_t)(mw__random(&random) % 6));
        if (line.edit.vertex == MW_NONE || line.edit.other == MW_NONE) continue;
        char text[MW_EDIT_TEXT_SIZE];
        const mw_edit_text_options *options = i % 2 ? &named : NULL;
        mw_edit_format(&line, options, text);
        mw_edit_line again = parse(text, options);
        expect_same(&line, &again, text);
    }
}

/* A file: numbers of lines, line ends, going on behind a line that is bad, and not behind data
 * that are. */
static void test_reader(void **state)
{
    (void)state;
    static const char text[] =
        "\xef\xbb\xbf# a session\r\n\r\ninsert 1 2 3 temp\r\nremve 4\nlocate,5,6\n\nundo";
    for (int packed = 0; packed < 2; packed++) {
        mw_edit_reader *reader;
        mw_edit_line line;
        mw_error error;
        if (packed)
            files_write_gzip("e.txt", BYTES(text));
        else
            files_write("e.txt", BYTES(text));
        assert_int_equal(mw_edit_reader_open("e.txt", &named, &reader, &error), MW_OK);
        assert_int_equal(mw_edit_reader_read(reader, &line, &error), MW_OK);
        assert_int_equal(line.line, 3);
        assert_int_equal(line.edit.field, 0);
        assert_int_equal(mw_edit_reader_read(reader, &line, &error), MW_ERROR_INPUT);
        assert_int_equal(line.line, 4);
        files_expect_error(&error, MW_ERROR_INPUT, 4, "e.txt:4: unknown edit 'remve'");
        assert_int_equal(mw_edit_reader_read(reader, &line, &error), MW_OK);
        assert_int_equal(line.kind, MW_EDIT_LINE_LOCATE);
        assert_int_equal(line.line, 5);
        assert_int_equal(mw_edit_reader_read(reader, &line, &error), MW_OK);
        assert_int_equal(line.kind, MW_EDIT_LINE_UNDO);
        for (int i = 0; i < 2; i++) {
            assert_int_equal(mw_edit_reader_read(reader, &line, &error), MW_OK);
            assert_int_equal(line.kind, MW_EDIT_LINE_NONE);
        }
        mw_edit_reader_close(reader);
    }
    mw_edit_reader *reader;
    mw_edit_line line;
    mw_error error;
    files_write("e.txt", BYTES("undo\nun\0do\nundo\n"));
    assert_int_equal(mw_edit_reader_open("e.txt", NULL, &reader, &error), MW_OK);
    assert_int_equal(mw_edit_reader_read(reader, &line, &error), MW_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(mw_edit_reader_read(reader, &line, &error), MW_ERROR_INPUT);
        assert_int_equal(line.line, 0);
        files_expect_error(&error, MW_ERROR_INPUT, 2, "e.txt:2: ");
    }
    mw_edit_reader_close(reader);
    assert_int_equal(mw_edit_reader_open("missing.txt", NULL, &reader, &error), MW_ERROR_SYSTEM);
    assert_null(reader);
    assert_int_equal(mw_edit_reader_open(NULL, NULL, &reader, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_reader_open("e.txt", NULL, NULL, &error), MW_ERROR_ARGUMENT);
    mw_edit_reader_close(NULL);
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinds),   cmocka_unit_test(test_forms),
        cmocka_unit_test(test_refused), cmocka_unit_test(test_fields),
        cmocka_unit_test(test_format),  cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_reader),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
