#include "polygons/polygon_sets.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST_TABLE = 64 };

bool mw__polygon_sets_create(mw_polygon_sets *s)
{
    *s = (mw_polygon_sets){
        .count = 1, .set_room = FIRST_TABLE, .rank_room = FIRST_TABLE, .table_size = FIRST_TABLE};
    /* not NULL, even if no point is inside a polygon */
    s->rank = mw__alloc(s->rank_room, sizeof *s->rank);
    s->first = mw__calloc(s->set_room, sizeof *s->first);
    s->table = mw__calloc(s->table_size, sizeof *s->table);
    return s->first && s->rank && s->table;
}

void mw__polygon_sets_release(mw_polygon_sets *s)
{
    free(s->first);
    free(s->rank);
    free(s->table);
    *s = (mw_polygon_sets){0};
}

void mw__polygon_sets_finish(mw_polygon_sets *s)
{
    free(s->table);
    s->table = NULL;
}

static uint64_t ranks_hash(const uint32_t *rank, size_t count)
{
    uint64_t hash = count;
    for (size_t i = 0; i < count; i++) {
        hash = (hash ^ rank[i]) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 29;
    }
    return hash;
}

/* The entry of a set in the table, or the free one where it belongs. */
static uint32_t *sets_entry(const mw_polygon_sets *s, const uint32_t *rank, size_t count)
{
    size_t at = ranks_hash(rank, count) & (s->table_size - 1);
    for (; s->table[at]; at = (at + 1) & (s->table_size - 1)) {
        uint32_t set = s->table[at];
        if (s->first[set + 1] - s->first[set] == count &&
            memcmp(s->rank + s->first[set], rank, count * sizeof *rank) == 0)
            break;
    }
    return &s->table[at];
}

static bool sets_double_table(mw_polygon_sets *s)
{
    uint32_t *table = mw__calloc(2 * s->table_size, sizeof *table);
    if (!table) return false;
    free(s->table);
    s->table = table;
    s->table_size *= 2;
    for (uint32_t set = 1; set < s->count; set++)
        *sets_entry(s, s->rank + s->first[set], s->first[set + 1] - s->first[set]) = set;
    return true;
}

/* Room for one more set, of `count` ranks at most. */
static bool sets_make_room(mw_polygon_sets *s, size_t count)
{
    if ((size_t)s->count + 2 > s->set_room) {
        size_t *first = mw__realloc(s->first, 2 * s->set_room, sizeof *first);
        if (!first) return false;
        s->first = first;
        s->set_room *= 2;
    }
    size_t wanted = s->first[s->count] + count;
    if (wanted > s->rank_room) {
        uint32_t *rank = mw__realloc(s->rank, 2 * wanted + FIRST_TABLE, sizeof *rank);
        if (!rank) return false;
        s->rank = rank;
        s->rank_room = 2 * wanted + FIRST_TABLE;
    }
    return 2 * (size_t)s->count < s->table_size || sets_double_table(s);
}

/* Write the set that differs from `set` behind the last one. Returns how many ranks it has. */
static size_t sets_write(mw_polygon_sets *s, uint32_t set, const uint32_t *ranks, size_t count)
{
    uint32_t *out = s->rank + s->first[s->count];
    size_t made = 0, i = s->first[set], end = s->first[set + 1];
    for (size_t k = 0; k < count;) {
        size_t same = k;
        while (same < count && ranks[same] == ranks[k]) same++;
        while (i < end && s->rank[i] < ranks[k]) out[made++] = s->rank[i++];
        bool had = i < end && s->rank[i] == ranks[k];
        if (had) i++;
        if (had != ((same - k) % 2 == 1)) out[made++] = ranks[k];
        k = same;
    }
    while (i < end) out[made++] = s->rank[i++];
    return made;
}

uint32_t mw__polygon_sets_toggle(mw_polygon_sets *s, uint32_t set, const uint32_t *ranks,
                                 size_t count)
{
    if (count == 0) return set;
    if (!sets_make_room(s, s->first[set + 1] - s->first[set] + count)) return MW_NONE;
    size_t made = sets_write(s, set, ranks, count);
    if (made == 0) return 0;
    uint32_t *entry = sets_entry(s, s->rank + s->first[s->count], made);
    if (!*entry) {
        s->first[s->count + 1] = s->first[s->count] + made;
        *entry = s->count++;
    }
    return *entry;
}
