#include "cli/gdal/gdal_points.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"
#include "cli/gdal/gdal_crs.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* --- telling the files of GDAL ---------------------------------------------------------------- */

static bool path_has_vector_ending(const char *path)
{
    static const char *const endings[] = {
        ".gpkg", ".shp", ".shz",     ".geojson", ".geojsonl", ".geojsons", ".json",
        ".fgb",  ".gpx", ".kml",     ".kmz",     ".gml",      ".gdb",      ".sqlite",
        ".mif",  ".dxf", ".parquet", ".feather", ".arrow"};
    size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t end = strlen(endings[i]);
        if (length > end && strcasecmp(path + length - end, endings[i]) == 0) return true;
    }
    return false;
}

static bool head_is_vector(const unsigned char *head, size_t size)
{
    static const char shape[] = {0, 0, 0x27, 0x0a};
    if (size >= 15 && memcmp(head, "SQLite format 3", 15) == 0) return true;
    if (size >= 4 && (memcmp(head, "fgb\3", 4) == 0 || memcmp(head, shape, 4) == 0 ||
                      memcmp(head, "PAR1", 4) == 0))
        return true;
    if (size >= 3 && memcmp(head, "\xef\xbb\xbf", 3) == 0) head += 3, size -= 3;
    while (size > 0 && strchr(" \t\r\n", *head)) head++, size--;
    return size > 0 && (*head == '{' || *head == '<' ||
                        (size >= 6 && strncasecmp((const char *)head, "!table", 6) == 0));
}

bool gdal_points_known(const char *path)
{
    struct stat s;
    unsigned char head[64];
    if (strcmp(path, "-") == 0 || stat(path, &s) != 0) return false;
    if (S_ISDIR(s.st_mode) || path_has_vector_ending(path)) return path_has_vector_ending(path);
    FILE *file = S_ISREG(s.st_mode) ? fopen(path, "rb") : NULL;
    if (!file) return false;
    size_t size = fread(head, 1, sizeof head, file);
    fclose(file);
    return head_is_vector(head, size);
}

#ifdef MW_GDAL

/* --- the layer -------------------------------------------------------------------------------- */

#define ROWS_LIMIT ((size_t)1 << 26) /* bytes of rows in memory */

struct gdal_points {
    const gdal_functions *gdal;
    const char *path;
    GDALDatasetH set;
    OGRLayerH layer;
    size_t coordinates, column_count; /* x, y and perhaps z are the first columns */
    char **names;
    char *crs; /* WKT; NULL: not known */
    text header, rows;
    size_t *ends, row_count, row_room; /* where the rows of the block end */
};

static int points_fail(const gdal_points *p, const char *what)
{
    const char *message = p->gdal->CPLGetLastErrorMsg();
    complain("%s: GDAL says: %.1000s", p->path, *message ? message : what);
    return END_INPUT;
}

/* GDAL knows no format for the file. Some need drivers that are often missing. */
static int points_fail_format(const gdal_points *p)
{
    static const char *const wanted[][2] = {
        {".parquet", "Parquet"}, {".feather", "Arrow"}, {".arrow", "Arrow"}};
    size_t length = strlen(p->path);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        size_t end = strlen(wanted[i][0]);
        if (length <= end || strcasecmp(p->path + length - end, wanted[i][0]) != 0) continue;
        if (p->gdal->GDALGetDriverByName(wanted[i][1])) break;
        complain("%s: this GDAL has no driver for %s; 'meshwalk --version' tells what was found",
                 p->path, wanted[i][1]);
        return END_INPUT;
    }
    return points_fail(p, "this is no vector file");
}

static bool layer_may_have_points(const gdal_points *p, OGRLayerH layer)
{
    OGRwkbGeometryType type = p->gdal->OGR_GT_Flatten(p->gdal->OGR_L_GetGeomType(layer));
    return type == wkbPoint || type == wkbMultiPoint || type == wkbUnknown ||
           type == wkbGeometryCollection;
}

