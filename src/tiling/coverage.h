/* coverage.h - how often a mesh covers each part of the plane. Private.
 *
 * The outline of the mesh is forced into a Delaunay triangulation of its nodes. The triangles of
 * this triangulation are the cells. Crossing an outline edge from its outer side to its inner side
 * enters one more triangle. So a flood from outside the hull finds the number of triangles over
 * each cell: its degree, a winding number. The mesh is an embedding only if it is 0 or 1
 * everywhere. */
#ifndef MW_SRC_TILING_COVERAGE_H
#define MW_SRC_TILING_COVERAGE_H

#include "base/job.h"
#include "mesh/defect.h"
#include "tiling/outline.h"
#include "triangulate/constrained/segment_insertion.h"

/* A node inside an outline edge. */
typedef struct mw_split {
    uint32_t edge; /* index of the outline edge */
    uint32_t node;
} mw_split;

typedef struct mw_coverage {
    const mw_outline *outline;
    mw_triangle *cell; /* vertices are nodes */
    uint32_t cell_count;
    mw_segment_insertion net; /* the outline as constraints of the cells */
    /* The outline edges along subsegment p: 2p from the lower node to the higher one, 2p + 1 the
     * way back; MW_NONE: none. */
    uint32_t *edge_along;
    mw_split *split; /* sorted by outline edge, then along it */
    size_t split_count, split_capacity;
    /* Per triangle: not counted, as an outline edge connected to it crosses or overlaps another;
     * NULL: all count. */
    uint8_t *left_out;
    int32_t *degree; /* triangles over each cell, without those left out */
} mw_coverage;

/* Cover the plane with the triangles of an outline that has edges. Adds crossings, vertices inside
 * edges, and edges that lie on one another to `defects`. MW_ERROR_MEMORY (also if cancelled),
 * MW_ERROR_LIMIT. Release in either case. Stages of the present part of the job. */
mw_status mw__coverage_create(mw_coverage *coverage, const mw_outline *outline, mw_job *job,
                              mw_defects *defects, mw_error *error);
void mw__coverage_release(mw_coverage *coverage);

/* The counted outline edge that has its inner side, or its outer side, in the cell of this
 * half-edge; MW_NONE if there is none. */
uint32_t mw__coverage_inner_edge(const mw_coverage *coverage, uint32_t half);
uint32_t mw__coverage_outer_edge(const mw_coverage *coverage, uint32_t half);

#endif
