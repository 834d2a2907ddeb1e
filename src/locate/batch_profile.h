/* batch_profile.h - what the queries of a batch have in common: how much of the mesh they touch,
 * and whether they come in a good order already. Only choices of speed are made by it; no answer
 * depends on them. Private. */
#ifndef MW_SRC_LOCATE_BATCH_PROFILE_H
#define MW_SRC_LOCATE_BATCH_PROFILE_H

#include "base/cache.h"
#include "locate/locator.h"

typedef struct mw_queries {
    const double *points;
    size_t n, stride; /* doubles from point to point, at least 2 */
} mw_queries;

/* The smallest cache that holds the tiles and points that queries touch: a core's own, the one that
 * cores share, or none. */
typedef enum mw_cache_level { MW_CACHE_OWN, MW_CACHE_SHARED, MW_CACHE_NONE } mw_cache_level;

/* The same for the whole mesh, and for the part of it that the queries touch. That part is
 * estimated from where a few of the queries lie, and from the size of the tiles that the guide
 * names there. */
mw_cache_level mw__cache_level_of_mesh(const mw_locator *locator, const mw_caches *caches);
mw_cache_level mw__cache_level_of_queries(const mw_locator *locator, const mw_caches *caches,
                                          const mw_queries *queries);

/* Are the queries, on average, so near the ones before them that a walk from there is quicker than
 * the locator's guide? The locator must have a guide. If the answer is no, only a few queries are
 * looked at. */
bool mw__queries_are_dense(const mw_locator *locator, const mw_queries *queries);

/* Do they come in an order in which the walks from one to the next take no longer than if they were
 * sorted, the sort counted? */
bool mw__queries_are_in_order(const mw_locator *locator, const mw_queries *queries);

#endif
