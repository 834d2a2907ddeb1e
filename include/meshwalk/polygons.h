/**
 * @file polygons.h
 * Which polygons contain a point.
 *
 * The rings of all polygons become constraints of one triangulation, and each triangle records the
 * polygons that cover it. A query is a walk in that triangulation, with any locator, walk or start
 * of locate.h:
 *
 *     mw_polygons_create(&rings, NULL, &polygons, &error);
 *     mw_locator_create(mw_polygons_mesh(polygons), NULL, &locator, &error);
 *     mw_locate_batch(locator, points, n, 2, NULL, locations, NULL, &error);
 *     count = mw_polygons_at(polygons, &points[2 * i], &locations[i], hits, capacity);
 *
 * Answers are exact, also where polygons overlap and rings cross. Nothing is rounded: a segment
 * that crosses others is not divided. In the few triangles that such a segment passes through, the
 * query decides on which side of the segment the point lies.
 */
#ifndef MESHWALK_POLYGONS_H
#define MESHWALK_POLYGONS_H

#include <meshwalk/locate.h>
#include <meshwalk/triangulate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Polygons prepared for queries. Opaque; any number of threads may query them. */
typedef struct mw_polygons mw_polygons;

/** Options of mw_polygons_create(). Zero-initialised options select the defaults. */
typedef struct mw_polygons_options {
    uint32_t threads;            /**< for the Delaunay triangulation; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_polygons_options;

/**
 * Prepare polygons for queries.
 *
 * A point is inside a polygon if a path from it to infinity crosses the polygon's segments an odd
 * number of times (even-odd rule). It is on the border if it lies on a segment. So rings may come
 * in any order and direction; a ring inside another is a hole, and a ring inside a hole is an
 * island. The rule also holds if rings of one polygon cross or overlap; mw_polygons_crossing()
 * lists such polygons.
 *
 * @param rings    points and segments; `polygon` holds the polygon of each segment, any number
 *                 below MW_NONE. Segments of MW_NONE, and segments with equal ends, are ignored.
 *                 Hole seeds are not accepted. Read during the call only
 * @param options  NULL selects the defaults
 * @param out      receives the polygons, owned by the caller (mw_polygons_destroy()); NULL on
 *                 failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT: no polygon, an open ring (the error names, as its vertex, a point
 *         where it ends), fewer than three different points, all points on one line, a coordinate
 *         that is not finite; MW_ERROR_ARGUMENT: NULL for an array that should have members, a
 *         stride of 1, a segment whose point does not exist, hole seeds; MW_ERROR_LIMIT as for
 *         mw_constrained_delaunay(); MW_ERROR_MEMORY; MW_CANCELLED
 *
 * Thread-safe. Time and memory: those of mw_constrained_delaunay(), and in addition proportional to
 * the triangles that segments pass through after their first crossing, and to the number of
 * polygons that cover each face of the plane. Source: constrained triangulation [Lee, Lin 1986;
 * Chew 1989]; the even-odd rule [Shimrat 1962], as a label of triangles.
 */
MW_API mw_status mw_polygons_create(const mw_constraints *rings, const mw_polygons_options *options,
                                    mw_polygons **out, mw_error *error);
/** Destroy polygons. NULL is allowed. */
MW_API void mw_polygons_destroy(mw_polygons *polygons);

/**
 * Give the triangulation in which points are located. It fills the convex hull; its vertex i is
 * point i of the rings.
 *
 * @param polygons  the polygons
 * @return the mesh, owned by the polygons.
 *
 * Thread-safe. O(1).
 */
MW_API const mw_mesh *mw_polygons_mesh(const mw_polygons *polygons);

/** A polygon that a point lies in. */
typedef struct mw_polygon_hit {
    uint32_t polygon; /**< its number, as in `rings` */
    uint32_t border;  /**< 1: the point is on its border; 0: inside */
} mw_polygon_hit;

/**
 * List the polygons that contain a point, inside or on their border.
 *
 * @param polygons  the polygons
 * @param point     x, y
 * @param location  the location of the point in mw_polygons_mesh(), from any locator. Nothing is
 *                  listed for MW_OUTSIDE, MW_NEAR and MW_BAD
 * @param hits      receives at most `capacity` polygons, in ascending order; may be NULL if
 *                  `capacity` is 0
 * @param capacity  room in `hits`
 * @return how many there are, which may be more than `capacity`
 *
 * Thread-safe; no allocation, no failure. Time is proportional to the result and to the undivided
 * segments that pass through the triangle.
 */
MW_API size_t mw_polygons_at(const mw_polygons *polygons, const double point[2],
                             const mw_location *location, mw_polygon_hit *hits, size_t capacity);

/**
 * List the polygons whose own segments cross or overlap.
 *
 * @param polygons        the polygons
 * @param polygons_found  receives at most `capacity` polygons, in ascending order; may be NULL if
 *                        `capacity` is 0
 * @param capacity        room in `polygons_found`
 * @return how many there are, which may be more than `capacity`.
 *
 * Thread-safe. O(polygons).
 */
MW_API size_t mw_polygons_crossing(const mw_polygons *polygons, uint32_t *polygons_found,
                                   size_t capacity);

/** Sizes of prepared polygons. */
typedef struct mw_polygons_info {
    uint32_t polygons;
    size_t crossing_segments; /**< segments that cross others and are not divided */
    size_t passages;          /**< triangles that these pass through, counted for each segment */
    uint32_t sets;            /**< different sets of covering polygons, with the empty set */
    size_t bytes;             /**< memory in bytes, without the mesh */
    uint32_t reserved[6];
} mw_polygons_info;
/** Fill `info` with the sizes of prepared polygons. Thread-safe. O(1). */
MW_API void mw_polygons_describe(const mw_polygons *polygons, mw_polygons_info *info);

#ifdef __cplusplus
}
#endif
#endif
