/* face_cut.h - cutting a face with many corners into triangles. Private.
 *
 *     d-------c     A quadrilateral is cut along its shorter diagonal, of two equal ones along that
 *     |     / |     with the lowest vertex number; a convex face with more corners into a fan
 *     |  /    |     from its lowest-numbered vertex. Corners may lie on a straight line between
 *     a-------b     their neighbours; then a cut without flat triangles is preferred.
 *
 * So the triangles depend only on the vertices and their numbers, not on the corner that a file
 * names first or on its format. Convexity is decided in the plane x, y if the face has an area
 * there and is convex; otherwise in the coordinate plane where its area is largest. A quadrilateral
 * in space, with corners at different z, need not be convex: it is cut along the diagonal at which
 * it folds less. Turns are decided exactly. */
#ifndef MW_SRC_IO_MESH_FACE_CUT_H
#define MW_SRC_IO_MESH_FACE_CUT_H

#include "base/base.h"

/* Cut a face of at least three corners; `triangles` receives three vertices for each of count - 2
 * triangles, which turn as the face does. `points` holds x, y, z of every vertex. Returns false if
 * the face is not convex, so that it cannot be cut in this way. A face without area, or with
 * coordinates that are not finite, is cut as a fan; later checks find the defect in its triangles.
 */
bool mw__face_cut(const double *points, const uint32_t *corners, size_t count, uint32_t *triangles);

#endif
