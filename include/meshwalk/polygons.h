/**
 * @file polygons.h
 * Which polygons contain a point.
 *
 * The rings of all polygons are forced into one triangulation as constraints, and each triangle
 * knows the polygons that cover it. A query is a walk in that triangulation, by any locator, walk
 * or start of locate.h:
 *
 *     mw_polygons_create(&rings, NULL, &polygons, &error);
 *     mw_locator_create(mw_polygons_mesh(polygons), NULL, &locator, &error);
 *     mw_locate_batch(locator, points, n, 2, NULL, locations, NULL, &error);
 *     count = mw_polygons_at(polygons, &points[2 * i], &locations[i], hits, capacity);
 *
 * Exact, also where polygons overlap and their rings cross: nothing is rounded, as segments that
 * cross others stay whole, and the few triangles that they pass through ask on which side of them
 * the point lies.
 */
#ifndef MESHWALK_POLYGONS_H
#define MESHWALK_POLYGONS_H

#include <meshwalk/locate.h>
#include <meshwalk/triangulate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Polygons that are ready for queries. Const while they are queried: threads may share them. */
typedef struct mw_polygons mw_polygons;

/** How polygons are prepared. All zero = the defaults. */
typedef struct mw_polygons_options {
    uint32_t threads;            /**< for the Delaunay triangulation; 0: one per processor */
    const mw_progress *progress; /**< who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[5];
} mw_polygons_options;

/**
 * Prepare polygons for queries.
 *
 * A point is inside a polygon if every way from it to infinity crosses the polygon's segments an
 * odd number of times (even-odd rule), and on its border if it lies on one of them. So rings may
 * come in any order and direction, a hole is a ring inside another, and islands in holes are
 * inside again. Where rings of one polygon cross, or run along one another, the rule still
 * decides; mw_polygons_crossing names these polygons.
 *
 * @param rings    points and segments; `polygon` tells the polygon of each segment, any number
 *                 below MW_NONE. Segments of MW_NONE, and those with equal ends, bound nothing. No
 *                 seed points of holes. Read during the call only
 * @param options  NULL = all zero
 * @param out      set to the polygons, owned by the caller (mw_polygons_destroy), or to NULL on
 *                 failure
 * @return MW_OK; MW_ERROR_INPUT: no polygon, one whose rings are not closed (the error names a
 *         point where one ends as its vertex), fewer than three different points, all points on
 *         one line, a coordinate that is not finite; MW_ERROR_ARGUMENT: NULL for an array that
 *         should have members, a stride of 1, a segment that names no point, seed points;
 *         MW_ERROR_LIMIT as of mw_constrained_delaunay; MW_ERROR_MEMORY; MW_CANCELLED
 *
 * Thread-safe. Time and memory are those of mw_constrained_delaunay, and in proportion to the
 * triangles that segments pass through behind their first crossing, and to the polygons that cover
 * each face of the plane. Source: constrained triangulation [Lee, Lin 1986; Chew 1989]; the
 * even-odd rule [Shimrat 1962], as a label of triangles.
 */
MW_API mw_status mw_polygons_create(const mw_constraints *rings, const mw_polygons_options *options,
                                    mw_polygons **out, mw_error *error);
/** Destroy polygons. NULL is allowed. */
MW_API void mw_polygons_destroy(mw_polygons *polygons);

/** The triangulation in which points are located: it fills the convex hull, and its vertex i is
 * point i.
 * @return owned by the polygons. Thread-safe. */
MW_API const mw_mesh *mw_polygons_mesh(const mw_polygons *polygons);

/** A polygon that a point lies in. */
typedef struct mw_polygon_hit {
    uint32_t polygon; /**< its number, as in `rings`                    */
    uint32_t border;  /**< 1: the point is on its border; 0: inside it */
} mw_polygon_hit;

/**
 * List the polygons that contain a point, or have it on their border.
 *
 * @param point     x, y
 * @param location  of the point in mw_polygons_mesh, from any locator; of a point outside, near or
 *                  bad nothing is listed
 * @param hits      room for `capacity`, or NULL if that is 0; in ascending order of the polygons'
 *                  numbers
 * @return how many there are, which may be more than `capacity`
 *
 * Thread-safe; no allocation, no failure. Time in proportion to the result and to the segments
 * that pass through the triangle uncut.
 */
MW_API size_t mw_polygons_at(const mw_polygons *polygons, const double point[2],
                             const mw_location *location, mw_polygon_hit *hits, size_t capacity);

/**
 * Name the polygons whose own segments cross each other, or run along each other.
 *
 * @param polygons_found  room for `capacity` numbers, or NULL if that is 0; ascending
 * @return how many there are, which may be more than `capacity`. Thread-safe.
 */
MW_API size_t mw_polygons_crossing(const mw_polygons *polygons, uint32_t *polygons_found,
                                   size_t capacity);

/** What was prepared. */
typedef struct mw_polygons_info {
    uint32_t polygons;
    size_t crossing_segments; /**< segments that stay whole, as they cross others                */
    size_t passages;          /**< triangles that these pass through, each counted for each      */
    uint32_t sets;            /**< different sets of covering polygons, the empty one too */
    size_t bytes;             /**< all memory, the mesh not counted                              */
    uint32_t reserved[6];
} mw_polygons_info;
/** Fill `info` with the sizes of prepared polygons. O(1). */
MW_API void mw_polygons_describe(const mw_polygons *polygons, mw_polygons_info *info);

#ifdef __cplusplus
}
#endif
#endif
