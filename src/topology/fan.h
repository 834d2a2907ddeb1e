/* fan.h - turning round a vertex through linked triangles of any orientation. Private. */
#ifndef MW_SRC_TOPOLOGY_FAN_H
#define MW_SRC_TOPOLOGY_FAN_H

#include "mesh/mesh.h"
#include "topology/coincident.h"

/* An edge of a triangle and one of its two ends: the corner where the edge starts, or the other
 * one. */
typedef struct mw_edge_end {
    uint32_t half; /* 4 * triangle + edge */
    bool start;
} mw_edge_end;

/* That corner, and the corner at the other end of the edge. */
static MW_INLINE uint32_t mw__near_corner(mw_edge_end e)
{
    return e.start ? mw__link_edge(e.half) : mw__next(mw__link_edge(e.half));
}
static MW_INLINE uint32_t mw__far_corner(mw_edge_end e)
{
    return mw__near_corner((mw_edge_end){e.half, !e.start});
}

/* The other edge of the same triangle at this corner. */
static MW_INLINE mw_edge_end mw__other_edge(mw_edge_end e)
{
    return (mw_edge_end){e.start ? mw__half_prev(e.half) : mw__half_next(e.half), !e.start};
}

static MW_INLINE uint32_t mw__link_of(const mw_triangle *tri, mw_edge_end e)
{
    return tri[mw__link_triangle(e.half)].link[mw__link_edge(e.half)];
}

/* The same edge as an edge of the neighbour, which must exist, and the same end: the same vertex,
 * or one that coincides with it (coincident.h). */
static MW_INLINE mw_edge_end mw__across(const mw_triangle *tri, const uint32_t *coincident,
                                        mw_edge_end e)
{
    uint32_t link = mw__link_of(tri, e),
             vertex = tri[mw__link_triangle(e.half)].v[mw__near_corner(e)];
    uint32_t start = tri[mw__link_triangle(link)].v[mw__link_edge(link)];
    return (mw_edge_end){link, mw__representative(coincident, start) ==
                                   mw__representative(coincident, vertex)};
}

#endif
