/* tile_holes.h - which hole of the whole mesh a hole of some of its triangles is. Private. */
#ifndef MW_SRC_PREPARED_TILES_TILE_HOLES_H
#define MW_SRC_PREPARED_TILES_TILE_HOLES_H

#include "base/base.h"

#include <meshwalk/locate.h>

typedef struct mw_tile_holes {
    int64_t *number; /* of each hole in the whole mesh; -1: it is none there */
    size_t count;
} mw_tile_holes;

/* Match holes by the lowest triangle at each and its edge there: `triangles` are the numbers in the
 * whole mesh of those of the part. MW_ERROR_MEMORY. Release in either case. O(n log n). */
mw_status mw__tile_holes_match(mw_tile_holes *holes, const mw_locator *whole,
                               const mw_locator *part, const uint32_t *triangles, mw_error *error);
void mw__tile_holes_release(mw_tile_holes *holes);

#endif
