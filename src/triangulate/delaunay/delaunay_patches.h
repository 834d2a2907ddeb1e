/* delaunay_patches.h - the plane is cut into patches, which are triangulated one by one, and
 * merged. Private. */
#ifndef MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_PATCHES_H
#define MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_PATCHES_H

#include "base/job.h"
#include "mesh/point_order.h"
#include "triangulate/delaunay/delaunay_grow.h"
#include "triangulate/delaunay/insertion_order.h"

/* A range of slots: one that is not cut further, or two halves, which a vertical or a horizontal
 * line separates strictly. */
typedef struct mw_patch {
    uint32_t from, to; /* slots                                                                 */
    uint32_t half;     /* number of the first of two halves that follow each other, MW_NONE: none */
    uint32_t rank;     /* 0 of what has no halves, else one more than the greater of theirs      */
    uint32_t ghost;    /* one of its ghosts; MW_NONE: its slots lie on one line, nothing grew   */
    uint32_t spare;    /* two facets that are free for a merge                                   */
    uint32_t duplicates;
    uint64_t visited;
} mw_patch;

typedef struct mw_patches {
    mw_patch *patch; /* patch 0 is the whole */
    uint32_t count, room;
} mw_patches;

/* Cut the slots, whose keys are sorted along the curve, until no patch has more than `most` of
 * them; a patch of equal points may. Spoils the keys. Returns false when out of memory; either way
 * release with free(patches->patch). */
bool mw__patches_cut(mw_patches *patches, const mw_point *points, mw_key *keys, uint32_t n,
                     uint32_t most);

/* What all patches grow from and into: slot i holds point[i], which is the user's point order[i].
 * Of equal points one is the vertex, with the lowest number; the others hold, instead of
 * coordinates, their twin: the slot of that vertex. */
typedef struct mw_patch_arrays {
    mw_point *point;
    uint32_t *order;
    uint32_t *sequence; /* scratch, one for each slot */
    /* two for each slot; those that remain unused are ghosts of nothing but infinity */
    mw_facet *facet;
    uint32_t n;
    double width, height, unit; /* as for mw__grow_prepare */
} mw_patch_arrays;

/* Grow and merge all patches. Where all points lie on one line no facet is made, and the ghost of
 * patch 0 is MW_NONE. Stages of the present part of the job. Returns false if it is cancelled. */
bool mw__patches_grow(mw_patches *patches, const mw_patch_arrays *arrays, mw_job *job);

/* Does the slot hold no vertex, but a point equal to that of slot `twin`? */
static inline bool mw__get_twin(mw_point point, uint32_t *twin)
{
    if (!isnan(point.x)) return false;
    *twin = (uint32_t)point.y;
    return true;
}

#endif
