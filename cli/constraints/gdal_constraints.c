#include "cli/constraints/gdal_constraints.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"
#include "cli/gdal/gdal_crs.h"

#ifdef MW_GDAL

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static gdal_functions gdal;

static bool gdal_load(void)
{
    const gdal_functions *functions = gdal_library_load();
    if (functions) gdal = *functions;
    return functions != NULL;
}

/* A constraint file that grows while features are added. */
typedef struct constraint_collector {
    mw_constraint_file *file;
    size_t point_room, segment_room, skipped_room;
    uint32_t feature;
    uint32_t polygons; /* of the feature */
    const gdal_constraints_options *options;
    feature_values *values; /* NULL: none are wanted */
    int layers;             /* read so far */
} constraint_collector;

/* Make room for one more element after `count`. Returns false if memory runs out. */
static bool array_make_room(void *array, size_t size, size_t count, size_t *room)
{
    if (count < *room) return true;
    size_t wanted = *room ? 2 * *room : 1024;
    void *old, *larger = NULL;
    memcpy(&old, array, sizeof old);
    if (wanted <= SIZE_MAX / size) larger = realloc(old, wanted * size);
    if (!larger) return false;
    memcpy(array, &larger, sizeof larger);
    *room = wanted;
    return true;
}

static bool collector_add_point(constraint_collector *c, OGRGeometryH geometry, int i)
{
    mw_constraint_file *file = c->file;
    double p[3] = {0};
    if (!array_make_room(&file->points, 3 * sizeof *file->points, file->point_count,
                         &c->point_room))
        return false;
    gdal.OGR_G_GetPoint(geometry, i, &p[0], &p[1], &p[2]);
    if (gdal.OGR_G_Is3D(geometry))
        file->has_z = 1;
    else
        p[2] = NAN;
    memcpy(file->points + 3 * file->point_count++, p, sizeof p);
    return true;
}

static bool collector_add_segment(constraint_collector *c, size_t a, size_t b, uint32_t polygon)
{
    mw_constraint_file *file = c->file;
    size_t i = file->segment_count, room[2] = {c->segment_room, c->segment_room};
    if (!array_make_room(&file->segments, 2 * sizeof *file->segments, i, &room[0])) return false;
    if (!array_make_room(&file->polygon, sizeof *file->polygon, i, &room[1])) return false;
    if (!array_make_room(&file->record, sizeof *file->record, i, &c->segment_room)) return false;
    file->segments[2 * i] = (uint32_t)a;
    file->segments[2 * i + 1] = (uint32_t)b;
    file->polygon[i] = polygon;
    file->record[i] = c->feature;
    file->segment_count++;
    return true;
}

/* Add the points of a line, and its segments. If `polygon` is not MW_NONE the line is a ring: the
 * points that close it are left out. */
static bool collector_add_chain(constraint_collector *c, OGRGeometryH line, uint32_t polygon)
{
    size_t first = c->file->point_count;
    int count = gdal.OGR_G_GetPointCount(line);
    for (int i = 0; i < count; i++)
        if (!collector_add_point(c, line, i)) return false;
    const double *points = c->file->points;
    size_t *end = &c->file->point_count;
    while (polygon != MW_NONE && *end > first + 1 && points[3 * first] == points[3 * *end - 3] &&
           points[3 * first + 1] == points[3 * *end - 2])
        --*end;
    for (size_t i = first + 1; i < *end; i++)
        if (!collector_add_segment(c, i - 1, i, polygon)) return false;
    return polygon == MW_NONE || *end < first + 2 ||
           collector_add_segment(c, *end - 1, first, polygon);
}

/* Does a ring have three points that differ in x or y? */
static bool ring_is_sound(OGRGeometryH ring)
{
    double seen[2][2], p[3];
    int different = 0, count = gdal.OGR_G_GetPointCount(ring);
    for (int i = 0; i < count; i++) {
        gdal.OGR_G_GetPoint(ring, i, &p[0], &p[1], &p[2]);
        bool known = false;
        for (int k = 0; k < different; k++)
            known = known || (p[0] == seen[k][0] && p[1] == seen[k][1]);
        if (!known && different == 2) return true;
        if (!known) memcpy(seen[different++], p, sizeof seen[0]);
    }
    return false;
}

