/* flat_facets.h - flips facets without area away. Private.
 *
 *        x              x         A flat facet b a v, v being its middle vertex, has v inside an
 *       / \            /|\        edge of the facet a b x across. Flipping this edge cuts that
 *      /   \    ->    / | \       facet into a v x and v b x, which both get its number. The flat
 *     a--v--b        a--v--b      facet is gone. So walks and ties only meet facets with an area.
 *                                 That a ray through v also meets a b x follows from its two halves
 *                                 at v. */
#ifndef MW_SRC_STAR_PREPARE_FLAT_FACETS_H
#define MW_SRC_STAR_PREPARE_FLAT_FACETS_H

#include "star/star.h"

/* Remove all facets without area from star->tri, whose facets are oriented. star->coincident tells
 * which vertices coincide. */
void mw__flat_facets_remove(mw_star *star);

#endif
