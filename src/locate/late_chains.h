/* late_chains.h - chains for all tiles, made when long walks have cost as much as making them.
 * Private.
 *
 * No sample of walks tells of every mesh whether its guide leads near everywhere. So walks that get
 * long are paid for as they come: what they visit is added up. When the sum has come to what it
 * costs to make chains for all tiles, the thread whose walk did that makes them; the others walk on
 * meanwhile, and nobody waits. From then on chains end long walks. Queries that are not long read
 * and write nothing here. */
#ifndef MW_SRC_LOCATE_LATE_CHAINS_H
#define MW_SRC_LOCATE_LATE_CHAINS_H

#include "start/chains.h"

#include <stdatomic.h>

/* Changed by queries: a locator, which is const there, has a pointer to it. */
typedef struct mw_late_chains {
    atomic_uint_fast64_t owed;        /* tiles that long walks have visited                 */
    mw_chains made;                   /* written by one thread, before it is published      */
    _Atomic(const mw_chains *) ready; /* NULL, or &made: written once, and never taken back */
} mw_late_chains;

/* All zero; NULL when out of memory. */
mw_late_chains *mw__late_chains_create(void);
/* NULL is allowed. */
void mw__late_chains_destroy(mw_late_chains *late);

/* The chains if they are made; else NULL, as for NULL. */
static inline const mw_chains *mw__late_chains_ready(const mw_late_chains *late)
{
    return late ? atomic_load_explicit(&late->ready, memory_order_acquire) : NULL;
}

/* A long walk has visited so many tiles beyond its limit. If long walks have thereby visited
 * enough, chains are made, in this call. If memory lacks, that is not tried again. NULL is
 * allowed. */
void mw__late_chains_owe(mw_late_chains *late, const mw_tiling *tiling, uint64_t tiles);

/* Of the chains; 0 if there are none yet. */
size_t mw__late_chains_bytes(const mw_late_chains *late);

#endif
