/* GeoJSON [RFC 7946]: the geometries of all features. Properties, `bbox` and foreign
 * members are passed over, and so are geometries that are null or have no coordinates. The third
 * number of a position is z, further ones do not count. A ring that is not closed is closed. One of
 * fewer than three different points is skipped and listed; if it is the outer one, so is its
 * polygon. The text is parsed by Jansson. */
#include "io/constraints/geojson.h"
#include "io/text/crs_text.h"

#ifdef MW_JANSSON

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct geojson_reader {
    mw_constraint_builder *builder;
    uint32_t feature;  /* number of the present one */
    uint32_t polygons; /* how many of that one were read */
    mw_error *error;
} geojson_reader;

/* Something is wrong with the present feature. */
__attribute__((format(printf, 2, 3))) static mw_status geojson_fail(const geojson_reader *g,
                                                                    const char *format, ...)
{
    char message[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    mw__message_clean(message);
    return mw__fail(g->error, MW_ERROR_INPUT, "%.200s: feature %" PRIu32 ": %s",
                    mw__source_name(g->builder->source), g->feature, message);
}

/* x, y, and z where there is one. */
static mw_status geojson_read_position(const geojson_reader *g, const json_t *position,
                                       double xyz[3])
{
    size_t size = json_array_size(position); /* 0 of what is not an array */
    if (size < 2) return geojson_fail(g, "a position is not two or three numbers");
    xyz[2] = NAN;
    for (size_t k = 0; k < 3 && k < size; k++) {
        const json_t *number = json_array_get(position, k);
        if (!json_is_real(number)) return geojson_fail(g, "a coordinate is not a number");
        xyz[k] = json_real_value(number);
    }
    return MW_OK;
}

/* Adds the position as a point. */
static mw_status geojson_add_position(geojson_reader *g, const json_t *position)
{
    double xyz[3];
    mw_status status = geojson_read_position(g, position, xyz);
    if (!status) status = mw__constraint_point(g->builder, xyz, g->error);
    if (!status && !isnan(xyz[2])) g->builder->file->has_z = 1;
    return status;
}

static mw_status geojson_read_point(geojson_reader *g, const json_t *coordinates)
{
    return geojson_add_position(g, coordinates);
}

/* Points 0 ... count - 1 of an array of positions, and the segments between them. */
static mw_status geojson_read_chain(geojson_reader *g, const json_t *positions, size_t count,
                                    uint32_t polygon)
{
    mw_constraint_file *file = g->builder->file;
    mw_status status = MW_OK;
    for (size_t i = 0; !status && i < count; i++) {
        status = geojson_add_position(g, json_array_get(positions, i));
        uint32_t last = (uint32_t)file->point_count - 1;
        if (!status && i > 0)
            status =
                mw__constraint_segment(g->builder, last - 1, last, polygon, g->feature, g->error);
    }
    return status;
}

static mw_status geojson_read_line(geojson_reader *g, const json_t *coordinates)
{
    size_t count = json_array_size(coordinates);
    if (count < 2) return geojson_fail(g, "a line has fewer than two positions");
    return geojson_read_chain(g, coordinates, count, MW_NONE);
}

static bool same_xy(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

/* The number of positions of a ring, without those at its end that repeat the first; 0 if fewer
 * than three differ in x or y. */
static mw_status ring_count_open(const geojson_reader *g, const json_t *ring, size_t *count)
{
    double seen[2][3], p[3]; /* the first position, and one that differs from it */
    size_t size = json_array_size(ring), different = 0;
    *count = 0;
    if (!json_is_array(ring)) return geojson_fail(g, "a ring is not an array");
    for (size_t i = 0; i < size; i++) {
        mw_status status = geojson_read_position(g, json_array_get(ring, i), p);
        if (status) return status;
        if (i > 0 && same_xy(p, seen[0])) continue;
        *count = i + 1;
        if (different < 2)
            memcpy(seen[different++], p, sizeof p);
        else if (!same_xy(p, seen[1]))
            different = 3;
    }
    if (different < 3) *count = 0;
    return MW_OK;
}

/* The first `count` positions of a ring, 3 at least, closed. */
static mw_status geojson_add_ring(geojson_reader *g, const json_t *ring, size_t count,
                                  uint32_t polygon)
{
    mw_constraint_file *file = g->builder->file;
    mw_status status = geojson_read_chain(g, ring, count, polygon);
    if (status) return status;
    uint32_t last = (uint32_t)file->point_count - 1, first = (uint32_t)(file->point_count - count);
    return mw__constraint_segment(g->builder, last, first, polygon, g->feature, g->error);
}

static mw_status geojson_read_polygon(geojson_reader *g, const json_t *coordinates)
{
    mw_constraint_file *file = g->builder->file;
    mw_status status = MW_OK;
    size_t count = json_array_size(coordinates), positions;
    bool skipped = false; /* the polygon, for its outer ring; the others are checked all the same */
    for (size_t i = 0; !status && i < count; i++) {
        const json_t *ring = json_array_get(coordinates, i);
        status = ring_count_open(g, ring, &positions);
        if (!status && positions == 0) {
            skipped = skipped || i == 0;
            status = mw__constraint_skip(
                g->builder, (mw_skipped_ring){g->feature, g->polygons, (uint32_t)i}, g->error);
        } else if (!status && !skipped) {
            status = geojson_add_ring(g, ring, positions, (uint32_t)file->polygon_count);
        }
    }
    g->polygons++;
    if (!skipped) file->polygon_count++;
    return status;
}

static const struct {
    const char *type;
    bool many; /* the coordinates are an array of what `read` takes */
    mw_status (*read)(geojson_reader *g, const json_t *coordinates);
} shapes[] = {
    {"Point", false, geojson_read_point},     {"MultiPoint", true, geojson_read_point},
    {"LineString", false, geojson_read_line}, {"MultiLineString", true, geojson_read_line},
    {"Polygon", false, geojson_read_polygon}, {"MultiPolygon", true, geojson_read_polygon},
};
enum { SHAPE_COUNT = sizeof shapes / sizeof *shapes };

static mw_status geojson_read_coordinates(geojson_reader *g, size_t shape,
                                          const json_t *coordinates)
{
    if (!json_is_array(coordinates))
        return geojson_fail(g, "a %s has no array of coordinates", shapes[shape].type);
    size_t count = json_array_size(coordinates);
    mw_status status = MW_OK;
    if (count == 0) return MW_OK;
    if (!shapes[shape].many) return shapes[shape].read(g, coordinates);
    for (size_t i = 0; !status && i < count; i++) {
        const json_t *part = json_array_get(coordinates, i);
        status = json_is_array(part)
                     ? shapes[shape].read(g, part)
                     : geojson_fail(g, "a part of a %s is not an array", shapes[shape].type);
    }
    return status;
}

static mw_status geojson_read_geometry(geojson_reader *g, const json_t *geometry)
{
    if (!geometry || json_is_null(geometry)) return MW_OK;
    const char *type = json_string_value(json_object_get(geometry, "type"));
    if (!type) return geojson_fail(g, "a geometry has no type");
    for (size_t i = 0; i < SHAPE_COUNT; i++)
        if (strcmp(type, shapes[i].type) == 0)
            return geojson_read_coordinates(g, i, json_object_get(geometry, "coordinates"));
    if (strcmp(type, "GeometryCollection") != 0)
        return geojson_fail(g, "'%.40s' is not a geometry type", type);
    const json_t *parts = json_object_get(geometry, "geometries");
    if (!json_is_array(parts))
        return geojson_fail(g, "a GeometryCollection has no array of geometries");
    mw_status status = MW_OK;
    for (size_t i = 0; !status && i < json_array_size(parts); i++) /* Jansson bounds the depth */
        status = geojson_read_geometry(g, json_array_get(parts, i));
    return status;
}

static bool object_is_feature(const json_t *object)
{
    const char *type = json_string_value(json_object_get(object, "type"));
    return type && strcmp(type, "Feature") == 0;
}

static mw_status geojson_read_feature(geojson_reader *g, const json_t *feature)
{
    if (!object_is_feature(feature)) return geojson_fail(g, "its type is not 'Feature'");
    return geojson_read_geometry(g, json_object_get(feature, "geometry"));
}

static mw_status geojson_read_root(geojson_reader *g, const json_t *root)
{
    const char *type = json_string_value(json_object_get(root, "type"));
    if (!type)
        return mw__fail(g->error, MW_ERROR_INPUT,
                        "%.240s: this is JSON, but not GeoJSON: it has no type",
                        mw__source_name(g->builder->source));
    g->builder->file->record_count = 1;
    if (object_is_feature(root)) return geojson_read_feature(g, root);
    if (strcmp(type, "FeatureCollection") != 0) return geojson_read_geometry(g, root);
    const json_t *features = json_object_get(root, "features");
    if (!json_is_array(features))
        return mw__fail(g->error, MW_ERROR_INPUT,
                        "%.240s: the FeatureCollection has no array of features",
                        mw__source_name(g->builder->source));
    mw_status status = MW_OK;
    g->builder->file->record_count = json_array_size(features);
    for (size_t i = 0; !status && i < json_array_size(features); i++) {
        g->feature = (uint32_t)i;
        g->polygons = 0;
        status = geojson_read_feature(g, json_array_get(features, i));
    }
    return status;
}

/* Could these be longitudes and latitudes? */
static bool points_are_lonlat(const mw_constraint_file *file)
{
    for (size_t i = 0; i < file->point_count; i++)
        if (!(fabs(file->points[3 * i]) <= 360) || !(fabs(file->points[3 * i + 1]) <= 90))
            return false;
    return file->point_count > 0;
}

/* The coordinate system: that of the member `crs` [GeoJSON 2008], whose value null means unknown.
 * Without `crs` they are longitudes and latitudes [RFC 7946, 4], if the numbers are in range. */
static mw_status geojson_read_crs(geojson_reader *g, const json_t *root)
{
    mw_constraint_file *file = g->builder->file;
    const json_t *crs = json_object_get(root, "crs");
    const char *name =
        json_string_value(json_object_get(json_object_get(crs, "properties"), "name"));
    if (!crs && points_are_lonlat(file)) name = "EPSG:4326";
    return name ? mw__crs_copy(name, strlen(name), &file->crs, g->error) : MW_OK;
}

typedef struct geojson_input {
    mw_source *source;
    mw_status status; /* of the reading */
    mw_error *error;
} geojson_input;

/* Callback of Jansson: gives it the next bytes of the text. */
static size_t geojson_next_bytes(void *buffer, size_t size, void *data)
{
    geojson_input *in = data;
    const char *peeked;
    const unsigned char *bytes = NULL;
    size_t count = 0;
    if (size > MW_BYTES_LIMIT) size = MW_BYTES_LIMIT;
    in->status = mw__source_peek(in->source, size, &peeked, &count, in->error);
    if (!in->status) in->status = mw__source_bytes(in->source, count, &bytes, in->error);
    if (in->status) return (size_t)-1;
    memcpy(buffer, bytes, count);
    return count;
}

static mw_status geojson_skip_byte_order_mark(mw_source *source, mw_error *error)
{
    const char *head;
    size_t count;
    mw_status status = mw__source_peek(source, 3, &head, &count, error);
    if (status || count < 3 || memcmp(head, "\xef\xbb\xbf", 3) != 0) return status;
    return mw__source_skip(source, 3, error);
}

static mw_status geojson_parse(mw_source *source, json_t **root, mw_error *error)
{
    geojson_input in = {.source = source, .error = error};
    json_error_t wrong = {.line = 1};
    *root = NULL;
    mw_status status = geojson_skip_byte_order_mark(source, error);
    if (status) return status;
    *root = json_load_callback(geojson_next_bytes, &in, JSON_DECODE_INT_AS_REAL | JSON_ALLOW_NUL,
                               &wrong);
    if (in.status) return in.status;
    if (!*root && json_error_code(&wrong) == json_error_out_of_memory)
        return mw__fail_memory(error);
    uint64_t line = wrong.line > 0 ? (uint64_t)wrong.line : 1;
    if (source->damage) return mw__source_fail_at(source, line, error, "%s", source->damage);
    return *root ? MW_OK : mw__source_fail_at(source, line, error, "%s", wrong.text);
}

mw_status mw__read_geojson(mw_source *source, mw_constraint_builder *builder, mw_error *error)
{
    geojson_reader g = {.builder = builder, .error = error};
    json_t *root;
    builder->file->record_name = "feature";
    mw_status status = geojson_parse(source, &root, error);
    if (!status) status = geojson_read_root(&g, root);
    if (!status) status = geojson_read_crs(&g, root);
    json_decref(root);
    return status;
}

bool mw__geojson_known(void)
{
    return true;
}

#else

mw_status mw__read_geojson(mw_source *source, mw_constraint_builder *builder, mw_error *error)
{
    (void)builder;
    return mw__fail(error, MW_ERROR_INPUT,
                    "%.240s: GeoJSON is not read here: meshwalk was built without Jansson",
                    mw__source_name(source));
}

bool mw__geojson_known(void)
{
    return false;
}

#endif
