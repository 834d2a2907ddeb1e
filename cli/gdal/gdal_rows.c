#include "cli/gdal/gdal_rows.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/gdal_directory.h"
#include "cli/gdal/vector_formats.h"
#include "src/base/posix.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool gdal_rows_known(const char *path)
{
    return vector_format_of(path) != NULL;
}

#ifdef MW_GDAL

#define TRANSACTION ((uint64_t)1 << 17) /* rows */

/* What a column holds, as far as its cells tell. */
typedef enum column_kind { KIND_EMPTY = 0, KIND_INTEGER, KIND_REAL, KIND_TEXT } column_kind;

typedef struct row_column {
    char *name;
    column_kind kind;
    int field; /* of the layer; -1: not written */
} row_column;

/* A cell of a row, without its quotes. */
typedef struct row_cell {
    const char *text;
    size_t length;
    bool quoted;
} row_cell;

struct gdal_rows {
    const gdal_functions *gdal;
    gdal_directory target; /* where it is written until it is complete */
    gdal_rows_form form;
    row_column *columns;
    row_cell *cells;
    size_t count;
    char *buffer; /* a cell ended by NUL */
    size_t room;
    GDALDatasetH set;
    OGRLayerH layer;
    uint64_t written, committed;
    bool warned;
    const vector_format *format;
    size_t line_count;        /* points of the line of the row that is written */
    const size_t *ring_first; /* of the polygon of the row that is written: its rings */
    size_t ring_count;
};

/* --- rows ------------------------------------------------------------------------------------- */

/* Take a cell off the row; *more tells whether the row goes on. Returns what follows. */
static const char *cell_take(const char *p, const char *end, char separator, row_cell *cell,
                             bool *more)
{
    while (p < end && *p == ' ') p++;
    const char *begin = p;
    bool quoted = p < end && *p == '"';
    if (quoted)
        for (p++; p < end && (*p != '"' || (p + 1 < end && p[1] == '"')); p++) p += *p == '"';
    while (p < end && *p != separator && *p != '\n') p++;
    size_t length = (size_t)(p - begin);
    while (length > 0 && begin[length - 1] == ' ') length--;
    if (quoted && length >= 2 && begin[length - 1] == '"')
        begin++, length -= 2;
    else
        quoted = false;
    *cell = (row_cell){begin, length, quoted};
    *more = p < end && *p == separator;
    return p < end ? p + 1 : p;
}

/* Take a row apart. Returns what follows it. */
static const char *row_take(gdal_rows *r, const char *p, const char *end)
{
    bool more = true;
    for (size_t i = 0; i < r->count; i++) {
        r->cells[i] = (row_cell){0};
        if (more) p = cell_take(p, end, r->form.separator, &r->cells[i], &more);
    }
    return p;
}

/* The cell as a text of C: "" in quotes is a quote. NULL if memory runs out. */
static const char *cell_text(gdal_rows *r, const row_cell *cell)
{
    if (cell->length >= r->room) {
        size_t room = 2 * cell->length + 64;
        char *buffer = realloc(r->buffer, room);
        if (!buffer) return NULL;
        r->buffer = buffer;
        r->room = room;
    }
    size_t size = 0;
    for (size_t i = 0; i < cell->length; i++) {
        r->buffer[size++] = cell->text[i];
        if (cell->quoted && cell->text[i] == '"') i++;
    }
    r->buffer[size] = 0;
    return r->buffer;
}

static bool cell_is_missing(const row_cell *cell)
{
    static const char *const words[] = {"", "-", "na", "n/a", "nan", "null"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == cell->length &&
            strncasecmp(words[i], cell->text, cell->length) == 0)
            return true;
    return false;
}

