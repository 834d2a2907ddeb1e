/* Points from text: which columns are read, and the rows. */
#include "io/points/point_table.h"

#include "base/posix.h"
#include "io/points/table_header.h"
#include "io/text/delimited.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { UNUSED = 0xffff }; /* a column that is not read */

typedef struct table_state {
    char separator;
    bool point, comma;       /* decimal points, decimal commas were seen: a table has one of them */
    bool header;             /* the file names its columns */
    size_t columns;          /* of every row */
    size_t optional;         /* values from this number on may be texts */
    mw_text_cells *texts;    /* these, per value; NULL if none may be */
    uint64_t expected, done; /* rows announced (UINT64_MAX: none are) and read */
    uint16_t slot[];         /* for each column: its position among the values, or UNUSED */
} table_state;

static mw_status table_take_column(mw_point_reader *reader, size_t column, mw_error *error)
{
    static const char *const letters[] = {"x", "y", "z"};
    table_state *t = reader->state;
    const mw_table_header *c = &reader->header;
    char number[32];
    snprintf(number, sizeof number, "c%zu", reader->width + 1);
    const char *name = c->names && *c->names[column] ? c->names[column] : NULL;
    if (!name) name = !c->names && reader->width < 3 ? letters[reader->width] : number;
    t->slot[column] = (uint16_t)reader->width;
    return mw__point_reader_add(reader, name, column, error);
}

static mw_status table_no_such_column(mw_point_reader *reader, const char *item, size_t length,
                                      mw_error *error)
{
    const mw_table_header *c = &reader->header;
    char known[160] = "";
    size_t used = 0;
    for (size_t i = 0; c->names && i < c->count && used < sizeof known; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : ": ",
                                 c->names[i]);
    return mw__source_fail(&reader->source, error, "there is no column '%.*s' among the %zu%s",
                           length < 60 ? (int)length : 60, item, c->count, known);
}

/* The column that the caller names, by name or by number. */
static mw_status table_find_column(mw_point_reader *reader, const char *item, size_t length,
                                   size_t *column, mw_error *error)
{
    const mw_table_header *c = &reader->header;
    *column = mw__table_header_find(c, item, length);
    for (size_t i = *column + 1; c->names && i < c->count; i++)
        if (strlen(c->names[i]) == length && strncasecmp(c->names[i], item, length) == 0)
            return mw__source_fail(&reader->source, error,
                                   "columns %zu and %zu are both called '%.*s': use a number",
                                   *column + 1, i + 1, length < 60 ? (int)length : 60, item);
    if (*column < c->count) return MW_OK;
    int64_t number;
    const char *end = mw__read_integer(item, &number);
    if (end != item + length || number < 1 || (uint64_t)number > c->count)
        return table_no_such_column(reader, item, length, error);
    *column = (size_t)number - 1;
    return MW_OK;
}

static mw_status table_select_named(mw_point_reader *reader, const char *selection, mw_error *error)
{
    const table_state *t = reader->state;
    size_t length, column;
    const char *rest = selection;
    for (const char *item; (item = mw__selection_item(&rest, &length));) {
        mw_status status = table_find_column(reader, item, length, &column, error);
        if (status) return status;
        if (t->slot[column] != UNUSED)
            return mw__fail(error, MW_ERROR_ARGUMENT, "columns '%.60s': '%.*s' is selected twice",
                            selection, length < 60 ? (int)length : 60, item);
        status = table_take_column(reader, column, error);
        if (status) return status;
    }
    return MW_OK;
}

/* Values from number `first` on may be texts, if the caller wants that. */
static mw_status table_allow_texts(mw_point_reader *reader, size_t first, mw_error *error)
{
    table_state *t = reader->state;
    if (!reader->texts_allowed) return MW_OK;
    t->texts = reader->texts = mw__calloc(reader->width, sizeof *t->texts);
    t->optional = first;
    return t->texts ? MW_OK : mw__fail_memory(error);
}

/* All columns with numbers, those that the header calls x, y, z first. */
static mw_status table_select_numbers(mw_point_reader *reader, mw_error *error)
{
    const mw_table_header *c = &reader->header;
    const table_state *t = reader->state;
    size_t found[3];
    if (mw__table_header_coordinates(c, found))
        for (int k = 0; k < 3; k++) {
            mw_status status =
                found[k] < c->count ? table_take_column(reader, found[k], error) : MW_OK;
            if (status) return status;
        }
    size_t coordinates = reader->width ? reader->width : 3;
    for (size_t i = 0; i < c->count; i++) {
        mw_status status =
            c->numbers[i] && t->slot[i] == UNUSED ? table_take_column(reader, i, error) : MW_OK;
        if (status) return status;
    }
    if (reader->width >= 2) return table_allow_texts(reader, coordinates, error);
    return mw__source_fail_at(&reader->source, (uint64_t)reader->source.line + 1, error,
                              "the table has %zu column%s of numbers; a point needs two",
                              reader->width, reader->width == 1 ? "" : "s");
}