static bool collector_skip_ring(constraint_collector *c, uint32_t ring)
{
    mw_constraint_file *file = c->file;
    if (!array_make_room(&file->skipped, sizeof *file->skipped, file->skipped_count,
                         &c->skipped_room))
        return false;
    file->skipped[file->skipped_count++] = (mw_skipped_ring){c->feature, c->polygons, ring};
    return true;
}

/* As the library does it for GeoJSON: a ring that is not sound is skipped, and if it is the outer
 * one, so is its polygon. */
static bool collector_add_polygon(constraint_collector *c, OGRGeometryH polygon)
{
    const uint32_t number = (uint32_t)c->file->polygon_count;
    const int count = gdal.OGR_G_GetGeometryCount(polygon);
    bool skipped = false;
    for (int i = 0; i < count; i++) {
        OGRGeometryH ring = gdal.OGR_G_GetGeometryRef(polygon, i);
        const bool sound = ring_is_sound(ring);
        skipped = skipped || (i == 0 && !sound);
        if (!sound && !collector_skip_ring(c, (uint32_t)i)) return false;
        if (sound && !skipped && !collector_add_chain(c, ring, number)) return false;
    }
    c->polygons++;
    if (!skipped) c->file->polygon_count++;
    return true;
}

static bool collector_add_geometry(constraint_collector *c, OGRGeometryH geometry)
{
    switch (gdal.OGR_GT_Flatten(gdal.OGR_G_GetGeometryType(geometry))) {
    case wkbPoint:
        return gdal.OGR_G_GetPointCount(geometry) == 0 || collector_add_point(c, geometry, 0);
    case wkbLineString: return collector_add_chain(c, geometry, MW_NONE);
    case wkbPolygon:
    case wkbTriangle: return collector_add_polygon(c, geometry);
    default: break;
    }
    int count = gdal.OGR_G_GetGeometryCount(geometry);
    for (int i = 0; i < count; i++)
        if (!collector_add_geometry(c, gdal.OGR_G_GetGeometryRef(geometry, i))) return false;
    return true;
}

static int gdal_fail(const char *path)
{
    const char *message = gdal.CPLGetLastErrorMsg();
    complain("%s: GDAL says: %.1000s", path, *message ? message : "this is not a vector file");
    return END_INPUT;
}

/* A feature without a geometry is skipped; but if GDAL failed to read the geometry, complain. */
static int gdal_fail_feature(const constraint_collector *c, const char *path)
{
    complain("%s: feature %" PRIu32 ": GDAL says: %.1000s", path, c->feature,
             gdal.CPLGetLastErrorMsg());
    return END_INPUT;
}

static int collector_add_feature(constraint_collector *c, OGRFeatureH feature, const char *path)
{
    OGRGeometryH geometry = gdal.OGR_F_GetGeometryRef(feature);
    c->polygons = 0;
    if (!geometry) return gdal.CPLGetLastErrorType() >= CE_Failure ? gdal_fail_feature(c, path) : 0;
    OGRGeometryH linear = gdal.OGR_G_GetLinearGeometry(geometry, 0, NULL); /* steps of 4 degrees */
    if (!linear) return gdal_fail_feature(c, path);
    bool added = collector_add_geometry(c, linear);
    gdal.OGR_G_DestroyGeometry(linear);
    if (!added) return fail_memory();
    if (c->file->point_count <= MW_MAX_VERTICES && c->file->segment_count < MW_NONE) return 0;
    complain("%s: has more than %" PRIu32 " points, or more than %" PRIu32 " segments", path,
             (uint32_t)MW_MAX_VERTICES, MW_NONE - 1);
    return END_RESOURCE;
}

/* --- attributes ---------------------------------------------------------------------------- */

