/**
 * @file edit.h
 * A planar mesh that changes between two queries.
 *
 * An editor copies a mesh and changes its copy by local edits. The cost of an edit depends on the
 * triangles that it touches, not on the size of the mesh. Between two edits the editor's locator
 * answers queries exactly, by every walk, and nothing is rebuilt.
 *
 * Numbers of vertices and triangles are handles. An edit renumbers only what it touches. Freed
 * numbers are not used again before mw_editor_compact().
 *
 * Threads: any number of threads may read the editor and query its locator, each with its own
 * cursor, while no edit is running. An edit must not overlap with any other call.
 */
#ifndef MESHWALK_EDIT_H
#define MESHWALK_EDIT_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A mesh that changes, with its locator. Opaque. */
typedef struct mw_editor mw_editor;

/** Whether an editor keeps its mesh Delaunay. Borders and constrained edges are never flipped. */
typedef enum mw_delaunay_mode {
    MW_DELAUNAY_AUTO = 0, /**< keep the mesh Delaunay if it is Delaunay at first */
    MW_DELAUNAY_MAKE,     /**< make the mesh Delaunay at first, by flips, and keep it so */
    MW_DELAUNAY_NEVER     /**< flip no edge except by MW_EDIT_FLIP */
} mw_delaunay_mode;

