#include "cli/input/columns.h"
#include "cli/frame/message.h"

#include <stdio.h>
#include <string.h>

const char *columns_list(const columns *wanted, char list[64])
{
    size_t size = 0;
    for (size_t k = 0; k < wanted->count; k++)
        size += (size_t)snprintf(list + size, 64 - size, "%s%s", k ? "," : "", wanted->names[k]);
    return list;
}

static bool find(const char *name, const mw_point_reader *reader, size_t *place)
{
    const char *column;
    for (size_t i = 0; (column = mw_point_reader_column(reader, i)); i++)
        if (strcasecmp(column, name) == 0) {
            *place = i;
            return true;
        }
    return false;
}

static bool find_all(const columns *wanted, const mw_point_reader *reader, size_t pick[MOST_COLUMNS])
{
    for (size_t k = 0; k < wanted->count; k++)
        if (!find(wanted->names[k], reader, &pick[k])) return false;
    return true;
}

/* Without a header the reader calls the columns x, y, z, c4, c5, ... */
static bool has_header(const columns *wanted, const mw_point_reader *reader)
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

static int wrong_choice(const columns *wanted, size_t width)
{
    char list[64];
    complain("option '--columns' wants %zu columns, %s, not %zu", wanted->count, columns_list(wanted, list), width);
    return END_USAGE;
}

static int not_found(const columns *wanted, const char *path, size_t width)
{
    char list[64];
    const char *file = strcmp(path, "-") == 0 ? "standard input" : path, *hint = wanted->hint ? wanted->hint : "";
    columns_list(wanted, list);
    if (width < wanted->count) {
        complain("%s: has %zu columns of numbers, but a row is %s%s", file, width, list, hint);
        return END_INPUT;
    }
    complain("%s: which of its %zu columns are %s? --columns names them%s", file, width, list, hint);
    return END_USAGE;
}

static bool is_longitude(const char *name)
{
    return strcasecmp(name, "lon") == 0 || strcasecmp(name, "longitude") == 0;
}

int columns_pick(const columns *wanted, const char *path, const mw_point_reader *reader, bool chosen,
                 size_t pick[MOST_COLUMNS])
{
    size_t width = mw_point_reader_width(reader);
    if (chosen && width != wanted->count) return wrong_choice(wanted, width);
    if (width < wanted->count) return not_found(wanted, path, width);
    if (!chosen && find_all(wanted, reader, pick)) return 0;
    for (size_t k = 0; k < wanted->count; k++) pick[k] = k;
    if (chosen || wanted->loose || !has_header(wanted, reader)) return 0;
    bool clear = width == wanted->count && !is_longitude(mw_point_reader_column(reader, 0));
    return clear ? 0 : not_found(wanted, path, width);
}
