/* gdal_points.h - points from any vector file that GDAL reads, with their attributes, as a table.
 */
#ifndef MW_CLI_GDAL_GDAL_POINTS_H
#define MW_CLI_GDAL_GDAL_POINTS_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct gdal_points gdal_points;

/* Is this a file that GDAL reads, and no table of text or LAS? Its first bytes or its name tell. */
bool gdal_points_known(const char *path);

/* Open the layer with points: that of this name, or the only one that has any.
 *   layer  NULL: not given
 *   where  which features are read, in SQL; NULL: all
 * Returns 0, or an exit code after a complaint. Close it in both cases. */
int gdal_points_open(gdal_points **points, const char *path, const char *layer, const char *where);
void gdal_points_close(gdal_points *points); /* NULL is allowed */

/* The columns: x, y and, if the layer has heights, z; then the attributes. The texts last until it
 * is closed. */
void gdal_points_table(const gdal_points *points, mw_point_table *table);

/* How many first columns are coordinates: 2, or 3 if there is z. */
size_t gdal_points_coordinates(const gdal_points *points);

/* The coordinate system of the points, as WKT; NULL: not known. */
const char *gdal_points_crs(const gdal_points *points);

/* Read up to `capacity` points, x, y and, if `width` is 3, z each; NaN where a feature has none.
 * *count is 0 at the end. Returns 0, or an exit code after a complaint. */
int gdal_points_read(gdal_points *points, double *values, size_t width, size_t capacity,
                     size_t *count);

/* The row of a point of the block read last, as CSV. */
const char *gdal_points_row(const gdal_points *points, size_t row, size_t *length);

#endif
