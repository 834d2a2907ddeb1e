#include "io/points/table_header.h"
#include "base/posix.h"
#include "io/points/axis_names.h"
#include "io/points/row_texts.h"
#include "io/text/delimited.h"
#include "io/text/number_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void mw__table_header_release(mw_table_header *c)
{
    for (size_t i = 0; c->names && i < c->count; i++) free(c->names[i]);
    free(c->names);
    free(c->text);
    free(c->numbers);
    *c = (mw_table_header){0};
}

/* Join lines to a row until none of its cells is open. */
static mw_status row_join_lines(mw_source *source, char separator, char **row, mw_error *error)
{
    uint64_t first = mw__source_position(source);
    bool unknown;
    if (!separator) separator = mw__delimited_separator(*row, &unknown);
    bool open = mw__delimited_is_open(*row, separator, false);
    while (open) {
        size_t known = source->line_bytes;
        mw_status status = mw__source_join_line(source, row, error);
        if (status) return status;
        if (!*row)
            return mw__source_fail_at(source, first, error,
                                      "a quoted cell begins in this row and does not end");
        open = mw__delimited_is_open(*row + known, separator, true);
    }
    return MW_OK;
}

/* A row of empty cells between tabs is a row. */
static bool row_is_none(const char *row, char separator, size_t columns)
{
    const char *p = row;
    while (*p == ' ' || (*p == '\t' && separator != '\t')) p++;
    if (*p != '#') return !*p;
    return columns == 0 || separator == ' ' || mw__delimited_count(row, separator) != columns;
}

mw_status mw__table_row(mw_source *source, char separator, size_t columns, char **row,
                        mw_error *error)
{
    for (;;) {
        mw_status status = mw__source_line(source, row, error);
        if (status || !*row) return status;
        if (row_is_none(*row, separator, columns)) continue;
        bool quotes = memchr(*row, '"', source->line_length) != NULL;
        return quotes ? row_join_lines(source, separator, row, error) : MW_OK;
    }
}

static mw_status header_keep_names(mw_table_header *c, const char *row, char separator,
                                   mw_error *error)
{
    c->names = mw__calloc(c->count, sizeof *c->names);
    c->text = strdup(row);
    if (!c->names || !c->text) return mw__fail_memory(error);
    mw_text_cell cell;
    bool more = true;
    for (size_t i = 0; mw__delimited_cell(&row, separator, &more, &cell); i++) {
        c->names[i] = strndup(cell.text, cell.length);
        if (!c->names[i]) return mw__fail_memory(error);
    }
    return MW_OK;
}

/* Which columns the first row of data has numbers in. */
static void header_note_numbers(mw_table_header *c, const char *row, char separator)
{
    mw_text_cell cell;
    bool more = true;
    for (size_t i = 0; i < c->count && mw__delimited_cell(&row, separator, &more, &cell); i++) {
        bool named = c->names && *c->names[i];
        bool words = c->texts || (named && mw__axis_name_known(c->names[i]));
        bool missing = cell.length == 0 || (words && mw__cell_is_missing(cell));
        c->numbers[i] = missing ? named : mw__cell_is_number(cell, separator);
    }
}

/* Do two cells at least name coordinates? Then other names may be numbers, as years are. */
static bool row_names_coordinates(const char *row, char separator)
{
    size_t known = 0;
    mw_text_cell cell;
    bool more = true;
    while (mw__delimited_cell(&row, separator, &more, &cell)) {
        char name[64];
        if (cell.length >= sizeof name) continue;
        memcpy(name, cell.text, cell.length);
        name[cell.length] = 0;
        known += mw__axis_name_known(name);
    }
    return known >= 2;
}

/* Numbers like 1,5 between blanks are refused: they could as well be two. */
static mw_status header_refuse_decimal_commas(const mw_source *source, const char *row,
                                              char *separator, mw_error *error)
{
    bool decimal_comma;
    *separator = mw__delimited_separator(row, &decimal_comma);
    if (!decimal_comma) return MW_OK;
    return mw__source_fail(source, error,
                           "the row has decimal commas: write decimal points, or separate the "
                           "columns by semicolons or tabs");
}

mw_status mw__table_header_detect(mw_source *source, mw_table_header *c, char *separator,
                                  mw_error *error)
{
    char *row, other;
    mw_status status = mw__table_row(source, 0, 0, &row, error);
    if (status || !row) return status;
    status = header_refuse_decimal_commas(source, row, separator, error);
    if (status) return status;
    c->count = mw__delimited_count(row, *separator);
    if (c->count > MW_COLUMN_LIMIT)
        return mw__source_fail(source, error, "more than %d columns", MW_COLUMN_LIMIT);
    c->numbers = mw__calloc(c->count, sizeof *c->numbers);
    if (!c->numbers) return mw__fail_memory(error);
    if (mw__delimited_is_header(row, *separator) || row_names_coordinates(row, *separator)) {
        status = header_keep_names(c, row, *separator, error);
        if (!status)
            status = mw__table_row(source, *separator, c->marks ? c->count : 0, &row, error);
        if (!status && row && !mw__delimited_takes_comma(*separator))
            status = header_refuse_decimal_commas(source, row, &other, error);
        if (status) return status;
    }
    for (size_t i = 0; !row && i < c->count; i++) c->numbers[i] = true;
    if (!row) return MW_OK;
    header_note_numbers(c, row, *separator);
    mw__source_unread_line(source);
    return MW_OK;
}

