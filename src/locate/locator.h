/* locator.h - what a locator holds, and which of its tiles are near a query. Private. */
#ifndef MW_SRC_LOCATE_LOCATOR_H
#define MW_SRC_LOCATE_LOCATOR_H

#include "tiling/tiling.h"
#include "base/job.h"
#include "locate/border_tree.h"
#include "locate/index.h"
#include "locate/late_chains.h"
#include "start/start.h"
#include "walk/walk.h"

#include <meshwalk/locate.h>

struct mw_locator {
    const mw_mesh *mesh;
    mw_tiling tiling;
    mw_border_tree border_tree; /* edge_count 0 and no boxes without options.border */
    double low[2], high[2];     /* extent of the tiling                             */
    /* 1, or a power of two by which the fast path multiplies differences of coordinates, where
     * their products would leave the doubles */
    double scale;
    /* The guide, with which queries begin by default; MW_START_AUTO: there is none. */
    mw_index guide;
    /* Chains for the few tiles that the guide leads far to, or for all, which end long walks;
     * MW_START_AUTO: there are none. */
    mw_index fallback;
    /* A tile within this squared distance is expected to be nearer than any of a sample. */
    double near2;
    /* The same for a guide: the area of one of its cells, as if it were a grid without refined
     * cells. */
    double cell2;
    /* Tiles that a straight line is expected to cross, per unit of its length. */
    double crossings_per_length;
    mw_walk_kind auto_walk; /* what MW_WALK_AUTO means here        */
    mw_walk_kind finish;    /* what ends the cheap walks           */
    uint32_t centre;        /* name of the tile in the middle      */
    bool has_border;        /* was the border tree built?          */
    /* Raised by each edit of the mesh, its upper half where triangles get other names; else 0. */
    uint64_t epoch;
    /* for a mesh that is no embedding: the promise that does not hold; else empty */
    char promise[640];
    uint32_t threads; /* of the options, for its indices */
    /* What long walks cost, and the chains that they may come to; NULL: the guide is chains, or
     * there can be none, or they are not wanted. */
    mw_late_chains *late;
};

/* Look at the tiling and fill in what follows from it: extent, density, default walks, the tile in
 * the middle. Steps of the present stage; if the job is cancelled, some of it is missing. */
void mw__locator_measure(mw_locator *locator, mw_job *job);

/* Set only what follows from the extent and the number of tiles. */
void mw__locator_scale(mw_locator *locator);

/* Let long walks lead to chains, where chains are possible. False when out of memory. */
bool mw__locator_allow_late_chains(mw_locator *locator);

/* Build the guide of a locator that has been measured. False when out of memory, or
 * cancelled; it may be released in either case. Stages of the present part of the job. */
bool mw__locator_guide(const mw_locator *locator, mw_job *job, mw_index *guide);

/* Does q lie within a few lengths of the shortest edge of tile t? Then a guide would hardly lead
 * nearer. The longest edge would be a bad measure, because many small tiles may lie next to it. A
 * tile as large as a cell, as along the hull, does not count as near. */
static MW_INLINE bool mw__locator_is_close(const mw_locator *locator, uint32_t t, mw_point q)
{
    enum { LENGTHS = 3 };
    const mw_tiling *tiling = &locator->tiling;
    const uint32_t *v = tiling->tri[t].v;
    mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    double ab = mw__distance2(a, b), bc = mw__distance2(b, c), ca = mw__distance2(c, a);
    double least = ab < bc ? ab : bc, shortest = least < ca ? least : ca, far = mw__distance2(a, q);
    /* if squares under- or overflow, the comparisons are false */
    return far < LENGTHS * LENGTHS * shortest && far < locator->cell2;
}

/* The tile to begin in if there is a guide: `last`, if q is close to it, else the guide's. */
static MW_INLINE uint32_t mw__locator_guided_tile(const mw_locator *locator, uint32_t last,
                                                  mw_point q)
{
    return mw__locator_is_close(locator, last, q)
               ? last
               : mw__index_tile(&locator->tiling, &locator->guide, q);
}

#endif
