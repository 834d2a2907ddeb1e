/**
 * @file surface_edit.h
 * A surface whose topology changes between two queries.
 *
 * An editor changes a surface in place: it splits, flips and collapses edges, adds and removes
 * triangles and vertices, cuts the surface along a path of edges, and sews borders. The cost of an
 * edit depends on the triangles that it touches, not on the size of the surface. Probers and stars
 * that are attached to the editor follow each edit, so that certain probes and rays from a centre
 * are right at once.
 *
 * Numbers of vertices and triangles are handles. An edit renumbers only what it touches. Freed
 * numbers are not used again before mw_surface_editor_compact().
 *
 * An edit is refused if an edge would get a third triangle, or if the two triangles at an edge
 * would newly get opposite orientation. A refused edit leaves the surface as it was.
 *
 * Threads: one thread edits a surface. On a surface with mw_surface_options.shared other threads
 * may query meanwhile: an edit waits for running queries, and new queries wait for its end.
 */
#ifndef MESHWALK_SURFACE_EDIT_H
#define MESHWALK_SURFACE_EDIT_H

#include <meshwalk/edit.h>
#include <meshwalk/probe.h>
#include <meshwalk/star.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What changes a surface. Opaque. */
typedef struct mw_surface_editor mw_surface_editor;

/** Options of an editor of a surface. Zero-initialised options select the defaults. */
typedef struct mw_surface_editor_options {
    /** NULL, or a prober of the surface to be attached, as mw_surface_editor_attach_prober() does.
     * Probers that are not attached, and stars, are out of date after an edit, until
     * mw_prober_update() or mw_star_update(). */
    mw_prober *prober;
    /** How many edits can be undone; each takes 40 bytes for each triangle that it touches.
     * SIZE_MAX: all. */
    size_t undo;
    uint32_t reserved[6]; /**< must be zero */
} mw_surface_editor_options;

/**
 * Create an editor of a surface.
 *
 * Until the editor is destroyed, the surface changes by the editor only, except for
 * mw_surface_points() and mw_prober_update(). The address that mw_surface_points() returned may
 * change with each edit.
 *
 * @param surface  the surface, which must outlive the editor
 * @param options  NULL selects the defaults
 * @param out      receives the editor, owned by the caller; NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT if a triangle of a tolerant surface names a vertex twice, or an
 *         edge has more than two triangles (the error names a triangle); MW_ERROR_ARGUMENT for
 *         NULL, a surface that was welded, borrows its points or has an editor already, or a prober
 *         of another surface; MW_ERROR_MEMORY.
 *
 * Belongs to the updating thread. O(n) time; 24 bytes a triangle and 8 a vertex, with room for half
 * as many more triangles and vertices.
 */
MW_API mw_status mw_surface_editor_create(mw_surface *surface,
                                          const mw_surface_editor_options *options,
                                          mw_surface_editor **out, mw_error *error);

/** Destroy an editor. The surface, its probers and its stars stay as they are; freed vertices then
 * count as unused. NULL is allowed. */
MW_API void mw_surface_editor_destroy(mw_surface_editor *editor);

/* --- probers and stars that follow edits ------------------------------------------------------ */

/**
 * Attach a prober: its boxes follow each edit from now on.
 *
 * Any number of probers may be attached. The cost of an edit grows with each. A prober without
 * boxes is always up to date and need not be attached. Attaching a prober twice changes nothing.
 *
 * @param editor  the editor
 * @param prober  a prober of its surface, which must outlive the editor or be detached before
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL or a prober of another surface; MW_ERROR_MEMORY, and
 *         nothing has changed.
 *
 * Belongs to the updating thread. On a shared surface other threads may query meanwhile. O(n). If
 * the prober missed edits, its boxes are made anew, in O(n log n).
 */
MW_API mw_status mw_surface_editor_attach_prober(mw_surface_editor *editor, mw_prober *prober,
                                                 mw_error *error);

/** Detach a prober. It is out of date after the next edit. Does nothing if the prober is not
 * attached. Belongs to the updating thread. O(attached probers). */
MW_API void mw_surface_editor_detach_prober(mw_surface_editor *editor, const mw_prober *prober);

