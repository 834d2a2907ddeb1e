/**
 * @file triangulate.h
 * Triangulations of points, with and without constraints.
 *
 * Delaunay triangulations are exact for the given doubles, in any position. Points are inserted
 * one by one, in random rounds along a Hilbert curve [Amenta, Choi, Rote 2003]: a walk from the
 * previous point, a split, and flips [Lawson 1977]. Many points are divided into patches, which
 * threads triangulate separately and merge [Guibas, Stolfi 1985]. If more than three points lie on
 * an empty circle, several Delaunay triangulations exist; the order of the points decides, not the
 * number of threads.
 */
#ifndef MESHWALK_TRIANGULATE_H
#define MESHWALK_TRIANGULATE_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a Delaunay triangulation did. */
typedef struct mw_delaunay_report {
    size_t points;              /**< points given */
    size_t duplicates;          /**< points equal to an earlier one; they are in no triangle */
    uint64_t triangles_visited; /**< by the walks that located the points */
} mw_delaunay_report;

/** Options of a Delaunay triangulation. Zero-initialised options select the defaults. */
typedef struct mw_delaunay_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_delaunay_options;

/**
 * Triangulate points by Delaunay's rule.
 *
 * Vertex i of the mesh is point i. All triangles are counter-clockwise and numbered along a Hilbert
 * curve. The result is the same for any number of threads.
 *
 * @param points        x, y of point i at points[i * stride] and the double after it; read during
 *                      the call
 * @param n             number of points
 * @param stride        doubles from one point to the next; 0 means 2
 * @param options       NULL selects the defaults
 * @param duplicate_of  NULL, or receives n numbers: the lowest point with the same coordinates if
 *                      there is an earlier one, else MW_NONE. Duplicates are vertices of no
 *                      triangle
 * @param report        NULL, or receives what was done
 * @param out           receives the mesh, owned by the caller (mw_mesh_destroy()); NULL on failure
 * @param error         NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT for fewer than three different points, collinear points, or a
 *         coordinate that is not finite (the error names the point as its vertex);
 *         MW_ERROR_ARGUMENT for NULL or a stride of 1; MW_ERROR_LIMIT for more than 2^29 points;
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. About linear time; O(n log n) triangles are made, expected, for any points. Needs
 * about 150 bytes per point, 80 of them for the mesh.
 */
MW_API mw_status mw_delaunay(const double *points, size_t n, size_t stride,
                             const mw_delaunay_options *options, uint32_t *duplicate_of,
                             mw_delaunay_report *report, mw_mesh **out, mw_error *error);

/* --- other kinds of triangulation ---------------------------------------------------------------
 */

/** The kinds of triangulation: kinds.def lists them. */
typedef enum mw_triangulation_kind {
#define MW_KIND_ENTRY(id, symbol, name, source, help) MW_KIND_##id,
#include <meshwalk/kinds.def>
    MW_KIND_COUNT
} mw_triangulation_kind;

/** The name of a kind, as on the command line; NULL for any other number. Thread-safe. */
MW_API const char *mw_kind_name(mw_triangulation_kind kind);
/** Where a kind was published, "Authors Year"; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_kind_source(mw_triangulation_kind kind);
/** One line of help for a kind; NULL for any other number. Thread-safe. O(1). */
MW_API const char *mw_kind_help(mw_triangulation_kind kind);

/** Properties of a triangulation of any kind. */
typedef struct mw_kind_report {
    mw_delaunay_report delaunay; /**< of the Delaunay triangulation that each kind starts from */
    double edge_length;          /**< sum of the edge lengths, each edge once; rounded */
    double largest_angle;        /**< in radians; rounded */
    /** 1: the optimum of its kind, up to rounding where mw_triangulate() says so. 0: a local
     * optimum. */
    int optimal;
    /** MW_KIND_MIN_WEIGHT: faces with more than three corners left by the skeleton. */
    size_t faces;
    size_t largest_face; /**< the most corners of one of them */
    size_t local_faces;  /**< of them, those too large or not simple: filled by a local optimum */
    size_t hidden;       /**< MW_KIND_REGULAR: hidden points, without those equal to a vertex */
    uint32_t reserved[6];
} mw_kind_report;

