/* edit.h - a planar mesh that changes between two queries.
 *
 * An editor holds a triangulation of its own, made from a mesh, and changes it by local edits: what an edit costs depends on the
 * triangles it touches, not on the mesh. Between two edits the editor's locator answers as any locator does, by every walk, and
 * exactly; nothing is rebuilt. Numbers are handles: an edit renumbers nothing that it does not touch, and the numbers of what it frees are
 * not used again before mw_editor_compact.
 *
 * Edits and queries alternate: any number of threads may query, with a cursor each, while no edit is under way. */
#ifndef MESHWALK_EDIT_H
#define MESHWALK_EDIT_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mw_editor mw_editor;

/* Whether an editor keeps its mesh Delaunay, its border and constraints respected. */
typedef enum mw_delaunay_mode {
    MW_DELAUNAY_AUTO = 0, /* a mesh that is Delaunay is kept so                */
    MW_DELAUNAY_MAKE,     /* one that is not is made so first, by flips        */
    MW_DELAUNAY_NEVER     /* no edge is flipped unless it is asked for         */
} mw_delaunay_mode;

/* All zero = choose. */
typedef struct mw_editor_options {
    mw_delaunay_mode delaunay;
    int log; /* 1: keep the list of all edits (mw_editor_log)                                                       */
    size_t
        undo; /* so many edits can be undone, 400 to 1000 bytes each; SIZE_MAX: all                                   */
    const uint32_t *constrained_edges; /* two vertices each, as mw_constrained_edges.edge: edges of the mesh that are
                                          not to be flipped away */
    size_t constrained_edge_count;
    uint32_t
        threads; /* of mw_editor_mesh, mw_editor_compact, and of the order of many points; 0: as many as processors */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[5];
} mw_editor_options;

/* Take a mesh, which is copied with its fields and may be destroyed.
 *   options  NULL = all zero
 *   out      owned by the caller (mw_editor_destroy); NULL on failure
 * The border is fixed as constraints are, unless the mesh fills its convex hull: then the hull grows and shrinks with the points.
 * MW_ERROR_INPUT: the mesh is no embedding, has flat triangles, or vertices that are used at one place (the error names the first); a
 * constraint is no edge of the mesh. MW_ERROR_ARGUMENT, MW_ERROR_LIMIT, MW_ERROR_MEMORY. */
MW_API mw_status mw_editor_create(const mw_mesh *mesh, const mw_editor_options *options, mw_editor **out,
                                  mw_error *error);
MW_API void mw_editor_destroy(mw_editor *editor); /* NULL is allowed */

/* --- edits --------------------------------------------------------------------------------------------------------- */

typedef enum mw_edit_kind {
    MW_EDIT_INSERT = 0, /* a vertex at x, y                                                                   */
    MW_EDIT_REMOVE,     /* `vertex`                                                                           */
    MW_EDIT_MOVE,       /* `vertex` to x, y                                                                   */
    MW_EDIT_FLIP,       /* the edge from `vertex` to `other`                                                  */
    MW_EDIT_CONSTRAIN,  /* the straight way from `vertex` to `other` becomes an edge that stays, or several   */
    MW_EDIT_RELEASE,    /* the constraints on the straight way from `vertex` to `other` end                   */
    MW_EDIT_VALUE,      /* `field` of `vertex` becomes `value`                                                */
    MW_EDIT_KIND_COUNT
} mw_edit_kind;

/* One edit, as it is asked for, logged and replayed. Members that its kind does not name are not read. */
typedef struct mw_edit {
    mw_edit_kind kind;
    uint32_t vertex, other;
    uint32_t field; /* number of a field (mw_editor_field_by_name)                                             */
    double x, y;
    double value; /* MW_EDIT_INSERT: of `field` at the new vertex; NaN: interpolated, as the other fields are */
} mw_edit;

/* A triangle that an edit made, freed, or gave other vertices (or the same in another order). */
typedef struct mw_changed_triangle {
    uint32_t triangle;
    uint32_t
        before[3]; /* its vertices before the edit; MW_NONE if it was made. mw_editor_triangle tells those after it */
} mw_changed_triangle;

/* What an edit changed. Triangles round a vertex that was moved keep their vertices, and are not
 * listed unless flipped. Holes keep their numbers. */
typedef struct mw_change {
    mw_changed_triangle *triangle; /* `made` ones, then `reused`, then `freed`; each in order of number. Owned by
                                      the editor, until its next edit                                             */
    size_t made, reused, freed;
    uint32_t vertex; /* the one inserted, removed or moved; where there was one at the place to insert at, that one */
    uint32_t vertices_made;  /* new ones: `vertex`, and (mw_edit_insert_points) those next in number                  */
    uint32_t vertices_freed; /* gone: `vertex`, and (what mw_edit_undo takes back) those next in number               */
    uint32_t flips; /* edges exchanged to make the mesh Delaunay again: as many as one after another would be to
                         put a vertex in; none where a small star is filled at once                               */
    uint32_t constrained_edges; /* MW_EDIT_CONSTRAIN, MW_EDIT_RELEASE: edges on the way                            */
    uint32_t reserved[6];
} mw_change;

