/* Points from text: a table with or without a header, its separator told from the first row. Also the vertices of
 * Triangle's .node, a table whose first row announces the rows and the meaning of their columns. */
#include "io/formats.h"
#include "io/number.h"
#include "io/points.h"
#include "io/table.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { UNUSED = 0xffff }; /* a column that is not read */

typedef struct table {
    char separator;
    bool header;             /* the file names its columns */
    size_t columns;          /* of every row */
    uint64_t expected, done; /* rows announced (UINT64_MAX: none are) and read */
    uint16_t slot[];         /* for each column: its place among the values, or UNUSED */
} table;

/* What is known of the columns while the reader is made. */
typedef struct columns {
    size_t count;
    char **names;      /* of the header; NULL without one */
    bool *numbers;     /* the first row has a number there (or nothing, in a named column) */
    uint64_t expected; /* rows, if announced */
} columns;

static void release_columns(columns *c)
{
    for (size_t i = 0; c->names && i < c->count; i++) free(c->names[i]);
    free(c->names);
    free(c->numbers);
}

/* The next row: neither empty nor a comment. */
static mw_status next_row(mw_source *source, char **row, mw_error *error)
{
    for (;;) {
        mw_status status = mw__source_line(source, row, error);
        if (status || !*row) return status;
        const char *p = mw__skip_blanks(*row);
        if (*p && *p != '#') return MW_OK;
    }
}

static mw_status keep_names(columns *c, const char *row, char separator, mw_error *error)
{
    c->names = mw__calloc(c->count, sizeof *c->names);
    if (!c->names) return mw__fail_memory(error);
    mw_text_field field;
    bool more = true;
    for (size_t i = 0; mw__table_field(&row, separator, &more, &field); i++) {
        c->names[i] = strndup(field.text, field.length);
        if (!c->names[i]) return mw__fail_memory(error);
    }
    return MW_OK;
}

/* Which columns the first row of data has numbers in. */
static void note_numbers(columns *c, const char *row, char separator)
{
    mw_text_field field;
    bool more = true;
    for (size_t i = 0; i < c->count && mw__table_field(&row, separator, &more, &field); i++) {
        bool named = c->names && *c->names[i];
        c->numbers[i] = field.length == 0 ? named : mw__table_is_number(field, separator);
    }
}

/* Look at the first rows; the first row of data stays unread. */
static mw_status detect(mw_source *source, columns *c, char *separator, mw_error *error)
{
    char *row;
    bool decimal_comma;
    mw_status status = next_row(source, &row, error);
    if (status || !row) return status;
    *separator = mw__table_separator(row, &decimal_comma);
    if (decimal_comma)
        return mw__source_fail(source, error,
                               "decimal commas: write points, or separate the columns by semicolons or tabs");
    c->count = mw__table_columns(row, *separator);
    if (c->count > MW_COLUMN_LIMIT) return mw__source_fail(source, error, "more than %d columns", MW_COLUMN_LIMIT);
    c->numbers = mw__calloc(c->count, sizeof *c->numbers);
    if (!c->numbers) return mw__fail_memory(error);
    if (mw__table_is_header(row, *separator)) {
        status = keep_names(c, row, *separator, error);
        if (!status) status = next_row(source, &row, error);
        if (status) return status;
    }
    for (size_t i = 0; !row && i < c->count; i++) c->numbers[i] = true;
    if (!row) return MW_OK;
    note_numbers(c, row, *separator);
    mw__source_unread_line(source);
    return MW_OK;
}

static mw_status name_column(columns *c, const char *name, size_t number, mw_error *error)
{
    char **names = mw__realloc(c->names, c->count + 1, sizeof *names);
    if (!names) return mw__fail_memory(error);
    c->names = names;
    char text[32];
    snprintf(text, sizeof text, number ? "%s%zu" : "%s", name, number);
    names[c->count] = strdup(text);
    if (!names[c->count]) return mw__fail_memory(error);
    c->count++;
    return MW_OK;
}

/* The first row of a .node file: "rows dimension attributes markers". */
static mw_status detect_node(mw_source *source, columns *c, mw_error *error)
{
    char *row;
    int64_t values[4] = {0, 2, 0, 0};
    mw_status status = mw__source_content(source, &row, error);
    if (status) return status;
    const char *p = row;
    for (int i = 0; i < 4 && p && *p; i++) {
        p = mw__read_integer(p, &values[i]);
        if (p) p = mw__at_gap(p) ? mw__skip_blanks(p) : NULL;
    }
    if (!p || *p || values[0] < 0 || values[1] < 2 || values[1] > 3 || values[2] < 0 ||
        values[2] > MW_COLUMN_LIMIT - 8 || values[3] < 0 || values[3] > 1)
        return mw__source_fail(source, error, "a .node file begins with 'count dimension attributes markers'");
    c->expected = (uint64_t)values[0];
    static const char *const letters[] = {"x", "y", "z"};
    status = name_column(c, "number", 0, error);
    for (int64_t k = 0; !status && k < values[1]; k++) status = name_column(c, letters[k], 0, error);
    for (int64_t k = 0; !status && k < values[2]; k++) status = name_column(c, "attribute", (size_t)k + 1, error);
    if (!status && values[3]) status = name_column(c, "marker", 0, error);
    if (status) return status;
    c->numbers = mw__calloc(c->count, sizeof *c->numbers);
    if (!c->numbers) return mw__fail_memory(error);
    for (size_t i = 1; i < c->count; i++) c->numbers[i] = i <= (size_t)(values[1] + values[2]);
    return MW_OK;
}

