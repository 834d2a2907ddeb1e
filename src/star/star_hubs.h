/* star_hubs.h - hubs: vertices of many facets, such as the poles of a globe, with their facets in
 * angular order. Private.
 *
 * A walk that turns round a hub visits its facets one by one. Their order round the hub is an
 * angular one, so a binary search finds the one whose wedge the ray lies in. */
#ifndef MW_SRC_STAR_STAR_HUBS_H
#define MW_SRC_STAR_STAR_HUBS_H

#include "star/star.h"

/* A vertex with fewer facets is not a hub: walking round it takes no longer than the search. */
#define MW_STAR_HUB_FACETS 64u

/* Find the hubs of the star's facets, without their rings. Returns false when out of memory. */
bool mw__star_hubs_create(mw_star_hubs *hubs, const mw_star *star);
void mw__star_hubs_release(mw_star_hubs *hubs);
size_t mw__star_hubs_bytes(const mw_star_hubs *hubs);

/* Collect the rings of all hubs, of a star whose facets are closed. Returns false when out of
 * memory. O(n) */
bool mw__star_hubs_collect(mw_star *star);

/* Facets round a vertex have changed, and now there are `degree`: it may become a hub, or cease to
 * be one; its ring is stale. O(hubs) */
void mw__star_hub_touch(mw_star *star, uint32_t vertex, uint32_t degree);

/* Collect the stale rings, of a star that tracks its facets, which are closed. A hub without memory
 * is given up. O(hubs + facets round stale ones) */
void mw__star_hubs_renew(mw_star *star);

/* The hub that is corner k of a facet; NULL: that corner is none. */
const mw_star_hub *mw__star_hub_at(const mw_star *star, uint32_t facet, uint32_t k);

/* The facet round a hub whose wedge the ray through q lies in. Exact, but the ray may lie beyond
 * the edge opposite to the hub. */
uint32_t mw__star_hub_facet(const mw_star *star, const mw_star_hub *hub, const double q[3]);

#endif
