/* components.h - walks in tilings without ghosts, of several connected components. Private. */
#ifndef MW_SRC_LOCATE_COMPONENTS_H
#define MW_SRC_LOCATE_COMPONENTS_H

#include "locate/locator.h"

/* Before a walk in a tiling without ghosts: choose the component to begin in. That is the one where
 * the walk is, if its box holds q; else the first one whose box does. Where no box holds q the walk
 * ends at once. */
void mw__components_begin(const mw_locator *locator, mw_walk *walk);

/* q is not in the component where the walk ended: look in the other ones whose boxes hold it, in
 * the order of the box tree, small ones first. Leaves in *walk where it ended. *hole: where q lies
 * if it is in none; MW_NONE: outside. */
mw_verdict mw__components_search(const mw_tiling *tiling, mw_walk *walk, bool counted,
                                 uint32_t *hole);

#endif
