#include "cli/gdal/gdal_point_layer.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"
#include "cli/gdal/gdal_crs.h"
#include "src/base/posix.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool path_ends(const char *path, const char *ending)
{
    size_t length = strlen(path), end = strlen(ending);
    return length > end && strcasecmp(path + length - end, ending) == 0;
}

static bool path_has_vector_ending(const char *path)
{
    static const char *const endings[] = {
        ".gpkg", ".shp", ".shz",     ".geojson", ".geojsonl", ".geojsons", ".json",
        ".fgb",  ".gpx", ".kml",     ".kmz",     ".gml",      ".gdb",      ".sqlite",
        ".mif",  ".dxf", ".parquet", ".feather", ".arrow"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (path_ends(path, endings[i])) return true;
    return false;
}

/* A mesh of VTK is XML as well as much that GDAL reads. */
static bool head_is_vtk(const unsigned char *head, size_t size)
{
    static const char mark[] = "<VTKFile";
    for (size_t i = 0; i + sizeof mark - 1 <= size; i++)
        if (memcmp(head + i, mark, sizeof mark - 1) == 0) return true;
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
    if (size == 0 || head_is_vtk(head, size)) return false;
    return *head == '{' || *head == '<' ||
           (size >= 6 && strncasecmp((const char *)head, "!table", 6) == 0);
}

bool point_layer_known(const char *path)
{
    struct stat s;
    unsigned char head[256];
    if (strcmp(path, "-") == 0 || stat(path, &s) != 0) return false;
    if (path_ends(path, ".vtu")) return false; /* whatever stands in front of its <VTKFile> */
    if (S_ISDIR(s.st_mode) || path_has_vector_ending(path)) return path_has_vector_ending(path);
    FILE *file = S_ISREG(s.st_mode) ? fopen(path, "rb") : NULL;
    if (!file) return false;
    size_t size = fread(head, 1, sizeof head, file);
    fclose(file);
    return head_is_vector(head, size);
}

#ifdef MW_GDAL

int point_layer_fail(const point_layer *p, const char *what)
{
    const char *message = p->gdal->CPLGetLastErrorMsg();
    complain("%s: GDAL says: %.1000s", p->path, *message ? message : what);
    return END_INPUT;
}

/* Some formats need drivers that are often missing. */
static int path_check_driver(const gdal_functions *gdal, const char *path)
{
    static const char *const wanted[][2] = {
        {".parquet", "Parquet"}, {".feather", "Arrow"}, {".arrow", "Arrow"}};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        if (!path_ends(path, wanted[i][0]) || gdal->GDALGetDriverByName(wanted[i][1])) continue;
        complain("%s: this GDAL has no driver for %s; 'meshwalk --version' tells what was found",
                 path, wanted[i][1]);
        return END_INPUT;
    }
    return 0;
}

int point_layers_check(const char *const *paths, int count)
{
    for (int i = 0; i < count; i++) {
        const char *path = paths[i];
        bool wanted = path && (path_ends(path, ".parquet") || path_ends(path, ".feather") ||
                               path_ends(path, ".arrow"));
        const gdal_functions *gdal = wanted ? gdal_library_load() : NULL;
        int end = gdal ? path_check_driver(gdal, path) : 0;
        if (end) return end;
    }
    return 0;
}

/* GDAL knows no format for the file. */
static int point_layer_fail_format(const point_layer *p)
{
    int end = path_check_driver(p->gdal, p->path);
    return end ? end : point_layer_fail(p, "this is not a vector file");
}

static bool layer_may_have_points(const point_layer *p, OGRLayerH layer)
{
    OGRwkbGeometryType type = p->gdal->OGR_GT_Flatten(p->gdal->OGR_L_GetGeomType(layer));
    return type == wkbPoint || type == wkbMultiPoint || type == wkbUnknown ||
           type == wkbGeometryCollection;
}

/* Does the layer have features? A file of GPX has a layer for everything that it could hold. */
static bool layer_is_empty(const point_layer *p, OGRLayerH layer)
{
    p->gdal->OGR_L_ResetReading(layer);
    OGRFeatureH feature = p->gdal->OGR_L_GetNextFeature(layer);
    if (feature) p->gdal->OGR_F_Destroy(feature);
    p->gdal->OGR_L_ResetReading(layer);
    return !feature;
}