/* A number as programs write it. 007 and +5 are no numbers: they may be names. */
static column_kind cell_kind(const gdal_rows *r, const row_cell *cell)
{
    const char *p = cell->text, *end = p + cell->length;
    if (cell_is_missing(cell)) return KIND_EMPTY;
    if (*p == '-') p++;
    size_t digits = 0, decimals = 0;
    for (const char *first = p; p < end && *p >= '0' && *p <= '9'; p++, digits++)
        if (p > first && *first == '0') return KIND_TEXT;
    if (p == end) return digits > 0 && digits <= 18 ? KIND_INTEGER : KIND_TEXT;
    if (digits == 0 || digits > 15) return KIND_TEXT;
    if (*p == '.' || (*p == ',' && r->form.decimal == ','))
        for (p++; p < end && *p >= '0' && *p <= '9'; p++) decimals++;
    else if (*p != 'e' && *p != 'E')
        return KIND_TEXT;
    if (p < end && decimals + digits > 0 && (*p == 'e' || *p == 'E')) {
        p += p + 1 < end && (p[1] == '-' || p[1] == '+') ? 2 : 1;
        if (p == end) return KIND_TEXT;
        while (p < end && *p >= '0' && *p <= '9') p++;
    }
    return p == end ? KIND_REAL : KIND_TEXT;
}

int gdal_rows_learn(gdal_rows *r, const char *bytes, size_t size)
{
    const char *end = bytes + size;
    size_t known = strlen(r->form.answers);
    for (const char *p = bytes; p < end;) {
        p = row_take(r, p, end);
        for (size_t i = 0; i + known < r->count; i++) {
            column_kind kind = cell_kind(r, &r->cells[i]);
            if (kind > r->columns[i].kind) r->columns[i].kind = kind;
        }
    }
    return 0;
}

/* --- the file --------------------------------------------------------------------------------- */

static int rows_fail(const gdal_rows *r, const char *what)
{
    const char *message = r->gdal->CPLGetLastErrorMsg();
    complain("%s: GDAL says: %.1000s", r->target.path, *message ? message : what);
    return END_RESOURCE;
}

static int rows_check_driver(const char *path, const vector_format *format)
{
    const gdal_functions *gdal = gdal_library_load();
    if (!gdal) {
        complain("%s: GDAL, which would write it, cannot be loaded (" MW_GDAL ")", path);
        return END_USAGE;
    }
    if (gdal->GDALGetDriverByName(format->driver)) return 0;
    complain("%s: this GDAL does not write %s", path, format->driver);
    return END_USAGE;
}

int gdal_rows_check(const char *path)
{
    const vector_format *format = vector_format_of(path);
    gdal_library_begin();
    int end = format->rare ? rows_check_driver(path, format) : 0;
    return end ? end : gdal_directory_check(path);
}

static int rows_read_header(gdal_rows *r)
{
    const char *p = r->form.header, *end = p + r->form.header_size, *answers = r->form.answers;
    bool more = true;
    row_cell cell;
    for (const char *q = p; more; r->count++)
        q = cell_take(q, end, r->form.separator, &cell, &more);
    r->columns = calloc(r->count, sizeof *r->columns);
    r->cells = calloc(r->count, sizeof *r->cells);
    if (!r->columns || !r->cells) return fail_memory();
    row_take(r, p, end);
    for (size_t i = 0; i < r->count; i++) {
        const char *name = cell_text(r, &r->cells[i]);
        r->columns[i].name = name ? strdup(name) : NULL;
        if (!r->columns[i].name) return fail_memory();
    }
    for (size_t k = 0, first = r->count - strlen(answers); answers[k]; k++)
        r->columns[first + k].kind = answers[k] == 'i'   ? KIND_INTEGER
                                     : answers[k] == 'r' ? KIND_REAL
                                                         : KIND_TEXT;
    return 0;
}

static int rows_check_lonlat(const gdal_rows *r)
{
    char name[CRS_NAME];
    if (r->form.polygons) {
        complain("%s: %s cannot hold polygons; .gpkg can", r->target.path, r->format->driver);
        return END_USAGE;
    }
    if (!r->form.crs || crs_is_lonlat(r->form.crs)) return 0;
    complain("%s: %s can hold longitudes and latitudes only, but the points are in %s; .gpkg can "
             "hold both",
             r->target.path, r->format->driver, crs_name(r->form.crs, name));
    return END_USAGE;
}

int gdal_rows_open(gdal_rows **rows, const char *path, const gdal_rows_form *form)
{
    gdal_rows *r = *rows = calloc(1, sizeof *r);
    if (!r) return fail_memory();
    r->form = *form;
    r->format = vector_format_of(path);
    r->gdal = gdal_library_load();
    int end = gdal_directory_open(&r->target, path);
    if (end == 0) end = rows_check_driver(path, r->format);
    if (end == 0 && r->format->lonlat_only) end = rows_check_lonlat(r);
    return end ? end : rows_read_header(r);
}

