/* What the readers of points share. */
#include "io/points/point_reader.h"

#include <stdlib.h>
#include <string.h>

mw_status mw__point_reader_add(mw_point_reader *reader, const char *name, size_t column,
                               mw_error *error)
{
    size_t *columns = mw__realloc(reader->columns, reader->width + 1, sizeof *columns);
    if (!columns) return mw__fail_memory(error);
    reader->columns = columns;
    columns[reader->width] = column;
    char **names = mw__realloc(reader->names, reader->width + 1, sizeof *names);
    if (!names) return mw__fail_memory(error);
    reader->names = names;
    names[reader->width] = strdup(name);
    if (!names[reader->width]) return mw__fail_memory(error);
    reader->width++;
    return MW_OK;
}

void mw__point_reader_clear(mw_point_reader *reader)
{
    for (size_t i = 0; i < reader->width; i++) free(reader->names[i]);
    free(reader->names);
    free(reader->columns);
    reader->names = NULL;
    reader->columns = NULL;
    reader->width = 0;
}

const char *mw__selection_item(const char **rest, size_t *length)
{
    if (!*rest) return NULL;
    const char *item = mw__skip_blanks(*rest);
    size_t size = strcspn(item, ",");
    *rest = item[size] ? item + size + 1 : NULL;
    while (size > 0 && mw__is_blank(item[size - 1])) size--;
    *length = size;
    return item;
}