/**
 * Attach a star: it follows each edit from now on.
 *
 * After an edit the star answers as a new star would. If the surface is no longer star-shaped, for
 * instance because a triangle was removed, all queries of the star return MW_BAD until further
 * edits make the surface star-shaped again. mw_star_ready() tells this, and mw_star_update() names
 * a defect. Exception: if an edit makes a facet without area, the star returns MW_BAD even if the
 * surface is star-shaped. mw_star_update() then decides, in O(n), and must be called after each
 * edit until the surface has no such facet.
 *
 * The star also follows edits within an update (mw_surface_begin_update()). Call mw_star_update()
 * before the end of the update, with the vertices that the caller moved without an edit.
 *
 * @param editor  the editor
 * @param star    a star of its surface, which must outlive the editor or be detached before; it may
 *                be out of date
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK, also if the surface is not star-shaped; MW_ERROR_ARGUMENT for NULL, a star of
 *         another surface, or a borrowed one; MW_ERROR_MEMORY: the star does not follow.
 *
 * Belongs to the updating thread. On a shared surface other threads may query meanwhile. O(n); for
 * a star that is out of date O(n log n). Takes 5 bytes a facet and 4 a vertex, and room for half as
 * many more once edits make some. Each edit then takes longer in proportion to the facets that it
 * touches, and to all facets round a vertex of these that has 64 or more.
 */
MW_API mw_status mw_surface_editor_attach_star(mw_surface_editor *editor, mw_star *star,
                                               mw_error *error);

/** Detach a star. It is out of date after the next edit. Does nothing if the star is not attached.
 * Belongs to the updating thread. O(attached stars). */
MW_API void mw_surface_editor_detach_star(mw_surface_editor *editor, mw_star *star);

/* --- edits ------------------------------------------------------------------------------------ */

/** The kinds of edits. mw_surface_edit_add_vertex() and the functions after it explain each. */
typedef enum mw_surface_edit_kind {
    MW_SURFACE_ADD_VERTEX = 0,  /**< add a vertex at `point` */
    MW_SURFACE_REMOVE_VERTEX,   /**< remove vertex[0] and its triangles */
    MW_SURFACE_MOVE_VERTEX,     /**< move vertex[0] to `point` */
    MW_SURFACE_ADD_TRIANGLE,    /**< add the triangle of vertex[0], [1], [2] */
    MW_SURFACE_REMOVE_TRIANGLE, /**< remove `triangle` */
    MW_SURFACE_SPLIT_EDGE,      /**< split the edge from vertex[0] to vertex[1] at `point` */
    MW_SURFACE_SPLIT_TRIANGLE,  /**< split `triangle` at `point` */
    MW_SURFACE_FLIP,            /**< flip the edge from vertex[0] to vertex[1] */
    MW_SURFACE_COLLAPSE,        /**< merge vertex[0] into vertex[1], which joins an edge to it */
    MW_SURFACE_CUT,             /**< cut along the edges of `path` */
    MW_SURFACE_SEW,             /**< sew the border edges along `other` to those along `path` */
    MW_SURFACE_EDIT_KIND_COUNT
} mw_surface_edit_kind;

/** The word of a kind in a stream of edits, such as "split-edge"; NULL for any other number.
 * Thread-safe. O(1). */
MW_API const char *mw_surface_edit_name(mw_surface_edit_kind kind);

/** One edit. Members that its kind does not name are ignored. */
typedef struct mw_surface_edit {
    mw_surface_edit_kind kind;
    uint32_t triangle;
    uint32_t vertex[3];
    /** x, y, z, in mesh units. For MW_SURFACE_SPLIT_EDGE, MW_SURFACE_SPLIT_TRIANGLE and
     * MW_SURFACE_COLLAPSE a NaN as the first selects the usual place. */
    double point[3];
    const uint32_t *path;  /**< MW_SURFACE_CUT, MW_SURFACE_SEW: vertices, in their order */
    const uint32_t *other; /**< MW_SURFACE_SEW: as many vertices */
    size_t path_count;     /**< number of vertices in `path`, and in `other` */
} mw_surface_edit;

/** A vertex that an edit made, freed or moved. */
typedef struct mw_changed_vertex {
    uint32_t vertex;
    /** Of a vertex made by a cut: the vertex that it is a copy of. Of a vertex freed by a collapse
     * or a seam: the vertex that took its place. Otherwise MW_NONE. */
    uint32_t other;
} mw_changed_vertex;

