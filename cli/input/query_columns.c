#include "cli/input/query_columns.h"
#include "cli/frame/message.h"

#include <stdio.h>
#include <string.h>

/* The names as in a header: "x,y,z". Returns `list`. */
static const char *columns_list_names(const query_columns *wanted, char list[64])
{
    size_t size = 0;
    for (size_t k = 0; k < wanted->count; k++)
        size += (size_t)snprintf(list + size, 64 - size, "%s%s", k ? "," : "", wanted->names[k]);
    return list;
}

static bool column_find(const char *name, const mw_point_reader *reader, size_t *index)
{
    const char *column;
    for (size_t i = 0; (column = mw_point_reader_column(reader, i)); i++)
        if (strcasecmp(column, name) == 0) {
            *index = i;
            return true;
        }
    return false;
}

static bool columns_find_by_name(const query_columns *wanted, const mw_point_reader *reader,
                                 size_t index[MAX_QUERY_COLUMNS])
{
    for (size_t k = 0; k < wanted->count; k++)
        if (!column_find(wanted->names[k], reader, &index[k])) return false;
    return true;
}

/* Has the file a header? Without one the reader calls the columns x, y, z, c4, c5, ... */
static bool columns_have_header(const query_columns *wanted, const mw_point_reader *reader)
{
    for (size_t k = 0; k < wanted->count; k++) {
        char name[32];
        if (k < 3)
            snprintf(name, sizeof name, "%c", "xyz"[k]);
        else
            snprintf(name, sizeof name, "c%zu", k + 1);
        if (strcmp(mw_point_reader_column(reader, k), name) != 0) return true;
    }
    return false;
}

static int columns_fail_count(const query_columns *wanted, size_t width)
{
    char list[64];
    complain("option '--columns' wants %zu columns, %s, not %zu", wanted->count, columns_list_names(wanted, list),
             width);
    return END_USAGE;
}

static int columns_fail_missing(const query_columns *wanted, const char *path, size_t width)
{
    char list[64];
    const char *file = strcmp(path, "-") == 0 ? "standard input" : path, *hint = wanted->hint ? wanted->hint : "";
    columns_list_names(wanted, list);
    if (width < wanted->count) {
        complain("%s: has %zu columns of numbers, but a row is %s%s", file, width, list, hint);
        return END_INPUT;
    }
    complain("%s: which of its %zu columns are %s? --columns names them%s", file, width, list, hint);
    return END_USAGE;
}

static bool column_is_longitude(const char *name)
{
    return strcasecmp(name, "lon") == 0 || strcasecmp(name, "longitude") == 0;
}

int query_columns_find(const query_columns *wanted, const char *path, const mw_point_reader *reader, bool chosen,
                       size_t index[MAX_QUERY_COLUMNS])
{
    size_t width = mw_point_reader_width(reader);
    if (chosen && width != wanted->count) return columns_fail_count(wanted, width);
    if (width < wanted->count) return columns_fail_missing(wanted, path, width);
    if (!chosen && columns_find_by_name(wanted, reader, index)) return 0;
    for (size_t k = 0; k < wanted->count; k++) index[k] = k;
    if (chosen || wanted->accept_first || !columns_have_header(wanted, reader)) return 0;
    bool clear = width == wanted->count && !column_is_longitude(mw_point_reader_column(reader, 0));
    return clear ? 0 : columns_fail_missing(wanted, path, width);
}