/* Does the layer have features? A file of GPX has a layer for everything that it could hold. */
static bool layer_is_empty(const gdal_points *p, OGRLayerH layer)
{
    p->gdal->OGR_L_ResetReading(layer);
    OGRFeatureH feature = p->gdal->OGR_L_GetNextFeature(layer);
    if (feature) p->gdal->OGR_F_Destroy(feature);
    p->gdal->OGR_L_ResetReading(layer);
    return !feature;
}

static int points_fail_layer(const gdal_points *p, const char *wanted)
{
    text names = {0};
    int count = p->gdal->GDALDatasetGetLayerCount(p->set);
    for (int i = 0; i < count; i++)
        text_printf(&names, "%s%s", i ? ", " : "",
                    p->gdal->OGR_L_GetName(p->gdal->GDALDatasetGetLayer(p->set, i)));
    int end = names.failed ? fail_memory() : wanted ? END_INPUT : END_USAGE;
    int size = names.size < 1000 ? (int)names.size : 1000;
    if (!names.failed && wanted)
        complain("%s: has no layer '%s', but: %.*s", p->path, wanted, size,
                 names.bytes ? names.bytes : "");
    else if (!names.failed)
        complain("%s: which layer has the points? --layer may be one of: %.*s", p->path, size,
                 names.bytes ? names.bytes : "");
    text_release(&names);
    return end;
}

static int points_find_layer(gdal_points *p, const char *wanted)
{
    size_t candidates = 0;
    int count = p->gdal->GDALDatasetGetLayerCount(p->set);
    for (int i = 0; i < count; i++) {
        OGRLayerH layer = p->gdal->GDALDatasetGetLayer(p->set, i);
        bool fits =
            wanted ? strcmp(p->gdal->OGR_L_GetName(layer), wanted) == 0
                   : layer_may_have_points(p, layer) && (count == 1 || !layer_is_empty(p, layer));
        if (!fits) continue;
        p->layer = layer;
        candidates++;
    }
    if (candidates == 1) return 0;
    if (candidates > 1 || wanted || count > 1) return points_fail_layer(p, wanted);
    complain("%s: GDAL finds no points in it", p->path);
    return END_INPUT;
}

/* --- columns ---------------------------------------------------------------------------------- */

static bool points_have_name(const gdal_points *p, const char *name)
{
    for (size_t i = 0; i < p->column_count; i++)
        if (p->names[i] && strcasecmp(p->names[i], name) == 0) return true;
    return false;
}

/* Name a coordinate; an attribute may have its name already. */
static bool points_name_coordinate(gdal_points *p, size_t k)
{
    char name[64];
    snprintf(name, sizeof name, "%c", "xyz"[k]);
    while (points_have_name(p, name) && strlen(name) + 4 < sizeof name) strcat(name, "_mw");
    p->names[k] = strdup(name);
    return p->names[k] != NULL;
}

/* Add a cell. */
static void row_cell(text *row, bool first, const char *cell)
{
    if (!first) text_bytes(row, ",", 1);
    size_t length = strlen(cell);
    bool blank = length > 0 && (cell[0] == ' ' || cell[length - 1] == ' ');
    if (!blank && !cell[strcspn(cell, ",;\t\"\r\n")]) {
        text_bytes(row, cell, length);
        return;
    }
    text_bytes(row, "\"", 1);
    for (; *cell; cell++) text_bytes(row, *cell == '"' ? "\"\"" : cell, *cell == '"' ? 2 : 1);
    text_bytes(row, "\"", 1);
}

