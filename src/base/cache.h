/* cache.h - how large the caches of the processor are. Private. */
#ifndef MW_SRC_BASE_CACHE_H
#define MW_SRC_BASE_CACHE_H

#include "base/base.h"

typedef struct mw_caches {
    /* bytes of a core's own second-level cache */
    size_t second;
    /* bytes that are near as a rule: what a core has of the caches, those it shares counted */
    size_t reach;
} mw_caches;

/* What the system says, common sizes where it says nothing. Takes 20 ns. */
mw_caches mw__caches(void);

#endif