static mw_status table_select(mw_point_reader *reader, const size_t *columns, size_t count,
                              mw_error *error)
{
    table_state *t = reader->state;
    for (size_t i = 0; i < t->columns; i++) t->slot[i] = UNUSED;
    for (size_t k = 0; k < count; k++) {
        mw_status status = table_take_column(reader, columns[k], error);
        if (status) return status;
    }
    return MW_OK;
}

/* Say why a row was refused. Its decimal commas may have been replaced by points. */
static mw_status table_explain_row(mw_point_reader *reader, const char *row, mw_error *error)
{
    const table_state *t = reader->state;
    size_t count = mw__delimited_count(row, t->separator);
    if (count != t->columns)
        return mw__source_fail(
            &reader->source, error, "%zu column%s where %s %zu%s", count, count == 1 ? "" : "s",
            t->header ? "the header has" : "the rows before have", t->columns,
            t->separator == ',' && count == 2 * t->columns ? " (are these decimal commas?)" : "");
    if (t->point && t->comma)
        return mw__source_fail(&reader->source, error,
                               "the table has both decimal points and decimal commas");
    mw_text_cell cell;
    bool more = true;
    for (size_t i = 0; mw__delimited_cell(&row, t->separator, &more, &cell); i++) {
        if (t->slot[i] == UNUSED || mw__cell_is_number(cell, t->separator)) continue;
        if (mw__cell_is_missing(cell) && (cell.length > 0 || t->separator != ' ')) continue;
        bool comma = mw__cell_is_number(cell, ';');
        return mw__source_fail(
            &reader->source, error, "column %zu: '%s' is not a number%s", i + 1,
            mw__excerpt_of(cell.text, cell.length).text,
            comma ? " (for decimal commas separate the columns by semicolons or tabs)" : "");
    }
    return mw__source_fail(&reader->source, error, "this is not a row of numbers");
}

static MW_INLINE char *table_skip_gap(char *p, char separator)
{
    while (*p == ' ' || (*p == '\t' && separator != '\t')) p++;
    return p;
}

/* A number where a decimal comma is one of the ways to write it; the comma becomes a point. */
static char *table_read_either_point(table_state *t, char *p, double *value)
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

static MW_INLINE char *table_read_value(table_state *t, char *p, double *value)
{
    if (mw__delimited_takes_comma(t->separator)) return table_read_either_point(t, p, value);
    const char *end = mw__read_double(p, value);
    return end ? p + (end - p) : NULL;
}

/* A cell that holds no number, but says that the value is missing. Returns its end; NULL if it says
 * something else. */
static char *table_read_missing(const table_state *t, char *p, double *value)
{
    mw_text_cell cell;
    const char *row = p, *end = mw__delimited_skip(p, t->separator);
    bool more = true;
    if (!mw__delimited_cell(&row, t->separator, &more, &cell) || !mw__cell_is_missing(cell))
        return NULL;
    if (cell.length == 0 && t->separator == ' ') return NULL;
    *value = NAN;
    return p + (end - p);
}

/* Read the cell that begins at p, after the gap. Returns its end; NULL if it is not a number. */
static MW_INLINE char *table_read_cell(table_state *t, char *p, double *value)
{
    bool quoted = *p == '"';
    char *end = table_read_value(t, p + quoted, value);
    if (MW_UNLIKELY(!end)) return t->point && t->comma ? NULL : table_read_missing(t, p, value);
    if (!quoted) return end;
    return *end == '"' ? end + 1 : NULL;
}

/* Skip a cell that holds a text. Returns its end, or NULL if a number belongs there. */
static char *table_skip_text(table_state *t, char *p, size_t slot, int64_t line, double *value)
{
    if (!t->texts || slot < t->optional) return NULL;
    mw_text_cells *texts = &t->texts[slot];
    if (texts->count++ == 0) texts->line = line;
    *value = NAN;
    return p + (mw__delimited_skip(p, t->separator) - p);
}

/* Read a cell of a table in which some columns may contain text. A decimal mark within text is
 * ignored. */
static char *table_read_cell_or_text(table_state *t, char *p, size_t slot, int64_t line,
                                     double *value)
{
    bool point = t->point, comma = t->comma;
    char *end = table_read_cell(t, p, value);
    char *after = end ? table_skip_gap(end, t->separator) : NULL;
    if (after && (!*after || *after == t->separator || (t->separator == ' ' && after > end)))
        return end;
    t->point = point;
    t->comma = comma;
    return table_skip_text(t, p, slot, line, value);
}

