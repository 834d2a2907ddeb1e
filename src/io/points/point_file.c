/* Points in files: telling the format, and the stream. */
#include "io/points/point_file.h"
#include "base/options.h"

#include "io/formats/mesh_formats.h"
#include "io/points/las.h"
#include "io/points/point_table.h"

#include <stdlib.h>
#include <string.h>

/* A selection names at least two columns, and none of its items is empty. */
static mw_status selection_check(const char *columns, mw_error *error)
{
    size_t count = 0, length;
    for (const char *rest = columns; mw__selection_item(&rest, &length); count++)
        if (length == 0)
            return mw__fail(error, MW_ERROR_ARGUMENT, "columns '%.60s': a name is empty", columns);
    if (count < 2 || count > MW_COLUMN_LIMIT)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "columns '%.60s': at least two are needed, x and y", columns);
    return MW_OK;
}

/* GeoJSON, GPX, KML and so on hold points, but no table of them. */
static mw_status text_refuse_markup(const mw_source *source, const char *head, size_t size,
                                    mw_error *error)
{
    if (size >= 3 && memcmp(head, "\xef\xbb\xbf", 3) == 0) head += 3, size -= 3;
    while (size > 0 && strchr(" \t\r\n", *head)) head++, size--;
    if (size == 0 || (*head != '{' && *head != '<')) return MW_OK;
    return mw__fail(error, MW_ERROR_INPUT, "%.240s: this is %s, not a table of points",
                    mw__source_name(source), *head == '{' ? "JSON" : "XML");
}

static mw_status point_reader_start(mw_point_reader *reader, const mw_point_reader_options *options,
                                    mw_error *error)
{
    const char *head;
    size_t size;
    mw_status status = options->columns ? selection_check(options->columns, error) : MW_OK;
    if (!status) status = mw__source_peek(&reader->source, 1024, &head, &size, error);
    if (status) return status;
    if (size >= 4 && memcmp(head, "LASF", 4) == 0) return mw__las_start(reader, options, error);
    const mw_mesh_format *format = mw__mesh_format_by_content(head, size);
    if (format && (!format->common_words || mw__mesh_format_by_path(reader->source.path) == format))
        return mw__fail(error, MW_ERROR_INPUT,
                        "%.240s: this is a mesh ('%s'), not a table of points",
                        mw__source_name(&reader->source), format->name);
    status = text_refuse_markup(&reader->source, head, size, error);
    return status ? status : mw__point_table_start(reader, options, error);
}

mw_status mw__point_reader_start(mw_source source, const mw_point_reader_options *options,
                                 mw_point_reader **out, mw_error *error)
{
    static const mw_point_reader_options none;
    mw_point_reader *reader = mw__calloc(1, sizeof *reader);
    if (!reader) {
        mw__source_close(&source);
        return mw__fail_memory(error);
    }
    reader->source = source;
    reader->table = options && options->table;
    reader->texts_allowed = options && options->texts && !options->columns;
    reader->separator = ',';
    reader->decimal = '.';
    mw_status status = point_reader_start(reader, options ? options : &none, error);
    if (status)
        mw_point_reader_close(reader);
    else
        *out = reader;
    return status;
}

mw_status mw_point_reader_open(const char *path, const mw_point_reader_options *options,
                               mw_point_reader **out, mw_error *error)
{
    if (out) *out = NULL;
    if (!path || !out)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_point_reader_open: the path or the pointer to the new reader is NULL");
    mw_source source;
    mw_status status = options ? MW_RESERVED_CHECK(mw_point_reader_options, options, error) : MW_OK;
    if (!status) status = mw__source_open(&source, path, error);
    if (!status) status = mw__point_reader_start(source, options, out, error);
    if (!status && !(*out)->crs) status = mw_read_prj(path, &(*out)->crs, error);
    if (status && *out) mw_point_reader_close(*out), *out = NULL;
    return status;
}

const char *mw_point_reader_crs(const mw_point_reader *reader)
{
    return reader->crs;
}

size_t mw_point_reader_width(const mw_point_reader *reader)
{
    return reader->width;
}

const char *mw_point_reader_column(const mw_point_reader *reader, size_t column)
{
    return column < reader->width ? reader->names[column] : NULL;
}

size_t mw_point_reader_column_number(const mw_point_reader *reader, size_t column)
{
    return column < reader->width ? reader->columns[column] : SIZE_MAX;
}

mw_status mw_point_reader_read(mw_point_reader *reader, double *values, size_t capacity,
                               size_t *count, mw_error *error)
{
    *count = 0;
    reader->begun = true;
    mw__row_texts_clear(&reader->rows);
    return reader->read(reader, values, capacity, count, error);
}

double mw_point_reader_fraction(const mw_point_reader *reader)
{
    return mw__source_fraction(&reader->source);
}

mw_status mw_point_reader_table(const mw_point_reader *reader, mw_point_table *table,
                                mw_error *error)
{
    if (!reader || !table)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_point_reader_table: the reader or the result is NULL");
    const mw_table_header *header = &reader->header;
    *table = (mw_point_table){.names = (const char *const *)header->names,
                              .header = header->text,
                              .column_count = header->count,
                              .separator = reader->separator,
                              .decimal = reader->decimal};
    return MW_OK;
}

mw_status mw_point_reader_select(mw_point_reader *reader, const size_t *columns, size_t count,
                                 mw_error *error)
{
    if (!reader || !columns)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_point_reader_select: the reader or the columns are NULL");
    if (!reader->table || reader->begun || count < 2)
        return mw__fail(error, MW_ERROR_ARGUMENT, "mw_point_reader_select: %s",
                        !reader->table  ? "the reader does not keep its table"
                        : reader->begun ? "reading has begun"
                                        : "at least two columns are needed");
    for (size_t k = 0; k < count; k++) {
        if (columns[k] >= reader->header.count)
            return mw__fail(error, MW_ERROR_ARGUMENT,
                            "mw_point_reader_select: there is no column %zu", columns[k]);
        for (size_t i = 0; i < k; i++)
            if (columns[i] == columns[k])
                return mw__fail(error, MW_ERROR_ARGUMENT,
                                "mw_point_reader_select: column %zu is named twice", columns[k]);
    }
    mw__point_reader_clear(reader);
    return reader->select(reader, columns, count, error);
}

uint64_t mw_point_reader_texts(const mw_point_reader *reader, size_t column, int64_t *line)
{
    if (!reader->texts || column >= reader->width || reader->texts[column].count == 0) return 0;
    if (line) *line = reader->texts[column].line;
    return reader->texts[column].count;
}

const char *mw_point_reader_row(const mw_point_reader *reader, size_t row, size_t *length)
{
    *length = 0;
    return reader->table && row < reader->rows.count ? mw__row_texts_at(&reader->rows, row, length)
                                                     : NULL;
}

void mw_point_reader_close(mw_point_reader *reader)
{
    if (!reader) return;
    mw__source_close(&reader->source);
    mw__point_reader_clear(reader);
    mw__table_header_release(&reader->header);
    mw__row_texts_release(&reader->rows);
    free(reader->state);
    free(reader->texts);
    free(reader->crs);
    free(reader);
}
