/* remembering_corners.h - the remembering walk that keeps what it saw of the corners. Private.
 *
 * Which walk: that of remembering.c, in exact arithmetic.
 *
 * Why it exists: an insertion goes on with the corners of the last tile as seen from the point:
 * with their differences from it, and the squares of these. A step here takes over two corners from
 * the tile before and computes the third. The squares also give the bound of the side tests. And it
 * asks memory for the tiles beyond: the walk goes there next, or the cavity of the insertion grows
 * there. A single query by this step took 1.02 to 1.13 times as long as by remembering_fast.h; an
 * insertion by that one would have to compute the corners anew.
 *
 * Why it takes the same way: all signs are exact. In the first tile it tries the edges in order;
 * later the two edges after that by which it came, in turn, where remembering.c takes the lower one
 * first. If q lies beyond both, the two walks may so part: either way is one of Lawson's walk.
 *
 * Why it ends: on a Delaunay mesh as remembering.c does. Elsewhere it may go in cycles: after
 * MW_CORNER_STEPS tiles the celestial walk takes over, which ends on every embedding. */
#ifndef MW_SRC_WALK_REMEMBERING_CORNERS_H
#define MW_SRC_WALK_REMEMBERING_CORNERS_H

#include "walk/prefetch.h"
#include "walk/lifted.h"
#include "walk/walk.h"

/* Where the walk ended: in `tile`, where q is; or outside, beyond an edge of that tile. */
typedef struct mw_walk_end {
    uint32_t tile, walked;    /* the last one of so many */
    bool inside, on_boundary; /* the tile's own          */
} mw_walk_end;

#define MW_CORNER_STEPS (1 << 16)

/* The same by the celestial walk, from tile t on. */
mw_walk_end mw__corners_surely(const mw_tiling *tiling, mw_point q, uint32_t t,
                               mw_lifted_vertex corner[3]);

/* Walk to q from tile t. corner: those of the last tile, if q is in it or the celestial walk came
 * there. Inline: a call of its own took an insertion a fortieth of its time. */
static MW_INLINE mw_walk_end mw__remembering_corners(const mw_tiling *tiling, mw_point q,
                                                     uint32_t t, mw_lifted_vertex corner[3])
{
    const mw_triangle *tri = tiling->tri;
    uint32_t fuel = MW_CORNER_STEPS, e = 0, exit = MW_NONE;
    mw_lifted_vertex a = mw__lift_vertex(tiling, tri[t].v[0], q),
                     b = mw__lift_vertex(tiling, tri[t].v[1], q),
                     c = mw__lift_vertex(tiling, tri[t].v[2], q);
    double ab = mw__lifted_side(tiling, &a, &b, q), bc = mw__lifted_side(tiling, &b, &c, q),
           ca = mw__lifted_side(tiling, &c, &a, q);
    if (ab < 0) {
        exit = 0, c = a, a = b, b = c;
    } else if (bc < 0) {
        exit = 1, a = c;
    } else if (ca < 0) {
        exit = 2, b = c;
    }
    while (exit != MW_NONE) { /* by an edge from b to a, which in the next tile goes from a to b */
        uint32_t link = tri[t].link[exit];
        if (link == MW_NONE) return (mw_walk_end){.tile = t, .walked = MW_CORNER_STEPS - fuel};
        t = mw__link_triangle(link);
        if (MW_UNLIKELY(fuel-- == 0)) return mw__corners_surely(tiling, q, t, corner);
        e = mw__link_edge(link);
        mw__prefetch_tile(tiling, tri[t].link[mw__next(e)]);
        mw__prefetch_tile(tiling, tri[t].link[mw__prev(e)]);
        c = mw__lift_vertex(tiling, tri[t].v[mw__prev(e)], q);
        exit = MW_NONE;
        ab = 1; /* it came over this edge */
        bc = mw__lifted_side(tiling, &b, &c, q);
        if (bc < 0) {
            exit = mw__next(e), a = c;
            continue;
        }
        ca = mw__lifted_side(tiling, &c, &a, q);
        if (ca < 0) exit = mw__prev(e), b = c;
    }
    corner[e] = a;
    corner[mw__next(e)] = b;
    corner[mw__prev(e)] = c;
    return (mw_walk_end){.tile = t,
                         .walked = MW_CORNER_STEPS - fuel,
                         .inside = true,
                         .on_boundary = ab == 0 || bc == 0 || ca == 0};
}

#endif