static int points_name_columns(gdal_points *p)
{
    OGRFeatureDefnH definition = p->gdal->OGR_L_GetLayerDefn(p->layer);
    OGRwkbGeometryType type = p->gdal->OGR_L_GetGeomType(p->layer);
    size_t fields = (size_t)p->gdal->OGR_FD_GetFieldCount(definition);
    p->coordinates = p->gdal->OGR_GT_HasZ(type) || type == wkbUnknown ? 3 : 2;
    p->column_count = p->coordinates + fields;
    p->names = calloc(p->column_count, sizeof *p->names);
    if (!p->names) return fail_memory();
    for (size_t i = 0; i < fields; i++) {
        OGRFieldDefnH field = p->gdal->OGR_FD_GetFieldDefn(definition, (int)i);
        p->names[p->coordinates + i] = strdup(p->gdal->OGR_Fld_GetNameRef(field));
        if (!p->names[p->coordinates + i]) return fail_memory();
    }
    for (size_t k = 0; k < p->coordinates; k++)
        if (!points_name_coordinate(p, k)) return fail_memory();
    for (size_t i = 0; i < p->column_count; i++) row_cell(&p->header, i == 0, p->names[i]);
    text_bytes(&p->header, "", 1);
    return p->header.failed ? fail_memory() : 0;
}

int gdal_points_open(gdal_points **points, const char *path, const char *layer, const char *where)
{
    gdal_points *p = *points = calloc(1, sizeof *p);
    if (!p) return fail_memory();
    p->path = path;
    p->gdal = gdal_library_load();
    if (!p->gdal) {
        complain("%s: GDAL, which would read it, cannot be loaded (" MW_GDAL ")", path);
        return END_INPUT;
    }
    p->gdal->CPLErrorReset();
    p->set = p->gdal->GDALOpenEx(path, GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                 NULL, NULL, NULL);
    if (!p->set) return points_fail_format(p);
    int end = points_find_layer(p, layer);
    if (end == 0) p->crs = crs_of_layer(p->set, p->layer);
    if (end == 0) end = points_name_columns(p);
    if (end || !where) return end;
    if (p->gdal->OGR_L_SetAttributeFilter(p->layer, where) == OGRERR_NONE) return 0;
    complain("option '--where' is no condition on the layer: GDAL says: %.1000s",
             p->gdal->CPLGetLastErrorMsg());
    return END_USAGE;
}

void gdal_points_close(gdal_points *p)
{
    if (!p) return;
    if (p->set) p->gdal->GDALClose(p->set);
    free(p->crs);
    for (size_t i = 0; p->names && i < p->column_count; i++) free(p->names[i]);
    free(p->names);
    text_release(&p->header);
    text_release(&p->rows);
    free(p->ends);
    free(p);
}

void gdal_points_table(const gdal_points *p, mw_point_table *table)
{
    *table = (mw_point_table){.names = (const char *const *)p->names,
                              .header = p->header.bytes,
                              .column_count = p->column_count,
                              .separator = ',',
                              .decimal = '.'};
}

size_t gdal_points_coordinates(const gdal_points *p)
{
    return p->coordinates;
}

const char *gdal_points_crs(const gdal_points *p)
{
    return p->crs;
}

/* --- features --------------------------------------------------------------------------------- */

/* The point of a feature. NaN if it has none. Returns 0, or an exit code after a complaint. */
static int feature_point(const gdal_points *p, OGRFeatureH feature, double at[3])
{
    const gdal_functions *gdal = p->gdal;
    OGRGeometryH geometry = gdal->OGR_F_GetGeometryRef(feature);
    at[0] = at[1] = at[2] = NAN;
    if (!geometry)
        return gdal->CPLGetLastErrorType() >= CE_Failure ? points_fail(p, "a damaged geometry") : 0;
    OGRGeometryH point = geometry;
    if (gdal->OGR_GT_Flatten(gdal->OGR_G_GetGeometryType(geometry)) == wkbMultiPoint &&
        gdal->OGR_G_GetGeometryCount(geometry) == 1)
        point = gdal->OGR_G_GetGeometryRef(geometry, 0);
    if (gdal->OGR_GT_Flatten(gdal->OGR_G_GetGeometryType(point)) != wkbPoint) {
        complain("%s: feature %" PRId64 " is a %s, not a point", p->path,
                 (int64_t)gdal->OGR_F_GetFID(feature), gdal->OGR_G_GetGeometryName(geometry));
        return END_INPUT;
    }
    if (gdal->OGR_G_GetPointCount(point) == 0) return 0;
    gdal->OGR_G_GetPoint(point, 0, &at[0], &at[1], &at[2]);
    if (!gdal->OGR_G_Is3D(point)) at[2] = NAN;
    return 0;
}

