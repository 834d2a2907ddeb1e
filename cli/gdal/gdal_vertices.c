#include "cli/gdal/gdal_vertices.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_point_layer.h"
#include "src/base/posix.h"

#ifdef MW_GDAL

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A value of each vertex, by its column of the layer. */
typedef struct vertex_value {
    size_t column;
    bool number; /* an attribute that holds numbers; else its texts are read as numbers */
    uint64_t numbers, texts;
    int64_t first; /* the feature with the first text */
    double now;    /* what the present feature has */
} vertex_value;

struct gdal_vertices {
    point_layer layer;
    vertex_value *values;
    size_t width;
    OGRFeatureH feature; /* the present one; NULL: none */
    OGRGeometryH geometry;
    int part, parts; /* the next of its points */
    uint64_t done;
    int64_t all; /* features; -1: not known */
};

/* --- columns ---------------------------------------------------------------------------------- */

static int vertices_fail_columns(const gdal_vertices *v, const char *item, int length,
                                 const char *why)
{
    complain("%s: --columns: '%.*s' %s; expected x, y and columns of the layer", v->layer.path,
             length, item, why);
    return END_INPUT;
}

/* A column by its name, in any case, or by its number from 1; SIZE_MAX: there is none. */
static size_t layer_find_column(const point_layer *l, const char *item, size_t length)
{
    for (size_t c = 0; c < l->column_count; c++)
        if (strlen(l->names[c]) == length && strncasecmp(l->names[c], item, length) == 0) return c;
    size_t number = 0;
    for (size_t i = 0; i < length; i++) {
        if (item[i] < '0' || item[i] > '9' || number > l->column_count) return SIZE_MAX;
        number = 10 * number + (size_t)(item[i] - '0');
    }
    return number >= 1 && number <= l->column_count ? number - 1 : SIZE_MAX;
}

/* The first two are the coordinates, even where attributes are called x and y, too. */
static size_t vertices_find_column(const gdal_vertices *v, const char *item, size_t length)
{
    if (v->width < 2 && length == 1 && (*item | 32) == "xy"[v->width]) return v->width;
    return layer_find_column(&v->layer, item, length);
}

static void vertices_add(gdal_vertices *v, size_t column)
{
    const point_layer *l = &v->layer;
    OGRFieldType type = OFTReal;
    if (column >= l->coordinates) {
        OGRFeatureDefnH definition = l->gdal->OGR_L_GetLayerDefn(l->layer);
        int field = (int)(column - l->coordinates);
        type = l->gdal->OGR_Fld_GetType(l->gdal->OGR_FD_GetFieldDefn(definition, field));
    }
    bool number = type == OFTReal || type == OFTInteger || type == OFTInteger64;
    v->values[v->width++] = (vertex_value){.column = column, .number = number};
}

static int vertices_choose(gdal_vertices *v, const char *list)
{
    for (const char *item = list;; item++) {
        size_t length = strcspn(item, ",");
        size_t column = vertices_find_column(v, item, length);
        int shown = length < 60 ? (int)length : 60;
        if (column == SIZE_MAX) return vertices_fail_columns(v, item, shown, "is not a column");
        for (size_t k = 0; k < v->width; k++)
            if (v->values[k].column == column)
                return vertices_fail_columns(v, item, shown, "is named twice");
        if (v->width < 2 && column != v->width)
            return vertices_fail_columns(v, item, shown, "is where x or y should be");
        vertices_add(v, column);
        item += length;
        if (!*item) break;
    }
    return v->width >= 2 ? 0 : vertices_fail_columns(v, list, 60, "is only one column");
}

int gdal_vertices_open(gdal_vertices **vertices, const char *path,
                       const gdal_vertices_options *options)
{
    gdal_vertices *v = *vertices = calloc(1, sizeof *v);
    if (!v) return fail_memory();
    int end = point_layer_open(&v->layer, path, options->layer, options->where);
    if (end) return end;
    v->values = calloc(v->layer.column_count, sizeof *v->values);
    if (!v->values) return fail_memory();
    v->all = v->layer.gdal->OGR_L_GetFeatureCount(v->layer.layer, 0);
    if (options->columns) return vertices_choose(v, options->columns);
    for (size_t c = 0; c < v->layer.column_count; c++) vertices_add(v, c);
    return 0;
}

void gdal_vertices_close(gdal_vertices *v)
{
    if (!v) return;
    if (v->feature) v->layer.gdal->OGR_F_Destroy(v->feature);
    point_layer_release(&v->layer);
    free(v->values);
    free(v);
}

size_t gdal_vertices_width(const gdal_vertices *v)
{
    return v->width;
}

const char *gdal_vertices_column(const gdal_vertices *v, size_t k)
{
    return v->layer.names[v->values[k].column];
}

bool gdal_vertices_is_z(const gdal_vertices *v, size_t k)
{
    return v->layer.coordinates > 2 && v->values[k].column == 2;
}

uint64_t gdal_vertices_numbers(const gdal_vertices *v, size_t k)
{
    return v->values[k].numbers;
}

uint64_t gdal_vertices_texts(const gdal_vertices *v, size_t k, int64_t *feature)
{
    if (feature && v->values[k].texts > 0) *feature = v->values[k].first;
    return v->values[k].texts;
}

const char *gdal_vertices_crs(const gdal_vertices *v)
{
    return v->layer.crs;
}

double gdal_vertices_fraction(const gdal_vertices *v)
{
    return v->all > 0 && v->done <= (uint64_t)v->all ? (double)v->done / (double)v->all : -1;
}

/* --- features --------------------------------------------------------------------------------- */