/* Carry out an edit. `change` may be NULL or is filled. On failure nothing has changed. Not thread-safe; queries have to wait.
 *   insert     A place inside a triangle or on an edge splits it; the halves of a constraint are constraints. Outside of a mesh
 *              that fills its hull the hull grows. Where a vertex is there is nothing to do. New triangles get new numbers, but for one,
 *              or two on an edge.
 *   remove     Its triangles are replaced by two less, which keep the lower numbers. On the hull of a mesh that fills it the hull
 *              shrinks. A vertex on the border or on constraints can go only where two of them meet and are in line.
 *   move       In place while no triangle round the vertex turns over; else by removing and inserting, the vertex keeps its number and
 *              values. A vertex on a constraint, or on a border that is fixed, keeps its triangles: the move is refused where
 *              one of them would turn over or lose its area, cover other vertices or triangles, or where an edge of it would
 *              cross an edge or meet a vertex; any other move is done. Where the hull of a mesh that fills it would not
 *              stay convex, new triangles fill it.
 *   flip       Needs two triangles that make a strictly convex quadrilateral. Ends keeping the mesh Delaunay, unless four points lie on a
 *              circle.
 *   constrain  May not cross a constraint, nor leave the mesh. Vertices on the way part it.
 *   release    All of the way has to be constraints, none of it border.
 * While the mesh is kept Delaunay, edges that are no longer so are flipped, exactly [Lawson 1977]; constraints and border stay. An edit
 * takes time in proportion to the triangles it touches: about six for spread points. To insert, the place is located first,
 * from where the edit before was if that is near, else by the locator's guide.
 * MW_ERROR_INPUT: any of the above, with the vertex or triangle in the way; a place that is not finite or outside of a mesh that does not
 * fill its hull; a vertex that is not there, or that no triangle has; nothing would be left. MW_ERROR_LIMIT: no more numbers before
 * mw_editor_compact; MW_ERROR_MEMORY; MW_ERROR_ARGUMENT: NULL, an unknown kind or field. */
MW_API mw_status mw_edit_apply(mw_editor *editor, const mw_edit *edit, mw_change *change, mw_error *error);

/* The same, each kind by itself. */
MW_API mw_status mw_edit_insert(mw_editor *editor, double x, double y, mw_change *change, mw_error *error);
MW_API mw_status mw_edit_remove(mw_editor *editor, uint32_t vertex, mw_change *change, mw_error *error);
MW_API mw_status mw_edit_move(mw_editor *editor, uint32_t vertex, double x, double y, mw_change *change,
                              mw_error *error);
MW_API mw_status mw_edit_flip(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change, mw_error *error);
MW_API mw_status mw_edit_constrain(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change, mw_error *error);
MW_API mw_status mw_edit_release(mw_editor *editor, uint32_t from, uint32_t to, mw_change *change, mw_error *error);
MW_API mw_status mw_edit_value(mw_editor *editor, uint32_t field, uint32_t vertex, double value, mw_error *error);

/* Insert n points as one edit, quicker than one by one. They go in in the order in which they come where that is along a curve, each near the
 * one before, and along a Hilbert curve otherwise; mesh and numbers are those that insertions in that order lead to. It is one edit to undo,
 * and n in the log. Fields are interpolated. Quickest where nobody asks what changed: `change` NULL, no undo, no index but the guide.
 *   points    x and y of each, `stride` doubles from one to the next (0: 2)
 *   vertices  NULL, or n numbers: the vertex at each point
 * change->vertex is the first of the new vertices, which have numbers one after another; MW_NONE if there was a vertex at each point. If
 * any point cannot be inserted nothing has changed, and the error tells one; `vertices` are undefined then. MW_ERROR_INPUT, MW_ERROR_LIMIT,
 * MW_ERROR_MEMORY as for an insertion; MW_ERROR_ARGUMENT: NULL, or a stride of 1. */
MW_API mw_status mw_edit_insert_points(mw_editor *editor, const double *points, size_t n, size_t stride,
                                       uint32_t *vertices, mw_change *change, mw_error *error);

/* Take back the last edit that is not: everything is as it was before it, numbers too. `change` tells what that changed.
 * MW_ERROR_INPUT: there is none, or none kept (options.undo). MW_ERROR_MEMORY: nothing has changed. */
MW_API mw_status mw_edit_undo(mw_editor *editor, mw_change *change, mw_error *error);

/* The edits since the editor was made or compacted, those that were undone left out: applied in this order to the same mesh
 * they give the same one, numbers too. NULL and 0 without options.log. Owned by the editor, until its next edit. */
MW_API const mw_edit *mw_editor_log(const mw_editor *editor, size_t *count);

/* Number everything anew, without gaps and in the same order, and lay it out in memory along a curve. Undo and log begin anew;
 * cursors and indices stay valid, though cursors begin elsewhere; holes are numbered anew. O(n). triangles, vertices: NULL, or arrays of as many numbers as
 * the ranges below: the new one of each, MW_NONE for those that are gone. MW_ERROR_MEMORY: nothing has changed. */
