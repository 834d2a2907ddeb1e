#include "cli/input/query_source.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_points.h"

#include <stdlib.h>

/* One of two readers. */
struct query_source {
    mw_point_reader *reader;
    gdal_points *points;
    size_t width;
    bool lonlat;
};

static int source_open_table(query_source *s, const char *path,
                             const query_source_settings *settings, const query_columns *wanted,
                             size_t *index)
{
    mw_error error;
    mw_point_reader_options options = {.columns = settings->columns, .table = 1};
    const char *option = settings->layer ? "layer" : settings->where ? "where" : NULL;
    if (option) {
        complain("option '--%s' is for files that GDAL reads, not for tables", option);
        return END_USAGE;
    }
    if (mw_point_reader_open(path, &options, &s->reader, &error) != MW_OK)
        return fail_reading(&error);
    return query_columns_find(wanted, path, s->reader, settings->columns, index, &s->lonlat);
}

static int source_open_points(query_source *s, const char *path,
                              const query_source_settings *settings, const query_columns *wanted,
                              size_t *index)
{
    mw_point_table table;
    if (settings->columns) {
        complain("option '--columns' is for tables; the points of %s have their coordinates", path);
        return END_USAGE;
    }
    int end = gdal_points_open(&s->points, path, settings->layer, settings->where);
    if (end) return end;
    gdal_points_table(s->points, &table);
    bool heights = table.column_count > 2 && mw_axis_name_matches(table.names[2], "z");
    for (size_t k = 0; k < wanted->count; k++) index[k] = k;
    if (wanted->count == 2 || (wanted->count == 3 && heights)) return 0;
    complain("%s: its points have x%s, but %zu numbers are wanted for each query", path,
             heights ? ", y and z" : " and y", wanted->count);
    return END_INPUT;
}

int query_source_open(query_source **source, const char *path,
                      const query_source_settings *settings, const query_columns *wanted,
                      size_t index[MAX_QUERY_COLUMNS])
{
    query_source *s = *source = calloc(1, sizeof *s);
    if (!s) return fail_memory();
    s->width = wanted->count;
    return gdal_points_known(path) ? source_open_points(s, path, settings, wanted, index)
                                   : source_open_table(s, path, settings, wanted, index);
}

void query_source_close(query_source *s)
{
    if (!s) return;
    mw_point_reader_close(s->reader);
    gdal_points_close(s->points);
    free(s);
}

void query_source_table(const query_source *s, mw_point_table *table)
{
    if (s->points)
        gdal_points_table(s->points, table);
    else
        mw_point_reader_table(s->reader, table, NULL);
}

size_t query_source_coordinates(const query_source *s)
{
    return s->points ? gdal_points_coordinates(s->points) : 0;
}

const char *query_source_crs(const query_source *s)
{
    return s->points ? gdal_points_crs(s->points) : mw_point_reader_crs(s->reader);
}

bool query_source_is_lonlat(const query_source *s)
{
    return s->lonlat;
}

int query_source_read(query_source *s, double *values, size_t capacity, size_t *count)
{
    mw_error error;
    if (s->points) return gdal_points_read(s->points, values, s->width, capacity, count);
    return mw_point_reader_read(s->reader, values, capacity, count, &error) == MW_OK
               ? 0
               : fail_reading(&error);
}

double query_source_fraction(const query_source *s)
{
    return s->reader ? mw_point_reader_fraction(s->reader) : -1;
}

const char *query_source_row(const query_source *s, size_t row, size_t *length)
{
    return s->points ? gdal_points_row(s->points, row, length)
                     : mw_point_reader_row(s->reader, row, length);
}