static bool rows_have_column(const gdal_rows *r, const char *name)
{
    for (size_t i = r->form.dropped; i < r->count; i++)
        if (strcasecmp(r->columns[i].name, name) == 0) return true;
    return false;
}

static int rows_create_field(gdal_rows *r, row_column *column)
{
    static const OGRFieldType types[] = {[KIND_EMPTY] = OFTString,
                                         [KIND_INTEGER] = OFTInteger64,
                                         [KIND_REAL] = OFTReal,
                                         [KIND_TEXT] = OFTString};
    const gdal_functions *gdal = r->gdal;
    if (!text_is_utf8(column->name)) {
        complain("%s: the name of column %zu is not UTF-8, as a vector file needs it; "
                 "'iconv -f WINDOWS-1252 -t UTF-8' converts most tables",
                 r->target.path, (size_t)(column - r->columns) + 1);
        return END_INPUT;
    }
    OGRFieldDefnH definition = gdal->OGR_Fld_Create(column->name, types[column->kind]);
    if (r->format->shapefile && types[column->kind] == OFTString)
        gdal->OGR_Fld_SetWidth(definition, 254);
    gdal->CPLErrorReset();
    OGRErr failure = gdal->OGR_L_CreateField(r->layer, definition, TRUE);
    gdal->OGR_Fld_Destroy(definition);
    if (failure != OGRERR_NONE) return rows_fail(r, "a column cannot be written");
    OGRFeatureDefnH layer = gdal->OGR_L_GetLayerDefn(r->layer);
    column->field = gdal->OGR_FD_GetFieldCount(layer) - 1;
    const char *name = gdal->OGR_Fld_GetNameRef(gdal->OGR_FD_GetFieldDefn(layer, column->field));
    if (strcmp(name, column->name) != 0 && !r->form.quiet)
        complain("%s: remark: the column '%.60s' is called '%s' in this format", r->target.path,
                 column->name, name);
    return 0;
}

/* What each row has, with heights or without. */
static OGRwkbGeometryType rows_geometry(const gdal_rows *r)
{
    bool high = r->form.dimensions == 3;
    if (r->form.polygons) return high ? wkbPolygon25D : wkbPolygon;
    if (r->form.lines) return high ? wkbLineString25D : wkbLineString;
    return high ? wkbPoint25D : wkbPoint;
}

static OGRLayerH rows_create_set(gdal_rows *r, const char *name, OGRSpatialReferenceH crs)
{
    const gdal_functions *gdal = r->gdal;
    const vector_format *format = r->format;
    bool fid = strcmp(format->driver, "GPKG") == 0 && rows_have_column(r, "fid");
    const char *create[] = {format->create, NULL};
    const char *const with_fid[] = {"FID=mw_fid", NULL};
    const char *const *options = fid ? with_fid : format->options;
    r->set = gdal->GDALCreate(gdal->GDALGetDriverByName(format->driver), r->target.temporary, 0, 0,
                              0, GDT_Unknown, (char **)(uintptr_t)create);
    if (!r->set) return NULL;
    return gdal->GDALDatasetCreateLayer(r->set, name, crs, rows_geometry(r),
                                        (char **)(uintptr_t)options);
}

static int rows_create_layer(gdal_rows *r)
{
    const gdal_functions *gdal = r->gdal;
    const char *given = r->form.lines ? r->format->lines : r->format->points;
    char name[256];
    const char *base = strrchr(r->target.temporary, '/') + 1;
    snprintf(name, sizeof name, "%.*s", (int)(strrchr(base, '.') - base), base);
    gdal->CPLSetConfigOption("OGR_SQLITE_SYNCHRONOUS", "OFF"); /* it has no name yet */
    OGRSpatialReferenceH crs = r->form.crs ? crs_parse(gdal, r->form.crs, true) : NULL;
    gdal->CPLErrorReset();
    r->layer = rows_create_set(r, given ? given : name, crs);
    if (crs) gdal->OSRRelease(crs);
    if (!r->layer) return rows_fail(r, "it cannot be written");
    int end = 0;
    for (size_t i = 0; i < r->count; i++) {
        r->columns[i].field = -1;
        if (end == 0 && i >= r->form.dropped) end = rows_create_field(r, &r->columns[i]);
    }
    return end;
}

