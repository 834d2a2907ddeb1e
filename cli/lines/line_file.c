#include "cli/lines/line_file.h"
#include "cli/constraints/constraint_file.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/gdal_library.h"
#include "cli/gdal/gdal_point_layer.h"
#include "cli/input/query_source.h"
#include "cli/vertices/vertex_crs.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- a table of points -------------------------------------------------------------------- */

enum { TABLE_BLOCK = 1 << 11 };

/* Append the rows of a block as points of the line. */
static int table_append(mw_constraint_file *c, const char *path, const double *xy, size_t count)
{
    double *points = realloc(c->points, 3 * (c->point_count + count) * sizeof *points);
    if (!points) return fail_memory();
    c->points = points;
    for (size_t i = 0; i < count; i++) {
        double *p = points + 3 * c->point_count++;
        p[0] = xy[2 * i];
        p[1] = xy[2 * i + 1];
        p[2] = NAN;
        if (isfinite(p[0]) && isfinite(p[1])) continue;
        complain("%s: point %zu of the line has no finite x and y",
                 files_is_standard(path) ? "standard input" : path, c->point_count);
        return END_INPUT;
    }
    return 0;
}

/* Its points as one chain of segments. */
static int table_chain(mw_constraint_file *c)
{
    size_t count = c->point_count ? c->point_count - 1 : 0;
    if (c->point_count > MW_MAX_VERTICES) {
        complain("a line has more than %" PRIu32 " points", (uint32_t)MW_MAX_VERTICES);
        return END_RESOURCE;
    }
    c->segments = malloc((2 * count + 1) * sizeof *c->segments);
    c->polygon = malloc((count + 1) * sizeof *c->polygon);
    c->record = calloc(count + 1, sizeof *c->record);
    if (!c->segments || !c->polygon || !c->record) return fail_memory();
    for (size_t i = 0; i < count; i++) {
        c->segments[2 * i] = (uint32_t)i;
        c->segments[2 * i + 1] = (uint32_t)i + 1;
        c->polygon[i] = MW_NONE;
    }
    c->segment_count = count;
    return 0;
}

static int table_note_crs(mw_constraint_file *c, const query_source *source, const char *mesh_crs)
{
    const char *crs = query_source_crs(source);
    if (!crs && mesh_crs && query_source_is_lonlat(source)) crs = CRS_LONLAT;
    if (crs && !(c->crs = strdup(crs))) return fail_memory();
    return 0;
}

/* The table is one line, so what its columns tell of each point has no place in the answers. */
static void table_remark_columns(const char *path, const query_source *source,
                                 const size_t index[MAX_QUERY_COLUMNS])
{
    mw_point_table table;
    text names = {0};
    query_source_table(source, &table);
    for (size_t i = 0; i < table.column_count; i++) {
        if (i == index[0] || i == index[1]) continue;
        if (names.size) text_string(&names, ", ");
        if (table.names && *table.names[i])
            text_string(&names, table.names[i]);
        else
            text_printf(&names, "%zu", i + 1);
    }
    int size = names.size < 1000 ? (int)names.size : 1000;
    if (names.size > 0 && !names.failed)
        complain(
            "%s: remark: a table is one line, so values of its points are not kept: columns %.*s",
            files_is_standard(path) ? "standard input" : path, size, names.bytes);
    text_release(&names);
}

static int table_read(const char *path, const line_file_settings *settings, bool quiet,
                      const char *mesh_crs, mw_constraint_file *c)
{
    query_source *source;
    query_source_settings how = {
        .columns = settings->columns, .layer = settings->layer, .crs = settings->crs};
    query_columns wanted = {.axes = QUERY_PLANE, .names = {"x", "y"}, .count = 2};
    size_t index[MAX_QUERY_COLUMNS], count = 1;
    double xy[2 * TABLE_BLOCK];
    progress_phase("reading", path);
    *c = (mw_constraint_file){.record_name = "feature"};
    int end = query_source_open(&source, path, &how, &wanted, index);
    while (end == 0 && count > 0) {
        end = query_source_read(source, xy, TABLE_BLOCK, &count);
        if (end == 0) end = table_append(c, path, xy, count);
    }
    if (end == 0) end = table_chain(c);
    if (end == 0) end = table_note_crs(c, source, mesh_crs);
    if (end == 0 && !quiet) table_remark_columns(path, source, index);
    query_source_close(source);
    return end;
}