/* A number as text; NaN if it is missing. False: it is a text. */
static bool text_is_number(const char *cell, double *value)
{
    static const char *const missing[] = {"", "-", "na", "n/a", "nan", "null"};
    char *end;
    *value = NAN;
    for (size_t i = 0; i < sizeof missing / sizeof *missing; i++)
        if (strcasecmp(cell, missing[i]) == 0) return true;
    double number = strtod(cell, &end);
    while (*end == ' ') end++;
    if (*end) return false;
    *value = number;
    return true;
}

/* Take the attributes of the present feature that are read. */
static void vertices_take_attributes(gdal_vertices *v)
{
    const gdal_functions *gdal = v->layer.gdal;
    for (size_t k = 2; k < v->width; k++) {
        vertex_value *value = &v->values[k];
        value->now = NAN;
        if (value->column < v->layer.coordinates) continue;
        int field = (int)(value->column - v->layer.coordinates);
        if (!gdal->OGR_F_IsFieldSetAndNotNull(v->feature, field)) continue;
        if (value->number)
            value->now = gdal->OGR_F_GetFieldAsDouble(v->feature, field);
        else if (value->texts > 0 ||
                 !text_is_number(gdal->OGR_F_GetFieldAsString(v->feature, field), &value->now))
            if (value->texts++ == 0) value->first = gdal->OGR_F_GetFID(v->feature);
        if (!isnan(value->now)) value->numbers++;
    }
}

/* Go on to the next feature, if the points of the present one are taken. */
static int vertices_advance(gdal_vertices *v)
{
    const gdal_functions *gdal = v->layer.gdal;
    int end = 0;
    if (v->feature && v->part < v->parts) return 0;
    if (v->feature) gdal->OGR_F_Destroy(v->feature);
    v->feature = point_layer_next(&v->layer, &end);
    if (!v->feature) return end;
    v->geometry = point_layer_geometry(&v->layer, v->feature, &end);
    if (end) return end;
    OGRwkbGeometryType type =
        v->geometry ? gdal->OGR_GT_Flatten(gdal->OGR_G_GetGeometryType(v->geometry)) : wkbPoint;
    if (type != wkbPoint && type != wkbMultiPoint)
        return point_layer_fail_geometry(&v->layer, v->feature, v->geometry);
    v->part = 0;
    v->parts = type == wkbMultiPoint ? gdal->OGR_G_GetGeometryCount(v->geometry) : 1;
    v->done++;
    vertices_take_attributes(v);
    if (v->geometry && v->parts > 0) return 0;
    complain("%s: feature %" PRId64 " has no point; --where chooses those that have", v->layer.path,
             (int64_t)gdal->OGR_F_GetFID(v->feature));
    return END_INPUT;
}

static int vertices_take_point(gdal_vertices *v, double *values)
{
    double at[3];
    bool many = v->layer.gdal->OGR_GT_Flatten(v->layer.gdal->OGR_G_GetGeometryType(v->geometry)) ==
                wkbMultiPoint;
    point_layer_take(&v->layer,
                     many ? v->layer.gdal->OGR_G_GetGeometryRef(v->geometry, v->part) : v->geometry,
                     at);
    v->part++;
    for (size_t k = 0; k < v->width; k++) {
        vertex_value *value = &v->values[k];
        bool coordinate = value->column < v->layer.coordinates;
        values[k] = coordinate ? at[value->column] : value->now;
        if (coordinate && !isnan(values[k])) value->numbers++;
    }
    if (isfinite(at[0]) && isfinite(at[1])) return 0;
    complain("%s: feature %" PRId64 " has a point without coordinates; --where chooses others",
             v->layer.path, (int64_t)v->layer.gdal->OGR_F_GetFID(v->feature));
    return END_INPUT;
}

int gdal_vertices_read(gdal_vertices *v, double *values, size_t capacity, size_t *count)
{
    *count = 0;
    while (*count < capacity) {
        int end = vertices_advance(v);
        if (end || !v->feature) return end;
        end = vertices_take_point(v, values + v->width * (*count)++);
        if (end) return end;
    }
    return 0;
}

#else

int gdal_vertices_open(gdal_vertices **vertices, const char *path,
                       const gdal_vertices_options *options)
{
    (void)options;
    *vertices = NULL;
    complain("%s: is not a text table; a program built with GDAL can read it", path);
    return END_INPUT;
}

void gdal_vertices_close(gdal_vertices *v)
{
    (void)v;
}

size_t gdal_vertices_width(const gdal_vertices *v)
{
    (void)v;
    return 0;
}

const char *gdal_vertices_column(const gdal_vertices *v, size_t k)
{
    (void)v;
    (void)k;
    return "";
}

bool gdal_vertices_is_z(const gdal_vertices *v, size_t k)
{
    (void)v;
    (void)k;
    return false;
}

uint64_t gdal_vertices_numbers(const gdal_vertices *v, size_t k)
{
    (void)v;
    (void)k;
    return 0;
}

uint64_t gdal_vertices_texts(const gdal_vertices *v, size_t k, int64_t *feature)
{
    (void)v;
    (void)k;
    (void)feature;
    return 0;
}

const char *gdal_vertices_crs(const gdal_vertices *v)
{
    (void)v;
    return NULL;
}

int gdal_vertices_read(gdal_vertices *v, double *values, size_t capacity, size_t *count)
{
    (void)v;
    (void)values;
    (void)capacity;
    *count = 0;
    return END_INPUT;
}

double gdal_vertices_fraction(const gdal_vertices *v)
{
    (void)v;
    return -1;
}

#endif