/* --- features --------------------------------------------------------------------------------- */

static int rows_fail_cell(gdal_rows *r, const row_column *column, const row_cell *cell)
{
    const char *value = cell_text(r, cell);
    complain(
        "%s: row %" PRIu64
        ": the column '%.60s' had numbers only, but here '%.60s': a field of a vector file has "
        "one kind of value; a table (CSV) can hold it",
        r->target.path, r->written + 1, column->name, value ? value : "");
    return END_INPUT;
}

/* Shapefiles write numbers in 24 columns, with at most 15 decimals. */
static int feature_check_shapefile(gdal_rows *r, const row_column *column, double value)
{
    if (fabs(value) >= 1e23) {
        complain("%s: row %" PRIu64 ": the column '%.60s' has %g, which is too large for a "
                 "Shapefile; .gpkg can hold it",
                 r->target.path, r->written + 1, column->name, value);
        return END_INPUT;
    }
    if (value == 0 || fabs(value) >= 1e-9 || r->warned || r->form.quiet) return 0;
    complain("%s: warning: row %" PRIu64 ": the column '%.60s' has %g, which a Shapefile rounds "
             "to 15 decimals; .gpkg can hold it",
             r->target.path, r->written + 1, column->name, value);
    r->warned = true;
    return 0;
}

static int feature_set_real(gdal_rows *r, OGRFeatureH feature, const row_column *column,
                            const char *digits)
{
    double value = strtod(digits, NULL);
    int end = r->format->shapefile ? feature_check_shapefile(r, column, value) : 0;
    if (end == 0) r->gdal->OGR_F_SetFieldDouble(feature, column->field, value);
    return end;
}

/* Text goes into a vector file as UTF-8; GDAL would write other bytes as they are. */
static int feature_set_text(gdal_rows *r, OGRFeatureH feature, const row_column *column,
                            const char *value)
{
    if (!text_is_utf8(value)) {
        complain("%s: row %" PRIu64 ": the text in the column '%.60s' is not UTF-8, as a vector "
                 "file needs it; 'iconv -f WINDOWS-1252 -t UTF-8' converts most tables",
                 r->target.path, r->written + 1, column->name);
        return END_INPUT;
    }
    r->gdal->OGR_F_SetFieldString(feature, column->field, value);
    return 0;
}

static int feature_set_field(gdal_rows *r, OGRFeatureH feature, const row_column *column,
                             const row_cell *cell)
{
    const gdal_functions *gdal = r->gdal;
    column_kind kind = cell_kind(r, cell);
    bool number = column->kind == KIND_INTEGER || column->kind == KIND_REAL;
    if (cell->length == 0 || (number && kind == KIND_EMPTY)) {
        gdal->OGR_F_SetFieldNull(feature, column->field);
        return 0;
    }
    bool answer = column >= r->columns + (r->count - strlen(r->form.answers));
    if (number && !answer && kind > column->kind) return rows_fail_cell(r, column, cell);
    char *value = (char *)(uintptr_t)cell_text(r, cell);
    if (!value) return fail_memory();
    for (char *c = value; number && *c; c++)
        if (*c == ',') *c = '.';
    if (column->kind == KIND_INTEGER)
        gdal->OGR_F_SetFieldInteger64(feature, column->field, strtoll(value, NULL, 10));
    else if (column->kind == KIND_REAL)
        return feature_set_real(r, feature, column, value);
    else
        return feature_set_text(r, feature, column, value);
    return 0;
}

/* Some formats mean longitudes and latitudes, unless the file names another system. */
static void rows_warn_of_lonlat(gdal_rows *r, const double *p)
{
    if (r->form.crs || r->warned || r->form.quiet || (fabs(p[0]) <= 360 && fabs(p[1]) <= 90))
        return;
    if (!r->format->lonlat_meant) return;
    complain("%s: warning: %s holds longitudes and latitudes, but row %" PRIu64
             " has other numbers",
             r->target.path, r->format->driver, r->written + 1);
    r->warned = true;
}