/* The column of that name, letters in any case, or c->count. */
static size_t find_name(const columns *c, const char *name, size_t length)
{
    static const char *const letters[] = {"x", "y", "z"};
    for (size_t i = 0; i < c->count; i++) {
        const char *known = c->names ? c->names[i] : i < 3 ? letters[i] : "";
        if (strlen(known) == length && strncasecmp(known, name, length) == 0) return i;
    }
    return c->count;
}

static mw_status take(mw_point_reader *reader, table *t, const columns *c, size_t column, mw_error *error)
{
    static const char *const letters[] = {"x", "y", "z"};
    char number[32];
    snprintf(number, sizeof number, "c%zu", reader->width + 1);
    const char *name = c->names && *c->names[column] ? c->names[column] : NULL;
    if (!name) name = !c->names && reader->width < 3 ? letters[reader->width] : number;
    t->slot[column] = (uint16_t)reader->width;
    return mw__points_add(reader, name, error);
}

static mw_status no_such_column(mw_point_reader *reader, const columns *c, const char *item, size_t length,
                                mw_error *error)
{
    char known[160] = "";
    size_t used = 0;
    for (size_t i = 0; c->names && i < c->count && used < sizeof known; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : ": ", c->names[i]);
    return mw__source_fail(&reader->source, error, "no column '%.*s' among the %zu%s", length < 60 ? (int)length : 60,
                           item, c->count, known);
}

/* The columns that the caller names, by name or by number. */
static mw_status select_named(mw_point_reader *reader, table *t, const columns *c, const char *selection,
                              mw_error *error)
{
    size_t length;
    const char *rest = selection;
    for (const char *item; (item = mw__points_item(&rest, &length));) {
        size_t column = find_name(c, item, length);
        if (column == c->count) {
            int64_t number;
            const char *end = mw__read_integer(item, &number);
            if (end != item + length || number < 1 || (uint64_t)number > c->count)
                return no_such_column(reader, c, item, length, error);
            column = (size_t)number - 1;
        }
        if (t->slot[column] != UNUSED)
            return mw__fail(error, MW_ERROR_ARGUMENT, "columns '%.60s': '%.*s' is selected twice", selection,
                            length < 60 ? (int)length : 60, item);
        mw_status status = take(reader, t, c, column, error);
        if (status) return status;
    }
    return MW_OK;
}

/* The columns of a header that mean x, y and z; false if x or y is not found. z may be c->count. */
static bool find_coordinates(const columns *c, size_t found[3])
{
    static const char *const pairs[][2] = {
        {"x", "y"}, {"lon", "lat"}, {"longitude", "latitude"}, {"easting", "northing"}};
    for (size_t i = 0; c->names && i < sizeof pairs / sizeof *pairs; i++) {
        for (int k = 0; k < 2; k++) found[k] = find_name(c, pairs[i][k], strlen(pairs[i][k]));
        if (found[0] < c->count && found[1] < c->count && c->numbers[found[0]] && c->numbers[found[1]]) {
            found[2] = find_name(c, "z", 1);
            if (found[2] < c->count && !c->numbers[found[2]]) found[2] = c->count;
            return true;
        }
    }
    return false;
}

/* All columns with numbers, those that the header calls x, y, z first. */
static mw_status select_numbers(mw_point_reader *reader, table *t, const columns *c, mw_error *error)
{
    size_t found[3];
    if (find_coordinates(c, found))
        for (int k = 0; k < 3; k++) {
            mw_status status = found[k] < c->count ? take(reader, t, c, found[k], error) : MW_OK;
            if (status) return status;
        }
    for (size_t i = 0; i < c->count; i++) {
        mw_status status = c->numbers[i] && t->slot[i] == UNUSED ? take(reader, t, c, i, error) : MW_OK;
        if (status) return status;
    }
    if (reader->width >= 2) return MW_OK;
    return mw__source_fail_at(&reader->source, (uint64_t)reader->source.line + 1, error,
                              "%zu column%s of numbers; a point needs two", reader->width,
                              reader->width == 1 ? "" : "s");
}

