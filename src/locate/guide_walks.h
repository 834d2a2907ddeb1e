/* guide_walks.h - how far a guide leads: walks to a sample of points, measured, and chains for the
 * few tiles to which it leads far. Private. */
#ifndef MW_SRC_LOCATE_GUIDE_WALKS_H
#define MW_SRC_LOCATE_GUIDE_WALKS_H

#include "base/job.h"
#include "locate/index.h"

/* A tiling with a guide, and how walks go on from there. */
typedef struct mw_guided {
    const mw_tiling *tiling;
    const mw_index *guide;
    mw_walk_kind walk;
    uint32_t threads; /* for making what is needed */
} mw_guided;

/* A query by chains takes as long as a walk over so many tiles. */
#define MW_CHAINS_WALK 24

/* How many tiles a walk from the guide visits on average, of walks to the middles of up to 256
 * tiles all over the mesh. A long one counts as if chains ended it, which they do if there are
 * more. */
double mw__guide_mean_walk(const mw_guided *guided);

/* Look for long walks from the guide, one for each 256 tiles, and make chains for the tiles that
 * they lead to and those round them: *fallback, which stays empty if there are none. A part of the
 * job. Returns false when out of memory, or cancelled. */
bool mw__guide_make_fallback(const mw_guided *guided, mw_job *job, mw_index *fallback);

#endif
