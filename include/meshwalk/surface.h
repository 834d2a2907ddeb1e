/**
 * @file surface.h
 * A triangle mesh in space, from the caller's arrays. It may move and change between queries.
 *
 * A surface keeps the caller's numbers, as a planar mesh does (mesh.h): vertices, triangles, local
 * vertices 0, 1, 2 as given; local edge k runs from local vertex k to local vertex (k + 1) mod 3.
 * The front of a triangle is the side from which its vertices appear counter-clockwise, in a
 * right-handed frame.
 *
 * Two kinds of queries exist: which facet a ray from a centre meets (star.h), and which triangle a
 * probe touches (probe.h). Their objects refer to the surface, which must outlive them.
 *
 * Threads: any number of threads may query one surface. mw_surface_begin_update() says how to
 * change it.
 */
#ifndef MESHWALK_SURFACE_H
#define MESHWALK_SURFACE_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A triangle mesh in space. Opaque. */
typedef struct mw_surface mw_surface;

/** Options of a surface. Zero-initialised options select the defaults: correct arrays, copied, and
 * no query during an update. */
typedef struct mw_surface_options {
    /** 1: accept triangles with repeated or non-finite vertices and edges of three triangles. Such
     * a triangle is kept but contains no point; the third triangle of an edge is not linked. */
    int tolerant;
    /** 1: link triangles across vertices with equal coordinates (-0.0 equals 0.0). Decided when the
     * surface is created: moving vertices neither joins nor separates them. */
    int weld;
    /** 1: queries of other threads may run while a thread requests an update. Then
     * mw_surface_begin_update() waits for running queries, and new queries wait for
     * mw_surface_end_update(). Each query takes a reader's lock. 0: the caller prevents queries
     * during an update. */
    int shared;
    /** 1: do not copy the points; arrays->points, with a stride of 3, must outlive the surface. */
    int borrow;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[6];        /**< must be zero */
} mw_surface_options;

/**
 * Create a surface from arrays.
 *
 * Open borders, several components, triangles without area, unused vertices and neighbours of
 * opposite orientation are accepted.
 *
 * @param arrays   vertex i has x, y, z at points[i * point_stride] and the two doubles after it; a
 *                 stride of 0 means 3
 * @param options  NULL selects the defaults
 * @param out      receives the surface, owned by the caller (mw_surface_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT if the arrays are unusable (the error names the first defect, see
 *         mw_mesh_create()); MW_ERROR_ARGUMENT for NULL, a stride of 1 or 2, or another stride than
 *         3 with `borrow`; MW_ERROR_LIMIT, MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(n) time for n triangles.
 */
MW_API mw_status mw_surface_create(const mw_arrays *arrays, const mw_surface_options *options,
                                   mw_surface **out, mw_error *error);

/** Destroy a surface. Stars and probers of it must be destroyed before. NULL is allowed. */
MW_API void mw_surface_destroy(mw_surface *surface);

/** Number of vertices. Counts unused vertices, and vertices that an editor (surface_edit.h) has
 * freed: all numbers of vertices are below it. Thread-safe. O(1). */
MW_API uint32_t mw_surface_vertex_count(const mw_surface *surface);

/** Number of triangles. Counts triangles that an editor (surface_edit.h) has freed: all numbers of
 * triangles are below it. Thread-safe. O(1). */
MW_API uint32_t mw_surface_triangle_count(const mw_surface *surface);

/**
 * Copy x, y, z of a vertex.
 *
 * @param surface  the surface
 * @param vertex   less than the number of vertices, not checked
 * @param point    receives x, y, z
 *
 * Thread-safe while no update runs. O(1).
 */
MW_API void mw_surface_vertex(const mw_surface *surface, uint32_t vertex, double point[3]);

/**
 * Copy the vertices of a triangle, in the order given.
 *
 * @param surface   the surface
 * @param triangle  less than the number of triangles, not checked
 * @param vertices  receives three vertices; of a triangle that an editor has freed three equal
 *                  numbers
 *
 * Thread-safe while no update runs. O(1).
 */
MW_API void mw_surface_triangle(const mw_surface *surface, uint32_t triangle, uint32_t vertices[3]);

/**
 * Find the triangle on the other side of a local edge.
 *
 * @param surface     the surface
 * @param triangle    less than the number of triangles, not checked
 * @param local_edge  0, 1 or 2, not checked
 * @param edge        NULL, or receives the local edge in the neighbour
 * @return the neighbour; MW_NONE on a border.
 *
 * Thread-safe while no update runs. O(1).
 */
MW_API uint32_t mw_surface_neighbour(const mw_surface *surface, uint32_t triangle,
                                     unsigned local_edge, unsigned *edge);

/** Memory used by a surface, in bytes, without borrowed points. Thread-safe while no update runs.
 * O(1). */
MW_API size_t mw_surface_bytes(const mw_surface *surface);

/* --- change ----------------------------------------------------------------------------------- */