/** What an edit changed. The arrays are owned by the editor, and valid until its next edit. */
typedef struct mw_surface_change {
    /** First the made triangles, then the reused ones, then the freed ones; each in ascending
     * order. A reused triangle got other vertices, or another order of its vertices. */
    const mw_changed_triangle *triangle;
    size_t made, reused, freed; /**< how many of each kind `triangle` holds */
    /** First the made vertices, then the freed ones, each in ascending order, then the moved one.
     */
    const mw_changed_vertex *vertex;
    size_t vertices_made, vertices_freed, vertices_moved;
    uint32_t reserved[8];
} mw_surface_change;

/**
 * Apply one edit. Equivalent to the function of its kind below.
 *
 * Between mw_surface_begin_update() and mw_surface_end_update() an edit is a part of that update:
 * call mw_prober_update() before its end, with a distance of 0 if only edits moved vertices.
 * Elsewhere an edit is an update by itself: attached probers and stars that were up to date before
 * the edit are up to date after it.
 *
 * @param editor  the editor
 * @param edit    the edit
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure, with the vertex or triangle concerned
 * @return MW_OK, or the error of the kind; on failure the surface is unchanged. All kinds:
 *         MW_ERROR_ARGUMENT if a pointer is NULL or the kind is unknown; MW_ERROR_INPUT if a vertex
 *         or triangle does not exist, a coordinate is not finite, or no triangle would be left;
 *         MW_ERROR_LIMIT if all numbers are used (mw_surface_editor_compact() frees some);
 *         MW_ERROR_MEMORY.
 *
 * Not thread-safe, except for queries of a shared surface. Time: proportional to the triangles that
 * the edit touches; for an edge also to the triangles round one of its ends, the one with fewer.
 * Memory grows now and then, in O(n).
 */
MW_API mw_status mw_surface_edit_apply(mw_surface_editor *editor, const mw_surface_edit *edit,
                                       mw_surface_change *change, mw_error *error);

/**
 * Add a vertex of no triangle. change->vertex names it.
 *
 * @param editor  the editor
 * @param point   x, y, z, finite, in mesh units
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(). Not thread-safe. O(1).
 */
MW_API mw_status mw_surface_edit_add_vertex(mw_surface_editor *editor, const double point[3],
                                            mw_surface_change *change, mw_error *error);

/**
 * Remove a vertex, and all triangles round it, which leaves a hole.
 *
 * @param editor  the editor
 * @param vertex  the vertex
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(). Not thread-safe. O(degree).
 */
MW_API mw_status mw_surface_edit_remove_vertex(mw_surface_editor *editor, uint32_t vertex,
                                               mw_surface_change *change, mw_error *error);

/**
 * Move a vertex. Its triangles stay as they are, whatever shape they get.
 *
 * @param editor  the editor
 * @param vertex  the vertex
 * @param point   x, y, z, finite, in mesh units
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(). Not thread-safe. O(degree).
 */
MW_API mw_status mw_surface_edit_move_vertex(mw_surface_editor *editor, uint32_t vertex,
                                             const double point[3], mw_surface_change *change,
                                             mw_error *error);

/**
 * Add a triangle of three vertices, and link it to the triangles at its edges.
 *
 * @param editor    the editor
 * @param vertices  its vertices, counter-clockwise as seen from its front
 * @param change    NULL, or receives what the edit changed
 * @param error     NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(); also MW_ERROR_INPUT if a vertex is named twice, an edge has
 *         two triangles, or its triangle has the opposite orientation.
 *
 * Not thread-safe. O(degree).
 */
MW_API mw_status mw_surface_edit_add_triangle(mw_surface_editor *editor, const uint32_t vertices[3],
                                              mw_surface_change *change, mw_error *error);

/**
 * Remove a triangle. Its vertices stay, perhaps with no triangle.
 *
 * @param editor    the editor
 * @param triangle  the triangle
 * @param change    NULL, or receives what the edit changed
 * @param error     NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(). Not thread-safe. O(1).
 */
MW_API mw_status mw_surface_edit_remove_triangle(mw_surface_editor *editor, uint32_t triangle,
                                                 mw_surface_change *change, mw_error *error);

/**
 * Split an edge by a new vertex, and with it the one or two triangles at the edge.
 *
 * Of the two parts of a triangle, the part at the lower-numbered end of the edge keeps the number.
 *
 * @param editor  the editor
 * @param a, b    the ends of the edge
 * @param point   NULL: the middle of the edge; or x, y, z, finite
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(); also MW_ERROR_INPUT if no edge joins the vertices, or both
 *         its triangles have the same vertices.
 *
 * Not thread-safe. Time: proportional to the lesser degree of the two ends.
 */
