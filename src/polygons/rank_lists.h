/* rank_lists.h - a list of numbers for each row of a table. Private. */
#ifndef MW_SRC_POLYGONS_RANK_LISTS_H
#define MW_SRC_POLYGONS_RANK_LISTS_H

#include "base/hilbert.h"

/* The list of row i is item[first[i]] .. item[first[i + 1] - 1], ascending. `first` NULL: all are
 * empty. */
typedef struct mw_rank_lists {
    uint32_t *first, *item;
} mw_rank_lists;

/* Entries in any order: `key` is the row, `item` the number. */
typedef struct mw_rank_entries {
    mw_key *entry;
    size_t count, room;
} mw_rank_entries;

/* false when out of memory */
bool mw__rank_entries_add(mw_rank_entries *entries, uint32_t row, uint32_t item);
void mw__rank_entries_release(mw_rank_entries *entries);

/* Make the lists of `rows` rows from the entries, which are sorted. `once`: leave out entries that
 * a list has already. Returns false when out of memory, or if there are 2^32 entries or more;
 * release the lists in either case. */
bool mw__rank_lists_create(mw_rank_lists *lists, mw_rank_entries *entries, uint32_t rows,
                           bool once);
void mw__rank_lists_release(mw_rank_lists *lists);

static inline size_t mw__rank_lists_bytes(const mw_rank_lists *lists, uint32_t rows)
{
    return lists->first ? ((size_t)rows + 1 + lists->first[rows]) * sizeof *lists->first : 0;
}

#endif
