/**
 * @file mend.h
 * Mend what is wrong with the arrays of a mesh, as far as that can be done without a
 * guess.
 */
#ifndef MESHWALK_MEND_H
#define MESHWALK_MEND_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What to mend; add up what is wanted. Carried out in the order of this list. */
typedef enum mw_repair_kind {
    MW_REPAIR_WELD = 1,   /**< coincident vertices, or those within the tolerance, become one */
    MW_REPAIR_DROP = 2,   /**< unusable and duplicate triangles go; flat ones with SPLIT */
    MW_REPAIR_SPLIT = 4,  /**< a triangle with another vertex inside a border edge is split there */
    MW_REPAIR_ORIENT = 8, /**< triangles turn counter-clockwise; in space like their neighbours, so
                               that the fewest of each component are turned */
    MW_REPAIR_ALL = 15
} mw_repair_kind;

/** How a mesh is mended. All zero mends everything, exactly, in the plane. */
typedef struct mw_mend_options {
    uint32_t repairs; /**< a sum of mw_repair_kind; 0: MW_REPAIR_ALL */
    uint32_t space;   /**< 1: a surface in space, of x, y, z; 0: a mesh in the plane, of x, y */
    /** Vertices no farther from each other are welded, and vertices no farther from a border edge
     * split it. 0: only what is equal, and exactly on an edge. Finite and not negative. */
    double tolerance;
    const mw_progress *progress; /**< who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[6];
} mw_mend_options;

/** What was done to a vertex or a triangle. */
typedef enum mw_mend_change_kind {
    MW_MEND_WELDED = 0,        /**< `vertex` became `other`, a lower number */
    MW_MEND_DROPPED_MISSING,   /**< `triangle` named `vertex`, which does not exist */
    MW_MEND_DROPPED_INFINITE,  /**< `vertex` of `triangle` had a coordinate not finite */
    MW_MEND_DROPPED_REPEATED,  /**< `triangle` had `vertex` twice, at least after welding */
    MW_MEND_DROPPED_DUPLICATE, /**< `triangle` had the same vertices as `other` */
    MW_MEND_DROPPED_FLAT,      /**< `triangle` had no area */
    MW_MEND_SPLIT,             /**< `triangle` was split at `vertex`, in one of its edges */
    MW_MEND_TURNED,            /**< the last two vertices of `triangle` were exchanged */
    MW_MEND_CHANGE_COUNT
} mw_mend_change_kind;

/** One change. Numbers are those of the arrays given; fields that do not apply are MW_NONE. */
typedef struct mw_mend_change {
    mw_mend_change_kind kind;
    uint32_t triangle, vertex, other;
} mw_mend_change;

/** A mended mesh, and how it came about. Owned by the caller: release with mw_mended_release. */
typedef struct mw_mended {
    uint32_t *triangles; /**< 3 per triangle: new vertex numbers */
    size_t triangle_count;
    size_t vertex_count;
    uint32_t *vertex_from;   /**< per new vertex its old number, which has its values */
    uint32_t *vertex_to;     /**< per old vertex its new number, or that of what it was welded to */
    uint32_t *triangle_from; /**< per new triangle the old one that it is, or is a part of */
    mw_mend_change *changes; /**< in the order in which they were made, then of numbers */
    size_t change_count;
} mw_mended;

/**
 * Mend the mesh in `arrays`: weld vertices, drop triangles, split and turn them.
 *
 * No vertex moves and none is added. Vertices that are welded to others go, and the remaining
 * vertices and triangles keep their order; the parts of a split triangle follow each other in its
 * place. With the tolerance 0 every repair is exact: except for welded vertices of different
 * height, the mesh covers the same part of the plane as before. With a tolerance, vertices in order
 * of their number are kept unless a kept one lies within the tolerance; then they are welded to the
 * lowest of these. What a repair cannot mend (overlaps, crossing edges, edges of three triangles)
 * stays: mw_check_arrays names it. Mending what was mended changes nothing, with the tolerance 0.
 *
 * @param arrays   the mesh, of any damage; of a surface a stride of 0 means 3
 * @param options  NULL = all zero
 * @param mended   filled in; empty after a failure
 * @param error    filled in after a failure; NULL is allowed
 * @return MW_OK, also if defects remain; MW_ERROR_INPUT: a triangle names a vertex that does not
 * exist, and MW_REPAIR_DROP is not asked for; MW_ERROR_ARGUMENT, MW_ERROR_LIMIT, MW_ERROR_MEMORY,
 * MW_CANCELLED
 *
 * Thread-safe. Time O(n log n), if few vertices lie in the boxes of border edges that they are not
 * near.
 */
MW_API mw_status mw_mend_arrays(const mw_arrays *arrays, const mw_mend_options *options,
                                mw_mended *mended, mw_error *error);
/** Release a mended mesh. @param mended  NULL and an empty one are allowed */
MW_API void mw_mended_release(mw_mended *mended);

/** Write "triangle 17: ..." for one change into text[size], always terminated. Thread-safe. */
MW_API void mw_mend_change_describe(const mw_mend_change *change, char *text, size_t size);

#ifdef __cplusplus
}
#endif
#endif
