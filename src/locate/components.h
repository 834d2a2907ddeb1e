/* pieces.h - walks in open tilings of several pieces. Private. */
#ifndef MW_SRC_PIECES_H
#define MW_SRC_PIECES_H

#include "locate/locator.h"

/* Let a walk that is about to begin in an open tiling begin in the piece that is likeliest to hold q: where it is, or else
 * one whose box tells more. Where no box holds q the walk ends at once. */
void mw__components_begin(const mw_locator *locator, mw_walk *walk);

/* q is not in the piece of an open tiling where the walk ended: look in the others whose boxes hold it, small ones first.
 * Leaves in *walk where it ended. *hole: where q lies if it is in none; MW_NONE: outside. */
mw_verdict mw__components_search(const mw_tiling *tiling, mw_walk *walk, bool counted, uint32_t *hole);

#endif
