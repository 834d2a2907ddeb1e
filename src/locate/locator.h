/* locator.h - what a locator holds, and which of its tiles are near a query. Private. */
#ifndef MW_SRC_LOCATOR_H
#define MW_SRC_LOCATOR_H

#include "tiling/tiling.h"
#include "locate/border_tree.h"
#include "locate/index.h"
#include "start/start.h"
#include "walk/walk.h"

#include <meshwalk/locate.h>

struct mw_locator {
    const mw_mesh *mesh;
    mw_tiling tiling;
    mw_border_tree border_tree;  /* edge_count 0 and no boxes without options.border */
    double low[2], high[2];      /* extent of the tiling                                                    */
    mw_index guide;              /* how queries begin where nothing is said; start MW_START_AUTO: there is none */
    double near2;                /* a tile within this squared distance beats a sample, by expectation      */
    double cell2;                /* the same of a guide: the area of one of its cells, if it were a grid, not refined */
    double crossings_per_length; /* tiles that a straight line crosses per unit of length, by expectation   */
    mw_walk_kind auto_walk;      /* what MW_WALK_AUTO means here */
    mw_walk_kind finish;         /* what ends the cheap walks    */
    uint32_t centre;             /* name of the tile in the middle                                           */
    bool has_border;
    uint64_t epoch;    /* raised by each edit of the mesh, its upper half where triangles get other names; else 0 */
    char promise[640]; /* which promise is void; empty for an embedding                            */
};

/* What a tiling shows, and choices that follow from it: extent, walks, the tile in the middle, density. */
void mw__locator_measure(mw_locator *locator);

/* The guide of a locator that has been surveyed. False when out of memory; it may be released in either case. */
bool mw__locator_guide(const mw_locator *locator, mw_index *guide);

/* Does q lie within a few lengths of the shortest edge of tile t? Then hardly any guide leads nearer. A long edge would not
 * tell, as many small tiles may lie beside it; nor does a tile as large as a cell, such as there are along the hull. */
static MW_INLINE bool mw__locator_is_close(const mw_locator *locator, uint32_t t, mw_point q)
{
    enum { LENGTHS = 3 };
    const mw_tiling *tiling = &locator->tiling;
    const uint32_t *v = tiling->tri[t].v;
    mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    double ab = mw__distance2(a, b), bc = mw__distance2(b, c), ca = mw__distance2(c, a);
    double least = ab < bc ? ab : bc, shortest = least < ca ? least : ca, far = mw__distance2(a, q);
    return far <= LENGTHS * LENGTHS * shortest && far <= locator->cell2;
}

/* Where to begin where there is a guide: at tile `last`, if q is close to it. */
static MW_INLINE uint32_t mw__locator_guided_tile(const mw_locator *locator, uint32_t last, mw_point q)
{
    return mw__locator_is_close(locator, last, q) ? last : mw__index_tile(&locator->tiling, &locator->guide, q);
}

#endif