/* --- vector files ------------------------------------------------------------------------- */

/* Attributes are read by GDAL only; where it is missing, GeoJSON is read without them. */
static bool vector_has_attributes(const char *path, const line_file_settings *settings)
{
    size_t length = strlen(path);
    if (settings->attribute || settings->layer) return true;
    if (length > 5 && strcmp(path + length - 5, ".poly") == 0) return false;
    if (length > 3 && strcmp(path + length - 3, ".gz") == 0) return false;
#ifdef MW_GDAL
    return gdal_library_load() != NULL;
#else
    return false;
#endif
}

static int vector_read(const char *path, const line_file_settings *settings,
                       const common_settings *common, feature_values *values, mw_constraint_file *c)
{
    constraint_file_options options = {.quiet = common->quiet,
                                       .gdal = {.layer = settings->layer, .lines = true}};
    if (settings->columns) {
        complain("%s: option '--columns' is for a table of points", path);
        return END_USAGE;
    }
    values->list = settings->attribute;
    if (vector_has_attributes(path, settings)) options.gdal.values = values;
    int end = constraint_file_read(path, options, c);
    if (end == 0 && !options.gdal.values && !constraint_file_is_poly(c) && !common->quiet)
        complain("%s: remark: its attributes are not read; GDAL reads them from a file that is not "
                 "compressed",
                 path);
    return end;
}

/* --- lines -------------------------------------------------------------------------------- */

/* Does segment i begin another line than that of the segment before it? */
static bool segment_begins_line(const mw_constraint_file *c, size_t i)
{
    return i == 0 || c->segments[2 * i] != c->segments[2 * i - 1] ||
           c->record[i] != c->record[i - 1] || c->polygon[i] != c->polygon[i - 1];
}

static bool lines_make_room(line_file *l, size_t points, size_t lines)
{
    l->points = malloc(2 * points * sizeof *l->points);
    l->first = malloc((lines + 1) * sizeof *l->first);
    l->feature = malloc((lines + 1) * sizeof *l->feature);
    l->part = malloc((lines + 1) * sizeof *l->part);
    l->polygon = malloc((lines + 1) * sizeof *l->polygon);
    return l->points && l->first && l->feature && l->part && l->polygon;
}

/* Add a point; not twice in a row. */
static size_t lines_add_point(line_file *l, size_t count, bool begins, const double *p)
{
    double *to = l->points + 2 * count;
    if (!begins && to[-2] == p[0] && to[-1] == p[1]) return count;
    memcpy(to, p, 2 * sizeof *p);
    return count + 1;
}

static void lines_begin(line_file *l, size_t point, uint32_t feature, uint32_t polygon)
{
    bool same = l->count > 0 && l->feature[l->count - 1] == feature;
    l->part[l->count] = same ? l->part[l->count - 1] + 1 : 0;
    l->feature[l->count] = feature;
    l->polygon[l->count] = polygon;
    l->first[l->count++] = point;
}