static int point_layer_fail_layer(const point_layer *p, const char *wanted)
{
    text names = {0};
    int count = p->gdal->GDALDatasetGetLayerCount(p->set);
    for (int i = 0; i < count; i++)
        text_printf(&names, "%s%s", i ? ", " : "",
                    p->gdal->OGR_L_GetName(p->gdal->GDALDatasetGetLayer(p->set, i)));
    int end = names.failed ? fail_memory() : wanted ? END_INPUT : END_USAGE;
    int size = names.size < 1000 ? (int)names.size : 1000;
    if (!names.failed && wanted)
        complain("%s: has no layer '%s'; it has: %.*s", p->path, wanted, size,
                 names.bytes ? names.bytes : "");
    else if (!names.failed)
        complain("%s: which layer has the points? --layer may be one of: %.*s", p->path, size,
                 names.bytes ? names.bytes : "");
    text_release(&names);
    return end;
}

static int point_layer_find_layer(point_layer *p, const char *wanted)
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
    if (candidates > 1 || wanted || count > 1) return point_layer_fail_layer(p, wanted);
    complain("%s: GDAL finds no points in it", p->path);
    return END_INPUT;
}

/* --- columns ---------------------------------------------------------------------------------- */

static bool point_layer_have_name(const point_layer *p, const char *name)
{
    for (size_t i = 0; i < p->column_count; i++)
        if (p->names[i] && strcasecmp(p->names[i], name) == 0) return true;
    return false;
}

/* Name a coordinate; an attribute may have its name already. */
static bool point_layer_name_coordinate(point_layer *p, size_t k)
{
    char name[64];
    snprintf(name, sizeof name, "%c", "xyz"[k]);
    while (point_layer_have_name(p, name) && strlen(name) + 4 < sizeof name) strcat(name, "_mw");
    p->names[k] = strdup(name);
    return p->names[k] != NULL;
}

static int point_layer_name_columns(point_layer *p)
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
        if (!point_layer_name_coordinate(p, k)) return fail_memory();
    return 0;
}

int point_layer_open(point_layer *p, const char *path, const char *layer, const char *where)
{
    *p = (point_layer){.path = path, .gdal = gdal_library_load()};
    if (!p->gdal) {
        complain("%s: GDAL, which would read it, cannot be loaded (" MW_GDAL ")", path);
        return END_INPUT;
    }
    p->gdal->CPLErrorReset();
    p->set = p->gdal->GDALOpenEx(path, GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                 NULL, NULL, NULL);
    if (!p->set) return point_layer_fail_format(p);
    int end = point_layer_find_layer(p, layer);
    if (end == 0) p->crs = crs_of_layer(p->set, p->layer);
    if (end == 0) end = point_layer_name_columns(p);
    if (end || !where) return end;
    if (p->gdal->OGR_L_SetAttributeFilter(p->layer, where) == OGRERR_NONE) return 0;
    complain("option '--where' is not a valid condition on the layer: GDAL says: %.1000s",
             p->gdal->CPLGetLastErrorMsg());
    return END_USAGE;
}

void point_layer_release(point_layer *p)
{
    if (p->set) p->gdal->GDALClose(p->set);
    free(p->crs);
    for (size_t i = 0; p->names && i < p->column_count; i++) free(p->names[i]);
    free(p->names);
    *p = (point_layer){0};
}

OGRFeatureH point_layer_next(const point_layer *p, int *end)
{
    p->gdal->CPLErrorReset();
    OGRFeatureH feature = p->gdal->OGR_L_GetNextFeature(p->layer);
    *end = !feature && p->gdal->CPLGetLastErrorType() >= CE_Failure
               ? point_layer_fail(p, "a damaged file")
               : 0;
    return feature;
}

OGRGeometryH point_layer_geometry(const point_layer *p, OGRFeatureH feature, int *end)
{
    OGRGeometryH geometry = p->gdal->OGR_F_GetGeometryRef(feature);
    *end = !geometry && p->gdal->CPLGetLastErrorType() >= CE_Failure
               ? point_layer_fail(p, "a damaged geometry")
               : 0;
    return geometry;
}

int point_layer_fail_geometry(const point_layer *p, OGRFeatureH feature, OGRGeometryH geometry)
{
    complain("%s: feature %" PRId64 " is a %s, not a point", p->path,
             (int64_t)p->gdal->OGR_F_GetFID(feature), p->gdal->OGR_G_GetGeometryName(geometry));
    return END_INPUT;
}

void point_layer_take(const point_layer *p, OGRGeometryH point, double at[3])
{
    at[0] = at[1] = at[2] = NAN;
    if (p->gdal->OGR_G_GetPointCount(point) == 0) return;
    p->gdal->OGR_G_GetPoint(point, 0, &at[0], &at[1], &at[2]);
    if (!p->gdal->OGR_G_Is3D(point)) at[2] = NAN;
}

#else

int point_layers_check(const char *const *paths, int count)
{
    (void)paths;
    (void)count;
    return 0;
}

#endif