static char field_kind(OGRFieldDefnH field)
{
    OGRFieldType type = gdal.OGR_Fld_GetType(field);
    return type == OFTReal ? 'r' : type == OFTInteger || type == OFTInteger64 ? 'i' : 't';
}

static int collector_choose_values(constraint_collector *c, OGRLayerH layer, const char *path)
{
    OGRFeatureDefnH definition = gdal.OGR_L_GetLayerDefn(layer);
    size_t count = (size_t)gdal.OGR_FD_GetFieldCount(definition);
    const char **names = calloc(count + 1, sizeof *names);
    char *kinds = calloc(count + 1, 1);
    for (size_t i = 0; names && kinds && i < count; i++) {
        OGRFieldDefnH field = gdal.OGR_FD_GetFieldDefn(definition, (int)i);
        names[i] = gdal.OGR_Fld_GetNameRef(field);
        kinds[i] = field_kind(field);
    }
    int end = names && kinds ? feature_values_choose(c->values, path, names, kinds, count)
                             : fail_memory();
    free(names);
    free(kinds);
    return end;
}

static bool collector_add_values(const constraint_collector *c, OGRFeatureH feature)
{
    for (size_t i = 0; i < c->values->count; i++) {
        int field = (int)c->values->fields[i];
        char digits[32];
        const char *cell = "";
        if (gdal.OGR_F_IsFieldSetAndNotNull(feature, field) && c->values->kinds[i] == 'r') {
            mw_format_double(gdal.OGR_F_GetFieldAsDouble(feature, field), digits);
            cell = digits;
        } else if (gdal.OGR_F_IsFieldSetAndNotNull(feature, field)) {
            cell = gdal.OGR_F_GetFieldAsString(feature, field);
        }
        if (!feature_values_add(c->values, cell)) return false;
    }
    return true;
}

/* --- layers -------------------------------------------------------------------------------- */

static int collector_read_layer(constraint_collector *c, OGRLayerH layer, const char *path)
{
    int chosen = c->values ? collector_choose_values(c, layer, path) : 0;
    if (chosen) return chosen;
    gdal.OGR_L_ResetReading(layer);
    for (;; c->feature++) {
        gdal.CPLErrorReset();
        OGRFeatureH feature = gdal.OGR_L_GetNextFeature(layer);
        if (!feature) return gdal.CPLGetLastErrorType() >= CE_Failure ? gdal_fail(path) : 0;
        int end = collector_add_feature(c, feature, path);
        if (end == 0 && c->values && !collector_add_values(c, feature)) end = fail_memory();
        gdal.OGR_F_Destroy(feature);
        if (end) return end;
    }
}

/* All layers have one coordinate system. */
static int collector_note_crs(constraint_collector *c, GDALDatasetH set, OGRLayerH layer,
                              const char *path)
{
    char *crs = crs_of_layer(set, layer), names[2][CRS_NAME];
    if (c->layers++ == 0) {
        c->file->crs = crs;
        return 0;
    }
    const char *first = c->file->crs;
    bool same = crs && first ? crs_same(crs, first) : !crs && !first;
    if (!same)
        complain("%s: its layers are in different coordinate systems: %s, and %s", path,
                 first ? crs_name(first, names[0]) : "one that is not known",
                 crs ? crs_name(crs, names[1]) : "one that is not known");
    free(crs);
    return same ? 0 : END_INPUT;
}

static bool layer_may_have_polygons(OGRLayerH layer)
{
    switch (gdal.OGR_GT_Flatten(gdal.OGR_L_GetGeomType(layer))) {
    case wkbPoint:
    case wkbMultiPoint:
    case wkbLineString:
    case wkbMultiLineString:
    case wkbCircularString:
    case wkbCompoundCurve:
    case wkbMultiCurve:
    case wkbNone: return false;
    default: return true;
    }
}

static bool layer_has_points(OGRLayerH layer)
{
    OGRwkbGeometryType type = gdal.OGR_GT_Flatten(gdal.OGR_L_GetGeomType(layer));
    return type == wkbPoint || type == wkbMultiPoint || type == wkbNone;
}

