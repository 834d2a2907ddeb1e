/* hub_table.h - the triangles round the hubs of an edited tiling, lowest first. Private.
 *
 * A hub is a vertex of very many tiles. Going round it to find its lowest triangle would take a
 * query time proportional to its degree. So a binary heap holds the numbers of its triangles. The
 * heap may also hold numbers of removed triangles, but its first number is always that of an
 * existing one. */
#ifndef MW_SRC_TILING_HUB_TABLE_H
#define MW_SRC_TILING_HUB_TABLE_H

#include "base/base.h"

typedef struct mw_hub {
    uint32_t vertex;  /* slot; MW_NONE: this place of the table is empty                  */
    uint32_t count;   /* of the numbers; 0: unknown, go round                             */
    uint32_t room;    /* for so many                                                      */
    uint32_t fresh;   /* of them when the heap was made                                   */
    bool lost;        /* memory ran out: the hub is no longer followed                    */
    uint32_t *number; /* a heap: number[i] is not above number[2 i + 1] and number[2 i + 2] */
} mw_hub;

typedef struct mw_hub_table {
    mw_hub *hub; /* mask + 1 places, at least half of them empty; NULL without hubs */
    uint32_t mask, count;
} mw_hub_table;

/* The place of vertex v, or the empty one where it would go. The table has places. */
static inline mw_hub *mw__hub_place(const mw_hub_table *table, uint32_t v)
{
    uint32_t at = v * UINT32_C(2654435769) >> 7;
    while (table->hub[at & table->mask].vertex != v &&
           table->hub[at & table->mask].vertex != MW_NONE)
        at++;
    return &table->hub[at & table->mask];
}

/* The hub at vertex v; NULL if none is known. */
static inline mw_hub *mw__hub_find(const mw_hub_table *table, uint32_t v)
{
    if (!table || table->count == 0) return NULL;
    mw_hub *hub = mw__hub_place(table, v);
    return hub->vertex == v ? hub : NULL;
}

#endif
