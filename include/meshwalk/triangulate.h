/* triangulate.h - Delaunay triangulation of points.
 *
 * Points are inserted one by one, in random rounds along a Hilbert curve [Amenta, Choi, Rote 2003], each by a walk from
 * the one before, a split and flips [Lawson 1977]. Exact: the result is a Delaunay triangulation of the given doubles,
 * whatever their position. Where more than three points lie on an empty circle there are several, and the order of the
 * points decides which one is made. */
#ifndef MESHWALK_TRIANGULATE_H
#define MESHWALK_TRIANGULATE_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mw_triangulation_report {
    size_t points;              /* points given                                      */
    size_t duplicates;          /* points equal to an earlier one; in no triangle    */
    uint64_t triangles_visited; /* by the walks that located the points              */
} mw_triangulation_report;

/* Delaunay triangulation of n points as a mesh whose vertex i is point i, all triangles counter-clockwise.
 *   points        x, y of point i at points[i * stride] and the double after it; read during the call only
 *   stride        in doubles, 0 = 2
 *   duplicate_of  NULL, or n numbers: MW_NONE, or the lowest-numbered point with the same coordinates. Such points are
 *                 vertices of the mesh that no triangle uses
 *   report        NULL or filled
 *   out           set to the mesh, owned by the caller (mw_mesh_destroy), or to NULL on failure. Its triangles are
 *                 numbered along a Hilbert curve
 * MW_ERROR_INPUT: fewer than three different points, all points on one line, or a coordinate that is not finite (the
 * error names the point as its vertex). MW_ERROR_ARGUMENT: NULL, or a stride of 1; MW_ERROR_LIMIT: over 2^29 points;
 * MW_ERROR_MEMORY: about 135 bytes per point are needed on the way, 80 of them for the mesh. The expected number of
 * triangles made is O(n log n) wherever the points lie; time is about linear. One thread; thread-safe. */
MW_API mw_status mw_delaunay(const double *points, size_t n, size_t stride, uint32_t *duplicate_of,
                             mw_triangulation_report *report, mw_mesh **out, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
