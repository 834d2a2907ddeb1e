/* Points from text: which columns are read, and the rows. */
#include "io/points/point_table.h"

#include "io/points/table_header.h"
#include "io/text/delimited.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { UNUSED = 0xffff }; /* a column that is not read */

typedef struct point_table {
    char separator;
    bool point, comma;       /* decimal points, decimal commas were seen: a table has one of them */
    bool header;             /* the file names its columns */
    size_t columns;          /* of every row */
    uint64_t expected, done; /* rows announced (UINT64_MAX: none are) and read */
    uint16_t slot[];         /* for each column: its position among the values, or UNUSED */
} point_table;

static mw_status table_take_column(mw_point_reader *reader, point_table *t, const mw_table_header *c, size_t column,
                                   mw_error *error)
{
    static const char *const letters[] = {"x", "y", "z"};
    char number[32];
    snprintf(number, sizeof number, "c%zu", reader->width + 1);
    const char *name = c->names && *c->names[column] ? c->names[column] : NULL;
    if (!name) name = !c->names && reader->width < 3 ? letters[reader->width] : number;
    t->slot[column] = (uint16_t)reader->width;
    return mw__point_reader_add(reader, name, error);
}

static mw_status table_no_such_column(mw_point_reader *reader, const mw_table_header *c, const char *item,
                                      size_t length, mw_error *error)
{
    char known[160] = "";
    size_t used = 0;
    for (size_t i = 0; c->names && i < c->count && used < sizeof known; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : ": ", c->names[i]);
    return mw__source_fail(&reader->source, error, "no column '%.*s' among the %zu%s", length < 60 ? (int)length : 60,
                           item, c->count, known);
}

/* The columns that the caller names, by name or by number. */
static mw_status table_select_named(mw_point_reader *reader, point_table *t, const mw_table_header *c,
                                    const char *selection, mw_error *error)
{
    size_t length;
    const char *rest = selection;
    for (const char *item; (item = mw__selection_item(&rest, &length));) {
        size_t column = mw__table_header_find(c, item, length);
        if (column == c->count) {
            int64_t number;
            const char *end = mw__read_integer(item, &number);
            if (end != item + length || number < 1 || (uint64_t)number > c->count)
                return table_no_such_column(reader, c, item, length, error);
            column = (size_t)number - 1;
        }
        if (t->slot[column] != UNUSED)
            return mw__fail(error, MW_ERROR_ARGUMENT, "columns '%.60s': '%.*s' is selected twice", selection,
                            length < 60 ? (int)length : 60, item);
        mw_status status = table_take_column(reader, t, c, column, error);
        if (status) return status;
    }
    return MW_OK;
}

/* All columns with numbers, those that the header calls x, y, z first. */
static mw_status table_select_numbers(mw_point_reader *reader, point_table *t, const mw_table_header *c,
                                      mw_error *error)
{
    size_t found[3];
    if (mw__table_header_coordinates(c, found))
        for (int k = 0; k < 3; k++) {
            mw_status status = found[k] < c->count ? table_take_column(reader, t, c, found[k], error) : MW_OK;
            if (status) return status;
        }
    for (size_t i = 0; i < c->count; i++) {
        mw_status status = c->numbers[i] && t->slot[i] == UNUSED ? table_take_column(reader, t, c, i, error) : MW_OK;
        if (status) return status;
    }
    if (reader->width >= 2) return MW_OK;
    return mw__source_fail_at(&reader->source, (uint64_t)reader->source.line + 1, error,
                              "%zu column%s of numbers; a point needs two", reader->width,
                              reader->width == 1 ? "" : "s");
}

/* A row that was refused: say why. `row` may have got points for its decimal commas. */
static mw_status table_explain_row(mw_point_reader *reader, const char *row, mw_error *error)
{
    const point_table *t = reader->state;
    size_t count = mw__delimited_count(row, t->separator);
    if (count != t->columns)
        return mw__source_fail(&reader->source, error, "%zu column%s where %s %zu%s", count, count == 1 ? "" : "s",
                               t->header ? "the header has" : "the rows before have", t->columns,
                               t->separator == ',' && count == 2 * t->columns ? " (are these decimal commas?)" : "");
    if (t->point && t->comma)
        return mw__source_fail(&reader->source, error, "decimal points and decimal commas in one table");
    mw_text_cell cell;
    bool more = true;
    for (size_t i = 0; mw__delimited_cell(&row, t->separator, &more, &cell); i++) {
        if (t->slot[i] == UNUSED || mw__cell_is_number(cell, t->separator)) continue;
        if (cell.length == 0 && t->separator != ' ') continue;
        bool comma = mw__cell_is_number(cell, ';');
        return mw__source_fail(&reader->source, error, "column %zu: '%s' is not a number%s", i + 1,
                               mw__excerpt_of(cell.text, cell.length).text,
                               comma ? " (for decimal commas separate the columns by semicolons or tabs)" : "");
    }
    return mw__source_fail(&reader->source, error, "this is no row of numbers");
}