static int lines_take(line_file *l, const char *path, const mw_constraint_file *c)
{
    size_t lines = 0, points = 0;
    for (size_t i = 0; i < c->segment_count; i++) lines += segment_begins_line(c, i);
    if (!lines_make_room(l, 2 * c->segment_count + 1, lines)) return fail_memory();
    for (size_t i = 0; i < c->segment_count; i++) {
        const double *a = c->points + 3 * (size_t)c->segments[2 * i],
                     *b = c->points + 3 * (size_t)c->segments[2 * i + 1];
        if (!isfinite(a[0]) || !isfinite(a[1]) || !isfinite(b[0]) || !isfinite(b[1])) {
            complain("%s: %s %" PRIu32 ": a point of the line has no finite x and y", path,
                     c->record_name, c->record[i]);
            return END_INPUT;
        }
        bool begins = segment_begins_line(c, i);
        if (begins) lines_begin(l, points, c->record[i], c->polygon[i]);
        if (begins) points = lines_add_point(l, points, true, a);
        points = lines_add_point(l, points, false, b);
    }
    l->first[l->count] = points;
    l->record_name = c->record_name;
    if (l->count > 0) return 0;
    complain("%s: there are no lines in it", path);
    return END_INPUT;
}

/* --lines-crs counts before what the file tells. */
static int lines_settle_crs(const line_file_settings *settings, const char *mesh_crs,
                            mw_constraint_file *c)
{
    const char *crs = settings->crs;
    if (!crs) return 0;
    if (strcmp(crs, "same") == 0) crs = mesh_crs;
    free(c->crs);
    c->crs = crs ? strdup(crs) : NULL;
    return crs && !c->crs ? fail_memory() : 0;
}

/* Features without a line, but for those whose rings were skipped: that has been told. */
static int lines_remark_missing(const line_file *l, const char *path, const mw_constraint_file *c)
{
    enum { NAMED = 10 };
    size_t missing = 0;
    text names = {0};
    bool *told = calloc(c->record_count + 1, sizeof *told);
    if (!told) return fail_memory();
    for (size_t i = 0; i < l->count; i++) told[l->feature[i]] = true;
    for (size_t i = 0; i < c->skipped_count; i++) told[c->skipped[i].record] = true;
    for (size_t i = 0; i < c->record_count; i++)
        if (!told[i] && missing++ < NAMED)
            text_printf(&names, "%s%zu", missing > 1 ? ", " : " ", i);
    free(told);
    if (missing > 0 && !names.failed)
        complain("%s: remark: %zu of %zu features without a line or polygon %s skipped (no "
                 "geometry, an empty one, or points only):%.*s%s",
                 path, missing, c->record_count, missing == 1 ? "is" : "are", (int)names.size,
                 names.bytes, missing > NAMED ? ", ..." : "");
    text_release(&names);
    return 0;
}

int line_file_read(line_file *l, const char *path, const line_file_settings *settings,
                   const common_settings *common, const char *mesh, const char *mesh_crs)
{
    mw_constraint_file c = {0};
    *l = (line_file){0};
    bool vector =
        !files_is_standard(path) && (mw_constraints_known(path) || point_layer_known(path));
    if (!vector && settings->attribute) {
        complain("%s: option '--attribute' is for vector files, not for a table of points", path);
        return END_USAGE;
    }
    int end = vector ? vector_read(path, settings, common, &l->values, &c)
                     : table_read(path, settings, common->quiet, mesh_crs, &c);
    if (end == 0) end = lines_settle_crs(settings, mesh_crs, &c);
    bool as_is = settings->crs && strcmp(settings->crs, "same") == 0;
    c.has_z = 0; /* heights of lines do not count */
    if (end == 0 && !as_is && (c.crs || mesh_crs))
        end = vertex_crs_move_constraints(common, path, &c, mesh, mesh_crs);
    if (end == 0) end = lines_take(l, files_is_standard(path) ? "standard input" : path, &c);
    if (end == 0 && c.record_count > 0 && !common->quiet) end = lines_remark_missing(l, path, &c);
    mw_constraint_file_release(&c);
    return end;
}

void line_file_release(line_file *l)
{
    free(l->points);
    free(l->first);
    free(l->feature);
    free(l->part);
    free(l->polygon);
    feature_values_release(&l->values);
    *l = (line_file){0};
}
