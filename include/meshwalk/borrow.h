/**
 * @file borrow.h
 * Point location in arrays that stay the caller's.
 *
 * A walk needs points, triangles and the neighbours of triangles. Many libraries already have all
 * three: SciPy's Delaunay, Triangle, matplotlib, most mesh generators. A borrowed mesh is a view of
 * such arrays. Nothing is copied or built: a view takes a hundred bytes, and without a check no
 * time. The arrays are only read. They must not change or move while the view is used; after a
 * change make a new view.
 *
 * The answers are those of mw_locate() in a mesh of the same arrays, bit for bit: the
 * lowest-numbered triangle that contains the point, decided exactly. There is one exception: a
 * point in a hole is MW_OUTSIDE.
 *
 * Queries are slower than in an ordinary mesh, because a borrowed mesh lacks three things: a layout
 * along a curve in memory, a guide to the first triangle, and ghost triangles that fill pockets and
 * holes. If the triangles do not fill their convex hull (mw_borrowed_info.convex is 0), a query
 * that meets the border tests all triangles: O(n). Use mw_mesh_create() for many queries in such a
 * mesh.
 *
 * Wrong arrays never make a query crash or run for ever: numbers out of range are noticed, and
 * walks have a limit. A reported triangle always contains the point. But if unchecked arrays are
 * wrong, it may not be the lowest such triangle, and with options.convex a point inside may be
 * reported as outside.
 */
#ifndef MESHWALK_BORROW_H
#define MESHWALK_BORROW_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Which neighbour of a triangle has the index k. */
typedef enum mw_neighbour_layout {
    MW_NEIGHBOUR_OPPOSITE = 0, /**< opposite to vertex k: SciPy, Qhull, Triangle, CGAL */
    MW_NEIGHBOUR_ACROSS_EDGE   /**< across edge k, from vertex k to vertex k + 1: matplotlib */
} mw_neighbour_layout;

/** The caller's arrays. */
typedef struct mw_borrowed_arrays {
    mw_arrays mesh; /**< points and triangles, as for mw_mesh_create() */
    /** The 3 neighbours of each triangle, of mesh.integer_type, from 0, packed. A number that no
     * triangle has, such as -1, means that there is no neighbour. */
    const void *neighbours;
    mw_neighbour_layout layout;
} mw_borrowed_arrays;

/** A view of a caller's mesh. Opaque; any number of threads may query one view. */
typedef struct mw_borrowed mw_borrowed;

/** Options of mw_mesh_borrow(). Zero-initialised options check the arrays. */
typedef struct mw_borrow_options {
    int unchecked; /**< 1: trust the arrays, O(1) */
    /** With `unchecked`: 1: the caller promises that the triangles fill their convex hull without
     * overlap, so a point beyond an edge without a neighbour is outside. 0: unknown. */
    int convex;
    uint32_t threads; /**< of the check; 0: one per processor */
    const mw_progress
        *progress;        /**< of the check: progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4]; /**< must be zero */
} mw_borrow_options;

/**
 * Borrow a caller's mesh.
 *
 * The check decides whether all numbers are in range, used vertices are finite, and neighbours
 * share their two vertices, name each other and lie on different sides of their edge. It also
 * decides whether the triangles fill their convex hull; if so, they are an embedding. In other
 * meshes it does not look for crossing borders; mw_check_arrays() does. If triangles of such a mesh
 * overlap, any triangle that contains a point may be reported.
 *
 * @param arrays   the caller's arrays, which must outlive *out; the structure itself need not
 * @param options  NULL selects the defaults: the arrays are checked
 * @param out      receives the view, owned by the caller (mw_borrowed_release()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, an unknown layout, or `convex` without `unchecked`;
 *         MW_ERROR_INPUT for wrong arrays (the error names the triangle); MW_ERROR_LIMIT for more
 *         than MW_MAX_TRIANGLES; MW_ERROR_MEMORY; MW_CANCELLED
 *
 * Thread-safe. O(n) time for the check, else O(1); O(1) memory in either case.
 */
MW_API mw_status mw_mesh_borrow(const mw_borrowed_arrays *arrays, const mw_borrow_options *options,
                                mw_borrowed **out, mw_error *error);