/* The end of a cell that is not read. */
static char *table_skip_cell(char *p, char separator)
{
    const char *rest = p;
    bool more = true;
    mw_text_cell cell;
    mw__delimited_cell(&rest, separator, &more, &cell);
    return p + (rest - p) - (more ? 1 : 0);
}

static MW_INLINE char *table_skip_gap(char *p, char separator)
{
    while (*p == ' ' || (*p == '\t' && separator != '\t')) p++;
    return p;
}

/* A number where a decimal comma is one of the ways to write it; the comma becomes a point. */
static char *table_read_either_point(point_table *t, char *p, double *value)
{
    char *mark = p + (*p == '-' || *p == '+');
    while (*mark >= '0' && *mark <= '9') mark++;
    t->point |= *mark == '.';
    t->comma |= *mark == ',';
    if (t->point && t->comma) return NULL;
    if (*mark == ',') *mark = '.';
    const char *end = mw__read_double(p, value);
    return end ? p + (end - p) : NULL;
}

static MW_INLINE char *table_read_value(point_table *t, char *p, double *value)
{
    if (mw__delimited_takes_comma(t->separator)) return table_read_either_point(t, p, value);
    const char *end = mw__read_double(p, value);
    return end ? p + (end - p) : NULL;
}

/* Read the values of a row; false if something is wrong with it. An empty cell is a missing
 * value, NaN. */
static bool table_parse_row(point_table *t, char *p, double *values)
{
    for (size_t i = 0; i < t->columns; i++) {
        p = table_skip_gap(p, t->separator);
        if (t->slot[i] != UNUSED) {
            bool quoted = *p == '"';
            if (quoted && p[1] == '"') p += 2, quoted = false;
            char *end = table_read_value(t, p + quoted, &values[t->slot[i]]);
            if (end) {
                if (quoted && *end++ != '"') return false;
                p = end;
            } else {
                if (t->separator == ' ' || (*p && *p != t->separator)) return false;
                values[t->slot[i]] = NAN;
            }
        } else {
            if (t->separator == ' ' && !*p) return false;
            p = table_skip_cell(p, t->separator);
        }
        char *after = table_skip_gap(p, t->separator);
        if (i + 1 < t->columns) {
            if (t->separator == ' ' ? after == p : *after != t->separator) return false;
            after += t->separator != ' ';
        }
        p = after;
    }
    return *p == 0;
}

static mw_status table_check_count(const mw_point_reader *reader, const point_table *t, mw_error *error)
{
    if (t->expected == UINT64_MAX || t->done == t->expected) return MW_OK;
    return mw__source_fail(&reader->source, error, "%" PRIu64 " rows where %" PRIu64 " are announced", t->done,
                           t->expected);
}

static mw_status table_read_rows(mw_point_reader *reader, double *values, size_t capacity, size_t *count,
                                 mw_error *error)
{
    point_table *t = reader->state;
    while (*count < capacity) {
        char *row;
        mw_status status = mw__table_row(&reader->source, &row, error);
        if (status) return status;
        if (!row) return table_check_count(reader, t, error);
        t->done++;
        if (!table_parse_row(t, row, values + *count * reader->width)) return table_explain_row(reader, row, error);
        ++*count;
    }
    return MW_OK;
}

/* Nothing to read: the columns are those selected, or x and y. */
static mw_status table_name_empty(mw_point_reader *reader, const char *selection, mw_error *error)
{
    size_t length;
    const char *rest = selection ? selection : "x,y";
    for (const char *item; (item = mw__selection_item(&rest, &length));) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", length < 63 ? (int)length : 63, item);
        mw_status status = mw__point_reader_add(reader, name, error);
        if (status) return status;
    }
    return MW_OK;
}

mw_status mw__point_table_start(mw_point_reader *reader, const mw_point_reader_options *options, mw_error *error)
{
    mw_table_header c = {.expected = UINT64_MAX};
    char separator = ' ';
    bool node = mw__path_ends(reader->source.path, ".node");
    mw_status status = node ? mw__table_header_of_node(&reader->source, &c, error)
                            : mw__table_header_detect(&reader->source, &c, &separator, error);
    point_table *t = status ? NULL : mw__alloc(1, sizeof *t + c.count * sizeof *t->slot);
    if (!status && !t) status = mw__fail_memory(error);
    if (!status) {
        t->separator = separator;
        t->header = c.names != NULL;
        t->columns = c.count;
        t->point = t->comma = false;
        t->expected = c.expected;
        t->done = 0;
        for (size_t i = 0; i < c.count; i++) t->slot[i] = UNUSED;
        reader->state = t;
        reader->read = table_read_rows;
        if (c.count == 0)
            status = table_name_empty(reader, options->columns, error);
        else if (options->columns)
            status = table_select_named(reader, t, &c, options->columns, error);
        else
            status = table_select_numbers(reader, t, &c, error);
    }
    mw__table_header_release(&c);
    return status;
}
