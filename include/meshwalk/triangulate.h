/* triangulate.h - triangulations of points, with and without constraints.
 *
 * Delaunay: points are inserted one by one, in random rounds along a Hilbert curve [Amenta, Choi, Rote 2003], each by a
 * walk from the one before, a split and flips [Lawson 1977]. Many points are parted into patches that grow by themselves, on
 * several threads, and are merged [Guibas, Stolfi 1985]. Exact: the result is a Delaunay triangulation of the given
 * doubles, whatever their position. Where more than three points lie on an empty circle there are several, and the order
 * of the points decides which one is made, not the number of threads. */
#ifndef MESHWALK_TRIANGULATE_H
#define MESHWALK_TRIANGULATE_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mw_delaunay_report {
    size_t points;              /* points given                                      */
    size_t duplicates;          /* points equal to an earlier one; in no triangle    */
    uint64_t triangles_visited; /* by the walks that located the points              */
} mw_delaunay_report;

typedef struct mw_delaunay_options {
    uint32_t threads;            /* 0: as many as processors */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[5];
} mw_delaunay_options;

/* Delaunay triangulation of n points as a mesh whose vertex i is point i, all triangles counter-clockwise.
 *   points        x, y of point i at points[i * stride] and the double after it; read during the call only
 *   stride        in doubles, 0 = 2
 *   options       NULL = all zero
 *   duplicate_of  NULL, or n numbers: MW_NONE, or the lowest-numbered point with the same coordinates. Such points are
 *                 vertices of the mesh that no triangle uses
 *   report        NULL or filled
 *   out           set to the mesh, owned by the caller (mw_mesh_destroy), or to NULL on failure. Its triangles are
 *                 numbered along a Hilbert curve
 * MW_ERROR_INPUT: fewer than three different points, all points on one line, or a coordinate that is not finite (the
 * error names the point as its vertex). MW_ERROR_ARGUMENT: NULL, or a stride of 1; MW_ERROR_LIMIT: over 2^29 points;
 * MW_ERROR_MEMORY: about 150 bytes per point are needed on the way, 80 of them for the mesh. The expected number of
 * triangles made is O(n log n) wherever the points lie; time is about linear. The result is the same for any number of
 * threads. Thread-safe. */
MW_API mw_status mw_delaunay(const double *points, size_t n, size_t stride, const mw_delaunay_options *options,
                             uint32_t *duplicate_of, mw_delaunay_report *report, mw_mesh **out, mw_error *error);

/* --- other kinds of triangulation -------------------------------------------------------------------------------- */

typedef enum mw_triangulation_kind {
#define MW_KIND_ENTRY(id, symbol, name, source, help) MW_KIND_##id,
#include <meshwalk/kinds.def>
    MW_KIND_COUNT
} mw_triangulation_kind;

/* Its name as on the command line, who described it first, and a line about it; NULL for a number that is no kind. */
MW_API const char *mw_kind_name(mw_triangulation_kind kind);
MW_API const char *mw_kind_source(mw_triangulation_kind kind);
MW_API const char *mw_kind_help(mw_triangulation_kind kind);

/* What was made, whatever the kind. */
typedef struct mw_kind_report {
    mw_delaunay_report delaunay; /* of the Delaunay triangulation that each kind begins with                      */
    double edge_length;          /* sum of the lengths of the edges, each counted once; rounded                   */
    double largest_angle;        /* in radians; rounded                                                           */
    int optimal;                 /* 1: it is a triangulation of its kind (of the least weight, of the least
                                         largest angle), up to rounding where stated; 0: a local optimum only, see
                                         mw_triangulate                                                                 */
    size_t faces;        /* MW_KIND_MIN_WEIGHT: faces of more than three corners that the skeleton left        */
    size_t largest_face; /* of these, most corners of one                                                 */
    size_t local_faces;  /* of these, too large, or not simple: filled by a local optimum                 */
    size_t hidden; /* MW_KIND_REGULAR: points that are hidden, but for those equal to a vertex                    */
    uint32_t reserved[6];
} mw_kind_report;

