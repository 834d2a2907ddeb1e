/* test_io_points.c - points from text: separators, headers, columns, and rows that are refused by
 * line. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/files.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Open "p.txt" with the text, plain or packed. */
static mw_point_reader *open_text(const char *text, const char *columns, bool packed)
{
    mw_point_reader_options options = {.columns = columns};
    mw_point_reader *reader = NULL;
    mw_error error;
    bytes contents = {text, strlen(text)};
    if (packed)
        files_write_gzip("p.txt", contents);
    else
        files_write("p.txt", contents);
    if (mw_point_reader_open("p.txt", &options, &reader, &error) != MW_OK)
        fail_msg("'%s': %s", text, error.message);
    return reader;
}

/* The text has these columns ("x y z", in one string) and values, read one by one and all at once,
 * plain and packed. */
static void expect_values(const char *text, const char *columns, const char *names, size_t rows,
                          const double *wanted)
{
    for (int round = 0; round < 2; round++) {
        mw_point_reader *reader = open_text(text, columns, round == 1);
        size_t width = mw_point_reader_width(reader), count, total = 0, step = round == 0 ? 1 : 100;
        char all_names[256] = "";
        for (size_t i = 0; i < width; i++) {
            strcat(all_names, i ? " " : "");
            strcat(all_names, mw_point_reader_column(reader, i));
        }
        assert_string_equal(all_names, names);
        assert_null(mw_point_reader_column(reader, width));
        double *values = calloc(100 * width, sizeof *values);
        assert_non_null(values);
        mw_error error;
        do {
            if (mw_point_reader_read(reader, values + total * width, step, &count, &error) != MW_OK)
                fail_msg("'%s': %s", text, error.message);
            total += count;
        } while (count == step);
        assert_int_equal(mw_point_reader_read(reader, values, step, &count, NULL), MW_OK);
        assert_int_equal(count, 0);
        assert_int_equal(total, rows);
        for (size_t i = 0; i < rows * width; i++)
            if (memcmp(&values[i], &wanted[i], sizeof *values) != 0 &&
                !(isnan(values[i]) && isnan(wanted[i])))
                fail_msg("'%s': value %zu is %g, not %g", text, i, values[i], wanted[i]);
        free(values);
        mw_point_reader_close(reader);
    }
    files_clear();
}

static const double two[] = {1, 2, 3.5, -4};

static void test_separators(void **state)
{
    (void)state;
    expect_values("1 2\n3.5 -4\n", NULL, "x y", 2, two);
    expect_values("1,2\n3.5,-4\n", NULL, "x y", 2, two);
    expect_values("1;2\n3.5;-4\n", NULL, "x y", 2, two);
    expect_values("1\t2\n3.5\t-4\n", NULL, "x y", 2, two);
    expect_values(" 1   2  \n\t3.5 \t -4\n", NULL, "x y", 2, two);
    expect_values("1 , 2\n 3.5,-4 \n", NULL, "x y", 2, two);
    expect_values("1, 2\n3.5, -4", NULL, "x y", 2, two);
    expect_values("1 ;\t2\n3.5; -4", NULL, "x y", 2, two);
    expect_values("1 \t2\n3.5\t -4\n", NULL, "x y", 2, two);
    expect_values("\"1\",\"2\"\n\"3.5\", \"-4\"\n", NULL, "x y", 2, two);
    expect_values("1 2\r\n\r\n3.5 -4\r\n", NULL, "x y", 2, two);
    expect_values("1 2\r3.5 -4\r", NULL, "x y", 2, two);
    expect_values("\xef\xbb\xbf"
                  "1,2\n3.5,-4\n",
                  NULL, "x y", 2, two);
    expect_values("# points\n\n  # more\n1 2\n\n#\n3.5 -4\n\n", NULL, "x y", 2, two);
    expect_values("1 2\t3 4\n5 6\t7 8\n", NULL, "x y z c4", 2,
                  (const double[]){1, 2, 3, 4, 5, 6, 7, 8});
    expect_values("1,\t2\n3.5,\t-4\n", NULL, "x y", 2, two);
    expect_values("+1e0 2E+0\n35e-1 -4d0\n", NULL, "x y", 2, two);
}