/** Options of mw_triangulate(). Zero-initialised options select the defaults. */
typedef struct mw_kind_options {
    /** How far to search for the optimum. 0: for about half a minute, with memory proportional to
     * the points. Any other number, without a limit on time and memory: MW_KIND_MIN_WEIGHT fills
     * faces of up to `limit` corners optimally; MW_KIND_MIN_MAX_ANGLE seeks the optimum for up to
     * `limit` points. */
    uint32_t limit;
    /** For the Delaunay triangulation at the start; 0: one per processor. */
    uint32_t threads;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    const double *weights;       /**< MW_KIND_REGULAR: one per point; NULL: all are 0 */
    /** MW_KIND_REGULAR: NULL, or receives per point 1 if it is hidden, else 0; set on success
     * only. */
    uint8_t *hidden;
    uint32_t reserved[4]; /**< must be zero */
} mw_kind_options;

/**
 * Triangulate points by any kind of rule.
 *
 * MW_KIND_GREEDY takes edges by increasing length (compared exactly; equal ones by the lower, then
 * the higher end) unless they cross an earlier edge. For scattered points it is about as fast as
 * sorting. A vertex from which thousands of others are visible takes time quadratic in its degree.
 * 200 bytes per point.
 *
 * MW_KIND_MIN_WEIGHT minimises the sum of edge lengths. Sums are compared in doubles, so of
 * triangulations that differ in the last digits any may result. Faces that are too large for
 * dynamic programming, or that contain points, get a local optimum: no exchange of the diagonal of
 * a quadrilateral shortens it, and it is no longer than MW_KIND_GREEDY, up to rounding. About 70
 * us and 700 bytes per scattered point, at most 3000 bytes per point.
 *
 * MW_KIND_MIN_MAX_ANGLE minimises the largest angle, compared exactly. The result is a local
 * optimum: no exchange of a diagonal makes the largest angle of its quadrilateral smaller. If
 * `optimal`, its largest angle is the least possible. About 10 us per scattered point; the
 * exchanges that lead to the local optimum have no bound on time.
 *
 * MW_KIND_REGULAR takes weighted points: circles round the points, with the weight as the square of
 * the radius. Point x of weight w is lifted to the height |x|^2 - w; the triangles are the lower
 * hull of the lifted points. Exact. A point above that hull is hidden: a vertex of no triangle. Of
 * points with equal coordinates only the heaviest, and of these the lowest, can be a corner. For a
 * point on the hull that is no corner, the order of insertion decides whether it is hidden. Equal
 * weights give a Delaunay triangulation. About 2 us and 250 bytes per point.
 *
 * docs/proofs/optimal-triangulations.md says what is optimal and what makes it slow.
 *
 * @param kind          the kind
 * @param points        as for mw_delaunay()
 * @param n             number of points
 * @param stride        doubles from one point to the next; 0 means 2
 * @param options       NULL selects the defaults
 * @param duplicate_of  as for mw_delaunay(); unspecified on failure
 * @param report        NULL, or receives the properties on success
 * @param out           receives the mesh, owned by the caller (mw_mesh_destroy()); NULL on failure
 * @param error         NULL, or receives the message of a failure
 * @return as mw_delaunay(); also MW_ERROR_ARGUMENT for an unknown kind, and MW_ERROR_INPUT for a
 *         weight that is not finite (the error names the point as its vertex).
 *
 * Thread-safe. One thread after the Delaunay triangulation.
 */
MW_API mw_status mw_triangulate(mw_triangulation_kind kind, const double *points, size_t n,
                                size_t stride, const mw_kind_options *options,
                                uint32_t *duplicate_of, mw_kind_report *report, mw_mesh **out,
                                mw_error *error);

/* --- constraints ------------------------------------------------------------------------------ */

/** Points, and the segments that must be edges of their triangulation. Read during the call only.
 */
typedef struct mw_constraints {
    const double *points; /**< x, y of point i at points[i * stride] and the double after it */
    size_t point_count;
    size_t stride;            /**< doubles from one point to the next; 0 means 2 */
    const uint32_t *segments; /**< two points per segment; a segment with equal ends is ignored */
    size_t segment_count;
    /** NULL, or per segment the polygon whose ring it belongs to; MW_NONE: a line, which bounds
     * nothing. A point is inside a polygon if a ray from it crosses an odd number of the polygon's
     * segments. So rings may come in any order and direction: outlines, holes, islands in holes. A
     * segment given twice counts twice. */
    const uint32_t *polygon;
    /** x, y of a point in each region to remove, packed. A point outside removes nothing, and is
     * counted in mw_constrain_report.idle_holes; a point on a constraint removes the regions on all
     * its sides. */
    const double *hole_seeds;
    size_t hole_seed_count;
} mw_constraints;