/* FlatGeobuf would lose a row without a point, and say nothing. */
static int feature_set_point(gdal_rows *r, OGRFeatureH feature, const double *p)
{
    const gdal_functions *gdal = r->gdal;
    bool finite = true;
    for (size_t k = 0; k < r->form.dimensions; k++) finite = finite && isfinite(p[k]);
    if (!finite && r->format->geometry_needed) {
        complain("%s: row %" PRIu64 " has no point, which %s cannot hold; .gpkg can",
                 r->target.path, r->written + 1, r->format->driver);
        return END_INPUT;
    }
    if (!finite) return 0;
    rows_warn_of_lonlat(r, p);
    OGRGeometryH point =
        gdal->OGR_G_CreateGeometry(r->form.dimensions == 3 ? wkbPoint25D : wkbPoint);
    if (r->form.dimensions == 3)
        gdal->OGR_G_SetPoint(point, 0, p[0], p[1], p[2]);
    else
        gdal->OGR_G_SetPoint_2D(point, 0, p[0], p[1]);
    gdal->OGR_F_SetGeometryDirectly(feature, point);
    return 0;
}

static OGRGeometryH line_create(const gdal_functions *gdal, OGRwkbGeometryType type,
                                const double *points, size_t count, size_t dimensions)
{
    OGRGeometryH line = gdal->OGR_G_CreateGeometry(type);
    const int stride = (int)(dimensions * sizeof *points);
    gdal->OGR_G_SetPoints(line, (int)count, points, stride, points + 1, stride,
                          dimensions == 3 ? points + 2 : NULL, stride);
    return line;
}

static int feature_set_line(gdal_rows *r, OGRFeatureH feature, const double *points)
{
    rows_warn_of_lonlat(r, points);
    r->gdal->OGR_F_SetGeometryDirectly(
        feature, line_create(r->gdal, wkbLineString, points, r->line_count, r->form.dimensions));
    return 0;
}

static int feature_set_polygon(gdal_rows *r, OGRFeatureH feature, const double *points)
{
    const gdal_functions *gdal = r->gdal;
    OGRGeometryH polygon = gdal->OGR_G_CreateGeometry(wkbPolygon);
    rows_warn_of_lonlat(r, points);
    for (size_t k = 0; k < r->ring_count; k++) {
        size_t first = r->ring_first[k], count = r->ring_first[k + 1] - first;
        gdal->OGR_G_AddGeometryDirectly(polygon, line_create(gdal, wkbLinearRing,
                                                             points + r->form.dimensions * first,
                                                             count, r->form.dimensions));
    }
    gdal->OGR_F_SetGeometryDirectly(feature, polygon);
    return 0;
}

/* A Shapefile's warning that a number may not fit comes for each with many digits; those that do
 * not fit have been refused. */
static bool rows_warned_by_gdal(const gdal_rows *r)
{
    return !r->warned && !r->form.quiet && r->gdal->CPLGetLastErrorType() >= CE_Warning &&
           !strstr(r->gdal->CPLGetLastErrorMsg(), "not successfully written");
}

static int rows_write_feature(gdal_rows *r, const double *point)
{
    const gdal_functions *gdal = r->gdal;
    OGRFeatureH feature = gdal->OGR_F_Create(gdal->OGR_L_GetLayerDefn(r->layer));
    int end = feature ? 0 : fail_memory();
    for (size_t i = r->form.dropped; end == 0 && i < r->count; i++)
        end = feature_set_field(r, feature, &r->columns[i], &r->cells[i]);
    if (end == 0)
        end = r->form.polygons ? feature_set_polygon(r, feature, point)
              : r->form.lines  ? feature_set_line(r, feature, point)
                               : feature_set_point(r, feature, point);
    if (end == 0) {
        gdal->CPLErrorReset();
        if (gdal->OGR_L_CreateFeature(r->layer, feature) != OGRERR_NONE)
            end = rows_fail(r, "a row cannot be written");
    }
    if (end == 0 && rows_warned_by_gdal(r)) {
        complain("%s: warning: row %" PRIu64 ": GDAL says: %.1000s", r->target.path, r->written + 1,
                 gdal->CPLGetLastErrorMsg());
        r->warned = true;
    }
    if (feature) gdal->OGR_F_Destroy(feature);
    r->written++;
    return end;
}

/* Databases are slow if every row is a transaction of its own. */
static void rows_commit_transaction(gdal_rows *r)
{
    if (r->written > 0) r->gdal->GDALDatasetCommitTransaction(r->set);
    r->gdal->GDALDatasetStartTransaction(r->set, FALSE);
    r->committed = r->written;
}

