/**
 * @file segment.h
 * Which triangles of a planar mesh lie along a straight segment.
 *
 * A walk along a segment from a to b lists its pieces in order. A point of the segment has the
 * parameter t: it is a + t (b - a), so that a has 0 and b has 1. The rules:
 *
 * - A piece is a maximal part of the segment, of positive length, that belongs to one triangle:
 *   mw_locate() returns this triangle for all points of the piece except finitely many. So a part
 *   along an edge belongs to the lower-numbered of the two triangles at that edge, and every part
 *   belongs to one piece only.
 * - Parts in holes, in pockets and outside the mesh belong to no piece. A segment may leave the
 *   mesh and enter it again as often as it likes, also in another connected component.
 * - A triangle that the segment touches in one point only has no piece.
 * - If a equals b, the segment is a point. It has one piece, from 0 to 0, if mw_locate() finds a
 *   triangle for it.
 *
 * All of this is decided exactly. Parameters are doubles: each is off by less than 2^-40 of itself
 * (or by less than the smallest normal double), and they never decrease along the segment. Where a
 * piece begins at the end of the piece before it, both have the same double.
 *
 * The locator has to fill pockets and holes, as it does by default (MW_FILL_YES if few queries were
 * announced), and its mesh has to be an embedding.
 */
#ifndef MESHWALK_SEGMENT_H
#define MESHWALK_SEGMENT_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Where in its triangle a piece begins or ends; edges and vertices as the caller numbers them. */
enum {
    MW_AT_EDGE = 0,   /**< 0, 1, 2: on that local edge, not at a vertex */
    MW_AT_VERTEX = 3, /**< 3, 4, 5: at local vertex 0, 1, 2 */
    MW_AT_INSIDE = 6  /**< inside: the segment begins or ends there */
};

/** A part of a segment, in one triangle. */
typedef struct mw_segment_piece {
    double from, to;   /**< parameters, from <= to; equal only if rounding makes them so */
    uint32_t triangle; /**< the caller's number */
    uint8_t from_at;   /**< where it begins: an edge, MW_AT_VERTEX + a vertex, or MW_AT_INSIDE */
    uint8_t to_at;     /**< where it ends */
    uint8_t along;     /**< the local edge that the piece runs along, or 255 */
    uint8_t gap;       /**< 1: the segment is in no triangle just before this piece */
} mw_segment_piece;

/**
 * A walk along a segment: a plain value that may be copied. All members are private.
 *
 * It is valid as long as its locator exists; for an editor's locator, until the next edit.
 */
typedef struct mw_segment {
    const mw_locator *locator;
    double a[2], b[2];
    double at;     /* parameter of the point reached */
    uint32_t tile; /* the tile that the segment enters there, or that has the vertex */
    uint8_t local; /* edge or vertex of that tile */
    uint8_t phase; /* what is reached */
    uint8_t gap;   /* 1: the last part was in no triangle */
    uint8_t held;  /* 1: `piece` is the next result */
    uint8_t reserved[8];
    mw_segment_piece piece;
} mw_segment;

/**
 * Begin a walk along a segment.
 *
 * @param locator  a locator that fills pockets and holes, of an embedding; it must outlive the walk
 * @param cursor   a cursor of this locator: says how the first triangle is found, and remembers it
 * @param a        x, y of the beginning
 * @param b        x, y of the end
 * @param segment  receives the walk
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a locator whose pockets and holes are open or whose
 *         mesh is not an embedding; MW_ERROR_INPUT if a coordinate is not finite.
 *
 * Thread-safe with one cursor per thread. Memory and time: those of a query (mw_locate()); if a is
 * outside the convex hull, also proportional to the hull edges that the search passes.
 */
MW_API mw_status mw_segment_begin(const mw_locator *locator, mw_cursor *cursor, const double a[2],
                                  const double b[2], mw_segment *segment, mw_error *error);

