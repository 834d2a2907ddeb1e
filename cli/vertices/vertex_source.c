#include "cli/vertices/vertex_source.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_points.h"
#include "cli/gdal/gdal_vertices.h"
#include "cli/input/query_columns.h"
#include "cli/vertices/las_classes.h"

#include <meshwalk/meshwalk.h>
#include <stdlib.h>

/* One of the two is not NULL. */
struct vertex_source {
    mw_point_reader *reader;
    gdal_vertices *features;
    bool chosen; /* --columns was given */
};

/* --- opening ---------------------------------------------------------------------------------- */

static int vertex_source_refuse(const char *path, const char *why)
{
    complain("%s: %s", files_is_standard(path) ? "standard input" : path, why);
    return END_USAGE;
}

static int vertex_source_open_features(vertex_source *s, const char *path,
                                       const vertex_source_options *options)
{
    const gdal_vertices_options how = {options->layer, options->where, options->columns};
    if (options->classes) return vertex_source_refuse(path, "option '--class' is for LAS");
    return gdal_vertices_open(&s->features, path, &how);
}

static int vertex_source_open_table(vertex_source *s, const char *path,
                                    const vertex_source_options *options)
{
    mw_error error;
    mw_point_reader_options how = {.columns = options->columns, .texts = 1};
    if (options->layer)
        return vertex_source_refuse(path, "option '--layer' is for files that GDAL reads");
    if (options->where)
        return vertex_source_refuse(path, "option '--where' is for files that GDAL reads");
    int end = options->classes ? las_classes_parse(options->classes, how.classes) : 0;
    if (end) return end;
    if (mw_point_reader_open(path, &how, &s->reader, &error) != MW_OK) {
        end = fail_reading(&error);
        if (end == END_INPUT) files_remark_raster(path);
        return end;
    }
    const char *name = files_is_standard(path) ? "standard input" : path;
    return s->chosen ? 0 : query_columns_check_points(name, s->reader);
}

int vertex_source_open(vertex_source **source, const char *path,
                       const vertex_source_options *options)
{
    vertex_source *s = *source = calloc(1, sizeof *s);
    if (!s) return fail_memory();
    s->chosen = options->columns != NULL;
    return gdal_points_known(path) ? vertex_source_open_features(s, path, options)
                                   : vertex_source_open_table(s, path, options);
}

void vertex_source_close(vertex_source *s)
{
    if (!s) return;
    mw_point_reader_close(s->reader);
    gdal_vertices_close(s->features);
    free(s);
}

/* --- columns ---------------------------------------------------------------------------------- */

bool vertex_source_has_features(const vertex_source *s)
{
    return s->features != NULL;
}

size_t vertex_source_width(const vertex_source *s)
{
    return s->features ? gdal_vertices_width(s->features) : mw_point_reader_width(s->reader);
}

const char *vertex_source_column(const vertex_source *s, size_t k)
{
    return s->features ? gdal_vertices_column(s->features, k)
                       : mw_point_reader_column(s->reader, k);
}

bool vertex_source_has_texts(const vertex_source *s, size_t k, int64_t *place)
{
    return (s->features ? gdal_vertices_texts(s->features, k, place)
                        : mw_point_reader_texts(s->reader, k, place)) > 0;
}

bool vertex_source_has_numbers(const vertex_source *s, size_t k)
{
    return !s->features || gdal_vertices_numbers(s->features, k) > 0;
}

static bool name_means_height(const char *name)
{
    static const char *const names[] = {"height",   "elevation", "elev", "ele",
                                        "altitude", "alt",       "h"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (mw_axis_name_matches(name, names[i])) return true;
    return false;
}

static bool name_means_z(const char *name)
{
    const mw_axis_names *set;
    for (size_t i = 0; (set = mw_axis_names_at(i)); i++)
        if (mw_axis_name_matches(name, set->axis[2])) return true;
    return false;
}

/* The only one of the values from number `first` on whose name fits; SIZE_MAX if there is none, or
 * several. */
static size_t columns_only(const vertex_source *s, size_t first, bool (*fits)(const char *name))
{
    size_t found = SIZE_MAX, count = 0;
    for (size_t k = first; k < vertex_source_width(s); k++)
        if (fits(vertex_source_column(s, k)) && vertex_source_has_numbers(s, k) && count++ == 0)
            found = k;
    return count == 1 ? found : SIZE_MAX;
}

static bool features_have_z(const vertex_source *s)
{
    return vertex_source_width(s) > 2 && gdal_vertices_is_z(s->features, 2);
}

size_t vertex_source_named_height(const vertex_source *s)
{
    if (!s->features || s->chosen) return SIZE_MAX;
    size_t first = features_have_z(s) ? 3 : 2;
    size_t z = columns_only(s, first, name_means_z);
    return z != SIZE_MAX ? z : columns_only(s, first, name_means_height);
}

static size_t features_height(const vertex_source *s)
{
    if (features_have_z(s) && vertex_source_has_numbers(s, 2)) return 2;
    return vertex_source_named_height(s);
}

static size_t table_height(const vertex_source *s)
{
    mw_error error;
    mw_point_table table = {0};
    size_t width = vertex_source_width(s);
    if (mw_point_reader_table(s->reader, &table, &error) != MW_OK || !table.names) return 2;
    if (name_means_z(vertex_source_column(s, 2))) return 2;
    size_t height = columns_only(s, 2, name_means_height);
    if (height != SIZE_MAX) return height;
    size_t x = mw_point_reader_column_number(s->reader, 0),
           y = mw_point_reader_column_number(s->reader, 1);
    size_t third = mw_point_reader_column_number(s->reader, 2);
    return width == 3 && third > x && third > y ? 2 : SIZE_MAX;
}

size_t vertex_source_height(const vertex_source *s)
{
    if (vertex_source_width(s) < 3) return SIZE_MAX;
    if (s->chosen) return 2;
    return s->features ? features_height(s) : table_height(s);
}

bool vertex_source_is_lonlat(const vertex_source *s)
{
    return !s->features && query_names_are_lonlat(mw_point_reader_column(s->reader, 0),
                                                  mw_point_reader_column(s->reader, 1));
}

const char *vertex_source_crs(const vertex_source *s)
{
    return s->features ? gdal_vertices_crs(s->features) : mw_point_reader_crs(s->reader);
}

/* --- reading ---------------------------------------------------------------------------------- */

int vertex_source_read(vertex_source *s, double *values, size_t capacity, size_t *count)
{
    mw_error error;
    if (s->features) return gdal_vertices_read(s->features, values, capacity, count);
    return mw_point_reader_read(s->reader, values, capacity, count, &error) == MW_OK
               ? 0
               : fail_reading(&error);
}

double vertex_source_fraction(const vertex_source *s)
{
    return s->features ? gdal_vertices_fraction(s->features) : mw_point_reader_fraction(s->reader);
}