MW_API mw_status mw_surface_edit_split_edge(mw_surface_editor *editor, uint32_t a, uint32_t b,
                                            const double point[3], mw_surface_change *change,
                                            mw_error *error);

/**
 * Split a triangle in three by a new vertex. One part keeps the number.
 *
 * @param editor    the editor
 * @param triangle  the triangle
 * @param point     NULL: its centre of gravity; or x, y, z, finite
 * @param change    NULL, or receives what the edit changed
 * @param error     NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(). Not thread-safe. O(1).
 */
MW_API mw_status mw_surface_edit_split_triangle(mw_surface_editor *editor, uint32_t triangle,
                                                const double point[3], mw_surface_change *change,
                                                mw_error *error);

/**
 * Flip the edge between two vertices, as mw_surface_flip() does. Both triangles keep their numbers.
 *
 * @param editor  the editor
 * @param a, b    the ends of the edge
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(); also MW_ERROR_INPUT if no edge joins the vertices, it has one
 *         triangle only, its triangles have opposite orientation, or an edge joins the two opposite
 *         vertices already.
 *
 * Not thread-safe. Time: proportional to the degrees of the ends and of the opposite vertices.
 */
MW_API mw_status mw_surface_edit_flip(mw_surface_editor *editor, uint32_t a, uint32_t b,
                                      mw_surface_change *change, mw_error *error);

/**
 * Collapse the edge between two vertices: `gone` merges into `kept`, and the triangles at the edge
 * go.
 *
 * The link condition [Dey, Edelsbrunner, Guha, Nekhayev 1999] is checked, so that the surface keeps
 * its topology:
 * - the only common neighbours of the two vertices are the corners opposite to the edge;
 * - no edge is opposite to `gone` in one triangle and to `kept` in another;
 * - if both vertices lie on a border, so does the edge;
 * - at most one of the two vertices is pinched.
 *
 * @param editor      the editor
 * @param gone, kept  the ends of the edge
 * @param point       NULL: `kept` stays where it is; or its new place, finite
 * @param change      NULL, or receives what the edit changed
 * @param error       NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(); also MW_ERROR_INPUT if no edge joins the vertices, or the
 *         link condition fails.
 *
 * Not thread-safe. O(d log d) for the sum d of both degrees.
 */
MW_API mw_status mw_surface_edit_collapse(mw_surface_editor *editor, uint32_t gone, uint32_t kept,
                                          const double point[3], mw_surface_change *change,
                                          mw_error *error);

/**
 * Cut the surface along a path of edges, as a scalpel does: the edges become borders.
 *
 * A vertex is divided if the path goes through it, or begins or ends there on a border. The side
 * with the lowest triangle keeps the vertex; the other sides get copies. A path may be closed and
 * may cross itself.
 *
 * @param editor  the editor
 * @param path    at least two vertices; each two in succession are joined by an edge
 * @param count   number of vertices
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(); also MW_ERROR_INPUT if no edge joins two successive vertices,
 *         an edge is a border already or comes twice, or both sides of an edge would keep the same
 *         ends: a cut that ends inside the surface needs at least two edges. MW_ERROR_ARGUMENT for
 *         fewer than two vertices.
 *
 * Not thread-safe. O(d log d) for the sum d of the degrees along the path.
 */
MW_API mw_status mw_surface_edit_cut(mw_surface_editor *editor, const uint32_t *path, size_t count,
                                     mw_surface_change *change, mw_error *error);

/**
 * Sew a chain of border edges to another one. Vertex i of `other` merges into vertex i of `path`,
 * which stays in its place.
 *
 * If other border edges get the same ends by this, they become one edge, too. The chains may share
 * vertices, such as the end of a cut.
 *
 * @param editor  the editor
 * @param path    at least two vertices; each two in succession are joined by a border edge
 * @param other   as many vertices, joined in the same way
 * @param count   number of vertices in each
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_surface_edit_apply(); also MW_ERROR_INPUT if no border edge joins two successive
 *         vertices, a vertex would merge into two, a triangle would have a vertex twice, an edge
 *         would have three triangles, or two triangles of opposite orientation. MW_ERROR_ARGUMENT
 *         for fewer than two vertices.
 *
 * Not thread-safe. O(d log d) for the sum d of the degrees along both chains.
 */
MW_API mw_status mw_surface_edit_sew(mw_surface_editor *editor, const uint32_t *path,
                                     const uint32_t *other, size_t count, mw_surface_change *change,
                                     mw_error *error);

