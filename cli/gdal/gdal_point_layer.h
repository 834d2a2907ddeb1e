/* gdal_point_layer.h - the layer with points of a vector file that GDAL reads. */
#ifndef MW_CLI_GDAL_GDAL_POINT_LAYER_H
#define MW_CLI_GDAL_GDAL_POINT_LAYER_H

#include "cli/gdal/gdal_library.h"

#include <stddef.h>

/* Is this a file that GDAL reads, and no table of text or LAS? Its first bytes or its name tell. */
bool point_layer_known(const char *path);

/* Refuse files whose names want a driver that this GDAL does not have, before anything is read.
 * NULL is allowed among the paths. Returns 0, or an exit code after a complaint. */
int point_layers_check(const char *const *paths, int count);

#ifdef MW_GDAL

typedef struct point_layer {
    const gdal_functions *gdal;
    const char *path;
    GDALDatasetH set;
    OGRLayerH layer;
    size_t coordinates, column_count; /* x, y and perhaps z are the first columns */
    char **names;
    char *crs; /* WKT; NULL: not known */
} point_layer;

/* The functions with a result of type int return 0, or an exit code after a complaint. */

/* Open the layer with points: that of this name, or the only one that has any.
 *   layer  NULL: not given
 *   where  which features are read, in SQL; NULL: all
 * Release it also after a failure. */
int point_layer_open(point_layer *p, const char *path, const char *layer, const char *where);
void point_layer_release(point_layer *p);

/* The next feature, to be destroyed; NULL: none, at the end or with *end set after a complaint. */
OGRFeatureH point_layer_next(const point_layer *p, int *end);

/* The geometry of a feature; NULL: it has none, or *end is set after a complaint. */
OGRGeometryH point_layer_geometry(const point_layer *p, OGRFeatureH feature, int *end);

/* The coordinates of a geometry that is a point: NaN where it has none. */
void point_layer_take(const point_layer *p, OGRGeometryH point, double at[3]);

/* Complain that a feature is no point; that GDAL fails, or else says `what`. */
int point_layer_fail_geometry(const point_layer *p, OGRFeatureH feature, OGRGeometryH geometry);
int point_layer_fail(const point_layer *p, const char *what);

#endif

#endif