/* Read the values of a row, which begins in that line; false if something is wrong with it. */
static bool table_parse_row(table_state *t, char *p, int64_t line, double *values)
{
    for (size_t i = 0; i < t->columns; i++) {
        p = table_skip_gap(p, t->separator);
        if (t->separator == ' ' && !*p) return false;
        size_t slot = t->slot[i];
        if (slot == UNUSED)
            p += mw__delimited_skip(p, t->separator) - p;
        else if (t->texts)
            p = table_read_cell_or_text(t, p, slot, line, &values[slot]);
        else
            p = table_read_cell(t, p, &values[slot]);
        if (!p) return false;
        char *after = table_skip_gap(p, t->separator);
        if (i + 1 < t->columns) {
            if (t->separator == ' ' ? after == p : *after != t->separator) return false;
            after += t->separator != ' ';
        }
        p = after;
    }
    return *p == 0;
}

/* Keep the text of a row before it is read: reading may change its decimal commas. */
static mw_status table_keep_row(mw_point_reader *reader, const char *row, mw_error *error)
{
    if (!reader->table) return MW_OK;
    const table_state *t = reader->state;
    return mw__row_texts_add(&reader->rows, row, reader->source.line_length, t->separator, error);
}

static mw_status table_check_count(const mw_point_reader *reader, const table_state *t,
                                   mw_error *error)
{
    if (t->expected == UINT64_MAX || t->done == t->expected) return MW_OK;
    return mw__source_fail(&reader->source, error,
                           "the file has %" PRIu64 " rows, but announces %" PRIu64, t->done,
                           t->expected);
}

static mw_status table_read_rows(mw_point_reader *reader, double *values, size_t capacity,
                                 size_t *count, mw_error *error)
{
    table_state *t = reader->state;
    /* an id like #12 begins a row of a table, a number does not */
    size_t marks = reader->table && t->columns > 0 && t->slot[0] == UNUSED ? t->columns : 0;
    while (*count < capacity && reader->rows.size < MW_ROW_TEXTS_LIMIT) {
        char *row;
        mw_status status = mw__table_row(&reader->source, t->separator, marks, &row, error);
        if (status) return status;
        if (!row) break;
        status = table_keep_row(reader, row, error);
        if (status) return status;
        t->done++;
        if (!table_parse_row(t, row, (int64_t)reader->source.line, values + *count * reader->width))
            return table_explain_row(reader, row, error);
        ++*count;
    }
    if (t->comma) reader->decimal = ',';
    return *count < capacity && reader->rows.size < MW_ROW_TEXTS_LIMIT
               ? table_check_count(reader, t, error)
               : MW_OK;
}

/* Nothing to read: the columns are those selected, or x and y. */
static mw_status table_name_empty(mw_point_reader *reader, const char *selection, mw_error *error)
{
    size_t length;
    const char *rest = selection ? selection : "x,y";
    for (const char *item; (item = mw__selection_item(&rest, &length));) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", length < 63 ? (int)length : 63, item);
        mw_status status = mw__point_reader_add(reader, name, reader->width, error);
        if (status) return status;
    }
    return MW_OK;
}

/* Choose the columns to read at the beginning. With `table` the choice may come later. */
static mw_status table_select_first(mw_point_reader *reader, const char *selection, mw_error *error)
{
    if (reader->header.count == 0) return table_name_empty(reader, selection, error);
    if (selection) return table_select_named(reader, selection, error);
    return reader->table ? MW_OK : table_select_numbers(reader, error);
}

static mw_status table_make(mw_point_reader *reader, char separator, mw_error *error)
{
    size_t columns = reader->header.count;
    table_state *t = mw__alloc(1, sizeof *t + columns * sizeof *t->slot);
    if (!t) return mw__fail_memory(error);
    *t = (table_state){.separator = separator,
                       .header = reader->header.names != NULL,
                       .columns = columns,
                       .expected = reader->header.expected};
    for (size_t i = 0; i < columns; i++) t->slot[i] = UNUSED;
    reader->state = t;
    reader->read = table_read_rows;
    reader->select = table_select;
    reader->separator = separator == ' ' ? ',' : separator;
    return MW_OK;
}

mw_status mw__point_table_start(mw_point_reader *reader, const mw_point_reader_options *options,
                                mw_error *error)
{
    char separator = ' ';
    reader->header = (mw_table_header){
        .expected = UINT64_MAX, .marks = reader->table, .texts = reader->texts_allowed};
    bool node = mw__path_ends(reader->source.path, ".node");
    mw_status status =
        node ? mw__table_header_of_node(&reader->source, &reader->header, error)
             : mw__table_header_detect(&reader->source, &reader->header, &separator, error);
    if (!status && reader->table)
        status = mw__table_header_commas(&reader->header, separator, error);
    if (!status) status = table_make(reader, separator, error);
    return status ? status : table_select_first(reader, options->columns, error);
}
