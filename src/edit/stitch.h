/* stitch.h - the smallest changes of a fabric: tiles come, go, get corners and neighbours. Private.
 *
 * Functions that may need memory return false when there is none; the edit is then rolled back, whatever is half done. */
#ifndef MW_SRC_STITCH_H
#define MW_SRC_STITCH_H

#include "edit/fabric_memory.h"

/* Put the record of a tile into the journal of this edit, before its corners, marks or neighbours beyond a hull edge change. */
static MW_INLINE bool mw__journal(mw_fabric *f, uint32_t t)
{
    if (t >= f->journaled || f->mark[t] & MW_JOURNALED) return true;
    if (MW_UNLIKELY(f->before_count == f->before_room) && !mw__journal_room(f, 1)) return false;
    mw_before *before = &f->before[f->before_count++];
    before->place = t;
    before->mark = f->mark[t] & MW_FIXED_EDGES;
    before->tile = f->tiling->tri[t];
    f->mark[t] |= MW_JOURNALED;
    return true;
}

/* n ghosts at the end of the array, for which there is room, all with the same number; as below. */
void mw__add_ghosts(mw_fabric *f, uint32_t like, uint32_t n, uint32_t *tiles);

/* n tiles there, with numbers of their own, or that of the ghost `beside`; corners, links and fixed edges are to be set. */
static MW_INLINE void mw__add_tiles(mw_fabric *f, uint32_t beside, uint32_t n, uint32_t *tiles)
{
    mw_tiling *tiling = f->tiling;
    if (MW_UNLIKELY(!mw__is_users(f, beside))) {
        mw__add_ghosts(f, tiling->tri[beside].user, n, tiles);
        return;
    }
    uint32_t t = tiling->tri_count, number = tiling->number_count;
    for (const uint32_t *end = tiles + n; tiles < end; t++, number++) {
        *tiles++ = t;
        f->mark[t] &= MW_JOURNALED; /* one of the journal may have gone before */
        tiling->tri[t].user = number;
        tiling->tile_of[number] = t;
    }
    tiling->tri_count = t;
    tiling->number_count = number;
}

/* Free the number of a tile of the user's, which leads to another one from here on. */
void mw__free_number(mw_fabric *f, uint32_t t, uint32_t heir);

/* Take tiles out of the array; each has been journaled, and none is anyone's neighbour. Sorts the list. */
bool mw__drop_tiles(mw_fabric *f, uint32_t *tiles, size_t count);

/* A vertex at q, for which there is room, with a number of its own. The place of one that no tile has any more is free. */
static MW_INLINE uint32_t mw__add_vertex(mw_fabric *f, mw_point q)
{
    mw_tiling *tiling = f->tiling;
    uint32_t v = f->free_count > 0 ? f->free_place[--f->free_count] : tiling->point_count++;
    tiling->point[v] = q;
    tiling->tile_at[v] = MW_NONE;
    f->vertex_number[v] = f->vertex_count;
    f->vertex_slot[f->vertex_count++] = v;
    return v;
}

/* Take a vertex out that no tile has any more: its place is free. False when out of memory. */
bool mw__free_vertex(mw_fabric *f, uint32_t vertex);

/* half and `beyond`, which may be MW_NONE, become neighbours. */
static MW_INLINE void mw__attach(mw_fabric *f, uint32_t half, uint32_t beyond)
{
    mw_triangle *tri = f->tiling->tri;
    tri[mw__link_triangle(half)].link[mw__link_edge(half)] = beyond;
    if (beyond != MW_NONE) tri[mw__link_triangle(beyond)].link[mw__link_edge(beyond)] = half;
}

static MW_INLINE void mw__set_corners(mw_fabric *f, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
    mw_triangle *tile = &f->tiling->tri[t];
    uint32_t *tile_at = f->tiling->tile_at;
    tile->v[0] = tile->v[3] = a;
    tile->v[1] = b;
    tile->v[2] = c;
    tile->user &= ~MW_REVERSED;
    tile_at[a] = tile_at[b] = tile_at[c] = t;
}

/* The three edges of a tile: fixed (bit k) or not. */
static MW_INLINE void mw__set_fixed(mw_fabric *f, uint32_t t, uint32_t edges)
{
    f->mark[t] = (uint8_t)((f->mark[t] & ~MW_FIXED_EDGES) | edges);
}

#endif