MW_API mw_status mw_editor_compact(mw_editor *editor, uint32_t *triangles, uint32_t *vertices, mw_error *error);

/* --- what is there now ------------------------------------------------------------------------------------------------ */

typedef struct mw_editor_info {
    uint32_t vertices, triangles;          /* that are there                                                      */
    uint32_t vertex_range, triangle_range; /* all numbers are below these                                         */
    uint32_t constrained_edges;            /* edges that are fixed, but for the border                            */
    int delaunay;                          /* 1: the mesh is kept Delaunay                                        */
    int convex;                            /* 1: it fills its convex hull, which grows and shrinks; 0: its border is
                                              fixed. Decided when the editor is made                              */
    size_t undoable;                       /* edits that can be undone                                            */
    size_t bytes;                          /* memory in use by the editor                                           */
    size_t undo_bytes;                     /* of it, for undo and the log                                         */
    size_t index_bytes;                    /* of it, of indices and the locator's guide                           */
    uint64_t edits;                        /* carried out since the editor was made, those undone too             */
    uint64_t refreshes;                    /* times an index or the guide was built anew                          */
    uint32_t reserved[8];
} mw_editor_info;
MW_API void mw_editor_describe(const mw_editor *editor, mw_editor_info *info);

/* The vertices of a triangle, counter-clockwise unless the caller's mesh had it clockwise; the place of a vertex. 0: there is none of
 * that number (any more), and nothing is written; else 1. */
MW_API int mw_editor_triangle(const mw_editor *editor, uint32_t triangle, uint32_t vertices[3]);
MW_API int mw_editor_vertex(const mw_editor *editor, uint32_t vertex, double point[2]);

/* The lowest triangle that has a vertex; MW_NONE if no triangle has. */
MW_API uint32_t mw_editor_triangle_of(const mw_editor *editor, uint32_t vertex);

/* The vertices joined to one by an edge, counter-clockwise round it; on a border from the first to the last. Writes at most
 * `capacity` of them and returns how many there are; 0 for a vertex that is not there or in no triangle. */
MW_API size_t mw_editor_adjacent_vertices(const mw_editor *editor, uint32_t vertex, uint32_t *neighbours,
                                          size_t capacity);

typedef enum mw_edge_kind {
    MW_EDGE_NONE = 0,      /* no edge of the mesh */
    MW_EDGE_UNCONSTRAINED, /* an inner edge that may be flipped away */
    MW_EDGE_CONSTRAINED,
    MW_EDGE_BORDER
} mw_edge_kind;

/* What kind of edge joins two vertices. */
MW_API mw_edge_kind mw_editor_edge(const mw_editor *editor, uint32_t from, uint32_t to);

/* The number of a field of the mesh by its name, MW_NONE if there is none. Its value at a vertex; NaN for a vertex that is not there.
 * Linear interpolation of a field as mw_interpolate does it. */
MW_API uint32_t mw_editor_field_by_name(const mw_editor *editor, const char *name);
MW_API double mw_editor_value(const mw_editor *editor, uint32_t field, uint32_t vertex);
MW_API void mw_editor_interpolate(const mw_editor *editor, uint32_t field, const mw_location *locations, size_t n,
                                  double *result);

/* A mesh of what is there now, numbered as by mw_editor_compact, with the fields; owned by the caller. triangles, vertices: as there.
 * Vertices that no triangle has stay. MW_ERROR_MEMORY. */
MW_API mw_status mw_editor_mesh(const mw_editor *editor, uint32_t *triangles, uint32_t *vertices, mw_mesh **out,
                                mw_error *error);

/* The constraints that are there now, two vertices each, released by the caller with free(); NULL when out of memory. */
MW_API uint32_t *mw_editor_constrained_edges(const mw_editor *editor, size_t *count);

/* --- location in between ---------------------------------------------------------------------------------------------- */

/* The locator of what is there now: the same one as long as the editor lives. Its cursors survive edits: one whose triangle
 * is gone begins at one that took its place. Pockets and holes are filled; their numbers stay until mw_editor_compact. It has no border index and
 * no stored areas. The triangle of a location is a number of the editor's. */
MW_API const mw_locator *mw_editor_locator(const mw_editor *editor);

/* Build an index (mw_index_create), or build it anew. The editor owns it and keeps it up: grids and layers follow
 * each edit at O(1) expected, and are built anew when there are twice as many vertices as when they were built, or half; for
 * layers [Devillers 2002] a new vertex rises with the same chance as at first, and one that goes leaves all layers.
 * MW_START_CURVE is built anew only here: after edits it leads less near. The locator's own guide is built anew when there are three times
 * as many vertices, or half, or a quarter as many outside the extent of that time, and after two insertions for every vertex, other edits
 * counting twice. *index stays valid until the editor is destroyed; there is one for each start.
 * Options as for mw_index_create, NULL = all zero. Errors as there. */
MW_API mw_status mw_editor_index(mw_editor *editor, mw_start_kind start, const mw_index_options *options,
                                 const mw_index **index, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
