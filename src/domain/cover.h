/* cover.h - how often a mesh covers each part of the plane. Private.
 *
 * The outline of the mesh is forced into a Delaunay triangulation of its places. Crossing an outline edge from its
 * outer side to its inner side enters one more triangle; so the number of triangles over each cell of that
 * triangulation follows by a flood from outside the hull. The mesh is an embedding only if it is 0 or 1 everywhere. */
#ifndef MW_SRC_COVER_H
#define MW_SRC_COVER_H

#include "mesh/defect.h"
#include "domain/outline.h"
#include "triangulate/constrained/segment_insertion.h"

/* A place inside an outline edge. */
typedef struct mw_split {
    uint32_t edge; /* index of the outline edge */
    uint32_t place;
} mw_split;

typedef struct mw_cover {
    const mw_outline *outline;
    mw_triangle *cell; /* vertices are places */
    uint32_t cell_count;
    mw_segment_insertion net; /* the outline in the cells */
    uint32_t *runs;     /* outline edges along piece p: at 2p the one from the lower place to the higher, at 2p + 1 the
                           one that comes back, as indices; MW_NONE if there is none */
    mw_split *split;    /* by outline edge, then along it */
    size_t split_count, split_capacity;
    uint8_t *left_out; /* per triangle: not counted, as an outline edge of its part of the mesh crosses or
                           overlaps another one; NULL if all are counted */
    int32_t *degree;   /* triangles over each cell, those left out not counted */
} mw_cover;

/* Cover the plane with the triangles of an outline that has edges; adds what is wrong to `defects`: crossings,
 * vertices inside edges, edges that lie on one another. MW_ERROR_MEMORY, MW_ERROR_LIMIT; release in either case. */
mw_status mw__cover_create(mw_cover *cover, const mw_outline *outline, mw_defects *defects, mw_error *error);
void mw__cover_release(mw_cover *cover);

/* The outline edge, of those counted, that has its inner side in the cell of this half-edge; the one that has its outer
 * side there; MW_NONE if there is none. */
uint32_t mw__cover_inner(const mw_cover *cover, uint32_t half);
uint32_t mw__cover_outer(const mw_cover *cover, uint32_t half);

#endif