/* A row that was refused: say why. `row` may have got points for its decimal commas. */
static mw_status explain(mw_point_reader *reader, const char *row, mw_error *error)
{
    const table *t = reader->state;
    size_t count = mw__table_columns(row, t->separator);
    if (count != t->columns)
        return mw__source_fail(&reader->source, error, "%zu column%s where %s %zu%s", count, count == 1 ? "" : "s",
                               t->header ? "the header has" : "the rows before have", t->columns,
                               t->separator == ',' && count == 2 * t->columns ? " (are these decimal commas?)" : "");
    mw_text_field field;
    bool more = true;
    for (size_t i = 0; mw__table_field(&row, t->separator, &more, &field); i++) {
        if (t->slot[i] == UNUSED || mw__table_is_number(field, t->separator)) continue;
        if (field.length == 0 && t->separator != ' ') continue;
        bool comma = mw__table_is_number(field, ';');
        return mw__source_fail(&reader->source, error, "column %zu: '%s' is not a number%s", i + 1,
                               mw__excerpt_of(field.text, field.length).text,
                               comma ? " (for decimal commas separate the columns by semicolons or tabs)" : "");
    }
    return mw__source_fail(&reader->source, error, "this is no row of numbers");
}

/* The end of a field that is not read. */
static char *skip_field(char *p, char separator)
{
    const char *rest = p;
    bool more = true;
    mw_text_field field;
    mw__table_field(&rest, separator, &more, &field);
    return p + (rest - p) - (more ? 1 : 0);
}

static MW_INLINE char *skip_gap(char *p, char separator)
{
    while (*p == ' ' || (*p == '\t' && separator != '\t')) p++;
    return p;
}

/* Read the values of a row; false if something is wrong with it. An empty field is a missing value, NaN. */
static bool parse_row(const table *t, char *p, double *values)
{
    for (size_t i = 0; i < t->columns; i++) {
        p = skip_gap(p, t->separator);
        if (t->slot[i] != UNUSED) {
            bool quoted = *p == '"';
            const char *end = mw__read_double(p + quoted, &values[t->slot[i]]);
            if (end) {
                if (quoted && *end++ != '"') return false;
                p += end - p;
            } else {
                if (t->separator == ' ' || (*p && *p != t->separator)) return false;
                values[t->slot[i]] = NAN;
            }
        } else {
            if (t->separator == ' ' && !*p) return false;
            p = skip_field(p, t->separator);
        }
        char *after = skip_gap(p, t->separator);
        if (i + 1 < t->columns) {
            if (t->separator == ' ' ? after == p : *after != t->separator) return false;
            after += t->separator != ' ';
        }
        p = after;
    }
    return *p == 0;
}

static mw_status check_count(const mw_point_reader *reader, const table *t, mw_error *error)
{
    if (t->expected == UINT64_MAX || t->done == t->expected) return MW_OK;
    return mw__source_fail(&reader->source, error, "%" PRIu64 " rows where %" PRIu64 " are announced", t->done,
                           t->expected);
}

static mw_status read_rows(mw_point_reader *reader, double *values, size_t capacity, size_t *count, mw_error *error)
{
    table *t = reader->state;
    while (*count < capacity) {
        char *row;
        mw_status status = next_row(&reader->source, &row, error);
        if (status) return status;
        if (!row) return check_count(reader, t, error);
        t->done++;
        if (mw__table_takes_comma(t->separator))
            for (char *comma = row; (comma = strchr(comma, ','));) *comma = '.';
        if (!parse_row(t, row, values + *count * reader->width)) return explain(reader, row, error);
        ++*count;
    }
    return MW_OK;
}

/* Nothing to read: the columns are those selected, or x and y. */
static mw_status empty_table(mw_point_reader *reader, const char *selection, mw_error *error)
{
    size_t length;
    const char *rest = selection ? selection : "x,y";
    for (const char *item; (item = mw__points_item(&rest, &length));) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", length < 63 ? (int)length : 63, item);
        mw_status status = mw__points_add(reader, name, error);
        if (status) return status;
    }
    return MW_OK;
}

mw_status mw__points_text(mw_point_reader *reader, const mw_points_options *options, mw_error *error)
{
    columns c = {.expected = UINT64_MAX};
    char separator = ' ';
    bool node = mw__path_ends(reader->source.path, ".node");
    mw_status status = node ? detect_node(&reader->source, &c, error) : detect(&reader->source, &c, &separator, error);
    table *t = status ? NULL : mw__alloc(1, sizeof *t + c.count * sizeof *t->slot);
    if (!status && !t) status = mw__fail_memory(error);
    if (!status) {
        t->separator = separator;
        t->header = c.names != NULL;
        t->columns = c.count;
        t->expected = c.expected;
        t->done = 0;
        for (size_t i = 0; i < c.count; i++) t->slot[i] = UNUSED;
        reader->state = t;
        reader->read = read_rows;
        if (c.count == 0)
            status = empty_table(reader, options->columns, error);
        else if (options->columns)
            status = select_named(reader, t, &c, options->columns, error);
        else
            status = select_numbers(reader, t, &c, error);
    }
    release_columns(&c);
    return status;
}