/**
 * Begin an update of a surface. One thread updates at a time.
 *
 * An update has four steps: begin; overwrite vertices in mw_surface_points() and flip edges with
 * mw_surface_flip(); bring the objects of the surface up to date with mw_star_update() and
 * mw_prober_update(); end. A star or prober that has not been brought up to date refuses queries.
 *
 * No query may run between begin and end. Without mw_surface_options.shared the caller prevents
 * this, and the two functions only mark the surface as changed. With `shared` the two functions
 * prevent it: an update waits for running queries, and new queries wait for its end. Queries are
 * mw_surface_describe() and the functions of star.h and probe.h that answer a ray, a probe or a
 * point, one or many. Each query of a batch is answered from one state of the surface; an update
 * may come between two of them. All other calls (creating stars, probers and indices, describing
 * them, reading vertices) belong to the updating thread.
 *
 * @param surface  the surface
 *
 * O(1), and the wait for running queries.
 */
MW_API void mw_surface_begin_update(mw_surface *surface);

/** End an update. Queries may run again. For the thread that began the update. O(1). */
MW_API void mw_surface_end_update(mw_surface *surface);

/**
 * Give the coordinates of all vertices, which may be overwritten during an update.
 *
 * A vertex with a NaN or infinite coordinate makes its triangles contain no point, as in a tolerant
 * surface.
 *
 * @param surface  the surface
 * @return x, y, z per vertex, packed; owned by the surface, or the caller's own if borrowed.
 *
 * Not thread-safe, for the updating thread only. O(1).
 */
MW_API double *mw_surface_points(mw_surface *surface);

/**
 * Flip the edge between two triangles, during an update.
 *
 * Triangle a b c with local edge ab and its neighbour b a d become, under the same numbers, c d b
 * and d c a. `triangle` keeps the corner c, the neighbour keeps d. With mw_surface_options.weld a
 * point may have different vertex numbers in the two triangles; then b is the number in
 * `triangle`, a the number in its neighbour.
 *
 * @param surface     the surface
 * @param triangle    less than the number of triangles, not checked
 * @param local_edge  0, 1 or 2, not checked
 * @param error       NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT, with the surface unchanged, if the edge has one triangle only, its
 *         triangles have opposite orientation, c equals d, or an edge already joins c and d (the
 *         search covers the fan of `triangle` round c, not other fans of a pinched vertex).
 *         MW_ERROR_ARGUMENT if the surface has an editor (mw_surface_edit_flip()).
 *
 * Not thread-safe, for the updating thread only. Time: proportional to the triangles round c.
 */
MW_API mw_status mw_surface_flip(mw_surface *surface, uint32_t triangle, unsigned local_edge,
                                 mw_error *error);

/* --- properties ------------------------------------------------------------------------------- */

/** Counts and properties of a surface. */
typedef struct mw_surface_info {
    uint32_t vertices, triangles; /**< as given, without those that an editor has freed */
    uint32_t unused_vertices;     /**< vertices of no triangle */
    uint32_t flat_triangles;      /**< triangles without area */
    uint32_t clashing_edges;      /**< inner edges whose two triangles have opposite orientation */
    uint32_t pinched_vertices;    /**< used vertices whose triangles form more than one fan */
    uint32_t border_edges;        /**< edges of one triangle */
    uint32_t border_loops;        /**< closed chains of border edges */
    uint32_t components;          /**< connected components: parts that share no vertex */
    int closed;                   /**< 1: there are triangles and no border edges */
    int oriented;                 /**< 1: no clashing edges */
    int64_t euler;                /**< used vertices - edges + triangles */
    double low[3], high[3];       /**< extent of the used vertices; NaN without triangles */
    double area;                  /**< sum of the triangles' areas, rounded */
    /** Enclosed volume of a closed oriented surface, rounded; positive if fronts face out. NaN for
     * other surfaces. */
    double volume;
} mw_surface_info;

/**
 * Describe a surface.
 *
 * With mw_surface_options.weld vertices with equal coordinates count once. A triangle that has a
 * vertex twice (with weld: two vertices with equal coordinates) is flat; it counts neither for
 * edges and fans nor for `euler`. The third triangle at an edge of a tolerant surface has a border
 * edge of its own there.
 *
 * @param surface  the surface
 * @param info     receives the description
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL; MW_ERROR_MEMORY.
 *
 * Thread-safe. With mw_surface_options.shared this is a query: it must not be called between begin
 * and end of an update. O(n).
 */
MW_API mw_status mw_surface_describe(const mw_surface *surface, mw_surface_info *info,
                                     mw_error *error);

/**
 * Find every defect of arrays as a surface.
 *
 * Defects are the unusable group of mw_defect_kind, then MW_DEFECT_CLASHING; MW_DEFECT_FLAT is a
 * remark. check->valid is 1 if there are none except flat triangles.
 *
 * @param arrays   as for mw_surface_create()
 * @param weld     as mw_surface_options.weld
 * @param options  NULL selects the defaults
 * @param check    receives the defects; release with mw_check_release()
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK, also if defects were found; MW_ERROR_ARGUMENT, MW_ERROR_LIMIT, MW_ERROR_MEMORY,
 *         MW_CANCELLED.
 *
 * Thread-safe. O(n); O(n log b) for unusable arrays with b edges of one triangle.
 */
MW_API mw_status mw_surface_check_arrays(const mw_arrays *arrays, int weld,
                                         const mw_check_options *options, mw_check *check,
                                         mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
