/**
 * @file borrow.h
 * Point location in arrays that stay the caller's.
 *
 * A walk needs points, triangles and the neighbours of triangles, and many libraries have all
 * three already: SciPy's Delaunay, Triangle, matplotlib, most mesh generators. A borrowed mesh is
 * a view of such arrays: nothing is copied and nothing is built, so it is made in no time and
 * takes a hundred bytes. The arrays are only read. They must not change or move while the view is
 * used; after a change make a new view.
 *
 * The answers are those of mw_locate in a mesh of the same arrays, bit for bit: the
 * lowest-numbered triangle that contains the point, decided exactly. Triangles are walked through
 * as they are: clockwise ones are not turned. Only holes are not told apart: a point in one is
 * MW_OUTSIDE. What an ordinary mesh has and a borrowed one has not costs time: its layout in
 * memory, its guide to the first triangle, and the ghost triangles that fill pockets and holes.
 * Where the triangles do not fill their convex hull (mw_borrowed_info.convex is 0), a query that
 * meets the border looks at all triangles: O(n). Choose mw_mesh_create for many queries in such a
 * mesh.
 *
 * Arrays that break a promise below never make a query crash or run for ever: numbers out of range
 * are noticed, and walks have a limit. A triangle that is reported contains the point in any case.
 * But where unchecked arrays are wrong, it may not be the lowest one, and with options.convex a
 * point may be taken to be outside.
 */
#ifndef MESHWALK_BORROW_H
#define MESHWALK_BORROW_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How neighbour k of a triangle lies to it. */
typedef enum mw_neighbour_layout {
    MW_NEIGHBOUR_OPPOSITE = 0, /**< opposite to vertex k: SciPy, Qhull, Triangle, CGAL */
    MW_NEIGHBOUR_ACROSS_EDGE   /**< across edge k, from vertex k to vertex k + 1: matplotlib */
} mw_neighbour_layout;

/** The caller's arrays. */
typedef struct mw_borrowed_arrays {
    mw_arrays mesh; /**< points and triangles, as for mw_mesh_create() */
    /** 3 triangles per triangle, of mesh.integer_type, from 0, packed. A number of no triangle,
     * such as -1, means that there is no neighbour. */
    const void *neighbours;
    mw_neighbour_layout layout;
} mw_borrowed_arrays;

/** A view of a caller's mesh. Opaque; any number of threads may query one view. */
typedef struct mw_borrowed mw_borrowed;

/** How arrays are borrowed. Zero-initialised options check them. */
typedef struct mw_borrow_options {
    int unchecked; /**< 1: trust the arrays, O(1) */
    /** 1, with `unchecked`: the triangles fill their convex hull without overlap. A point beyond
     * an edge without a neighbour is then outside. 0: unknown. */
    int convex;
    uint32_t threads; /**< of the check; 0: one per processor */
    const mw_progress
        *progress;        /**< of the check: progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4]; /**< must be zero */
} mw_borrow_options;

/**
 * Borrow a caller's mesh.
 *
 * The check finds out whether every number names something, every used vertex is finite,
 * neighbours share the two vertices that they must, name each other, and lie on different sides of
 * their edge; and whether the triangles fill their convex hull, in which case they surely are an
 * embedding. In other meshes it does not look for borders that cross (mw_check_arrays does): where
 * triangles overlap, any of those that contain a point may be reported.
 *
 * @param arrays   the caller's; they must outlive *out, except for the structure itself
 * @param options  NULL = all zero: checked
 * @param out      the view, owned by the caller (mw_borrowed_release); NULL on failure
 * @return MW_OK; MW_ERROR_ARGUMENT; MW_ERROR_INPUT, of which the error names the triangle;
 *         MW_ERROR_LIMIT for more than MW_MAX_TRIANGLES; MW_ERROR_MEMORY; MW_CANCELLED
 *
 * Cost: O(n) time for the check, else O(1); O(1) memory in either case.
 */