int gdal_rows_write(gdal_rows *r, const char *bytes, size_t size, const double *points,
                    size_t stride)
{
    const char *end = bytes + size;
    int code = r->layer ? 0 : rows_create_layer(r);
    if (code) return code;
    if (r->written == 0) rows_commit_transaction(r);
    for (const char *p = bytes; code == 0 && p < end; points += stride) {
        p = row_take(r, p, end);
        code = rows_write_feature(r, points);
    }
    if (r->written - r->committed >= TRANSACTION) rows_commit_transaction(r);
    return code;
}

int gdal_rows_write_line(gdal_rows *r, const char *bytes, size_t size, const double *points,
                         size_t count)
{
    if (count > INT_MAX) {
        complain("%s: a line has more than %d points", r->target.path, INT_MAX);
        return END_RESOURCE;
    }
    r->line_count = count;
    return gdal_rows_write(r, bytes, size, points, 0);
}

int gdal_rows_write_polygon(gdal_rows *r, const char *bytes, size_t size, const double *points,
                            const size_t *first, size_t ring_count)
{
    if (first[ring_count] > INT_MAX) {
        complain("%s: a polygon has more than %d points", r->target.path, INT_MAX);
        return END_RESOURCE;
    }
    r->ring_first = first;
    r->ring_count = ring_count;
    return gdal_rows_write(r, bytes, size, points, 0);
}

/* Files beside an older Shapefile would be taken for some of the new one. */
static void rows_remove_sidecars(const gdal_rows *r)
{
    static const char *const endings[] = {"prj", "cpg", "qix", "sbn", "sbx"};
    if (!r->format->shapefile) return;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char name[4096];
        int stem = (int)strlen(r->target.path) - 3;
        if (snprintf(name, sizeof name, "%.*s%s", stem, r->target.path, endings[i]) <
            (int)sizeof name)
            unlink(name);
    }
}

int gdal_rows_close(gdal_rows *r, bool commit)
{
    int end = 0;
    if (!r) return 0;
    if (commit && !r->layer) end = rows_create_layer(r);
    if (r->set) {
        r->gdal->CPLErrorReset();
        if (commit && r->written > 0) r->gdal->GDALDatasetCommitTransaction(r->set);
        r->gdal->GDALClose(r->set);
        if (commit && end == 0 && r->gdal->CPLGetLastErrorType() >= CE_Failure)
            end = rows_fail(r, "it is incomplete");
    }
    if (commit && end == 0) rows_remove_sidecars(r);
    int closed = gdal_directory_close(&r->target, commit && end == 0);
    if (end == 0) end = closed;
    for (size_t i = 0; r->columns && i < r->count; i++) free(r->columns[i].name);
    free(r->columns);
    free(r->cells);
    free(r->buffer);
    free(r);
    return end;
}

#else

int gdal_rows_check(const char *path)
{
    complain("%s: only a program built with GDAL can write it", path);
    return END_USAGE;
}

int gdal_rows_open(gdal_rows **rows, const char *path, const gdal_rows_form *form)
{
    (void)form;
    *rows = NULL;
    return gdal_rows_check(path);
}

int gdal_rows_learn(gdal_rows *rows, const char *bytes, size_t size)
{
    (void)rows;
    (void)bytes;
    (void)size;
    return END_USAGE;
}

int gdal_rows_write(gdal_rows *rows, const char *bytes, size_t size, const double *points,
                    size_t stride)
{
    (void)rows;
    (void)bytes;
    (void)size;
    (void)points;
    (void)stride;
    return END_USAGE;
}

int gdal_rows_write_line(gdal_rows *rows, const char *bytes, size_t size, const double *points,
                         size_t count)
{
    (void)count;
    return gdal_rows_write(rows, bytes, size, points, 0);
}

int gdal_rows_write_polygon(gdal_rows *rows, const char *bytes, size_t size, const double *points,
                            const size_t *first, size_t ring_count)
{
    (void)first;
    (void)ring_count;
    return gdal_rows_write(rows, bytes, size, points, 0);
}

int gdal_rows_close(gdal_rows *rows, bool commit)
{
    (void)rows;
    (void)commit;
    return 0;
}

#endif
