/* dynamic_tiling_memory.h - create, grow and release a dynamic tiling. Private.
 *
 * Arrays grow to twice their size, so n additions copy O(n) in all. Functions that ask for room
 * return false when there is none, and then nothing has changed. */
#ifndef MW_SRC_DYNAMIC_DYNAMIC_TILING_MEMORY_H
#define MW_SRC_DYNAMIC_DYNAMIC_TILING_MEMORY_H

#include "dynamic/dynamic_tiling.h"

/* Take over the arrays of a tiling; arrays borrowed from `mesh` are copied. `mesh` gives the
 * numbers of vertices. `convex`: the mesh fills its hull, which follows the edits; else the border
 * is fixed, even where it happens to be convex. Fixes the border's edges. MW_ERROR_INPUT:
 * coincident vertices, or triangles that the tiling cut; MW_ERROR_MEMORY. Release in either case,
 * before the tiling. */
mw_status mw__dynamic_create(mw_dynamic_tiling *dynamic, mw_tiling *tiling, const mw_mesh *mesh,
                             bool convex, mw_error *error);
void mw__dynamic_release(mw_dynamic_tiling *dynamic);
/* With room in the tiling that is not used yet, without mw__tiling_bytes. */
size_t mw__dynamic_bytes(const mw_dynamic_tiling *dynamic);

/* Room for n more tiles, and for their numbers if they are user tiles, as tile `beside` is. False
 * when out of memory or numbers. */
bool mw__tile_room_grow(mw_dynamic_tiling *dynamic, size_t n, bool users);
static MW_INLINE bool mw__tile_room(mw_dynamic_tiling *dynamic, uint32_t beside, size_t n)
{
    const mw_tiling *tiling = dynamic->tiling;
    bool room = tiling->tri_count + n <= dynamic->tile_room &&
                tiling->number_count + n <= dynamic->number_room;
    return MW_LIKELY(room) || mw__tile_room_grow(dynamic, n, mw__is_users_tile(dynamic, beside));
}

/* Room for n more vertices and their numbers. False when out of memory or numbers. */
bool mw__vertex_room_grow(mw_dynamic_tiling *dynamic, size_t n);
static MW_INLINE bool mw__vertex_room(mw_dynamic_tiling *dynamic, size_t n)
{
    bool slots = dynamic->tiling->point_count + n <= dynamic->point_room;
    return MW_LIKELY(slots && dynamic->vertex_count + n <= dynamic->vertex_room) ||
           mw__vertex_room_grow(dynamic, n);
}

/* Room for one more free slot of a vertex. */
bool mw__free_slot_room(mw_dynamic_tiling *dynamic);

/* Room for so many more entries of the journal. */
bool mw__journal_room(mw_dynamic_tiling *dynamic, size_t more);

/* Room for so many more numbers on the scratch stack. */
bool mw__stack_room(mw_dynamic_tiling *dynamic, size_t more);

/* Push a half-edge onto the stack. */
static MW_INLINE bool mw__stack_push(mw_dynamic_tiling *dynamic, uint32_t half)
{
    if (MW_UNLIKELY(dynamic->stack_count == dynamic->stack_room) && !mw__stack_room(dynamic, 1))
        return false;
    dynamic->stack[dynamic->stack_count++] = half;
    return true;
}

/* Room for so many steps in dynamic->boundary and dynamic->pending, tiles in dynamic->pool, and
 * twice as many lifted vertices in dynamic->lifted. */
bool mw__boundary_enlarge(mw_dynamic_tiling *dynamic, size_t steps);
static MW_INLINE bool mw__boundary_room(mw_dynamic_tiling *dynamic, size_t steps)
{
    return MW_LIKELY(steps <= dynamic->boundary_room) || mw__boundary_enlarge(dynamic, steps);
}
void mw__boundary_release(mw_dynamic_tiling *dynamic);
size_t mw__boundary_bytes(const mw_dynamic_tiling *dynamic);

/* Release the journal, which is empty, and the scratch arrays. */
void mw__dynamic_trim(mw_dynamic_tiling *dynamic);

#endif
