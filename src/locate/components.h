/* components.h - walks in tilings without ghosts, of several connected components. Private. */
#ifndef MW_SRC_LOCATE_COMPONENTS_H
#define MW_SRC_LOCATE_COMPONENTS_H

#include "locate/locator.h"

/* Before a walk in a tiling without ghosts: choose the connected component to begin in. It is the
 * one where the walk is, if its box contains q, else the first one whose box does. If no box
 * contains q, the walk ends at once. */
void mw__components_begin(const mw_locator *locator, mw_walk *walk);

/* q is not in the component where the walk ended: search the other ones whose boxes contain it, in
 * the order of the box tree, small ones first. *walk is left where the last search ended. If q is
 * in none of them, *hole is set to the hole that q lies in, or to MW_NONE if it is outside. */
mw_verdict mw__components_search(const mw_tiling *tiling, mw_walk *walk, bool counted,
                                 uint32_t *hole);

#endif
