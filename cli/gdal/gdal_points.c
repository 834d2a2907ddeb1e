#include "cli/gdal/gdal_points.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"
#include "cli/gdal/gdal_point_layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool gdal_points_known(const char *path)
{
    return point_layer_known(path);
}

#ifdef MW_GDAL

#define ROWS_LIMIT ((size_t)1 << 26) /* bytes of rows in memory */

struct gdal_points {
    point_layer layer;
    text header, rows;
    size_t *ends, row_count, row_room; /* where the rows of the block end */
};

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

int gdal_points_open(gdal_points **points, const char *path, const char *layer, const char *where)
{
    gdal_points *p = *points = calloc(1, sizeof *p);
    if (!p) return fail_memory();
    int end = point_layer_open(&p->layer, path, layer, where);
    for (size_t i = 0; end == 0 && i < p->layer.column_count; i++)
        row_cell(&p->header, i == 0, p->layer.names[i]);
    text_bytes(&p->header, "", 1);
    return end == 0 && p->header.failed ? fail_memory() : end;
}

void gdal_points_close(gdal_points *p)
{
    if (!p) return;
    point_layer_release(&p->layer);
    text_release(&p->header);
    text_release(&p->rows);
    free(p->ends);
    free(p);
}

void gdal_points_table(const gdal_points *p, mw_point_table *table)
{
    *table = (mw_point_table){.names = (const char *const *)p->layer.names,
                              .header = p->header.bytes,
                              .column_count = p->layer.column_count,
                              .separator = ',',
                              .decimal = '.'};
}

size_t gdal_points_coordinates(const gdal_points *p)
{
    return p->layer.coordinates;
}

const char *gdal_points_crs(const gdal_points *p)
{
    return p->layer.crs;
}

/* --- features --------------------------------------------------------------------------------- */

/* The point of a feature. NaN if it has none. Returns 0, or an exit code after a complaint. */
static int feature_point(const point_layer *l, OGRFeatureH feature, double at[3])
{
    int end;
    OGRGeometryH geometry = point_layer_geometry(l, feature, &end), point = geometry;
    at[0] = at[1] = at[2] = NAN;
    if (!geometry) return end;
    if (l->gdal->OGR_GT_Flatten(l->gdal->OGR_G_GetGeometryType(geometry)) == wkbMultiPoint &&
        l->gdal->OGR_G_GetGeometryCount(geometry) == 1)
        point = l->gdal->OGR_G_GetGeometryRef(geometry, 0);
    if (l->gdal->OGR_GT_Flatten(l->gdal->OGR_G_GetGeometryType(point)) != wkbPoint)
        return point_layer_fail_geometry(l, feature, geometry);
    point_layer_take(l, point, at);
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
    const gdal_functions *gdal = p->layer.gdal;
    OGRFeatureDefnH definition = gdal->OGR_L_GetLayerDefn(p->layer.layer);
    for (size_t k = 0; k < p->layer.coordinates; k++) row_number(&p->rows, k == 0, at[k]);
    for (int i = 0; (size_t)i < p->layer.column_count - p->layer.coordinates; i++) {
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
        OGRFeatureH feature = point_layer_next(&p->layer, &end);
        if (!feature) return end;
        end = feature_point(&p->layer, feature, at);
        if (end == 0 && !points_keep_row(p, feature, at)) end = fail_memory();
        p->layer.gdal->OGR_F_Destroy(feature);
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
    complain("%s: is not a text table; a program built with GDAL can read it", path);
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