/* A file of GPX has a layer for everything that it could hold. */
static bool layer_has_features(OGRLayerH layer)
{
    gdal.OGR_L_ResetReading(layer);
    OGRFeatureH feature = gdal.OGR_L_GetNextFeature(layer);
    if (feature) gdal.OGR_F_Destroy(feature);
    gdal.OGR_L_ResetReading(layer);
    return feature != NULL;
}

static bool layer_is_wanted(const gdal_constraints_options *o, OGRLayerH layer)
{
    if (o->layer) return strcmp(gdal.OGR_L_GetName(layer), o->layer) == 0;
    if (o->lines) return !layer_has_points(layer) && layer_has_features(layer);
    return !o->polygons || (layer_may_have_polygons(layer) && layer_has_features(layer));
}

static int layers_fail(const gdal_constraints_options *o, GDALDatasetH set, const char *path)
{
    text names = {0};
    for (int i = 0; i < gdal.GDALDatasetGetLayerCount(set); i++) {
        OGRLayerH layer = gdal.GDALDatasetGetLayer(set, i);
        if (o->layer || layer_is_wanted(o, layer))
            text_printf(&names, "%s%s", names.size ? ", " : "", gdal.OGR_L_GetName(layer));
    }
    int size = names.size < 1000 ? (int)names.size : 1000;
    if (names.failed || names.size == 0)
        complain("%s: GDAL finds no layer in it", path);
    else if (o->layer)
        complain("%s: has no layer '%s'; it has: %.*s", path, o->layer, size, names.bytes);
    else
        complain("%s: which layer has the %s? %s may be one of: %.*s", path,
                 o->lines ? "lines" : "polygons", o->lines ? "--layer" : "--polygon-layer", size,
                 names.bytes);
    text_release(&names);
    return o->layer ? END_INPUT : END_USAGE;
}

static int collector_read_layers(constraint_collector *c, GDALDatasetH set, const char *path)
{
    int end = 0, wanted = 0, count = gdal.GDALDatasetGetLayerCount(set);
    bool one = c->options->layer || c->options->polygons || c->options->lines;
    for (int i = 0; i < count; i++)
        wanted += layer_is_wanted(c->options, gdal.GDALDatasetGetLayer(set, i));
    if (one && (c->options->layer ? wanted == 0 : wanted > 1))
        return layers_fail(c->options, set, path);
    for (int i = 0; end == 0 && i < count; i++) {
        OGRLayerH layer = gdal.GDALDatasetGetLayer(set, i);
        if (!layer_is_wanted(c->options, layer)) continue;
        end = collector_note_crs(c, set, layer, path);
        if (end == 0) end = collector_read_layer(c, layer, path);
    }
    return end;
}

int gdal_constraints_read(const char *path, const gdal_constraints_options *options,
                          mw_constraint_file *file)
{
    constraint_collector c = {.file = file, .options = options, .values = options->values};
    *file = (mw_constraint_file){.record_name = "feature"};
    if (!gdal_load()) {
        complain("%s: is neither GeoJSON nor .poly, and GDAL, which might read it, cannot be "
                 "loaded (" MW_GDAL ")",
                 path);
        return END_INPUT;
    }
    GDALDatasetH set = gdal.GDALOpenEx(
        path, GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, NULL, NULL, NULL);
    if (!set) return gdal_fail(path);
    int end = collector_read_layers(&c, set, path);
    file->record_count = c.feature;
    gdal.GDALClose(set);
    if (end == 0 && file->point_count == 0) {
        complain("%s: GDAL finds no %spolygons in it", path,
                 options->polygons ? ""
                 : options->lines  ? "lines or "
                                   : "points, lines or ");
        end = END_INPUT;
    }
    if (end) mw_constraint_file_release(file);
    return end;
}

#else

int gdal_constraints_read(const char *path, const gdal_constraints_options *options,
                          mw_constraint_file *file)
{
    (void)options;
    *file = (mw_constraint_file){0};
    complain("%s: the program was built without GDAL", path);
    return END_INPUT;
}

#endif
