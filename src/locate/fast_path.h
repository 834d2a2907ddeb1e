/* fast_path.h - the fast path of queries: which may take it, and the answer at its end. Private.
 *
 * Nearly every query walks over a few tiles and ends inside a triangle of the user's, and rounded
 * areas are sure of each turn. Such a query takes the remembering walk in one of its fast forms:
 * one query by walk/remembering_fast.h (query.c), a batch by walk/remembering_vector.h
 * (interleaved.c). Their last areas are the weights, so that the answer is written at once. Where q
 * is on an edge or nearly so, or the tile is thin, the exact conclusion is tried in the tile where
 * the walk ended. All else goes on from there by the walk of the cursor. */
#ifndef MW_SRC_LOCATE_FAST_PATH_H
#define MW_SRC_LOCATE_FAST_PATH_H

#include "locate/location.h"
#include "walk/remembering_fast.h"

/* May these queries take the fast path? They may if they are exact and not counted, and the tiling
 * has ghosts and no cut triangles. With MW_WALK_AUTO the remembering walk may be tried first,
 * whatever walk the cursor has. */
static MW_INLINE bool mw__has_fast_path(const mw_tiling *tiling, const mw_query_options *options)
{
    return (options->walk == MW_WALK_AUTO || options->walk == MW_WALK_REMEMBERING) &&
           !options->counters && options->arithmetic == MW_EXACT && !tiling->border_loops &&
           !tiling->cut;
}

/* Write the answer of a fast walk that has not ended in one of the user's triangles, but in the
 * ghost `tile` or, if it left, beyond an edge of `tile` on the hull. Returns false if the exact
 * conclusion is needed, or the nearest border edge. */
static MW_INLINE bool mw__fast_path_outside(const mw_tiling *tiling, const mw_cursor *cursor,
                                            const mw_triangle *tile, bool inside, bool left,
                                            mw_location *location)
{
    if (cursor->tolerance > 0 || !tiling->embedding || !(inside || left)) return false;
    mw__location_write_outside(location, inside ? tile->user : 0);
    return true;
}

#endif