/**
 * Undo the latest edit that has not been undone. Restores the surface and all numbers.
 *
 * Vertices that were overwritten in mw_surface_points() stay where they are, except for those that
 * the edit moved.
 *
 * @param editor  the editor
 * @param change  NULL, or receives what undoing changed
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT if there is no edit to undo, or it was not kept
 *         (mw_surface_editor_options.undo); MW_ERROR_MEMORY, and nothing has changed.
 *
 * Time: as the edit. Not thread-safe.
 */
MW_API mw_status mw_surface_edit_undo(mw_surface_editor *editor, mw_surface_change *change,
                                      mw_error *error);

/**
 * Renumber vertices and triangles without gaps, in the same order. Earlier edits cannot be undone
 * afterwards.
 *
 * The boxes of attached probers are made anew; attached stars get the new numbers.
 *
 * @param editor     the editor
 * @param triangles  NULL, or an array of mw_surface_triangle_count() numbers: receives the new
 *                   number of each triangle, MW_NONE for freed ones
 * @param vertices   the same for vertices, mw_surface_vertex_count() numbers
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_MEMORY, and nothing has changed.
 *
 * Time: O(n), O(n log n) with boxes. Not thread-safe.
 */
MW_API mw_status mw_surface_editor_compact(mw_surface_editor *editor, uint32_t *triangles,
                                           uint32_t *vertices, mw_error *error);

/* --- the present surface ---------------------------------------------------------------------- */

/** Sizes and counts of an editor. */
typedef struct mw_surface_editor_info {
    uint32_t vertices, triangles; /**< without freed ones */
    /** All numbers are below these: mw_surface_vertex_count() and mw_surface_triangle_count(). */
    uint32_t vertex_range, triangle_range;
    uint32_t border_edges; /**< edges of one triangle */
    size_t undoable;       /**< edits that can be undone */
    /** Memory of the editor and of the room in the surface that edits will use; without probers and
     * stars. */
    size_t bytes;
    size_t undo_bytes; /**< of these, for undo */
    uint64_t edits;    /**< edits applied since the editor was created, undone ones included */
    uint32_t reserved[8];
} mw_surface_editor_info;

/** Fill `info` with sizes and counts of the editor. Thread-safe while no edit runs. O(1). */
MW_API void mw_surface_editor_describe(const mw_surface_editor *editor,
                                       mw_surface_editor_info *info);

/**
 * Copy the vertices of a triangle, as mw_surface_triangle() does.
 *
 * @param editor    the editor
 * @param triangle  any number
 * @param vertices  receives three vertices; unchanged if there is no such triangle
 * @return 1, or 0 if no triangle has that number.
 *
 * Thread-safe while no edit runs. O(1).
 */
MW_API int mw_surface_editor_triangle(const mw_surface_editor *editor, uint32_t triangle,
                                      uint32_t vertices[3]);

/**
 * Copy the coordinates of a vertex.
 *
 * @param editor  the editor
 * @param vertex  any number
 * @param point   receives x, y, z; unchanged if there is no such vertex
 * @return 1, or 0 if no vertex has that number.
 *
 * Thread-safe while no edit runs. O(1).
 */
MW_API int mw_surface_editor_vertex(const mw_surface_editor *editor, uint32_t vertex,
                                    double point[3]);

/**
 * List the triangles round a vertex, in ascending order.
 *
 * @param editor     the editor
 * @param vertex     any number
 * @param triangles  receives at most `capacity` triangles, the lowest; may be NULL if `capacity` is
 *                   0
 * @param capacity   room in `triangles`
 * @return how many there are, also if `capacity` is less.
 *
 * Thread-safe while no edit runs. O(d * min(d, capacity)) for the degree d.
 */
MW_API size_t mw_surface_editor_triangles_of(const mw_surface_editor *editor, uint32_t vertex,
                                             uint32_t *triangles, size_t capacity);

/**
 * Find the triangles at the edge between two vertices.
 *
 * @param editor     the editor
 * @param a, b       the ends of the edge: any two numbers
 * @param triangles  receives the triangles, the lower one first; MW_NONE where there is none
 * @return how many there are: 0, 1 or 2.
 *
 * Thread-safe while no edit runs. Time: proportional to the lesser degree of the two ends.
 */
MW_API unsigned mw_surface_editor_edge(const mw_surface_editor *editor, uint32_t a, uint32_t b,
                                       uint32_t triangles[2]);

#ifdef __cplusplus
}
#endif
#endif
