/* contour_polygons.h - the parts of a mesh whose values lie between two levels.
 *
 * A value at a level counts as above it, as it does for the lines. So each point of the mesh has
 * one band, [level, next level), a triangle of equal values lies in one band whole, and polygons of
 * neighbouring bands share the lines of the level between them, point for point. */
#ifndef MW_CLI_LINES_CONTOUR_POLYGONS_H
#define MW_CLI_LINES_CONTOUR_POLYGONS_H

#include <meshwalk/meshwalk.h>

/* A connected part of a band. Its rings are simple, end with their first points, and meet one
 * another in points at most: the outline, counter-clockwise, then the holes. */
typedef struct contour_polygon {
    double low, high;     /* of the band: levels, or the least and the greatest value of the mesh */
    const double *points; /* x, y of the points of all rings */
    const size_t *first;  /* [ring]: number of its first point; one more for the end */
    size_t ring_count;
} contour_polygon;

/* Take a polygon, which is valid during the call. Returns 0, or an exit code after a complaint,
 * which ends the work. */
typedef int contour_polygon_sink(void *self, const contour_polygon *polygon);

/* Make the polygons of all bands, from the lowest on.
 *   mesh    an embedding without flat triangles
 *   values  one for each vertex; triangles with a NaN count as no part of the mesh
 *   levels  ascending
 * Returns 0, or an exit code after a complaint. */
int contour_polygons_make(const mw_mesh *mesh, const double *values, const double *levels,
                          size_t level_count, contour_polygon_sink *sink, void *self);

#endif