/** Release a view. The arrays are not touched. NULL is allowed. */
MW_API void mw_borrowed_release(mw_borrowed *mesh);

/** Properties of a view. */
typedef struct mw_borrowed_info {
    size_t bytes; /**< memory of the view, without the caller's arrays */
    int checked;
    int convex; /**< 1: the triangles fill their convex hull: checked, or promised by the caller */
    uint32_t flat_triangles;      /**< triangles without area; 0 if unchecked */
    uint32_t clockwise_triangles; /**< 0 if unchecked */
} mw_borrowed_info;

/** Fill `info` with the properties of a view. Thread-safe. O(1). */
MW_API void mw_borrowed_describe(const mw_borrowed *mesh, mw_borrowed_info *info);

/** How to answer queries. Zero-initialised options select the defaults. */
typedef struct mw_borrowed_query_options {
    /** MW_WALK_REMEMBERING (also 0), MW_WALK_BARYCENTRIC or MW_WALK_DIRECT. The last two are the
     * published forms for mixed orientation; the remembering walk ends them. */
    mw_walk_kind walk;
    int in_order;     /**< batches, 1: each query is near the previous one; do not sort */
    uint64_t seed;    /**< seed of samples; answers do not depend on it */
    uint32_t threads; /**< batches: number of threads; 0: one per processor */
    const mw_progress *progress; /**< batches: progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_borrowed_query_options;

/** The state of a series of queries: one per thread, a plain value that may be copied. A
 * zero-initialised cursor has the default options. Members other than `counters` are private. */
typedef struct mw_borrowed_cursor {
    /** queries, triangles_visited, triangles_max; triangles and orient: of the walk;
     * triangles_final and orient_final: of the walk that ends barycentric and direct walks;
     * handovers: queries that tested all triangles. */
    mw_counters counters;
    uint64_t random;
    uint32_t last; /* triangle of the last query */
    uint32_t walk; /* mw_walk_kind */
    uint32_t reserved[4];
} mw_borrowed_cursor;

/**
 * Initialise a cursor.
 *
 * @param options  NULL selects the defaults
 * @param cursor   receives the initial state
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, or a walk that mw_borrowed_query_options does not list
 *
 * Thread-safe. O(1).
 */
MW_API mw_status mw_borrowed_cursor_init(const mw_borrowed_query_options *options,
                                         mw_borrowed_cursor *cursor, mw_error *error);

/**
 * Locate one point. The walk begins at the triangle found last if the point is near it, else at the
 * nearest of a random sample. The size of the sample is the cube root of the number of vertices.
 *
 * @param mesh    the view
 * @param cursor  a cursor, initialised or all zero
 * @param x, y    any doubles
 * @return as mw_locate(), but MW_OUTSIDE for a point in a hole; MW_BAD for a point that is not
 *         finite
 *
 * Thread-safe with one cursor per thread. No allocation, no failure. Time: the sample and the walk;
 * O(n) if the triangles do not fill their convex hull and the query meets the border.
 */
MW_API mw_location mw_borrowed_locate(const mw_borrowed *mesh, mw_borrowed_cursor *cursor, double x,
                                      double y);

/**
 * Locate n points. Queries are sorted along a Hilbert curve, and each walk begins where the
 * previous one ended.
 *
 * @param mesh       the view
 * @param points     x, y of point i at points[i * stride] and the double after it
 * @param n          number of points
 * @param stride     doubles from one point to the next; 0 means 2
 * @param options    NULL selects the defaults
 * @param locations  receives n results, in the order of the points, equal for every number of
 *                   threads; unspecified on failure
 * @param counters   NULL, or receives the sums over the batch
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a stride of 1, and as mw_borrowed_cursor_init();
 *         MW_ERROR_MEMORY, MW_CANCELLED
 *
 * Thread-safe. Takes 32 bytes a query for the sort, which handles at most 4 million queries at a
 * time.
 */
MW_API mw_status mw_borrowed_locate_batch(const mw_borrowed *mesh, const double *points, size_t n,
                                          size_t stride, const mw_borrowed_query_options *options,
                                          mw_location *locations, mw_counters *counters,
                                          mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