/** Which triangles of the convex hull are kept. */
typedef enum mw_keep {
    MW_KEEP_AUTO = 0, /**< as INSIDE if there are polygons or hole seeds, else as HULL */
    MW_KEEP_HULL,     /**< all triangles, holes too */
    /** With polygons: triangles inside at least one of them. Without: triangles that segments
     * separate from the outside. Either way without those that a hole seed reaches. */
    MW_KEEP_INSIDE
} mw_keep;

/** Options of mw_constrained_delaunay(). Zero-initialised options select the defaults. */
typedef struct mw_constrain_options {
    mw_keep keep;
    /** 1: where segments cross, add a vertex, rounded, and split them. 0: crossing segments are an
     * error. */
    int split;
    /** For the Delaunay triangulation of the points; 0: one per processor. */
    uint32_t threads;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[3];        /**< must be zero */
} mw_constrain_options;

/** What a constrained triangulation did. */
typedef struct mw_constrain_report {
    mw_delaunay_report delaunay; /**< of the points without the constraints */
    size_t constrained_edges;    /**< constrained edges of the result */
    size_t vertices_added;       /**< with mw_constrain_options.split: vertices at crossings */
    size_t triangles_removed;    /**< outside and in holes */
    uint64_t triangles_crossed;  /**< by segments */
    /** After MW_ERROR_INPUT for crossing segments: the two segments; else MW_NONE. */
    uint32_t crossing_segments[2];
    /** Hole seeds that removed nothing: outside, or in a part that was removed already. */
    uint32_t idle_holes;
    uint32_t first_idle_hole; /**< the first of them; MW_NONE without any */
    uint32_t reserved[4];
} mw_constrain_report;

/**
 * The constrained edges of a result, in the order of the triangles.
 *
 * Edge i joins vertices edge[2 i] and edge[2 i + 1], in the direction of segment[i], of which it
 * is a part; of several segments that share it, the lowest.
 */
typedef struct mw_constrained_edges {
    uint32_t *edge, *segment;
    size_t count;
} mw_constrained_edges;

/** Release constrained edges. NULL and empty ones are allowed. */
MW_API void mw_constrained_edges_release(mw_constrained_edges *edges);

/**
 * Triangulate points and segments by the constrained Delaunay rule [Lee, Lin 1986; Chew 1989].
 * Exact.
 *
 * Every segment becomes an edge, or a chain of edges through the vertices on it. The circle of a
 * triangle contains no vertex that the triangle sees past the segments. If several points have the
 * coordinates of a segment's end, the segment ends at the lowest of them. Segments that meet at
 * their ends or at a vertex do not cross. With
 * mw_constrain_options.split a crossing is rounded to doubles, and its segments may move by that
 * rounding; each remains an edge or chain of edges between its ends.
 *
 * @param constraints   points, segments, polygons and hole seeds
 * @param options       NULL selects the defaults
 * @param duplicate_of  NULL, or receives point_count numbers, as for mw_delaunay()
 * @param report        NULL, or receives what was done, also on failure
 * @param edges         NULL, or receives the constrained edges; release with
 *                      mw_constrained_edges_release()
 * @param out           receives the mesh, owned by the caller (mw_mesh_destroy()); NULL on failure.
 *                      Vertex i is point i; vertices at crossings follow. Neighbours across a
 *                      constrained edge are linked like others
 * @param error         NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT as mw_delaunay(), and for crossing segments
 *         (report->crossing_segments), or with `split` for segments that rounding cannot separate,
 *         for a polygon whose rings are not closed if polygons decide what is kept (the error
 *         names the point as its vertex), and if nothing is left (the message tells whether no ring
 *         is closed, or which hole seed removed the rest); MW_ERROR_ARGUMENT for NULL, a
 *         stride of 1, an unknown `keep`, a segment that names no point, or a hole seed that is
 *         not finite; MW_ERROR_LIMIT for more than 2^29 points, crossings included (k segments may
 *         cross in k^2 / 2 points), or 2^32 - 2 segments; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. One thread after the Delaunay triangulation; time about proportional to the
 * triangles that segments cross (docs/proofs/delaunay.md).
 */
MW_API mw_status mw_constrained_delaunay(const mw_constraints *constraints,
                                         const mw_constrain_options *options,
                                         uint32_t *duplicate_of, mw_constrain_report *report,
                                         mw_constrained_edges *edges, mw_mesh **out,
                                         mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