static void test_decimal_commas(void **state)
{
    (void)state;
    static const double wanted[] = {1.5, 2, 3.25, -4.125};
    expect_values("1,5;2\n3,25;-4,125\n", NULL, "x y", 2, wanted);
    expect_values("1,5\t2\n3,25\t-4,125\n", NULL, "x y", 2, wanted);
    expect_values("a;b\n1,5;2\n3,25;-4,125e0\n", NULL, "a b", 2, wanted);
    expect_values("\"1,5\";2\n3,25;\"-4,125\"\n", NULL, "x y", 2, wanted);
    expect_values("1234567890,5;+987654321,0625\n", NULL, "x y", 1,
                  (const double[]){1234567890.5, 987654321.0625});
    expect_values(",5;2,\n-,25;1\n", NULL, "x y", 2, (const double[]){.5, 2, -.25, 1});
}

static void test_odd_numbers(void **state)
{
    (void)state;
    static const double wanted[] = {NAN, INFINITY, -INFINITY, NAN, -0.0, 1e-320};
    expect_values("nan inf\n-INF NaN\n-0.0 1e-320\n", NULL, "x y", 3, wanted);
    expect_values("1,2\n,3\n4,\n", NULL, "x y", 3, (const double[]){1, 2, NAN, 3, 4, NAN});
    expect_values("1;2\n;\n\"\"; 3\n", NULL, "x y", 3, (const double[]){1, 2, NAN, NAN, NAN, 3});
}

static void test_headers(void **state)
{
    (void)state;
    static const double three[] = {1, 2, 3, 4, 5, 6};
    expect_values("x,y\n1,2\n3.5,-4\n", NULL, "x y", 2, two);
    expect_values("A B\n1 2\n3.5 -4\n", NULL, "A B", 2, two);
    expect_values("\"the x\"; \"the;y\"\n1;2\n3.5;-4\n", NULL, "the x the;y", 2, two);
    expect_values("wind speed\tdirection\n1\t2\n3.5\t-4\n", NULL, "wind speed direction", 2, two);
    /* the header says what x, y and z are */
    expect_values("id,X,Y,Z\n7,1,2,3\n8,4,5,6\n", NULL, "X Y Z id", 2,
                  (const double[]){1, 2, 3, 7, 4, 5, 6, 8});
    expect_values("lat,lon\n2,1\n-4,3.5\n", NULL, "lon lat", 2, two);
    expect_values("name,Longitude,note,Latitude\na,1,b,2\nc,3.5,d,-4\n", NULL, "Longitude Latitude",
                  2, two);
    expect_values("northing easting h\n2 1 3\n5 4 6\n", NULL, "easting northing h", 2, three);
    /* columns of text are passed over, those with empty names and nothing in them too */
    expect_values("x,y,name\n1,2,here\n3.5,-4,\"there, too\"\n", NULL, "x y", 2, two);
    expect_values("A12 1 2\nB7 3.5 -4\n", NULL, "x y", 2, two);
    expect_values("1,2,\n3.5,-4,\n", NULL, "x y", 2, two);
    expect_values("x,y,\n1,2,\n3.5,-4,\n", NULL, "x y", 2, two);
    /* an empty value in a named column is a missing value */
    expect_values("x,y,z\n1,2,\n4,5,6\n", NULL, "x y z", 2, (const double[]){1, 2, NAN, 4, 5, 6});
    expect_values("x,y\n", NULL, "x y", 0, NULL);
    expect_values("a,b,c\n", "c,a", "c a", 0, NULL);
}

static void test_selection(void **state)
{
    (void)state;
    static const char table[] = "name,lat,lon,h\na,2,1,10\nb,-4,3.5,20\n";
    expect_values(table, "lon,lat", "lon lat", 2, two);
    expect_values(table, " LON , Lat ", "lon lat", 2, two);
    expect_values(table, "3,2", "lon lat", 2, two);
    expect_values(table, "lon,2,h", "lon lat h", 2, (const double[]){1, 2, 10, 3.5, -4, 20});
    expect_values("9 1 2\n9 3.5 -4\n", "2,3", "x y", 2, two);
    expect_values("9 1 2\n9 3.5 -4\n", "y,z", "x y", 2, two);
    expect_values("a 1 2 b\nc 3.5 -4 d\n", "2,3", "x y", 2, two);
}