static void row_number(text *row, bool first, double value)
{
    char digits[32] = "";
    if (!isnan(value)) mw_format_double(value, digits);
    row_cell(row, first, digits);
}

static bool points_keep_row(gdal_points *p, OGRFeatureH feature, const double at[3])
{
    const gdal_functions *gdal = p->gdal;
    OGRFeatureDefnH definition = gdal->OGR_L_GetLayerDefn(p->layer);
    for (size_t k = 0; k < p->coordinates; k++) row_number(&p->rows, k == 0, at[k]);
    for (int i = 0; (size_t)i < p->column_count - p->coordinates; i++) {
        if (!gdal->OGR_F_IsFieldSetAndNotNull(feature, i))
            row_cell(&p->rows, false, "");
        else if (gdal->OGR_Fld_GetType(gdal->OGR_FD_GetFieldDefn(definition, i)) == OFTReal)
            row_number(&p->rows, false, gdal->OGR_F_GetFieldAsDouble(feature, i));
        else
            row_cell(&p->rows, false, gdal->OGR_F_GetFieldAsString(feature, i));
    }
    if (p->row_count == p->row_room) {
        size_t room = 2 * p->row_room + 1024;
        size_t *ends = realloc(p->ends, room * sizeof *ends);
        if (!ends) return false;
        p->ends = ends;
        p->row_room = room;
    }
    p->ends[p->row_count++] = p->rows.size;
    return !p->rows.failed;
}

int gdal_points_read(gdal_points *p, double *values, size_t width, size_t capacity, size_t *count)
{
    int end = 0;
    text_clear(&p->rows);
    p->row_count = *count = 0;
    while (end == 0 && *count < capacity && p->rows.size < ROWS_LIMIT) {
        double at[3];
        p->gdal->CPLErrorReset();
        OGRFeatureH feature = p->gdal->OGR_L_GetNextFeature(p->layer);
        if (!feature)
            return p->gdal->CPLGetLastErrorType() >= CE_Failure ? points_fail(p, "a damaged file")
                                                                : 0;
        end = feature_point(p, feature, at);
        if (end == 0 && !points_keep_row(p, feature, at)) end = fail_memory();
        p->gdal->OGR_F_Destroy(feature);
        if (end == 0) memcpy(values + width * (*count)++, at, width * sizeof *at);
    }
    return end;
}

const char *gdal_points_row(const gdal_points *p, size_t row, size_t *length)
{
    size_t begin = row > 0 ? p->ends[row - 1] : 0;
    *length = p->ends[row] - begin;
    return p->rows.bytes + begin;
}

#else

int gdal_points_open(gdal_points **points, const char *path, const char *layer, const char *where)
{
    (void)layer;
    (void)where;
    *points = NULL;
    complain("%s: is no table of text; a program that was built with GDAL reads it", path);
    return END_INPUT;
}

void gdal_points_close(gdal_points *points)
{
    (void)points;
}

void gdal_points_table(const gdal_points *points, mw_point_table *table)
{
    (void)points;
    *table = (mw_point_table){0};
}

size_t gdal_points_coordinates(const gdal_points *points)
{
    (void)points;
    return 2;
}

const char *gdal_points_crs(const gdal_points *points)
{
    (void)points;
    return NULL;
}

int gdal_points_read(gdal_points *points, double *values, size_t width, size_t capacity,
                     size_t *count)
{
    (void)points;
    (void)values;
    (void)width;
    (void)capacity;
    *count = 0;
    return END_INPUT;
}

const char *gdal_points_row(const gdal_points *points, size_t row, size_t *length)
{
    (void)points;
    (void)row;
    *length = 0;
    return NULL;
}

#endif