MW_API mw_status mw_mesh_borrow(const mw_borrowed_arrays *arrays, const mw_borrow_options *options,
                                mw_borrowed **out, mw_error *error);

/** Release a view; the arrays are not touched. NULL is allowed. */
MW_API void mw_borrowed_release(mw_borrowed *mesh);

/** Properties of a view. */
typedef struct mw_borrowed_info {
    size_t bytes; /**< memory of the view, without the caller's arrays */
    int checked;
    int convex; /**< 1: the triangles fill their convex hull, by the check or the caller's word */
    uint32_t flat_triangles;      /**< triangles without area; 0 if unchecked */
    uint32_t clockwise_triangles; /**< 0 if unchecked */
} mw_borrowed_info;

/** Describe a view. Thread-safe; O(1). */
MW_API void mw_borrowed_describe(const mw_borrowed *mesh, mw_borrowed_info *info);

/** How to answer queries. Zero-initialised options select the defaults. */
typedef struct mw_borrowed_query_options {
    /** MW_WALK_REMEMBERING; or MW_WALK_BARYCENTRIC or MW_WALK_DIRECT, as published for mixed
     * orientation and ended by the remembering walk; 0: remembering. */
    mw_walk_kind walk;
    int in_order;     /**< batches, 1: each query is near the previous one; do not sort */
    uint64_t seed;    /**< seed of samples; answers do not depend on it */
    uint32_t threads; /**< batches: number of threads; 0: one per processor */
    const mw_progress *progress; /**< batches: progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_borrowed_query_options;

/** The state of a series of queries: one per thread, a plain value that may be copied.
 * Zero-initialised it has the default options. Members other than `counters` are private. */
typedef struct mw_borrowed_cursor {
    /** queries, triangles_visited, triangles_max; triangles and orient of the walk;
     * triangles_final and orient_final of what ends the barycentric and direct walks; handovers:
     * queries that looked at all triangles. */
    mw_counters counters;
    uint64_t random;
    uint32_t last; /* triangle of the last query */
    uint32_t walk; /* mw_walk_kind */
    uint32_t reserved[4];
} mw_borrowed_cursor;

/**
 * Initialise a cursor.
 *
 * @param options  NULL = all zero
 * @return MW_OK; MW_ERROR_ARGUMENT for another walk than those of mw_borrowed_query_options
 */
MW_API mw_status mw_borrowed_cursor_init(const mw_borrowed_query_options *options,
                                         mw_borrowed_cursor *cursor, mw_error *error);

/**
 * Locate one point. The walk begins at the triangle found last if the point is near, else at the
 * nearest of a random sample, as large as the cube root of the number of vertices.
 *
 * @return as mw_locate, but MW_OUTSIDE for a point in a hole; MW_BAD for a point that is not finite
 *
 * Thread-safe with one cursor per thread; no allocation, no failure.
 */
MW_API mw_location mw_borrowed_locate(const mw_borrowed *mesh, mw_borrowed_cursor *cursor, double x,
                                      double y);

/**
 * Locate n points. Queries are sorted along a Hilbert curve first, so that each walk begins where
 * the one before ended.
 *
 * @param points     x, y of point i at points[i * stride] and the double after it
 * @param stride     in doubles; 0 = 2
 * @param options    NULL = all zero
 * @param locations  n results, in input order, the same for any number of threads
 * @param counters   NULL, or filled with the sum over the batch
 * @return MW_OK; MW_ERROR_ARGUMENT as mw_borrowed_cursor_init; MW_ERROR_MEMORY, MW_CANCELLED: then
 *         locations is unspecified
 *
 * Thread-safe. Takes 32 bytes a query for the sort, of 4 million queries at most.
 */
MW_API mw_status mw_borrowed_locate_batch(const mw_borrowed *mesh, const double *points, size_t n,
                                          size_t stride, const mw_borrowed_query_options *options,
                                          mw_location *locations, mw_counters *counters,
                                          mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