/* How far the optimum is sought. 0: the search ends after about half a minute, with memory in proportion to the points.
 * Else MW_KIND_MIN_WEIGHT: faces of up to so many corners are filled optimally; MW_KIND_MIN_MAX_ANGLE: the optimum is
 * sought for up to so many points; either however long it takes, and whatever memory. */
typedef struct mw_kind_options {
    uint32_t limit;
    uint32_t threads; /* for the Delaunay triangulation that each kind begins with; 0: as many as processors */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    const double *weights;       /* MW_KIND_REGULAR: one for each point; NULL: all are 0 */
    uint8_t *
        hidden; /* MW_KIND_REGULAR: NULL, or room for one of each point: 1 if no triangle has it; out of a successful call */
    uint32_t reserved[4];
} mw_kind_options;

/* A triangulation of any kind; arguments as for mw_delaunay, options NULL = all zero, report NULL or filled on success.
 *   MW_KIND_GREEDY         Edges by increasing length (compared exactly), of equal ones by the numbers of their ends
 *                          (the lower, then the higher), each taken unless it crosses one taken before. About as long as
 *                          sorting for spread points, a square of the degree at a vertex that sees thousands; 200
 *                          bytes per point.
 *   MW_KIND_MIN_WEIGHT     Sums of lengths are compared in doubles, so of triangulations that differ in the last digits
 *                          any may be made. Faces that are too large for dynamic programming, or hold points, get a
 *                          local optimum: no exchange of the diagonal of a quadrilateral shortens it, and it is no
 *                          longer than MW_KIND_GREEDY, up to rounding. About 70 us and 700 bytes per spread point, up
 *                          to 3000 bytes per point.
 *   MW_KIND_MIN_MAX_ANGLE  Angles are compared exactly. Always a local optimum, and above the limit that only: no
 *                          exchange of a diagonal makes the largest angle of its quadrilateral smaller; if `optimal`,
 *                          the largest of all is the least possible. About 10 us per spread point; the exchanges up to
 *                          the local optimum have no bound on time.
 *   MW_KIND_REGULAR        Points have weights: think of circles round them, with the weight as the square of the radius. Lift
 *                          each point x of weight w to the height |x|^2 - w: the triangles are the lower hull seen from
 *                          below. Exact. A point above that hull is hidden: a vertex of no triangle; of points at one place all
 *                          but the heaviest, or the lowest of these. A point exactly on it, but no corner, is hidden or
 *                          not by the order of insertion. With equal weights it is a Delaunay triangulation. A weight that
 *                          is not finite: MW_ERROR_INPUT, with the point as the error's vertex. About 1.5 us and 130 bytes
 *                          per point.
 * Errors as for mw_delaunay (duplicate_of is unspecified then), and MW_ERROR_ARGUMENT for an unknown kind. After
 * the Delaunay triangulation one thread; thread-safe. docs/guarantees.md tells what is optimal, and what makes it slow. */
MW_API mw_status mw_triangulate(mw_triangulation_kind kind, const double *points, size_t n, size_t stride,
                                const mw_kind_options *options, uint32_t *duplicate_of, mw_kind_report *report,
                                mw_mesh **out, mw_error *error);

/* --- constraints ------------------------------------------------------------------------------------------------- */

/* Points, and what must show among the edges of their triangulation. Arrays are read during the call only. */
typedef struct mw_constraints {
    const double *points; /* x, y of point i at points[i * stride] and the double after it             */
    size_t point_count;
    size_t stride;            /* in doubles, 0 = 2                                                         */
    const uint32_t *segments; /* two numbers of points per segment; one with equal ends is passed over     */
    size_t segment_count;
    const uint32_t *polygon;  /* NULL, or per segment the number of the polygon whose ring it belongs to;
                                MW_NONE: a line, which bounds nothing. A place is inside a polygon where an odd number of
                                its segments lie on the way to infinity, so rings may come in any order and direction:
                                outlines, holes, islands in them; a segment given twice counts twice       */
    const double *hole_seeds; /* x, y of a seed point in each part that is to be removed, packed. One outside the hull
                                 removes nothing, one on a constraint the parts on all its sides           */
    size_t hole_seed_count;
} mw_constraints;