/**
 * Begin the next part of a polyline: a walk from the end of the last segment to another point. It
 * starts in the triangle where the last walk ended.
 *
 * @param segment  a walk, preferably at its end; receives the new walk
 * @param b        x, y of the new end
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL; MW_ERROR_INPUT if a coordinate is not finite: then the
 *         walk is unchanged.
 *
 * Thread-safe on different walks. No allocation. Time: as mw_segment_begin(), but without the walk
 * to the first triangle.
 */
MW_API mw_status mw_segment_continue(mw_segment *segment, const double b[2], mw_error *error);

/**
 * Find the next piece of a segment.
 *
 * @param segment  a walk
 * @param piece    receives the piece; unchanged at the end
 * @return 1, or 0 at the end.
 *
 * Thread-safe on different walks. No allocation. O(1) for each triangle, ghost triangles of pockets
 * and holes included; at a vertex on the segment, proportional to its degree.
 */
MW_API int mw_segment_next(mw_segment *segment, mw_segment_piece *piece);

/** Options of mw_segment_batch(). Zero-initialised options select the defaults. */
typedef struct mw_segment_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    uint32_t reserved[3];        /**< must be zero */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
} mw_segment_options;

/** The pieces of many segments. Release with mw_segment_pieces_release(). */
typedef struct mw_segment_pieces {
    size_t *offset;          /**< segment i has the pieces offset[i] up to offset[i + 1] - 1 */
    mw_segment_piece *piece; /**< all pieces, in the order of the segments */
    size_t segment_count;    /**< offset has one more */
    size_t piece_count;
    size_t bad_count; /**< segments with a coordinate that is not finite; they have no pieces */
} mw_segment_pieces;

/**
 * List the pieces of n segments.
 *
 * @param locator   as for mw_segment_begin()
 * @param segments  x, y of the beginning and x, y of the end of segment i at segments[i * stride]
 *                  and the three doubles after it
 * @param n         number of segments
 * @param stride    doubles from one segment to the next; 0 means 4. With 2, n + 1 packed points are
 *                  a polyline of n segments
 * @param options   NULL selects the defaults
 * @param pieces    receives the pieces, equal for every number of threads; empty on failure
 * @param error     NULL, or receives the message of a failure
 * @return MW_OK, also if a coordinate is not finite (bad_count); MW_ERROR_ARGUMENT for NULL, a
 *         stride of 1 or 3, and as mw_segment_begin(); MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. Time: proportional to the triangles that the segments pass, and a query for each
 * segment that does not begin where the previous one ends.
 */
MW_API mw_status mw_segment_batch(const mw_locator *locator, const double *segments, size_t n,
                                  size_t stride, const mw_segment_options *options,
                                  mw_segment_pieces *pieces, mw_error *error);
/** Release the pieces of segments. Zero-initialised pieces are allowed. */
MW_API void mw_segment_pieces_release(mw_segment_pieces *pieces);

/**
 * Compute the point where a piece begins or ends, and its weights for interpolation.
 *
 * A field interpolated by these weights has the same value, bit for bit, on both pieces that meet
 * at a point, because both use only the vertices of the edge or vertex between them. Exception: a
 * flat triangle that joins a vertex to the inside of an edge, where the field jumps.
 *
 * @param mesh    the mesh of the locator
 * @param a       beginning of the segment, as it was given
 * @param b       end of the segment
 * @param piece   a piece of that segment
 * @param end     0: where the piece begins; 1: where it ends
 * @param weight  receives the weights of the triangle's vertices: at least 0, sum 1 up to rounding,
 *                exactly 0 for a vertex off the edge that the point is on
 * @param point   NULL, or receives x, y: a, b or a vertex as it is, else rounded
 *
 * Thread-safe. O(1), no allocation.
 */
MW_API void mw_segment_weights(const mw_mesh *mesh, const double a[2], const double b[2],
                               const mw_segment_piece *piece, int end, double weight[3],
                               double point[2]);

#ifdef __cplusplus
}
#endif
#endif
