#include "cli/lines/row_output.h"
#include "cli/output/csv_row.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/signals.h"
#include "cli/output/prj_output.h"

#include <stdlib.h>
#include <string.h>

enum { ROWS_AT_A_TIME = 1 << 14 };

int row_output_check(const char *path)
{
    return gdal_rows_known(path) ? gdal_rows_check(path) : files_check_text_output(path);
}

/* What each row has. */
enum { ROW_POINT = 0, ROW_LINE, ROW_POLYGON };

static int row_output_begin(row_output *o, const text *header, const char *kinds, int geometry,
                            size_t dimensions)
{
    mw_error error;
    gdal_rows_form form = {.header = header->bytes,
                           .header_size = header->size,
                           .separator = ',',
                           .decimal = '.',
                           .dimensions = dimensions,
                           .answers = kinds,
                           .crs = o->crs,
                           .quiet = o->quiet,
                           .lines = geometry == ROW_LINE,
                           .polygons = geometry == ROW_POLYGON};
    if (gdal_rows_known(o->path)) return gdal_rows_open(&o->rows, o->path, &form);
    int end = prj_output_check(o->path, o->crs, o->quiet);
    if (end) return end;
    if (mw_output_open(o->path, &o->out, &error) != MW_OK) return fail_writing(&error);
    signals_set_temporary(mw_output_temporary(o->out));
    mw_output_write(o->out, header->bytes, header->size);
    return 0;
}

int row_output_open(row_output *o, const char *path, const text *header, const char *kinds,
                    const char *crs, bool quiet)
{
    *o = (row_output){.path = path ? path : "-", .crs = crs, .quiet = quiet};
    o->room = ROWS_AT_A_TIME;
    o->points = malloc(2 * o->room * sizeof *o->points);
    if (!o->points || header->failed) return fail_memory();
    return row_output_begin(o, header, kinds, ROW_POINT, 2);
}

int row_output_open_lines(row_output *o, const char *path, const text *header, const char *kinds,
                          const char *crs, bool quiet)
{
    *o = (row_output){.path = path, .crs = crs, .quiet = quiet};
    return header->failed ? fail_memory() : row_output_begin(o, header, kinds, ROW_LINE, 2);
}

int row_output_open_polygons(row_output *o, const char *path, const text *header, const char *kinds,
                             const char *crs, bool quiet)
{
    *o = (row_output){.path = path, .crs = crs, .quiet = quiet};
    return header->failed ? fail_memory() : row_output_begin(o, header, kinds, ROW_POLYGON, 2);
}

int row_output_open_draped(row_output *o, const char *path, const text *header, const char *kinds,
                           const char *crs, bool quiet, bool polygons)
{
    *o = (row_output){.path = path, .crs = crs, .quiet = quiet};
    return header->failed
               ? fail_memory()
               : row_output_begin(o, header, kinds, polygons ? ROW_POLYGON : ROW_LINE, 3);
}

static int row_output_flush(row_output *o)
{
    int end = 0;
    if (o->text.failed) return fail_memory();
    if (o->rows)
        end = gdal_rows_write(o->rows, o->text.bytes, o->text.size, o->points, 2);
    else
        mw_output_write(o->out, o->text.bytes, o->text.size);
    text_clear(&o->text);
    o->count = 0;
    if (end == 0 && o->out && mw_output_failed(o->out)) end = END_RESOURCE; /* closing tells */
    return end;
}

int row_output_row(row_output *o, const double point[2])
{
    memcpy(o->points + 2 * o->count++, point, 2 * sizeof *point);
    return o->count < o->room ? 0 : row_output_flush(o);
}

int row_output_line(row_output *o, const double *points, size_t count)
{
    if (o->text.failed) return fail_memory();
    int end = gdal_rows_write_line(o->rows, o->text.bytes, o->text.size, points, count);
    text_clear(&o->text);
    return end;
}

int row_output_polygon(row_output *o, const double *points, const size_t *first, size_t ring_count)
{
    if (o->text.failed) return fail_memory();
    int end =
        gdal_rows_write_polygon(o->rows, o->text.bytes, o->text.size, points, first, ring_count);
    text_clear(&o->text);
    return end;
}

int row_output_close(row_output *o, bool commit)
{
    mw_error error;
    int end = commit && o->count > 0 ? row_output_flush(o) : 0;
    bool good = commit && end == 0;
    bool failed = o->out && mw_output_failed(o->out); /* what failed is told, and not kept */
    if (o->out && mw_output_close(o->out, good || failed, &error) != MW_OK &&
        (end == 0 || end == END_RESOURCE))
        end = fail_writing(&error);
    int closed = gdal_rows_close(o->rows, good);
    if (end == 0) end = closed;
    signals_set_temporary(NULL);
    if (good && end == 0 && o->out) end = prj_output_write(o->path, o->crs, o->quiet);
    free(o->points);
    text_release(&o->text);
    return end;
}

void row_output_begin_header(text *header, text *kinds, const feature_values *values,
                             row_output_own *is_own, const void *rows)
{
    text_string(header, "feature,part");
    text_string(kinds, "ii");
    for (size_t i = 0; i < values->count; i++) {
        text name = {0};
        text_printf(&name, "%s%s", is_own(rows, values->names[i]) ? "line_" : "", values->names[i]);
        text_bytes(&name, "", 1);
        if (!name.failed) csv_row_text(header, name.bytes);
        header->failed = header->failed || name.failed;
        text_release(&name);
        text_bytes(kinds, &values->kinds[i], 1);
    }
}

void row_output_begin_row(text *out, const feature_values *values, uint32_t feature, uint32_t part)
{
    text_printf(out, "%u,%u", feature, part);
    for (size_t i = 0; i < values->count; i++) {
        const char *cell = feature_values_cell(values, feature, i);
        if (values->kinds[i] == 't')
            csv_row_text(out, cell);
        else
            csv_row_word(out, cell);
    }
}
