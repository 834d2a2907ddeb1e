/* flat.h - facets without area are flipped away. Private.
 *
 *        x              x         The middle one v of the three vertices of such a facet b a v lies inside the edge of
 *       / \            /|\        a facet a b x across. Flipping that edge cuts the facet in two, a v x and v b x,
 *      /   \    ->    / | \       which both are marked with its number; the flat one is gone. So walks and ties know
 *     a--v--b        a--v--b      of facets with an area only: that a ray through v also meets a b x follows from the
 *                                 pieces at v. */
#ifndef MW_SRC_FLAT_H
#define MW_SRC_FLAT_H

#include "star/star.h"

/* Take away those among the facets of star->tri, which are oriented, that have no area. star->place tells which
 * vertices are at one place. */
void mw__star_remove_flats(mw_star *star);

#endif
