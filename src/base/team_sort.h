/* team_sort.h - a sort of keys by several threads. Private. */
#ifndef MW_SRC_BASE_TEAM_SORT_H
#define MW_SRC_BASE_TEAM_SORT_H

#include "base/hilbert.h"

/* So many keys, 2 to this, are worth a thread. */
#define MW_TEAM_SORT_BITS 16

/* As mw__sort_keys, by a team (threads.h). */
void mw__sort_keys_in_team(mw_key *keys, mw_key *scratch, size_t n, uint32_t team);

#endif