typedef enum mw_keep {
    MW_KEEP_AUTO =
        0,         /* inside, if any segment belongs to a polygon or there are holes; else the hull                 */
    MW_KEEP_HULL,  /* all triangles of the convex hull, holes too                                               */
    MW_KEEP_INSIDE /* with polygons those inside at least one of them, else those that segments part from the
                         outside; of either, those that segments part from each of the seed points of holes        */
} mw_keep;

typedef struct mw_constrain_options {
    mw_keep keep;
    int split; /* 1: where segments cross, put a vertex there, rounded, and split them; 0: an error                */
    uint32_t threads; /* for the Delaunay triangulation of the points; 0: as many as processors                       */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[3];
} mw_constrain_options;

typedef struct mw_constrain_report {
    mw_delaunay_report delaunay;   /* of the points without the constraints                                 */
    size_t constrained_edges;      /* edges of the result that are constraints                              */
    size_t vertices_added;         /* with options.split: vertices made where segments cross                */
    size_t triangles_removed;      /* outside and in holes                                                  */
    uint64_t triangles_crossed;    /* by segments                                                           */
    uint32_t crossing_segments[2]; /* MW_ERROR_INPUT for segments that cross: their numbers; else MW_NONE   */
    uint32_t reserved[6];
} mw_constrain_report;

/* The constrained edges of the result: edge i joins vertices edge[2 i] and edge[2 i + 1], in the direction of segment
 * segment[i], of which it is a part: the lowest of those that share it. In the order of the triangles. */
typedef struct mw_constrained_edges {
    uint32_t *edge, *segment;
    size_t count;
} mw_constrained_edges;
MW_API void mw_constrained_edges_release(mw_constrained_edges *edges); /* NULL and empty ones are allowed */

/* Constrained Delaunay triangulation [Lee, Lin 1986; Chew 1989]: every segment is an edge, or a chain of edges with the
 * vertices that lie on it; no vertex that a triangle sees past the segments lies in its circle. Exact.
 *   options       NULL = all zero
 *   duplicate_of  NULL, or point_count numbers, as for mw_delaunay: segments end at the lowest-numbered point of a place
 *   report        NULL or filled, after a failure too
 *   edges         NULL or filled; released by the caller
 *   out           the mesh, as of mw_delaunay: vertex i is point i; vertices made by options.split come after the points.
 *                 Its neighbours across a constraint are linked as any others
 * With options.split a point is rounded to doubles and a segment may be moved by as much; it is still an edge or a chain
 * of edges between its ends. Ends, and vertices that lie on a segment, are no crossings.
 * MW_ERROR_INPUT as for mw_delaunay, and: segments that cross (report->crossing_segments) without options.split,
 * or so close that rounding cannot part them with it; a polygon whose rings are not closed, where polygons decide
 * what is kept (the error names the point as its vertex); nothing left to keep. MW_ERROR_ARGUMENT: NULL for an
 * array that should have members, or for out; a stride of 1; an unknown `keep`; a segment that names no point; a
 * seed point of a hole that is not finite. MW_ERROR_LIMIT: over 2^29 points, those made by options.split counted
 * (k segments may cross in k^2 / 2 places), or 2^32 - 2 segments. MW_ERROR_MEMORY. Each segment walks along
 * itself: time in proportion to the triangles it crosses, and little more (docs/guarantees.md). After the Delaunay
 * triangulation one thread; thread-safe. */
MW_API mw_status mw_constrained_delaunay(const mw_constraints *constraints, const mw_constrain_options *options,
                                         uint32_t *duplicate_of, mw_constrain_report *report,
                                         mw_constrained_edges *edges, mw_mesh **out, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