static void test_missing(void **state)
{
    (void)state;
    expect_values("1,2\nNA,3\n4,-\nnull,n/a\n\"\",\"NaN\"\n", NULL, "x y", 5,
                  (const double[]){1, 2, NAN, 3, 4, NAN, NAN, NAN, NAN, NAN});
    expect_values("1 2\nna -\n", NULL, "x y", 2, (const double[]){1, 2, NAN, NAN});
    /* in the first row, where it tells that the column has numbers only if its name does */
    expect_values("x,y,z,id\n1,2,NA,NA\n3,4,5,6\n", NULL, "x y z", 2,
                  (const double[]){1, 2, NAN, 3, 4, 5});
}

static void test_quotes(void **state)
{
    (void)state;
    expect_values("x,y,t\n1,2,\"a\nb,\"\n3.5,-4,\"say \"\"x\"\"\"\n", NULL, "x y", 2, two);
    expect_values("x,y,t\n1,2,5\" pipe\n3.5,-4,a\"b\n", NULL, "x y", 2, two);
    expect_values("\"a;b\",x,y\nu,1,2\n\"v\r\nw\",3.5,-4\r\n", NULL, "x y", 2, two);
    expect_values("t\tx\ty\nq\t1\t2\n\"a\tb\"\t3.5\t-4\n", NULL, "x y", 2, two);
}

/* A row's text without its line end. */
static void expect_row(const mw_point_reader *reader, size_t row, const char *text)
{
    size_t length;
    const char *found = mw_point_reader_row(reader, row, &length);
    if (!text) {
        assert_null(found);
        return;
    }
    assert_non_null(found);
    assert_int_equal(length, strlen(text));
    assert_memory_equal(found, text, length);
}

