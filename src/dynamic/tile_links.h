/* tile_links.h - the smallest changes of a dynamic tiling: add and delete tiles and vertices, set
 * corners and neighbours. Private.
 *
 * Functions that may need memory return false when there is none. The caller then rolls the edit
 * back, even if a change is half done. */
#ifndef MW_SRC_DYNAMIC_TILE_LINKS_H
#define MW_SRC_DYNAMIC_TILE_LINKS_H

#include "dynamic/dynamic_tiling_memory.h"

/* Record a tile in the journal, before the edit changes its corners, its marks, or its neighbour
 * beyond a hull edge. */
static MW_INLINE bool mw__journal_tile(mw_dynamic_tiling *dynamic, uint32_t t)
{
    if (t >= dynamic->journal_below || dynamic->mark[t] & MW_JOURNALED) return true;
    if (MW_UNLIKELY(dynamic->journal_count == dynamic->journal_room) &&
        !mw__journal_room(dynamic, 1))
        return false;
    mw_journal_entry *entry = &dynamic->journal[dynamic->journal_count++];
    entry->slot = t;
    entry->mark = dynamic->mark[t] & MW_FIXED_EDGES;
    entry->tile = dynamic->tiling->tri[t];
    dynamic->mark[t] |= MW_JOURNALED;
    return true;
}

/* Add n ghosts at the end of the array, which has room for them. All have the number `like`. */
void mw__add_ghosts(mw_dynamic_tiling *dynamic, uint32_t like, uint32_t n, uint32_t *tiles);

/* Add n tiles at the end of the array, which has room for them: user tiles with new numbers, or, if
 * `beside` is a ghost, ghosts with its number. The caller sets corners, links and fixed edges. */
static MW_INLINE void mw__add_tiles(mw_dynamic_tiling *dynamic, uint32_t beside, uint32_t n,
                                    uint32_t *tiles)
{
    mw_tiling *tiling = dynamic->tiling;
    if (MW_UNLIKELY(!mw__is_users_tile(dynamic, beside))) {
        mw__add_ghosts(dynamic, tiling->tri[beside].user, n, tiles);
        return;
    }
    uint32_t t = tiling->tri_count, number = tiling->number_count;
    for (const uint32_t *end = tiles + n; tiles < end; t++, number++) {
        *tiles++ = t;
        dynamic->mark[t] &= MW_JOURNALED; /* a recorded tile may have left this slot */
        tiling->tri[t].user = number;
        tiling->tile_of[number] = t;
    }
    tiling->tri_count = t;
    tiling->number_count = number;
}

/* Free the number of a user tile. From now on it leads to the number `heir`. */
void mw__free_number(mw_dynamic_tiling *dynamic, uint32_t t, uint32_t heir);

/* Delete tiles from the array. Each has been recorded and is no neighbour of a tile. Sorts the
 * list. */
bool mw__drop_tiles(mw_dynamic_tiling *dynamic, uint32_t *tiles, size_t count);

/* Add a vertex at q, with a new number. There is room for it. */
static MW_INLINE uint32_t mw__add_vertex(mw_dynamic_tiling *dynamic, mw_point q)
{
    mw_tiling *tiling = dynamic->tiling;
    uint32_t v =
        dynamic->free_count > 0 ? dynamic->free_slot[--dynamic->free_count] : tiling->point_count++;
    tiling->point[v] = q;
    tiling->tile_at[v] = MW_NONE;
    dynamic->vertex_number[v] = dynamic->vertex_count;
    dynamic->vertex_slot[dynamic->vertex_count++] = v;
    return v;
}

/* Delete a vertex that has no tile left. False when out of memory. */
bool mw__free_vertex(mw_dynamic_tiling *dynamic, uint32_t vertex);

/* Make the half-edges `half` and `beyond` neighbours. `beyond` may be MW_NONE. */
static MW_INLINE void mw__attach(mw_dynamic_tiling *dynamic, uint32_t half, uint32_t beyond)
{
    mw_triangle *tri = dynamic->tiling->tri;
    tri[mw__link_triangle(half)].link[mw__link_edge(half)] = beyond;
    if (beyond != MW_NONE) tri[mw__link_triangle(beyond)].link[mw__link_edge(beyond)] = half;
}

static MW_INLINE void mw__set_corners(mw_dynamic_tiling *dynamic, uint32_t t, uint32_t a,
                                      uint32_t b, uint32_t c)
{
    mw_triangle *tile = &dynamic->tiling->tri[t];
    uint32_t *tile_at = dynamic->tiling->tile_at;
    tile->v[0] = tile->v[3] = a;
    tile->v[1] = b;
    tile->v[2] = c;
    tile->user &= ~MW_REVERSED;
    tile_at[a] = tile_at[b] = tile_at[c] = t;
}

/* Set which edges of a tile are fixed (bit k: edge k). */
static MW_INLINE void mw__set_fixed(mw_dynamic_tiling *dynamic, uint32_t t, uint32_t edges)
{
    dynamic->mark[t] = (uint8_t)((dynamic->mark[t] & ~MW_FIXED_EDGES) | edges);
}

#endif
