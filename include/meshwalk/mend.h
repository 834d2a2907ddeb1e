/**
 * @file mend.h
 * Mend the defects of a mesh in arrays, if that needs no guess.
 */
#ifndef MESHWALK_MEND_H
#define MESHWALK_MEND_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What to mend. Add the values of several repairs; they are done in the order of this list. */
typedef enum mw_repair_kind {
    MW_REPAIR_WELD = 1, /**< coincident vertices, or those within the tolerance, become one */
    /** unusable and duplicate triangles are removed; with MW_REPAIR_SPLIT also flat ones */
    MW_REPAIR_DROP = 2,
    MW_REPAIR_SPLIT = 4, /**< a triangle with another vertex inside a border edge is split there */
    /** clockwise triangles are turned; in space the fewest of each component, so that neighbours
     * agree */
    MW_REPAIR_ORIENT = 8,
    MW_REPAIR_ALL = 15
} mw_repair_kind;

/** Options of mw_mend_arrays(). Zero-initialised options mend everything, exactly, in the plane. */
typedef struct mw_mend_options {
    uint32_t repairs; /**< a sum of mw_repair_kind; 0: MW_REPAIR_ALL */
    uint32_t space;   /**< 1: a surface in space, of x, y, z; 0: a mesh in the plane, of x, y */
    /** Vertices at most this far from each other are welded, and a vertex at most this far from a
     * border edge splits it. 0: only equal vertices, and vertices exactly on an edge. Finite and
     * not negative. */
    double tolerance;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[6];
} mw_mend_options;

/** What was done to a vertex or a triangle. */
typedef enum mw_mend_change_kind {
    MW_MEND_WELDED = 0,        /**< `vertex` became `other`, a lower number */
    MW_MEND_DROPPED_MISSING,   /**< `triangle` named `vertex`, which does not exist */
    MW_MEND_DROPPED_INFINITE,  /**< `vertex` of `triangle` had a coordinate that is not finite */
    MW_MEND_DROPPED_REPEATED,  /**< `triangle` had `vertex` twice, maybe after welding */
    MW_MEND_DROPPED_DUPLICATE, /**< `triangle` had the same vertices as `other` */
    MW_MEND_DROPPED_FLAT,      /**< `triangle` had no area */
    MW_MEND_SPLIT,             /**< `triangle` was split at `vertex` inside one of its edges */
    MW_MEND_TURNED,            /**< the last two vertices of `triangle` were exchanged */
    MW_MEND_CHANGE_COUNT
} mw_mend_change_kind;

/** One change. Numbers are those of the given arrays; members that do not apply are MW_NONE. */
typedef struct mw_mend_change {
    mw_mend_change_kind kind;
    uint32_t triangle, vertex, other;
} mw_mend_change;

/** A mended mesh, and what was changed. Owned by the caller: release with mw_mended_release(). */
typedef struct mw_mended {
    uint32_t *triangles; /**< 3 per triangle: new vertex numbers */
    size_t triangle_count;
    size_t vertex_count;
    uint32_t *vertex_from; /**< per new vertex its old number: use it to copy values */
    /** per old vertex its new number, or that of the vertex it was welded to */
    uint32_t *vertex_to;
    uint32_t *triangle_from; /**< per new triangle the old one that it is or was part of */
    mw_mend_change *changes; /**< in the order of the repairs, then of the numbers */
    size_t change_count;
} mw_mended;

/**
 * Mend the mesh in `arrays`: weld vertices, drop triangles, split and turn them.
 *
 * No vertex moves and none is added. Welded vertices disappear; the remaining vertices and
 * triangles keep their order. The parts of a split triangle take its place. With tolerance 0 every
 * repair is exact: the mesh covers the same part of the plane as before, except where vertices of
 * different height are welded.
 *
 * With a tolerance, vertices are visited by number. A vertex is kept if no kept vertex lies within
 * the tolerance; else it is welded to the lowest such vertex.
 *
 * Overlaps, crossing edges and edges of three triangles cannot be mended and stay;
 * mw_check_arrays() names them. With tolerance 0, mending a mended mesh changes nothing.
 *
 * @param arrays   the mesh, with any defects; for a surface a stride of 0 means 3
 * @param options  NULL selects the defaults
 * @param mended   receives the mended mesh; empty on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK, also if defects remain; MW_ERROR_INPUT: a triangle names a vertex that does not
 *         exist, and MW_REPAIR_DROP was not requested; MW_ERROR_ARGUMENT, MW_ERROR_LIMIT,
 *         MW_ERROR_MEMORY, MW_CANCELLED
 *
 * Thread-safe. Time O(n log n) if few vertices lie in the bounding box of a border edge without
 * being near it.
 */
MW_API mw_status mw_mend_arrays(const mw_arrays *arrays, const mw_mend_options *options,
                                mw_mended *mended, mw_error *error);
/** Release a mended mesh. NULL and an empty one are allowed. */
MW_API void mw_mended_release(mw_mended *mended);

/**
 * Describe one change in words: "triangle 17: ...".
 *
 * @param change  the change
 * @param text    receives the description, always terminated
 * @param size    room in `text`, in bytes; a longer description is cut off
 *
 * Thread-safe. O(1).
 */
MW_API void mw_mend_change_describe(const mw_mend_change *change, char *text, size_t size);

#ifdef __cplusplus
}
#endif
#endif
