/* polygon_sets.h - sets of polygons, each stored once and named by a number. Private. */
#ifndef MW_SRC_POLYGONS_POLYGON_SETS_H
#define MW_SRC_POLYGONS_POLYGON_SETS_H

#include "base/base.h"

/* Set i is rank[first[i]] .. rank[first[i + 1] - 1], ascending. Set 0 is empty. */
typedef struct mw_polygon_sets {
    size_t *first;
    uint32_t *rank;
    uint32_t count;
    size_t set_room, rank_room;
    /* open addressing: numbers of sets, 0 = free; only until mw__polygon_sets_finish */
    uint32_t *table;
    size_t table_size; /* a power of two */
} mw_polygon_sets;

/* Begin with the empty set. False when out of memory; release it in either case. */
bool mw__polygon_sets_create(mw_polygon_sets *sets);
void mw__polygon_sets_release(mw_polygon_sets *sets);

/* The set that differs from `set` in the ranks that are listed an odd number of times; the list is
 * ascending. MW_NONE when out of memory. */
uint32_t mw__polygon_sets_toggle(mw_polygon_sets *sets, uint32_t set, const uint32_t *ranks,
                                 size_t count);

/* No more sets will be made: release what only making them needs. */
void mw__polygon_sets_finish(mw_polygon_sets *sets);

#endif