/** Options of an editor. Zero-initialised options select the defaults. */
typedef struct mw_editor_options {
    mw_delaunay_mode delaunay; /**< whether the mesh is kept Delaunay */
    int log;                   /**< 1: keep a list of all edits, for mw_editor_log() */
    /** How many edits can be undone; each takes 400 to 1000 bytes. SIZE_MAX: all. */
    size_t undo;
    /** Edges that must not be flipped away: two vertices per edge, as in mw_constrained_edges.edge.
     * Every pair must be an edge of the mesh. Read during mw_editor_create() only. */
    const uint32_t *constrained_edges;
    size_t constrained_edge_count; /**< number of those edges */
    /** Threads used by mw_editor_mesh(), mw_editor_compact() and mw_edit_insert_points(); 0: one
     * per processor. Results do not depend on it. */
    uint32_t threads;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_editor_options;

/**
 * Create an editor from a mesh.
 *
 * The mesh and its fields are copied; the caller may destroy the mesh afterwards. If the mesh fills
 * its convex hull, the hull grows and shrinks with the vertices. Otherwise the border edges are
 * fixed like constrained edges.
 *
 * @param mesh     the mesh to copy
 * @param options  NULL selects the defaults
 * @param out      receives the editor, owned by the caller; NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT if the mesh is not an embedding, has triangles without area, or has
 *         two used vertices with equal coordinates; or if a constrained edge is not an edge of the
 *         mesh (the error names the first); MW_ERROR_ARGUMENT, MW_ERROR_LIMIT, MW_ERROR_MEMORY,
 *         MW_CANCELLED.
 *
 * Thread-safe for a const mesh. Time and memory: about linear in the triangles.
 */
MW_API mw_status mw_editor_create(const mw_mesh *mesh, const mw_editor_options *options,
                                  mw_editor **out, mw_error *error);

/** Destroy an editor with its locator and indices. NULL is allowed. */
MW_API void mw_editor_destroy(mw_editor *editor);

/* --- edits ------------------------------------------------------------------------------------ */

/** The kinds of edits. mw_edit_insert() and the functions after it explain each. */
typedef enum mw_edit_kind {
    MW_EDIT_INSERT = 0, /**< insert a vertex at (x, y) */
    MW_EDIT_REMOVE,     /**< remove `vertex` */
    MW_EDIT_MOVE,       /**< move `vertex` to (x, y) */
    MW_EDIT_FLIP,       /**< flip the edge from `vertex` to `other` */
    MW_EDIT_CONSTRAIN,  /**< constrain the segment from `vertex` to `other` */
    MW_EDIT_RELEASE,    /**< release the constraints along the segment from `vertex` to `other` */
    MW_EDIT_VALUE,      /**< set `field` of `vertex` to `value` */
    MW_EDIT_KIND_COUNT
} mw_edit_kind;

/** One edit, as requested, logged and replayed. Members that its kind does not name are ignored. */
typedef struct mw_edit {
    mw_edit_kind kind;
    uint32_t vertex, other;
    uint32_t field; /**< number of a field, from mw_editor_field_by_name() */
    double x, y;
    /** MW_EDIT_VALUE: the new value. MW_EDIT_INSERT: the value of `field` at the new vertex; NaN:
     * interpolated, as all other fields are. */
    double value;
} mw_edit;

/** A triangle that an edit made, freed, or gave other vertices or another order of vertices. */
typedef struct mw_changed_triangle {
    uint32_t triangle;
    /** Its vertices before the edit, or MW_NONE if the edit made it. mw_editor_triangle() has those
     * after the edit. */
    uint32_t before[3];
} mw_changed_triangle;

/**
 * What an edit changed.
 *
 * Triangles round a moved vertex keep their vertices; they are listed only if an edge was flipped.
 * Holes keep their numbers.
 */
typedef struct mw_change {
    /** First the made triangles, then the reused ones, then the freed ones, each in ascending
     * order. Owned by the editor, valid until its next edit. */
    mw_changed_triangle *triangle;
    size_t made, reused, freed; /**< how many of each kind `triangle` holds */
    /** The inserted, removed or moved vertex. If a vertex already was at the point to insert: that
     * vertex. */
    uint32_t vertex;
    uint32_t vertices_made;  /**< new vertices: numbered from `vertex` on */
    uint32_t vertices_freed; /**< removed vertices: numbered from `vertex` on */
    /** Flips that made the mesh Delaunay again. An insertion counts the flips that inserting step
     * by step would need. Filling a small cavity at once counts none. */
    uint32_t flips;
    uint32_t constrained_edges; /**< MW_EDIT_CONSTRAIN, MW_EDIT_RELEASE: edges along the segment */
    uint32_t reserved[6];
} mw_change;

/**
 * Apply one edit. Equivalent to the function of its kind below.
 *
 * @param editor  the editor
 * @param edit    the edit
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure, with the vertex or triangle concerned
 * @return MW_OK, or the error of the kind; on failure the mesh is unchanged. All kinds:
 *         MW_ERROR_ARGUMENT if a pointer is NULL or the kind or field is unknown; MW_ERROR_INPUT if
 *         a vertex does not exist or belongs to no triangle, a coordinate is not finite, or no
 *         triangle would be left; MW_ERROR_LIMIT if all numbers are used (mw_editor_compact() frees
 *         some); MW_ERROR_MEMORY.
 *
 * If the mesh is kept Delaunay, edges that are no longer Delaunay are flipped, decided exactly
 * [Lawson 1977]. Not thread-safe: no other call on the editor or its locator may run. Time: that of
 * the kind's function.
 */
MW_API mw_status mw_edit_apply(mw_editor *editor, const mw_edit *edit, mw_change *change,
                               mw_error *error);

/**
 * Insert a vertex at (x, y).
 *
 * A point inside a triangle or on an edge splits it; the halves of a constrained edge are
 * constrained. A point outside a mesh that fills its convex hull extends the hull. Inserting at an
 * existing vertex changes nothing. All fields are interpolated. New triangles get new numbers,
 * except one (inside a triangle) or two (on an edge), which reuse the numbers of the split
 * triangles.
 *
 * @param editor  the editor
 * @param x, y    finite coordinates, in mesh units
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_edit_apply(); also MW_ERROR_INPUT if the point is outside a mesh whose border is
 *         fixed.
 *
 * Time: the walk to the point, from the previous edit if that was near, else from the locator's
 * guide; then proportional to the triangles in conflict, about six for scattered points. Not
 * thread-safe.
 */
MW_API mw_status mw_edit_insert(mw_editor *editor, double x, double y, mw_change *change,
                                mw_error *error);

/**
 * Remove a vertex. Its triangles are replaced by two fewer, which keep the lowest numbers.
 *
 * If the mesh fills its convex hull, a vertex of the hull can be removed: the hull shrinks. Any
 * other vertex on the border or on constrained edges can be removed only if it has exactly two such
 * edges and they are collinear.
 *
 * @param editor  the editor
 * @param vertex  the vertex
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_edit_apply(); also MW_ERROR_INPUT for fixed edges as above.
 *
 * Time: O(d log d) for a vertex of degree d. Not thread-safe.
 */
MW_API mw_status mw_edit_remove(mw_editor *editor, uint32_t vertex, mw_change *change,
                                mw_error *error);

/**
 * Move a vertex to (x, y). The vertex keeps its number and its values.
 *
 * The vertex moves in place as long as no triangle round it turns over; otherwise it is removed and
 * inserted again. A vertex on a constrained edge or on a fixed border takes its triangles along. If
 * a mesh that fills its convex hull would no longer do so, new triangles fill the gap.
 *
 * @param editor  the editor
 * @param vertex  the vertex
 * @param x, y    finite coordinates, in mesh units
 * @param change  NULL, or receives what the edit changed
 * @param error   NULL, or receives the message of a failure
 * @return as mw_edit_apply(); also MW_ERROR_INPUT if a vertex with fixed edges would turn a
 *         triangle over or flatten it, cover other vertices or triangles, or let an edge cross an
 *         edge or meet a vertex.
 *
 * Time: O(d) in place, else as a removal and an insertion. Not thread-safe.
 */
MW_API mw_status mw_edit_move(mw_editor *editor, uint32_t vertex, double x, double y,
                              mw_change *change, mw_error *error);

/**
 * Flip the edge between two vertices. Its two triangles must form a strictly convex quadrilateral.
 *
 * Afterwards the mesh is no longer kept Delaunay, unless the four vertices are cocircular.
 *
 * @param editor    the editor
 * @param from, to  the ends of the edge
 * @param change    NULL, or receives what the edit changed
 * @param error     NULL, or receives the message of a failure
 * @return as mw_edit_apply(); also MW_ERROR_INPUT if there is no such edge, it is fixed, or the
 *         quadrilateral is not strictly convex.
 *
 * Time: O(d) for the degree of `from`. Not thread-safe.
 */
MW_API mw_status mw_edit_flip(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change,
                              mw_error *error);

/**
 * Constrain the segment between two vertices: make it an edge, or a chain of edges, that stays.
 *
 * Vertices on the segment divide it. The segment must not cross a constrained edge or leave the
 * mesh.
 *
 * @param editor    the editor
 * @param from, to  the ends of the segment
 * @param change    NULL, or receives what the edit changed
 * @param error     NULL, or receives the message of a failure
 * @return as mw_edit_apply(); also MW_ERROR_INPUT if the segment crosses a constrained edge or
 *         leaves the mesh.
 *
 * Time: O(m log m) for m crossed triangles, expected. Not thread-safe.
 */
MW_API mw_status mw_edit_constrain(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change,
                                   mw_error *error);

/**
 * Release the constraints along the segment between two vertices. The edges may be flipped again.
 *
 * @param editor    the editor
 * @param from, to  the ends of the segment
 * @param change    NULL, or receives what the edit changed
 * @param error     NULL, or receives the message of a failure
 * @return as mw_edit_apply(); also MW_ERROR_INPUT if a part of the segment is not constrained, or
 *         is a fixed border edge.
 *
 * Time: O(m) for the edges along the segment, and the flips. Not thread-safe.
 */
MW_API mw_status mw_edit_release(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change,
                                 mw_error *error);

/**
 * Set the value of a field at a vertex.
 *
 * @param editor  the editor
 * @param field   number of a field, from mw_editor_field_by_name()
 * @param vertex  the vertex
 * @param value   any value, also NaN
 * @param error   NULL, or receives the message of a failure
 * @return as mw_edit_apply().
 *
 * Time: O(1). Not thread-safe.
 */
MW_API mw_status mw_edit_value(mw_editor *editor, uint32_t field, uint32_t vertex, double value,
                               mw_error *error);

/**
 * Insert n points as one edit. Faster than inserting them one by one.
 *
 * If each point is near the one before, points are inserted in the order given; otherwise along a
 * Hilbert curve. The result, numbers included, is that of single insertions in the same order. All
 * points together are one edit to undo, and n entries of the log. All fields are interpolated. The
 * call is fastest without a change report: `change` NULL, no undo, and no index except the
 * locator's guide.
 *
 * @param editor    the editor
 * @param points    x and y of each point, in mesh units
 * @param n         number of points
 * @param stride    doubles from one point to the next; 0 means 2
 * @param vertices  NULL, or receives n numbers: the vertex at each point
 * @param change    NULL, or receives what the edit changed. change->vertex is the first new vertex;
 *                  new vertices are numbered consecutively. MW_NONE if no vertex was new.
 * @param error     NULL, or receives the message of a failure, naming a point
 * @return MW_OK; MW_ERROR_INPUT, MW_ERROR_LIMIT, MW_ERROR_MEMORY as for an insertion;
 *         MW_ERROR_ARGUMENT if a pointer is NULL or the stride is 1; MW_CANCELLED. On failure the
 *         mesh is unchanged and `vertices` is unspecified.
 *
 * Time: n insertions with short walks, and the sort along the curve. Not thread-safe.
 */
MW_API mw_status mw_edit_insert_points(mw_editor *editor, const double *points, size_t n,
                                       size_t stride, uint32_t *vertices, mw_change *change,
                                       mw_error *error);

/**
 * Undo the latest edit that has not been undone. Restores the mesh and all numbers.
 *
 * @param editor  the editor
 * @param change  NULL, or receives what undoing changed
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT if there is no edit to undo, or it was not kept
 *         (mw_editor_options.undo); MW_ERROR_MEMORY, and nothing has changed.
 *
 * Time: as the edit. Not thread-safe.
 */
MW_API mw_status mw_edit_undo(mw_editor *editor, mw_change *change, mw_error *error);

/**
 * List the edits since the editor was created or compacted, without those that were undone.
 *
 * Applied in this order to the same mesh, they give the same mesh with the same numbers.
 *
 * @param editor  the editor
 * @param count   receives the number of edits
 * @return the edits, owned by the editor and valid until its next edit; NULL, and a count of 0,
 *         without mw_editor_options.log.
 *
 * Thread-safe while no edit runs. O(1).
 */
MW_API const mw_edit *mw_editor_log(const mw_editor *editor, size_t *count);

/**
 * Renumber vertices and triangles without gaps, in the same order, and lay them out along a curve
 * in memory.
 *
 * Earlier edits cannot be undone afterwards, and the log begins anew. Cursors and indices stay
 * valid; a cursor forgets the triangle of its last query. Holes are renumbered.
 *
 * @param editor     the editor
 * @param triangles  NULL, or an array of mw_editor_info.triangle_range numbers: receives the new
 *                   number of each triangle, MW_NONE for freed ones
 * @param vertices   the same for vertices, mw_editor_info.vertex_range numbers
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_MEMORY or MW_CANCELLED, and nothing has changed.
 *
 * Time: O(n). Not thread-safe.
 */
MW_API mw_status mw_editor_compact(mw_editor *editor, uint32_t *triangles, uint32_t *vertices,
                                   mw_error *error);

/* --- the present mesh ------------------------------------------------------------------------- */

/** Sizes and counts of an editor. */
typedef struct mw_editor_info {
    uint32_t vertices, triangles;          /**< without freed ones */
    uint32_t vertex_range, triangle_range; /**< all numbers are below these */
    uint32_t constrained_edges;            /**< constrained edges, without a fixed border */
    int delaunay;                          /**< 1: the mesh is kept Delaunay */
    /** 1: the mesh fills its convex hull, which grows and shrinks. 0: its border is fixed. Decided
     * when the editor is created. */
    int convex;
    size_t undoable;    /**< edits that can be undone */
    size_t bytes;       /**< memory in bytes, with room for further edits */
    size_t undo_bytes;  /**< of these, for undo and the log */
    size_t index_bytes; /**< of these, for indices and the locator's guide */
    uint64_t edits;     /**< edits applied since the editor was created, undone ones included */
    uint64_t refreshes; /**< how often an index or the guide was rebuilt */
    uint32_t reserved[8];
} mw_editor_info;

/** Fill `info` with sizes and counts of the editor. Thread-safe while no edit runs. O(indices). */
MW_API void mw_editor_describe(const mw_editor *editor, mw_editor_info *info);

/**
 * Copy the vertices of a triangle: counter-clockwise, unless the triangle was clockwise in the
 * caller's mesh.
 *
 * @param editor    the editor
 * @param triangle  any number
 * @param vertices  receives three vertices; unchanged if there is no such triangle
 * @return 1, or 0 if no triangle has that number.
 *
 * Thread-safe while no edit runs. O(1).
 */
MW_API int mw_editor_triangle(const mw_editor *editor, uint32_t triangle, uint32_t vertices[3]);

/**
 * Copy the coordinates of a vertex.
 *
 * @param editor  the editor
 * @param vertex  any number
 * @param point   receives x and y; unchanged if there is no such vertex
 * @return 1, or 0 if no vertex has that number.
 *
 * Thread-safe while no edit runs. O(1).
 */
MW_API int mw_editor_vertex(const mw_editor *editor, uint32_t vertex, double point[2]);

/**
 * Find the lowest triangle that has a vertex as a corner.
 *
 * @param editor  the editor
 * @param vertex  any number
 * @return the triangle; MW_NONE if no triangle has this vertex.
 *
 * Thread-safe while no edit runs. O(degree).
 */
MW_API uint32_t mw_editor_triangle_of(const mw_editor *editor, uint32_t vertex);

/**
 * List the vertices that edges join to a vertex, counter-clockwise. For a vertex on a border the
 * list begins and ends with a border edge.
 *
 * @param editor      the editor
 * @param vertex      any number
 * @param neighbours  receives at most `capacity` vertices; may be NULL if `capacity` is 0
 * @param capacity    room in `neighbours`
 * @return how many there are, also if `capacity` is less; 0 if the vertex does not exist or
 *         belongs to no triangle.
 *
 * Thread-safe while no edit runs. O(degree).
 */
MW_API size_t mw_editor_adjacent_vertices(const mw_editor *editor, uint32_t vertex,
                                          uint32_t *neighbours, size_t capacity);

/** What kind of edge joins two vertices. */
typedef enum mw_edge_kind {
    MW_EDGE_NONE = 0,      /**< no edge of the mesh */
    MW_EDGE_UNCONSTRAINED, /**< an inner edge that may be flipped away */
    MW_EDGE_CONSTRAINED,   /**< an inner edge that stays */
    MW_EDGE_BORDER         /**< an edge of one triangle */
} mw_edge_kind;

/**
 * Tell what kind of edge joins two vertices.
 *
 * @param editor    the editor
 * @param from, to  any two numbers
 * @return the kind; MW_EDGE_NONE also if a vertex does not exist.
 *
 * Thread-safe while no edit runs. O(degree).
 */
MW_API mw_edge_kind mw_editor_edge(const mw_editor *editor, uint32_t from, uint32_t to);

/**
 * Find a field by its name.
 *
 * @param editor  the editor
 * @param name    the name, not NULL
 * @return the number of the field, from 0; MW_NONE if no field has that name.
 *
 * Thread-safe while no edit runs. O(fields).
 */
MW_API uint32_t mw_editor_field_by_name(const mw_editor *editor, const char *name);

/**
 * Tell the value of a field at a vertex.
 *
 * @param editor  the editor
 * @param field   number of a field
 * @param vertex  any number
 * @return the value; NaN if the field or the vertex does not exist.
 *
 * Thread-safe while no edit runs. O(1).
 */
MW_API double mw_editor_value(const mw_editor *editor, uint32_t field, uint32_t vertex);

/**
 * Interpolate a field linearly at n locations, as mw_interpolate() does.
 *
 * @param editor     the editor
 * @param field      number of a field
 * @param locations  n locations from the editor's locator, made since its last edit
 * @param n          number of locations
 * @param result     receives n values; NaN for a location without a triangle
 *
 * Thread-safe while no edit runs. O(n), without allocation.
 */
MW_API void mw_editor_interpolate(const mw_editor *editor, uint32_t field,
                                  const mw_location *locations, size_t n, double *result);

/**
 * Copy the present mesh, numbered as mw_editor_compact() would number it, with all fields.
 *
 * Vertices of no triangle are kept.
 *
 * @param editor     the editor
 * @param triangles  NULL, or receives the new number of each triangle, as in mw_editor_compact()
 * @param vertices   the same for vertices
 * @param out        receives the mesh, owned by the caller (mw_mesh_destroy()); NULL on failure
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK, MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe while no edit runs. O(n).
 */
MW_API mw_status mw_editor_mesh(const mw_editor *editor, uint32_t *triangles, uint32_t *vertices,
                                mw_mesh **out, mw_error *error);

/**
 * Copy the constrained edges. A fixed border is not among them.
 *
 * @param editor  the editor
 * @param count   receives the number of edges
 * @return two vertices per edge, packed, released by the caller with free(); NULL if memory runs
 *         out.
 *
 * Thread-safe while no edit runs. O(n).
 */
MW_API uint32_t *mw_editor_constrained_edges(const mw_editor *editor, size_t *count);

/* --- location between edits ------------------------------------------------------------------- */

/**
 * Give the locator of the present mesh. It is the same object as long as the editor exists.
 *
 * Its cursors survive edits: if a cursor's last triangle is gone, the next query starts in a
 * triangle that replaced it. Pockets and holes are filled; holes keep their numbers until
 * mw_editor_compact(). The locator has no border index and no stored areas. Its locations have the
 * editor's triangle numbers.
 *
 * @param editor  the editor
 * @return the locator, owned by the editor.
 *
 * Thread-safe, as its queries are, while no edit runs. O(1).
 */
MW_API const mw_locator *mw_editor_locator(const mw_editor *editor);

/**
 * Build or rebuild an index for the editor's locator, as mw_index_create() does.
 *
 * The editor owns the index and keeps it up to date. Grids and layers follow each edit at O(1)
 * expected cost; they are rebuilt when the number of vertices has doubled or halved since they were
 * built. In layers a new vertex rises with the usual chance [Devillers 2002], and a removed vertex
 * leaves all layers. MW_START_CURVE and the published starts (buckets, k-d tree) are rebuilt only
 * by this function; after edits walks from them get longer, and answers stay exact. The locator's
 * own guide is rebuilt when the number of vertices has tripled or halved, when the vertices outside
 * its extent are a quarter of all, and after two insertions per vertex, where any other edit counts
 * as two.
 *
 * @param editor   the editor
 * @param start    the start to build an index for; one index per start
 * @param options  as for mw_index_create(); NULL selects the defaults
 * @param index    receives the index, valid until the editor is destroyed
 * @param error    NULL, or receives the message of a failure
 * @return as mw_index_create().
 *
 * Not thread-safe. Cost as mw_index_create().
 */
MW_API mw_status mw_editor_index(mw_editor *editor, mw_start_kind start,
                                 const mw_index_options *options, const mw_index **index,
                                 mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
