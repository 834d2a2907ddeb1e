/* cache.h - how large the caches of the processor are. Private. */
#ifndef MW_SRC_BASE_CACHE_H
#define MW_SRC_BASE_CACHE_H

#include "base/base.h"

typedef struct mw_caches {
    /* bytes of a core's own second-level cache */
    size_t second;
    /* how many bytes a core can expect to find in its caches, its share of shared ones included */
    size_t reach;
} mw_caches;

/* What the system says, common sizes where it says nothing. Takes 20 ns. */
mw_caches mw__caches(void);

#endif