static void test_table(void **state)
{
    (void)state;
    mw_point_reader_options options = {.table = 1};
    mw_point_reader *reader;
    mw_point_table table;
    mw_error error;
    double values[20];
    size_t count;
    files_write_text("p.txt", "id; name ;X;Y\r\nB1; \"a;b\" ;1,5;2\r\n\r\n;;NA; 3 \r\n");
    assert_int_equal(mw_point_reader_open("p.txt", &options, &reader, &error), MW_OK);
    assert_int_equal(mw_point_reader_width(reader), 0);
    assert_int_equal(mw_point_reader_table(reader, &table, &error), MW_OK);
    assert_int_equal(table.column_count, 4);
    assert_string_equal(table.header, "id; name ;X;Y");
    assert_string_equal(table.names[1], "name");
    assert_int_equal(table.separator, ';');
    assert_int_equal(mw_point_reader_select(reader, (const size_t[]){3, 2}, 2, &error), MW_OK);
    assert_int_equal(mw_point_reader_width(reader), 2);
    assert_string_equal(mw_point_reader_column(reader, 0), "Y");
    assert_int_equal(mw_point_reader_column_number(reader, 1), 2);
    assert_int_equal(mw_point_reader_column_number(reader, 2), SIZE_MAX);
    expect_row(reader, 0, NULL);
    assert_int_equal(mw_point_reader_read(reader, values, 10, &count, &error), MW_OK);
    assert_int_equal(count, 2);
    assert_true(values[0] == 2 && values[1] == 1.5 && values[2] == 3 && isnan(values[3]));
    expect_row(reader, 0, "B1; \"a;b\" ;1,5;2");
    expect_row(reader, 1, ";;NA; 3 ");
    expect_row(reader, 2, NULL);
    assert_int_equal(mw_point_reader_table(reader, &table, &error), MW_OK);
    assert_int_equal(table.decimal, ',');
    assert_int_equal(mw_point_reader_select(reader, (const size_t[]){0, 1}, 2, &error),
                     MW_ERROR_ARGUMENT);
    mw_point_reader_close(reader);

    /* without names, between blanks */
    files_write_text("p.txt", "q 0 0\n a,b  1 \t2 \n");
    assert_int_equal(mw_point_reader_open("p.txt", &options, &reader, &error), MW_OK);
    static const size_t wrong[][2] = {{0, 3}, {1, 1}};
    for (int i = 0; i < 2; i++)
        assert_int_equal(mw_point_reader_select(reader, wrong[i], 2, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_reader_select(reader, wrong[1], 1, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_reader_select(reader, NULL, 2, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_reader_table(reader, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_reader_select(reader, (const size_t[]){1, 2}, 2, &error), MW_OK);
    assert_int_equal(mw_point_reader_read(reader, values, 10, &count, &error), MW_OK);
    assert_int_equal(count, 2);
    expect_row(reader, 0, "q,0,0");
    expect_row(reader, 1, "\"a,b\",1,2");
    assert_int_equal(mw_point_reader_table(reader, &table, &error), MW_OK);
    assert_true(!table.names && !table.header && table.separator == ',' && table.decimal == '.');
    mw_point_reader_close(reader);

    /* a reader that keeps no table */
    assert_int_equal(mw_point_reader_open("p.txt", NULL, &reader, &error), MW_OK);
    assert_int_equal(mw_point_reader_select(reader, (const size_t[]){1, 2}, 2, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_reader_read(reader, values, 10, &count, &error), MW_OK);
    expect_row(reader, 0, NULL);
    mw_point_reader_close(reader);
    files_clear();
}

static void test_axis_names(void **state)
{
    (void)state;
    const mw_axis_names *set;
    size_t lonlat = 0;
    for (size_t i = 0; (set = mw_axis_names_at(i)); i++) {
        for (int k = 0; k < 3; k++) assert_true(mw_axis_name_matches(set->axis[k], set->axis[k]));
        assert_false(mw_axis_name_matches(set->axis[0], set->axis[1]));
        lonlat += set->lonlat != 0;
    }
    assert_true(lonlat >= 3);
    static const char *const same[][2] = {{"POINT_X", "point_x"}, {"Point X", "point_x"},
                                          {"pointx", "point_x"},  {"x [m]", "x"},
                                          {"X(ft)", "x"},         {" x ", "x"}};
    static const char *const other[][2] = {{"xx", "x"},    {"", "x"},    {"x", "point_x"},
                                           {"m (x)", "x"}, {"x m", "x"}, {"lone", "lon"}};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        if (!mw_axis_name_matches(same[i][0], same[i][1]))
            fail_msg("'%s' is no '%s'", same[i][0], same[i][1]);
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        if (mw_axis_name_matches(other[i][0], other[i][1]))
            fail_msg("'%s' is '%s'", other[i][0], other[i][1]);
}

static void test_nothing(void **state)
{
    (void)state;
    expect_values("", NULL, "x y", 0, NULL);
    expect_values("# only a comment\n\n", NULL, "x y", 0, NULL);
    expect_values("", "a,b,c", "a b c", 0, NULL);
}

static void test_node(void **state)
{
    (void)state;
    static const char text[] = "# vertices\n2 2 1 1\n1 1 2 30 0\n2 3.5 -4 40 1\n# end\n";
    const double wanted[] = {1, 2, 30, 3.5, -4, 40};
    files_write_text("p.node", text);
    mw_point_reader *reader;
    assert_int_equal(mw_point_reader_open("p.node", NULL, &reader, NULL), MW_OK);
    double values[12];
    size_t count;
    assert_int_equal(mw_point_reader_width(reader), 3);
    assert_string_equal(mw_point_reader_column(reader, 2), "attribute1");
    assert_int_equal(mw_point_reader_read(reader, values, 4, &count, NULL), MW_OK);
    assert_int_equal(count, 2);
    assert_memory_equal(values, wanted, sizeof wanted);
    mw_point_reader_close(reader);
    static const char *const bads[] = {"3 2 0 0\n1 1 2\n2 3 4\n", "1 2 0 0\n1 1 2\n2 3 4\n",
                                       "2\n1 1 2 3\n", "x y\n1 2\n", ""};
    static const char *const says[] = {"p.node:3: the file has 2 rows, but announces 3",
                                       "p.node:3: the file has 2 rows, but announces 1",
                                       "p.node:2: 4 columns where the header has 3",
                                       "p.node:1: a .node file begins with",
                                       "p.node:1: a .node file begins with"};
    for (int i = 0; i < 5; i++) {
        mw_error error;
        files_write_text("p.node", bads[i]);
        mw_status status = mw_point_reader_open("p.node", NULL, &reader, &error);
        if (status == MW_OK) {
            status = mw_point_reader_read(reader, values, 4, &count, &error);
            mw_point_reader_close(reader);
        }
        assert_int_equal(status, MW_ERROR_INPUT);
        files_expect_error(&error, MW_ERROR_INPUT, error.line, says[i]);
    }
    files_clear();
}

/* What is wrong with a text, in which line, and how many points before it were good. */
typedef struct bad_points {
    const char *text, *columns;
    int64_t line;
    size_t good;
    const char *says;
} bad_points;

static const bad_points bads[] = {
    {"1 2\n3\n", NULL, 2, 1, "1 column where the rows before have 2"},
    {"1 2\n3 4 5\n", NULL, 2, 1, "3 columns where the rows before have 2"},
    {"1,2\n# a\n\n3,4,5\n", NULL, 4, 1, "3 columns where"},
    {"x,y\n1,2,3\n", NULL, 2, 0, "3 columns where the header has 2"},
    {"x,y,z\n1,2\n", NULL, 2, 0, "2 columns where the header has 3"},
    {"1,2\n3\n", NULL, 2, 1, "1 column where"},
    {"1;2\n3;4;\n", NULL, 2, 1, "3 columns where"},
    {"1 2\n3 four\n", NULL, 2, 1, "column 2: 'four' is not a number"},
    {"1,2\n3,4x\n", NULL, 2, 1, "column 2: '4x' is not a number"},
    {"1,2\n3 5,4\n", NULL, 2, 1, "column 1: '3 5' is not a number"},
    {"1,2\n\"3,4\n", NULL, 2, 1, "a quoted cell begins in this row and does not end"},
    {"1,2\n\"3\n\",4\n", NULL, 3, 1, "column 1: '3?' is not a number"},
    {"1,2\n--,4\n", NULL, 2, 1, "column 1: '--' is not a number"},
    {"x,y,X\n1,2,3\n", "x,y", 1, 0, "columns 1 and 3 are both called 'x': use a number"},
    {"1,2\n0x10,4\n", NULL, 2, 1, "'0x10' is not a number"},
    {"1\t2\n1.2.3\t4\n", NULL, 2, 1, "'1.2.3' is not a number"},
    {"1 2\n3\n4\n", NULL, 2, 1, "1 column where"},
    /* decimal commas that cannot be taken, or are doubtful */
    {"1,5 2,5\n", NULL, 1, 0, "the row has decimal commas: write decimal points"},
    {"1,5, 2,5\n", NULL, 1, 0, "the row has decimal commas: write decimal points"},
    {"1 2\n1,5 2,5\n", NULL, 2, 1,
     "'1,5' is not a number (for decimal commas separate the columns by"},
    {"x y\n1,5 2,5\n", NULL, 2, 0, "the row has decimal commas: write decimal points"},
    {"x,y\n1,5,2,5\n", NULL, 2, 0, "4 columns where the header has 2 (are these decimal commas?)"},
    {"0.5;0,5\n", NULL, 1, 0, "the table has both decimal points and decimal commas"},
    {"0,5;1\n2;0.5\n", NULL, 2, 1, "the table has both decimal points and decimal commas"},
    {"1;2\n1.234,5;2\n", NULL, 2, 1, "is not a number"},
    /* too few columns, or none of that name */
    {"1\n2\n", NULL, 1, 0, "1 column of numbers; a point needs two"},
    {"x\n2\n", NULL, 2, 0, "1 column of numbers; a point needs two"},
    {"a b\nc d\n", NULL, 2, 0, "0 columns of numbers; a point needs two"},
    {"This is\nprose.\n", NULL, 2, 0, "0 columns of numbers"},
    {"a,b\n1,2\n", "a,c", 1, 0, "no column 'c' among the 2: a, b"},
    {"1 2\n", "1,3", 0, 0, "no column '3' among the 2"},
    {"1 2\n", "0,1", 0, 0, "no column '0' among the 2"},
    {"1 2\n", "x,z", 0, 0, "no column 'z' among the 2"},
    {"1 2\n", "1,99999999999999999999", 0, 0, "no column '99999999999999999999'"},
    {"n,a,b\nx,1,2\n", "n,a", 2, 0, "column 1: 'x' is not a number"},
    {"\xff\xfe"
     "1\1 \1",
     NULL, 1, 0, "UTF-16"},
};

static void test_malformed(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof bads / sizeof *bads; i++) {
        mw_point_reader_options options = {.columns = bads[i].columns};
        mw_point_reader *reader;
        mw_error error;
        double values[64];
        size_t good = 0;
        files_write_text("p.txt", bads[i].text);
        mw_status status = mw_point_reader_open("p.txt", &options, &reader, &error);
        if (status == MW_OK) {
            status = mw_point_reader_read(reader, values, 10, &good, &error);
            mw_point_reader_close(reader);
        } else {
            assert_null(reader);
        }
        if (status != MW_ERROR_INPUT)
            fail_msg("case %zu: '%s' was taken (%s)", i, bads[i].text, bads[i].says);
        files_expect_error(&error, MW_ERROR_INPUT, bads[i].line > 0 ? bads[i].line : error.line,
                           bads[i].says);
        assert_int_equal(strncmp(error.message, "p.txt:", 6), 0);
        assert_int_equal(good, bads[i].good);
    }
    files_clear();
}

static void test_arguments(void **state)
{
    (void)state;
    static const char *const selections[] = {"", "x", "x,", ",x", "x,,y", "1,1", "x,X"};
    mw_point_reader *reader;
    mw_error error;
    files_write_text("p.txt", "x,y\n1,2\n");
    assert_int_equal(mw_point_reader_select(NULL, NULL, 2, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_reader_table(NULL, NULL, &error), MW_ERROR_ARGUMENT);
    for (size_t i = 0; i < sizeof selections / sizeof *selections; i++) {
        mw_point_reader_options options = {.columns = selections[i]};
        assert_int_equal(mw_point_reader_open("p.txt", &options, &reader, &error),
                         MW_ERROR_ARGUMENT);
        assert_null(reader);
    }
    assert_int_equal(mw_point_reader_open(NULL, NULL, &reader, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_reader_open("p.txt", NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_reader_open("missing.txt", NULL, &reader, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "missing.txt: No such file or directory");
    assert_int_equal(mw_point_reader_open(".", NULL, &reader, &error), MW_ERROR_SYSTEM);
    mw_point_reader_close(NULL);
    files_clear();
}

/* Files that are something else. */
static void test_other_kinds(void **state)
{
    (void)state;
    const struct {
        const char *name;
        bytes contents;
        const char *says;
    } cases[] = {
        {"m.off", BYTES("OFF\n0 0 0\n"), "this is a mesh ('off')"},
        {"m.txt", BYTES("ply\nformat ascii 1.0\n"), "this is a mesh ('ply')"},
        {"m.obj", BYTES("v 0 0 0\nv 1 0 0\n"), "this is a mesh ('obj')"},
        {"m.txt", BYTES("\n {\"type\": \"Point\"}\n"), "m.txt: this is JSON, not a table"},
        {"m.txt", BYTES("\xef\xbb\xbf<?xml?>\n"), "m.txt: this is XML, not a table"},
        {"m.txt", BYTES("1 2\n\0\0\n"), "m.txt:2: a NUL byte"},
        {"m.txt", BYTES("\x89PNG\r\n\x1a\n\0\0"), "m.txt:2: the table has 0 columns of numbers"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mw_point_reader *reader;
        mw_error error;
        double values[16];
        size_t count;
        files_write(cases[i].name, cases[i].contents);
        mw_status status = mw_point_reader_open(cases[i].name, NULL, &reader, &error);
        if (status == MW_OK) {
            status = mw_point_reader_read(reader, values, 4, &count, &error);
            mw_point_reader_close(reader);
        }
        assert_int_equal(status, MW_ERROR_INPUT);
        files_expect_error(&error, MW_ERROR_INPUT, error.line, cases[i].says);
        unlink(cases[i].name);
    }
}

/* More than a block, with rows of all lengths across the borders of blocks. */
static void test_many(void **state)
{
    (void)state;
    enum { ROWS = 150000 };
    FILE *out = fopen("many.csv", "w");
    assert_non_null(out);
    fprintf(out, "x,y\r\n");
    for (int i = 0; i < ROWS; i++) fprintf(out, "%d.%0*d,%d\r\n", i, 1 + i % 9, 5, -i);
    fclose(out);
    mw_point_reader *reader;
    assert_int_equal(mw_point_reader_open("many.csv", NULL, &reader, NULL), MW_OK);
    double *values = malloc(2 * ROWS * sizeof *values);
    assert_non_null(values);
    size_t total = 0, count;
    do {
        assert_int_equal(mw_point_reader_read(reader, values + 2 * total, 1000, &count, NULL),
                         MW_OK);
        total += count;
    } while (count > 0);
    assert_int_equal(total, ROWS);
    for (int i = 0; i < ROWS; i++) {
        char text[64];
        snprintf(text, sizeof text, "%d.%0*d", i, 1 + i % 9, 5);
        if (values[2 * i] != strtod(text, NULL) || values[2 * i + 1] != -i) fail_msg("row %d", i);
    }
    free(values);
    mw_point_reader_close(reader);
    files_clear();
}

/* Texts in columns beyond the coordinates are missing values, if the caller wants that, and are
 * counted. */
static void test_texts(void **state)
{
    (void)state;
    const char *text = "x,y,z,a,b,c\n1,2,3,4,NA,6\n1,2,,x,5,6\n1,2,3,-,5,7e\n\n1,2,3,\"y\",5,6 7\n";
    mw_point_reader_options options = {.texts = 1};
    mw_point_reader *reader;
    mw_error error;
    double values[6 * 8];
    size_t count;
    int64_t line = -1;
    files_write("p.txt", (bytes){text, strlen(text)});
    assert_int_equal(mw_point_reader_open("p.txt", &options, &reader, &error), MW_OK);
    assert_int_equal(mw_point_reader_width(reader), 6);
    assert_int_equal(mw_point_reader_read(reader, values, 8, &count, &error), MW_OK);
    assert_int_equal(count, 4);
    assert_true(isnan(values[4]) && isnan(values[6 + 2]) && isnan(values[6 + 3]) &&
                values[18 + 4] == 5);
    assert_true(values[5] == 6 && isnan(values[12 + 5]) && isnan(values[18 + 5]));
    const uint64_t texts[] = {0, 0, 0, 2, 0, 2};
    for (size_t k = 0; k < 6; k++)
        assert_int_equal(mw_point_reader_texts(reader, k, NULL), texts[k]);
    assert_int_equal(mw_point_reader_texts(reader, 6, &line), 0);
    assert_int_equal(line, -1);
    mw_point_reader_texts(reader, 3, &line);
    assert_int_equal(line, 3);
    mw_point_reader_texts(reader, 5, &line);
    assert_int_equal(line, 4);
    mw_point_reader_close(reader);
    /* a single one */
    files_write("p.txt", (bytes){"x,y,z,name\n1,2,3,4\n1,2,3,a\n1,2,3,5\n", 35});
    assert_int_equal(mw_point_reader_open("p.txt", &options, &reader, &error), MW_OK);
    assert_int_equal(mw_point_reader_read(reader, values, 8, &count, &error), MW_OK);
    line = -1;
    assert_int_equal(mw_point_reader_texts(reader, 3, &line), 1);
    assert_int_equal(line, 3);
    mw_point_reader_close(reader);
    /* not in coordinates, and not in columns that the caller has chosen */
    files_write("p.txt", (bytes){"x,y,z\n1,2,3\n1,2,a\n", 18});
    assert_int_equal(mw_point_reader_open("p.txt", &options, &reader, &error), MW_OK);
    assert_int_equal(mw_point_reader_read(reader, values, 8, &count, &error), MW_ERROR_INPUT);
    assert_int_equal(error.line, 3);
    mw_point_reader_close(reader);
    files_write("p.txt", (bytes){"x,y,b\n1,2,3\n1,2,a\n", 18});
    options.columns = "x,y,b";
    assert_int_equal(mw_point_reader_open("p.txt", &options, &reader, &error), MW_OK);
    assert_int_equal(mw_point_reader_read(reader, values, 8, &count, &error), MW_ERROR_INPUT);
    mw_point_reader_close(reader);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_separators),  cmocka_unit_test(test_decimal_commas),
        cmocka_unit_test(test_odd_numbers), cmocka_unit_test(test_texts),
        cmocka_unit_test(test_headers),     cmocka_unit_test(test_selection),
        cmocka_unit_test(test_nothing),     cmocka_unit_test(test_node),
        cmocka_unit_test(test_missing),     cmocka_unit_test(test_quotes),
        cmocka_unit_test(test_table),       cmocka_unit_test(test_axis_names),
        cmocka_unit_test(test_malformed),   cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_other_kinds), cmocka_unit_test(test_many),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
