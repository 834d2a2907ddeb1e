#include "polygons/rank_lists.h"

#include <stdlib.h>

bool mw__rank_entries_add(mw_rank_entries *e, uint32_t row, uint32_t item)
{
    if (e->count == e->room) {
        size_t room = 2 * e->room + 64;
        mw_key *entry = mw__realloc(e->entry, room, sizeof *entry);
        if (!entry) return false;
        e->entry = entry;
        e->room = room;
    }
    e->entry[e->count++] = (mw_key){row, item};
    return true;
}

void mw__rank_entries_release(mw_rank_entries *e)
{
    free(e->entry);
    *e = (mw_rank_entries){0};
}

static void entries_swap(mw_rank_entries *e)
{
    for (size_t i = 0; i < e->count; i++) e->entry[i] = (mw_key){e->entry[i].item, e->entry[i].key};
}

/* By row, then by number: sorting keeps the order of equal keys. */
static bool entries_sort(mw_rank_entries *e)
{
    mw_key *scratch = mw__alloc(e->count, sizeof *scratch);
    if (!scratch) return false;
    entries_swap(e);
    mw__sort_keys(e->entry, scratch, e->count);
    entries_swap(e);
    mw__sort_keys(e->entry, scratch, e->count);
    free(scratch);
    return true;
}

bool mw__rank_lists_create(mw_rank_lists *lists, mw_rank_entries *e, uint32_t rows, bool once)
{
    *lists = (mw_rank_lists){0};
    if (e->count == 0) return true;
    if (e->count >= MW_NONE || !entries_sort(e)) return false;
    lists->first = mw__calloc((uint64_t)rows + 1, sizeof *lists->first);
    lists->item = mw__alloc(e->count, sizeof *lists->item);
    if (!lists->first || !lists->item) return false;
    uint32_t made = 0, row = 0;
    for (size_t i = 0; i < e->count; i++) {
        mw_key entry = e->entry[i];
        if (once && i > 0 && e->entry[i - 1].key == entry.key && e->entry[i - 1].item == entry.item)
            continue;
        while (row < entry.key) lists->first[++row] = made;
        lists->item[made++] = entry.item;
    }
    while (row < rows) lists->first[++row] = made;
    return true;
}

void mw__rank_lists_release(mw_rank_lists *lists)
{
    free(lists->first);
    free(lists->item);
    *lists = (mw_rank_lists){0};
}
