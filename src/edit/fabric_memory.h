/* fabric_memory.h - a fabric is made from a tiling, grows, and is released. Private.
 *
 * Arrays grow to twice their size, so that n additions copy O(n) in all. Functions that ask for room
 * return false when there is none; then what was there is as it was. */
#ifndef MW_SRC_FABRIC_MEMORY_H
#define MW_SRC_FABRIC_MEMORY_H

#include "edit/fabric.h"

/* Take the arrays of a tiling, borrowed from `mesh` or its own (borrowed ones are copied); `mesh` gives the numbers of vertices. Border
 * between tiles and ghosts is fixed. MW_ERROR_INPUT: vertices at one place, or triangles cut; MW_ERROR_MEMORY. Release in either case,
 * before the tiling is. */
mw_status mw__fabric_create(mw_fabric *f, mw_tiling *tiling, const mw_mesh *mesh, mw_error *error);
void mw__fabric_release(mw_fabric *f);
size_t mw__fabric_bytes(const mw_fabric *f); /* but for the tiling's own (mw__tiling_bytes)   */

/* Room for n tiles more, and for their numbers if they are the user's, as tile `beside` is. False when out of memory or numbers. */
bool mw__more_tiles(mw_fabric *f, size_t n, bool users);
static MW_INLINE bool mw__tile_room(mw_fabric *f, uint32_t beside, size_t n)
{
    const mw_tiling *tiling = f->tiling;
    bool room = tiling->tri_count + n <= f->tile_room && tiling->number_count + n <= f->number_room;
    return MW_LIKELY(room) || mw__more_tiles(f, n, mw__is_users(f, beside));
}

/* Room for n vertices more, and their numbers. False when out of memory or numbers. */
bool mw__more_vertices(mw_fabric *f, size_t n);
static MW_INLINE bool mw__vertex_room(mw_fabric *f, size_t n)
{
    bool places = f->tiling->point_count + n <= f->point_room;
    return MW_LIKELY(places && f->vertex_count + n <= f->vertex_room) || mw__more_vertices(f, n);
}

/* Room for one more place of a vertex that is gone. */
bool mw__free_place_room(mw_fabric *f);

/* Room for so many records of the journal. */
bool mw__journal_room(mw_fabric *f, size_t more);

/* Room for so many numbers in the scratch stack (beyond its count). */
bool mw__stack_room(mw_fabric *f, size_t more);

/* Put a half-edge onto it. */
static MW_INLINE bool mw__push(mw_fabric *f, uint32_t half)
{
    if (MW_UNLIKELY(f->stack_count == f->stack_room) && !mw__stack_room(f, 1)) return false;
    f->stack[f->stack_count++] = half;
    return true;
}

/* Room for so many steps in f->rim and f->ahead, tiles in f->pool, and twice as many sights. */
bool mw__rim_enlarge(mw_fabric *f, size_t steps);
static MW_INLINE bool mw__rim_room(mw_fabric *f, size_t steps)
{
    return MW_LIKELY(steps <= f->rim_room) || mw__rim_enlarge(f, steps);
}
void mw__rim_release(mw_fabric *f);
size_t mw__rim_bytes(const mw_fabric *f);

/* Release an empty journal, and scratch. */
void mw__fabric_trim(mw_fabric *f);

#endif
