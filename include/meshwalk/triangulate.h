/* triangulate.h - Delaunay triangulation of points.
 *
 * Incremental insertion in spatial order with walking location [Bowyer 1981; Watson 1981; Amenta, Choi, Rote 2003],
 * exact: the result is a Delaunay triangulation of the given doubles, whatever their position. */
#ifndef MESHWALK_TRIANGULATE_H
#define MESHWALK_TRIANGULATE_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mw_triangulation_report {
    size_t points;          /* points given                                      */
    size_t duplicates;      /* points equal to an earlier one; in no triangle    */
    uint64_t triangles_visited; /* by the walks that located the points              */
} mw_triangulation_report;

/* Delaunay triangulation of n points as a mesh whose vertex i is point i, all triangles counter-clockwise.
 *   points        x, y of point i at points[i * stride] and the double after it; read during the call only
 *   stride        in doubles, 0 = 2
 *   duplicate_of  NULL, or n numbers: MW_NONE, or the lowest-numbered point with the same coordinates. Such points are
 *                 vertices of the mesh that no triangle uses
 *   report        NULL or filled
 * MW_ERROR_INPUT: fewer than three different points, all points on one line, or a coordinate that is not finite (the
 * error names the point as its vertex). Expected O(n log n) worst case for points in spatial order O(n). */
MW_API mw_status mw_delaunay(const double *points, size_t n, size_t stride, uint32_t *duplicate_of,
                             mw_triangulation_report *report, mw_mesh **out, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