/* The names with blanks between them; none of them holds one. */
static char *header_join_names(const mw_table_header *c)
{
    size_t size = 1;
    for (size_t i = 0; i < c->count; i++) size += strlen(c->names[i]) + 1;
    char *text = mw__alloc(size, 1);
    if (!text) return NULL;
    text[0] = 0;
    for (size_t i = 0; i < c->count; i++) {
        if (i > 0) strcat(text, " ");
        strcat(text, c->names[i]);
    }
    return text;
}

mw_status mw__table_header_commas(mw_table_header *c, char separator, mw_error *error)
{
    if (!c->names || (c->text && separator != ' ')) return MW_OK;
    if (!c->text) c->text = header_join_names(c);
    if (!c->text) return mw__fail_memory(error);
    mw_row_texts row = {0};
    mw_status status = mw__row_texts_add(&row, c->text, strlen(c->text), ' ', error);
    char *text = status ? NULL : strndup(row.bytes, row.size);
    mw__row_texts_release(&row);
    if (!status && !text) status = mw__fail_memory(error);
    if (status) return status;
    free(c->text);
    c->text = text;
    return MW_OK;
}

static mw_status header_name_column(mw_table_header *c, const char *name, size_t number,
                                    mw_error *error)
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

mw_status mw__table_header_of_node(mw_source *source, mw_table_header *c, mw_error *error)
{
    char *row;
    int64_t values[4] = {0, 2, 0, 0};
    mw_status status = mw__source_content_line(source, &row, error);
    if (status) return status;
    const char *p = row;
    for (int i = 0; i < 4 && p && *p; i++) {
        const char *number = p;
        p = mw__read_integer(p, &values[i]);
        if (p && !mw__integer_fits(values[i]))
            return mw__source_fail_large(source, number, p, error);
        if (p) p = mw__at_gap(p) ? mw__skip_blanks(p) : NULL;
    }
    if (!p || *p || values[0] < 0 || values[1] < 2 || values[1] > 3 || values[2] < 0 ||
        values[2] > MW_COLUMN_LIMIT - 8 || values[3] < 0 || values[3] > 1)
        return mw__source_fail(source, error,
                               "a .node file begins with 'count dimension attributes markers'");
    c->expected = (uint64_t)values[0];
    static const char *const letters[] = {"x", "y", "z"};
    status = header_name_column(c, "number", 0, error);
    for (int64_t k = 0; !status && k < values[1]; k++)
        status = header_name_column(c, letters[k], 0, error);
    for (int64_t k = 0; !status && k < values[2]; k++)
        status = header_name_column(c, "attribute", (size_t)k + 1, error);
    if (!status && values[3]) status = header_name_column(c, "marker", 0, error);
    if (status) return status;
    c->numbers = mw__calloc(c->count, sizeof *c->numbers);
    if (!c->numbers) return mw__fail_memory(error);
    for (size_t i = 1; i < c->count; i++) c->numbers[i] = i <= (size_t)(values[1] + values[2]);
    return MW_OK;
}

size_t mw__table_header_find(const mw_table_header *c, const char *name, size_t length)
{
    static const char *const letters[] = {"x", "y", "z"};
    for (size_t i = 0; i < c->count; i++) {
        const char *known = c->names ? c->names[i] : i < 3 ? letters[i] : "";
        if (strlen(known) == length && strncasecmp(known, name, length) == 0) return i;
    }
    return c->count;
}

/* The first column of that name that has numbers; c->count if there is none. */
static size_t header_find_axis(const mw_table_header *c, const char *name)
{
    for (size_t i = 0; i < c->count; i++)
        if (c->numbers[i] && mw_axis_name_matches(c->names[i], name)) return i;
    return c->count;
}

bool mw__table_header_coordinates(const mw_table_header *c, size_t found[3])
{
    const mw_axis_names *set;
    for (size_t i = 0; c->names && (set = mw_axis_names_at(i)); i++) {
        for (int k = 0; k < 3; k++) found[k] = header_find_axis(c, set->axis[k]);
        if (found[2] == c->count) found[2] = header_find_axis(c, "z");
        if (found[0] < c->count && found[1] < c->count) return true;
    }
    return false;
}
